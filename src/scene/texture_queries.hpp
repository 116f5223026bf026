// Sixteen hits whose textures are to be asked, side by side.
#pragma once

#include "core/lanes.hpp"
#include "scene/shading_point.hpp"
#include "textures/texture_block.hpp"

namespace raytracer {

/// Of two sorts: all seen by light that has been scattered widely, or all by the eye, one of many samples of
/// a pixel. Lanes from `count` on hold anything that is a number.
struct TextureQueries {
  int count = 0;
  bool is_rough = false;
  Vector2Block uv{};
  Vector3Block position{}, shading_normal{}, along_u{}, along_v{};
  alignas(64) float width[kBlockSize]{};  ///< of the footprint; of rough ones alone
  /// Of the eye's alone: the surface's own normal, the way of the ray, and the footprint's edges.
  Vector3Block normal, direction, dx{}, dy{};

  TextureQueries() {
    for (int i = 0; i < kBlockSize; ++i) {
      normal.set(i, {0, 0, 1});
      direction.set(i, {0, 0, 1});
    }
  }

  void set_rough(int i, const SurfacePoint& surface, const SurfaceDetail& detail, float footprint_width) {
    set_place(i, surface, detail);
    width[i] = footprint_width;
  }
  void set_seen(int i, const SurfacePoint& surface, const SurfaceDetail& detail, const Ray3f& ray, float t,
                const RayCone& cone) {
    set_place(i, surface, detail);
    normal.set(i, surface.normal);
    direction.set(i, ray.direction);
    dx.set(i, cone.dx_at(t));
    dy.set(i, cone.dy_at(t));
  }

 private:
  void set_place(int i, const SurfacePoint& surface, const SurfaceDetail& detail) {
    uv.set(i, detail.uv);
    position.set(i, surface.position);
    shading_normal.set(i, surface.shading_normal);
    along_u.set(i, detail.along_u);
    along_v.set(i, detail.along_v);
  }
};

/// Where the textures are asked there: as Scene::texture_point() has it, to the last bit.
void texture_points(const TextureQueries& queries, TextureBlock& points);

}  // namespace raytracer
