#include "lights/illuminate.hpp"

namespace raytracer {
namespace {

float fade(Falloff falloff, float distance) {
  switch (falloff) {
    case Falloff::kNone: return 1;
    case Falloff::kLinear: return 1 / distance;
    case Falloff::kQuadratic: return 1 / (distance * distance);
  }
  return 1;
}

// The share of a spot's light in a direction whose cosine to its axis is given.
float cone_share(const Light& light, float cosine) {
  if (cosine >= light.cos_inner) return 1;
  if (cosine <= light.cos_outer) return 0;
  return glm::smoothstep(light.cos_outer, light.cos_inner, cosine);
}

Illumination from_far_away(const Light& light, const Vector3f& normal, const Vector3f& offset_position) {
  const float cosine = -glm::dot(light.direction, normal);
  if (!(cosine > 0)) return {};
  return {light.lambda * cosine, {offset_position, -light.direction}};
}

}  // namespace

Illumination illuminate(const Light& light, const Vector3f& position, const Vector3f& normal,
                        const Vector3f& offset_position) {
  if (light.kind == Light::Kind::kDirectional) return from_far_away(light, normal, offset_position);
  const Vector3f to_light = light.position - position;
  const float distance = glm::length(to_light);
  const float facing = glm::dot(to_light, normal);
  if (!(facing > 0) || !(distance > 0 && distance < kInfinity)) return {};
  const Vector3f direction = to_light / distance;
  float strength = facing / distance * fade(light.falloff, distance);
  if (light.kind == Light::Kind::kSpot) strength *= cone_share(light, -glm::dot(direction, light.direction));
  return {light.lambda * strength, {offset_position, light.position - offset_position, 0, 1}};
}

}  // namespace raytracer
