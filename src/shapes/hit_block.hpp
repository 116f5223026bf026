// Sixteen hits, and the surfaces there, side by side.
#pragma once

#include "core/lanes.hpp"
#include "raytracer/shape.hpp"

namespace raytracer {

/// As Hit has them. Lanes without a hit hold anything.
struct alignas(64) HitBlock {
  float t[kBlockSize], u[kBlockSize], v[kBlockSize];
  std::uint32_t shape[kBlockSize], primitive[kBlockSize], instance[kBlockSize];

  Hit at(int i) const { return {t[i], shape[i], primitive[i], u[i], v[i], instance[i]}; }
  void set(int i, const Hit& hit) {
    t[i] = hit.t;
    u[i] = hit.u;
    v[i] = hit.v;
    shape[i] = hit.shape;
    primitive[i] = hit.primitive;
    instance[i] = hit.instance;
  }
};

/// As SurfacePoint has them.
struct alignas(64) SurfaceBlock {
  Vector3Block position, normal, shading_normal, shadow_offset;
  float position_error[kBlockSize];

  SurfacePoint at(int i) const {
    return {position.at(i), position_error[i], normal.at(i), shading_normal.at(i), shadow_offset.at(i)};
  }
  void set(int i, const SurfacePoint& point) {
    position.set(i, point.position);
    normal.set(i, point.normal);
    shading_normal.set(i, point.shading_normal);
    shadow_offset.set(i, point.shadow_offset);
    position_error[i] = point.position_error;
  }
};

}  // namespace raytracer
