// Sixteen places where a texture is asked, side by side.
#pragma once

#include "core/lanes.hpp"
#include "raytracer/texture.hpp"

namespace raytracer {

/// As TexturePoint has them; none of them is coarse. Lanes from `count` on hold anything that is a number.
struct TextureBlock {
  int count = 0;
  bool is_rough = false;
  Vector2Block uv{}, uv_dx{}, uv_dy{};
  Vector3Block position{}, normal{}, position_dx{}, position_dy{};

  TexturePoint at(int i) const {
    return {uv.at(i),          position.at(i),    normal.at(i), uv_dx.at(i), uv_dy.at(i),
            position_dx.at(i), position_dy.at(i), false,        is_rough};
  }
  void set(int i, const TexturePoint& point) {
    uv.set(i, point.uv);
    uv_dx.set(i, point.uv_dx);
    uv_dy.set(i, point.uv_dy);
    position.set(i, point.position);
    normal.set(i, point.normal);
    position_dx.set(i, point.position_dx);
    position_dy.set(i, point.position_dy);
  }
};

}  // namespace raytracer
