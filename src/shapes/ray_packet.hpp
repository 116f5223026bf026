// Eight rays side by side, laid out so that a compiler can compute with all of them at once.
#pragma once

#include <cstdint>

#include "raytracer/shape.hpp"

namespace raytracer {

/// What Shape::is_hit() gets one by one. A lane with t_max below t_min is idle: nothing is on that ray.
struct alignas(32) RayPacket {
  static constexpr int kSize = 8;

  float origin_x[kSize], origin_y[kSize], origin_z[kSize];
  float direction_x[kSize], direction_y[kSize], direction_z[kSize];
  float t_min[kSize], t_max[kSize];

  Vector3f origin(int i) const { return {origin_x[i], origin_y[i], origin_z[i]}; }
  Vector3f direction(int i) const { return {direction_x[i], direction_y[i], direction_z[i]}; }
  Ray3f ray(int i) const { return {origin(i), direction(i), t_min[i], t_max[i]}; }
};

/// What a shape says of them.
struct alignas(32) HitPacket {
  float t[RayPacket::kSize];  ///< kInfinity: no hit, and the other values mean nothing
  std::uint32_t primitive[RayPacket::kSize];
  float u[RayPacket::kSize], v[RayPacket::kSize];
};

}  // namespace raytracer
