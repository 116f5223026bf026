// Lights without extent.
#pragma once

#include <cstdint>

#include "raytracer/vector3f.hpp"

namespace raytracer {

/// How light fades with the distance d from its source.
enum class Falloff : std::uint8_t {
  kNone,       ///< 1
  kLinear,     ///< 1/d: the paper's lambda <S-P, N> / |S-P|^2
  kQuadratic,  ///< 1/d^2: what a real point does
};

struct Light {
  enum class Kind : std::uint8_t { kPoint, kDirectional, kSpot };

  Kind kind = Kind::kPoint;
  Falloff falloff = Falloff::kLinear;  ///< of point and spot
  Vector3f position{0};                ///< world space; of point and spot
  Vector3f direction{0, -1,
                     0};  ///< world space, unit length, the way the light travels; directional and spot
  Color3f lambda{255};    ///< intensity times colour, in the 0..255 units of the buffers
  float cos_inner = 1;    ///< spot: full strength inside the cone of this cosine …
  float cos_outer = -1;   ///< … and none outside of this one
};

}  // namespace raytracer
