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
  bool is_uv_asked = true;  ///< else there is none
  Vector2Block uv{};
  Vector3Block along_u{}, along_v{};
  alignas(64) float width[kBlockSize]{};  ///< of the footprint; of rough ones alone
  /// Of the eye's alone: the way of the ray, and the footprint's edges.
  Vector3Block direction, dx{}, dy{};

  TextureQueries() {
    for (int i = 0; i < kBlockSize; ++i) direction.set(i, {0, 0, 1});
  }

  void set_seen(int i, const Ray3f& ray, float t, const RayCone& cone) {
    direction.set(i, ray.direction);
    dx.set(i, cone.dx_at(t));
    dy.set(i, cone.dy_at(t));
  }
  void set_detail(int i, const SurfaceDetail& detail) {
    uv.set(i, detail.uv);
    along_u.set(i, detail.along_u);
    along_v.set(i, detail.along_v);
  }
};

/// Where the textures are asked there, on surfaces whose two normals are one: as Scene::texture_point() has
/// it, to the last bit.
void texture_points(const TextureQueries& queries, const Vector3Block& position, const Vector3Block& normal,
                    TextureBlock& points);

}  // namespace raytracer
