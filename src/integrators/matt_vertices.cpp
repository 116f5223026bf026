#include "integrators/matt_vertices.hpp"

#include "integrators/weights.hpp"
#include "sampling/hemisphere.hpp"

namespace raytracer {

void MattVertices::add(std::uint32_t path_index, const SurfacePoint& surface, const Vector3f& way) {
  const auto i = static_cast<int>(count++);
  path[i] = path_index;
  position.set(i, surface.position);
  normal.set(i, surface.normal);
  side[i] = glm::dot(surface.normal, -way) > 0 ? 1.0F : -1.0F;
  const Vector3f facing = side[i] * surface.normal;
  lights.from.position.set(i, surface.position);
  lights.normal.set(i, facing);
}

// Into arrays of its own: what could be memory that is read keeps loops from becoming vectors.
void MattVertices::find_light(const LightSamples& samples, Sampling sampling) {
  const bool is_weighted = sampling == Sampling::kBoth, is_delta_only = sampling == Sampling::kMaterials;
  Vector3Block found, from;
  alignas(64) std::uint32_t is_found[kSize];
  for (int i = 0; i < kBlockSize; ++i) {
    const Vector3f facing = side[i] * normal.at(i);
    from.set(i, position.at(i) + offset[i] * facing);
    const Vector3f to_light = samples.direction.at(i);
    const float cosine = glm::dot(facing, to_light), light_pdf = samples.pdf[i];
    const float chosen = cosine_pdf(cosine);  // the density with which the material would have
    const bool is_delta = samples.is_delta[i] != 0;
    const float heuristic = power_heuristic(light_pdf, chosen);
    const float weight = (is_delta | !is_weighted) ? 1.0F : heuristic;
    const Color3f value = color_share(color.at(i)) * chosen;
    const Color3f radiance = samples.radiance.at(i);
    const Color3f result = throughput.at(i) * value * (weight / light_pdf) * radiance;
    found.set(i, result);
    const bool is_some = (result.x > 0) | (result.y > 0) | (result.z > 0);
    is_found[i] = ((cosine > 0) & (light_pdf > 0) & is_some & (is_delta | !is_delta_only)) ? 1 : 0;
  }
  light = found;
  start = from;
  for (int i = 0; i < kBlockSize; ++i) is_lit[i] = is_found[i];
}

void MattVertices::scatter() {
  Vector3Block chosen, rest;
  alignas(64) float density[kSize];
  for (int i = 0; i < kBlockSize; ++i) {
    const Vector3f axis = normal.at(i);
    Vector3f tangent, bitangent;
    complete_frame(axis, tangent, bitangent);
    const Vector3f way = sample_cosine({u[i], v[i]});
    const Vector3f result = way.x * tangent + way.y * bitangent + side[i] * way.z * axis;
    chosen.set(i, result);
    rest.set(i, throughput.at(i) * color_share(color.at(i)));
    const float cosine = side[i] * glm::dot(axis, result);
    density[i] = cosine > 0 ? cosine_pdf(way.z) : 0.0F;
  }
  direction = chosen;
  throughput = rest;
  for (int i = 0; i < kBlockSize; ++i) pdf[i] = density[i];
}

}  // namespace raytracer
