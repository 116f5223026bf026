#include "scene/shining_parts.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "materials/fresnel.hpp"
#include "materials/media.hpp"
#include "scene/shading_point.hpp"
#include "textures/material_at.hpp"

namespace raytracer {
namespace {

bool may_be_there(const Material& material) {
  return material.alpha > 0 || (material.textures && material.textures->alpha);
}

float largest(const Color3f& c) { return std::max({c.x, c.y, c.z}); }

// A cone of directions in an instance's own space, around the way from `from` to `to`, is that much narrower
// in the world: |M w|^3 / |det M| for the unit vector w.
float density_scale(const glm::mat3& to_world, const Vector3f& from, const Vector3f& to) {
  const float stretch = glm::length(to_world * glm::normalize(to - from));
  return stretch * stretch * stretch / std::abs(glm::determinant(to_world));
}

// What a surface between a point and a light lets through, straight on.
Color3f share_through(const MaterialValues& material, float cosine) {
  if (material.transmission == 0) return Color3f(0);
  const float reflected = material.specular * fresnel_dielectric(std::abs(cosine), material.ior).reflectance;
  return (1 - material.metallic) * material.transmission * (1 - reflected) * material.color;
}

// Whether anything in that place may shine or let light pass. Most places are of shapes of which none does.
bool may_matter(const SceneDescription& scene, const Instance& instance, std::vector<std::int8_t>& known) {
  const auto matters = [](const Material& m) { return largest(m.emission) > 0 || lets_light_pass(m); };
  if (instance.material != Instance::kOwnMaterials && matters(scene.materials[instance.material]))
    return true;
  std::int8_t& answer = known[instance.shared];
  if (answer >= 0) return answer != 0;
  const SharedShapes& shared = *scene.shared[instance.shared];
  answer = 0;
  for (std::uint32_t i = 0; i < shared.size() && answer == 0; ++i)
    answer = matters(shared.material_of(i)) ? 1 : 0;
  return answer != 0;
}

}  // namespace

ShiningParts::ShiningParts(const SceneDescription& scene) {
  for (std::size_t i = 0; i < scene.shapes.size(); ++i) {
    add(*scene.shapes[i], scene.materials[scene.material_of[i]], nullptr);
  }
  std::vector<std::int8_t> known(scene.shared.size(), -1);
  for (std::uint32_t place = 0; place < scene.instances.size(); ++place) {
    const Instance& instance = scene.instances[place];
    const SharedShapes& shared = *scene.shared[instance.shared];
    if (!may_matter(scene, instance, known)) continue;
    for (std::uint32_t i = 0; i < shared.size(); ++i) {
      add(shared.shape(i), scene.material(place, i), &instance);
    }
  }
}

void ShiningParts::add(const Shape& shape, const Material& material, const Instance* instance) {
  has_see_through_ = has_see_through_ || lets_light_pass(material);
  if (!(largest(material.emission) > 0) || !may_be_there(material)) return;
  for (std::uint32_t part = 0; part < shape.part_count(); ++part) {
    const double power = static_cast<double>(shape.part_extent(part).area) * largest(material.emission);
    if (!(power > 0)) continue;
    const double before = parts_.empty() ? 0 : parts_.back().power_up_to;
    parts_.push_back({&shape, &material, instance, part, before + power});
  }
}

// What the point gives off.
Color3f ShiningParts::light_of(const Part& part, const Vector3f& own_from, const ShapeSample& chosen,
                               const Vector3f& position, const Vector3f& normal) {
  TexturePoint point;
  point.position = position;
  point.normal = normal;
  if (part.material->textures != nullptr) {
    Hit hit;
    hit.t = 1;
    hit.primitive = part.part;
    hit.u = chosen.u;
    hit.v = chosen.v;
    point.uv = part.shape->detail_at({own_from, chosen.position - own_from}, hit).uv;
  }
  return emitted_at(*part.material, point);
}

bool ShiningParts::sample(std::uint32_t k, const Vector3f& from, const Vector2f& u,
                          ShiningSample& sample) const {
  std::size_t index = k;
  float weight = 1;
  if (parts_.size() > kMostSamples) {  // each stands for an equal share of all the power there is
    const double total = parts_.back().power_up_to;
    const double wanted = (k + 0.5) / kMostSamples * total;
    index = static_cast<std::size_t>(std::ranges::lower_bound(parts_, wanted, {}, &Part::power_up_to) -
                                     parts_.begin());
    const double power = parts_[index].power_up_to - (index > 0 ? parts_[index - 1].power_up_to : 0);
    weight = static_cast<float>(total / (kMostSamples * power));
  }
  const Part& part = parts_[index];
  const glm::mat3 linear = part.instance != nullptr ? part.instance->linear : glm::mat3(1);
  const Vector3f translation = part.instance != nullptr ? part.instance->translation : Vector3f(0);
  const Vector3f own_from = part.instance != nullptr ? glm::inverse(linear) * (from - translation) : from;
  ShapeSample chosen;
  if (!part.shape->sample_part(part.part, own_from, u, chosen) || !(chosen.pdf > 0)) return false;
  float pdf = chosen.pdf;
  Vector3f normal = chosen.normal;
  float error = chosen.position_error;
  if (part.instance != nullptr) {
    pdf *= density_scale(linear, own_from, chosen.position);
    normal = glm::normalize(glm::transpose(glm::inverse(linear)) * normal);
    error *= std::max({glm::length(linear[0]), glm::length(linear[1]), glm::length(linear[2])});
  }
  const Vector3f position = linear * chosen.position + translation;
  const Vector3f way = position - from;
  const float distance = glm::length(way);
  if (!(distance > 0)) return false;
  sample.direction = way / distance;
  const float facing = -glm::dot(sample.direction, normal);
  if (part.material->is_area_light && !(facing > 0)) return false;
  sample.light = weight / pdf * light_of(part, own_from, chosen, position, normal);
  sample.target = position + (facing > 0 ? error : -error) * normal;
  return true;
}

Color3f share_passing(const Scene& scene, const Ray3f& shadow_ray, std::uint64_t& rays) {
  constexpr int kMostSurfaces = 64;
  Color3f share(1);
  Ray3f ray = shadow_ray;
  const float length = glm::length(ray.direction);
  float entered_at = -1;
  Color3f absorption(0);
  for (int i = 0; i < kMostSurfaces; ++i) {
    ++rays;
    Hit hit;
    if (!scene.is_hit(ray, hit)) return share;
    const Material& own = scene.material_of(hit);
    if (!lets_light_pass(own)) return Color3f(0);
    SurfacePoint surface = scene.surface_at(ray, hit);
    std::optional<MaterialValues> textured;
    if (varies(scene, own)) textured = scene.textured(ray, hit, Footprint{}, surface);
    const MaterialValues& material = textured ? *textured : static_cast<const MaterialValues&>(own);
    const float cosine = glm::dot(surface.normal, ray.direction) / length;
    const float alpha = scene.alpha_at(ray, hit);
    share *= Color3f(1 - alpha) + alpha * share_through(material, cosine);
    if (!material.thin && cosine < 0) {
      entered_at = hit.t;
      absorption = absorption_of(material);
    }
    if (!material.thin && cosine > 0 && entered_at >= 0) {
      share *= glm::exp(-(hit.t - entered_at) * length * absorption);
      entered_at = -1;
    }
    if (share == Color3f(0)) return share;
    ray.t_min = std::nextafter(hit.t, kInfinity);
  }
  return Color3f(0);
}

}  // namespace raytracer
