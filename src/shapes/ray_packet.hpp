// Eight rays side by side, and what a shape says of them.
#pragma once

#include <cstdint>

#include "core/lanes.hpp"
#include "raytracer/shape.hpp"

namespace raytracer {

/// What Shape::is_hit() gets one by one. A lane with t_max below t_min is idle: nothing is on that ray.
struct RayPacket : RayLanes<8> {};

struct alignas(32) HitPacket {
  float t[RayPacket::kSize];  ///< kInfinity: no hit, and the other values mean nothing
  std::uint32_t primitive[RayPacket::kSize];
  float u[RayPacket::kSize], v[RayPacket::kSize];
};

}  // namespace raytracer
