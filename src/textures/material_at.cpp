#include "textures/material_at.hpp"

#include <algorithm>
#include <cmath>

#include "textures/averaged.hpp"
#include "textures/limited.hpp"

namespace raytracer {
namespace {

constexpr float kBrightest = 1e30f;  // beyond it products of colours are no numbers any more

// What a texture may take the place of, one row each, with the values that make sense there.
template <class Value>
struct Row {
  TexturePointer MaterialTextures::*texture;
  Value& (*value)(MaterialValues&);
  float least = 0, most = 1;
};

template <auto Member>
auto& member(MaterialValues& values) {
  return values.*Member;
}

template <Vector3f ConductorIndex::*Member>
Color3f& of_conductor(MaterialValues& values) {
  if (!values.conductor) values.conductor.emplace();
  return (*values.conductor).*Member;
}

using Textures = MaterialTextures;
using Values = MaterialValues;
constexpr Row<float> kNumbers[] = {
    {&Textures::shininess, member<&Values::shininess>},
    {&Textures::roughness, member<&Values::roughness>},
    {&Textures::metallic, member<&Values::metallic>},
    {&Textures::ior, member<&Values::ior>, 1, 10},
    {&Textures::specular, member<&Values::specular>},
    {&Textures::transmission, member<&Values::transmission>},
    {&Textures::attenuation_distance, member<&Values::attenuation_distance>, 0, 1e18F},
    {&Textures::coat, member<&Values::coat>},
    {&Textures::coat_roughness, member<&Values::coat_roughness>},
    {&Textures::anisotropy, member<&Values::anisotropy>, -1, 1},
    {&Textures::alpha, member<&Values::alpha>},
};
constexpr Row<Color3f> kColors[] = {
    {&Textures::color, member<&Values::color>},
    {&Textures::attenuation_color, member<&Values::attenuation_color>},
    {&Textures::emission, member<&Values::emission>, 0, kBrightest},
    {&Textures::eta, of_conductor<&ConductorIndex::eta>, 0.01F, 100},
    {&Textures::k, of_conductor<&ConductorIndex::k>, 0, 100},
};

}  // namespace

MaterialValues material_at(const Material& material, const TexturePoint& point) {
  MaterialValues result = material;
  if (!material.textures) return result;
  const MaterialTextures& textures = *material.textures;
  for (const Row<Color3f>& row : kColors) {
    const TexturePointer& texture = textures.*row.texture;
    if (texture) row.value(result) = limited(averaged(*texture, point), row.least, row.most);
  }
  for (const Row<float>& row : kNumbers) {
    const TexturePointer& texture = textures.*row.texture;
    if (texture) row.value(result) = limited(number_of(averaged(*texture, point)), row.least, row.most);
  }
  return result;
}

bool varies_in_color_alone(const MaterialTextures& textures) {
  const auto is_other = [&](const auto& row) {
    return row.texture != &MaterialTextures::color && textures.*row.texture != nullptr;
  };
  return textures.color != nullptr && std::ranges::none_of(kColors, is_other) &&
         std::ranges::none_of(kNumbers, is_other) && textures.normal_map == nullptr &&
         textures.bump == nullptr;
}

Color3f color_at(const Texture& color, const TexturePoint& point) {
  return limited(averaged(color, point), 0, 1);
}

void colors_at(const Texture& color, const TextureBlock& points, ColorBlock& colors) {
  color.colors_at(points, colors);
  for (int i = 0; i < kBlockSize; ++i) colors.set(i, limited(colors.at(i), 0, 1));
}

float alpha_at(const Material& material, const TexturePoint& point) {
  if (!material.textures || !material.textures->alpha) return material.alpha;
  return limited(number_of(averaged(*material.textures->alpha, point)), 0, 1);
}

Color3f emitted_at(const Material& material, const TexturePoint& point) {
  const bool is_textured = material.textures != nullptr && material.textures->emission != nullptr;
  const Color3f emission = is_textured ? material.textures->emission->at(point) : material.emission;
  return alpha_at(material, point) * limited(emission, 0, kBrightest);
}

namespace {

/// How the position changes along two directions of the surface, and how uv does with it.
struct Directions {
  Vector3f along_u{0}, along_v{0};
  bool is_uv = false;  // false: any two directions; uv stays the same
};

Directions directions_of(const SurfaceDetail& detail, const Vector3f& normal) {
  const Vector3f across = glm::cross(detail.along_u, detail.along_v);
  const float size = glm::length(detail.along_u) * glm::length(detail.along_v);
  constexpr float kFlat = 1e-6f;  // sine of the angle between them
  if (size > 0 && glm::length(across) > kFlat * size) return {detail.along_u, detail.along_v, true};
  const Vector3f any = std::abs(normal.x) < 0.7f ? Vector3f(1, 0, 0) : Vector3f(0, 1, 0);
  const Vector3f along_u = glm::normalize(glm::cross(any, normal));
  return {along_u, glm::cross(normal, along_u), false};
}

// Unit length and on the side of `normal`, whatever came out.
Vector3f on_side_of(const Vector3f& normal, const Vector3f& bent) {
  constexpr float kLeast = 1e-3f;  // of the cosine between them
  const float length = glm::length(bent);
  if (!(length > 0 && length < kInfinity)) return normal;
  const Vector3f unit = bent / length;
  const float cosine = glm::dot(unit, normal);
  return cosine >= kLeast ? unit : glm::normalize(unit + (kLeast - cosine) * normal);
}

// x along u, y towards growing v, z along the normal, as glTF 2.0 has its normal maps.
Vector3f mapped_normal(const Texture& map, const Directions& directions, const TexturePoint& point,
                       const Vector3f& normal) {
  if (!directions.is_uv) return normal;
  const Vector3f bent = 2.0f * map.at(point) - 1.0f;
  const Vector3f flat = directions.along_u - glm::dot(directions.along_u, normal) * normal;
  const float length = glm::length(flat);
  if (!(length > 0)) return normal;
  const Vector3f tangent = flat / length;
  const Vector3f across = glm::cross(normal, tangent);
  const float side = glm::dot(across, directions.along_v) < 0 ? -1.0f : 1.0f;
  return on_side_of(normal, bent.x * tangent + (side * bent.y) * across + bent.z * normal);
}

/// How the height changes along a direction, by central difference over the footprint.
float slope(const Texture& height, const TexturePoint& point, const Vector2f& uv_step,
            const Vector3f& position_step, float size) {
  const auto at = [&](float steps) {
    TexturePoint moved = point;
    moved.uv += steps * size * uv_step;
    moved.position += steps * size * position_step;
    return number_of(height.at(moved));
  };
  const float difference = (at(0.5f) - at(-0.5f)) / size;
  return std::isfinite(difference) ? difference : 0.0f;
}

// Blinn 1978, "Simulation of wrinkled surfaces", in the form of Mikkelsen 2010, "Bump mapping unparametrized
// surfaces on the GPU", equation 1.
Vector3f bumped_normal(const Texture& height, const Directions& directions, const TexturePoint& point,
                       const Vector3f& normal) {
  constexpr float kLeastStep = 5e-4f;  // of uv, or of scene units
  float u_step = kLeastStep, v_step = kLeastStep;
  if (directions.is_uv) {
    u_step = std::max(u_step, std::max(std::abs(point.uv_dx.x), std::abs(point.uv_dy.x)));
    v_step = std::max(v_step, std::max(std::abs(point.uv_dx.y), std::abs(point.uv_dy.y)));
  } else {
    u_step = std::max({u_step, glm::length(point.position_dx), glm::length(point.position_dy)});
    v_step = u_step;
  }
  const float uv = directions.is_uv ? 1.0f : 0.0f;
  const float along_u = slope(height, point, {uv, 0}, directions.along_u, u_step);
  const float along_v = slope(height, point, {0, uv}, directions.along_v, v_step);
  const Vector3f u_side = glm::cross(directions.along_v, normal),
                 v_side = glm::cross(normal, directions.along_u);
  const float area = glm::dot(directions.along_u, u_side);
  const Vector3f gradient = std::copysign(1.0f, area) * (along_u * u_side + along_v * v_side);
  return on_side_of(normal, std::abs(area) * normal - gradient);
}

}  // namespace

Vector3f perturbed_normal(const Material& material, const SurfaceDetail& detail, const TexturePoint& point,
                          const Vector3f& normal) {
  if (!material.textures || (!material.textures->normal_map && !material.textures->bump)) return normal;
  const Directions directions = directions_of(detail, normal);
  Vector3f result = normal;
  if (material.textures->normal_map) {
    result = mapped_normal(*material.textures->normal_map, directions, point, result);
  }
  if (material.textures->bump) result = bumped_normal(*material.textures->bump, directions, point, result);
  return result;
}

}  // namespace raytracer
