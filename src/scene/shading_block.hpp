// Sixteen points of surfaces side by side, as the paper's recursion shades them.
#pragma once

#include "core/lanes.hpp"
#include "core/with_constant.hpp"
#include "scene/shading_point.hpp"
#include "shapes/hit_block.hpp"

namespace raytracer {

struct alignas(64) ShadingBlock {
  BlockMask is_used;  ///< the lanes that this is about; the others hold anything
  SurfaceBlock surface;
  ColorBlock color;
  float mirror_share[kBlockSize];
  Vector3Block position, normal, shading_normal, offset_position, shadow_position;
  ColorBlock light;  ///< what has arrived so far

  ShadingPoint at(int i) const {
    return {position.at(i), normal.at(i), shading_normal.at(i), offset_position.at(i), shadow_position.at(i)};
  }
  void set(int i, const ShadingPoint& point) {
    position.set(i, point.position);
    normal.set(i, point.normal);
    shading_normal.set(i, point.shading_normal);
    offset_position.set(i, point.offset_position);
    shadow_position.set(i, point.shadow_position);
  }
};

/// shading_point() of all lanes at once.
inline void place(const std::optional<float>& epsilon, const RayBlock& rays, const float* t,
                  ShadingBlock& __restrict points) {
  const float offset = epsilon.value_or(0);
  with_constant<true, false>(epsilon.has_value(), [&](auto has_epsilon) {
    for (int i = 0; i < kBlockSize; ++i) {
      points.set(i, shading_point(has_epsilon, offset, rays.ray(i), t[i], points.surface.at(i)));
    }
  });
}

}  // namespace raytracer
