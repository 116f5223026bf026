// What a light without extent does at a point. Inline: asked for every point and light.
#pragma once

#include "core/lanes.hpp"
#include "core/with_constant.hpp"
#include "raytracer/light.hpp"

namespace raytracer {

struct Illumination {
  Color3f color{
      0};  ///< what a white surface returns of it if nothing stands between, 0..255 units; 0: nothing arrives
  Ray3f shadow_ray;  ///< from the offset point to the light; t = 1 is the light
};

namespace lights {

constexpr float fade(Falloff falloff, float distance) {
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
  const float share = glm::smoothstep(light.cos_outer, light.cos_inner, cosine);
  return cosine >= light.cos_inner ? 1.0f : cosine <= light.cos_outer ? 0.0f : share;
}

// Without branches: it is done to blocks of points.
template <Light::Kind kKind, Falloff kFalloff>
inline Illumination illuminate(const Light& light, const Vector3f& position, const Vector3f& normal,
                               const Vector3f& offset_position) {
  if constexpr (kKind == Light::Kind::kDirectional) {
    const float cosine = -glm::dot(light.direction, normal);
    return {light.lambda * (cosine > 0 ? cosine : 0.0f), {offset_position, -light.direction}};
  } else {
    const Vector3f to_light = light.position - position;
    const float distance = glm::length(to_light);
    const float facing = glm::dot(to_light, normal);
    float strength = facing / distance * fade(kFalloff, distance);
    if constexpr (kKind == Light::Kind::kSpot) {
      strength *= cone_share(light, -glm::dot(to_light / distance, light.direction));
    }
    const bool is_lit = (facing > 0) & (distance > 0) & (distance < kInfinity);
    return {light.lambda * (is_lit ? strength : 0.0f),
            {offset_position, light.position - offset_position, 0, 1}};
  }
}

// Calls function(kind, falloff) with what the light is as constants.
template <class Function>
inline auto with_kind(const Light& light, const Function& function) {
  using Kind = Light::Kind;
  return with_constant<Kind::kPoint, Kind::kSpot, Kind::kDirectional>(light.kind, [&](auto kind) {
    return with_constant<Falloff::kNone, Falloff::kLinear, Falloff::kQuadratic>(
        light.falloff, [&](auto falloff) { return function(kind, falloff); });
  });
}

}  // namespace lights

/// The light that arrives at `position` with unit `normal`: the paper's lambda <S-P, N> / |S-P|^2 and its
/// kin. The shadow ray starts at `offset_position`.
inline Illumination illuminate(const Light& light, const Vector3f& position, const Vector3f& normal,
                               const Vector3f& offset_position) {
  return lights::with_kind(light, [&](auto kind, auto falloff) {
    return lights::illuminate<kind(), falloff()>(light, position, normal, offset_position);
  });
}

/// The very same for a block of points.
inline void illuminate(const Light& light, const Vector3Block& position, const Vector3Block& normal,
                       const Vector3Block& offset_position, ColorBlock& __restrict color,
                       RayBlock& __restrict shadow_rays) {
  const Light source = light;
  lights::with_kind(light, [&](auto kind, auto falloff) {
    for (int i = 0; i < kBlockSize; ++i) {
      const Illumination one =
          lights::illuminate<kind(), falloff()>(source, position.at(i), normal.at(i), offset_position.at(i));
      color.set(i, one.color);
      shadow_rays.set(i, one.shadow_ray);
    }
  });
}

}  // namespace raytracer
