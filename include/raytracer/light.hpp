// Lights without extent.
#pragma once

#include <cstdint>
#include <memory>

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

/// Light from infinitely far away, all around. Immutable.
class Environment {
 public:
  virtual ~Environment() = default;

  /// What arrives from `direction` (unit length, world space, away from the scene); 1 is white.
  virtual Color3f radiance(const Vector3f& direction) const = 0;
  /// Chooses a direction from which much arrives, with its density per steradian; false: nothing shines.
  virtual bool sample(const Vector2f& u, Vector3f& direction, float& pdf) const = 0;
  /// The density per steradian with which sample() chooses `direction`.
  virtual float pdf(const Vector3f& direction) const = 0;
  /// Whether it is the same in all directions, so that choosing a direction by it is a waste.
  virtual bool is_constant() const { return false; }
  /// The mean radiance over all directions.
  virtual Color3f mean() const = 0;
};

}  // namespace raytracer
