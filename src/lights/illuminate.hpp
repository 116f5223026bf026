// What a light without extent does at a point. Inline: asked for every point and light.
#pragma once

#include "raytracer/light.hpp"

namespace raytracer {

struct Illumination {
  Color3f color{
      0};  ///< what a white surface returns of it if nothing stands between, 0..255 units; 0: nothing arrives
  Ray3f shadow_ray;  ///< from the offset point to the light; t = 1 is the light
};

namespace lights {

inline float fade(Falloff falloff, float distance) {
  switch (falloff) {
    case Falloff::kNone:
      return 1;
    case Falloff::kLinear:
      return 1 / distance;
    case Falloff::kQuadratic:
      return 1 / (distance * distance);
  }
  return 1;
}

// The share of a spot's light in a direction whose cosine to its axis is given.
inline float cone_share(const Light& light, float cosine) {
  if (cosine >= light.cos_inner) return 1;
  if (cosine <= light.cos_outer) return 0;
  return glm::smoothstep(light.cos_outer, light.cos_inner, cosine);
}

inline Illumination from_far_away(const Light& light, const Vector3f& normal,
                                  const Vector3f& offset_position) {
  const float cosine = -glm::dot(light.direction, normal);
  if (!(cosine > 0)) return {};
  return {light.lambda * cosine, {offset_position, -light.direction}};
}

}  // namespace lights

/// The light that arrives at `position` with unit `normal`: the paper's lambda <S-P, N> / |S-P|^2 and its
/// kin. The shadow ray starts at `offset_position`.
inline Illumination illuminate(const Light& light, const Vector3f& position, const Vector3f& normal,
                               const Vector3f& offset_position) {
  if (light.kind == Light::Kind::kDirectional) return lights::from_far_away(light, normal, offset_position);
  const Vector3f to_light = light.position - position;
  const float distance = glm::length(to_light);
  const float facing = glm::dot(to_light, normal);
  if (!(facing > 0) || !(distance > 0 && distance < kInfinity)) return {};
  const Vector3f direction = to_light / distance;
  float strength = facing / distance * lights::fade(light.falloff, distance);
  if (light.kind == Light::Kind::kSpot)
    strength *= lights::cone_share(light, -glm::dot(direction, light.direction));
  return {light.lambda * strength, {offset_position, light.position - offset_position, 0, 1}};
}

}  // namespace raytracer
