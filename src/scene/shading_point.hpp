// A hit as the recursion shades it, and where rays go on from it.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>

#include "raytracer/scene.hpp"

namespace raytracer {

/// How wide the part of the picture is that a ray stands for: at distance t of a ray with unit direction,
/// width + t * spread. Textures are averaged over it.
struct RaySpread {
  float width = 0;
  float spread = 0;
  bool is_rough = false;  ///< it has been scattered widely

  Footprint footprint_at(float t) const {
    Footprint footprint;
    footprint.width = width + t * spread;
    footprint.is_rough = is_rough;
    return footprint;
  }
  /// Of a ray that goes on from there.
  RaySpread at(float t) const { return {width + t * spread, spread, is_rough}; }
  /// Likewise, of one whose direction was chosen with that density per steradian: it stands for about 1 /
  /// pdf, shared by the many that are chosen there.
  void scatter(float pdf) {
    constexpr float kWidest = 0.1F, kShare = 0.055F, kRough = 0.04F;
    spread = std::max(spread, std::min(kWidest, kShare / std::sqrt(pdf)));
    is_rough = is_rough || spread > kRough;
  }
};

/// What the eye's rays know besides: how they differ from the ray through the middle of what they stand for,
/// and how that one changes over the edges of it.
struct RayCone {
  RaySpread spread{};
  Vector3f aside_origin{0}, aside_direction{0};  ///< like the differential's
  RayDifferential edges{};
  bool is_coarse = false;  ///< few rays share the pixel

  Vector3f dx_at(float t) const { return edges.origin_dx + t * edges.direction_dx; }
  Vector3f dy_at(float t) const { return edges.origin_dy + t * edges.direction_dy; }
  /// Whether all that is known are the edges: it is one of many that share a pixel.
  bool is_one_of_many() const {
    const bool has_dx = edges.direction_dx != Vector3f(0) || edges.origin_dx != Vector3f(0);
    const bool has_dy = edges.direction_dy != Vector3f(0) || edges.origin_dy != Vector3f(0);
    return has_dx && has_dy && !is_coarse && aside_origin == Vector3f(0) && aside_direction == Vector3f(0);
  }
  Footprint footprint_at(float t) const {
    Footprint footprint = spread.footprint_at(t);
    footprint.dx = dx_at(t);
    footprint.dy = dy_at(t);
    footprint.aside = aside_origin + t * aside_direction;
    footprint.is_coarse = is_coarse;
    return footprint;
  }
  /// Of a ray that goes on from there.
  RayCone at(float t) const { return {spread.at(t)}; }
};

struct ShadingPoint {
  Vector3f position;
  Vector3f normal;           ///< geometric, unit length, turned towards where the ray came from
  Vector3f shading_normal;   ///< likewise, of the curved surface that a mesh stands for
  Vector3f offset_position;  ///< where reflected rays start
  Vector3f shadow_position;  ///< where rays to lights start
};

/// Of a point `surface` of the scene that a ray meets at t. Without branches: it is done to blocks of points.
inline ShadingPoint shading_point(bool has_epsilon, float epsilon, const Ray3f& ray, float t,
                                  const SurfacePoint& surface) {
  ShadingPoint point;
  const float side = glm::dot(surface.normal, ray.direction) > 0 ? -1.0f : 1.0f;
  point.normal = side * surface.normal;
  point.shading_normal = side * surface.shading_normal;
  // With an epsilon, the paper's way: the point as the ray's equation gives it, its rounding error included.
  const Vector3f along = ray.at(t);
  point.position = {has_epsilon ? along.x : surface.position.x, has_epsilon ? along.y : surface.position.y,
                    has_epsilon ? along.z : surface.position.z};
  point.offset_position = point.position + (has_epsilon ? epsilon : surface.position_error) * point.normal;
  point.shadow_position = point.offset_position + surface.shadow_offset;
  return point;
}

inline ShadingPoint shading_point(const Scene& scene, const Ray3f& ray, const Hit& hit,
                                  const SurfacePoint& surface) {
  const std::optional<float>& epsilon = scene.description().epsilon;
  return shading_point(epsilon.has_value(), epsilon.value_or(0), ray, hit.t, surface);
}

/// A mirror that is curved by its shading normals alone may send a ray into itself: it then goes along the
/// surface.
inline Ray3f reflected_ray(const Ray3f& ray, const ShadingPoint& point) {
  const Vector3f direction = glm::reflect(ray.direction, point.shading_normal);
  const float away = glm::dot(direction, point.normal);
  const float back = away < 0 ? 1.001f * away : 0.0f;
  return {point.offset_position, direction - back * point.normal};
}

/// Whether a hit on it needs Scene::textured().
inline bool varies(const Scene& scene, const Material& material) {
  return material.textures != nullptr || (scene.has_vertex_colors() && material.takes_vertex_colors);
}

/// With what the vertices of a mesh say.
inline Color3f surface_color(const Scene& scene, const Ray3f& ray, const Hit& hit, const Material& material) {
  if (!scene.has_vertex_colors() || !material.takes_vertex_colors) return material.color;
  return material.color * scene.detail_at(ray, hit).color;
}

inline float mirror_share(const MaterialValues& material) {
  return glm::clamp(material.shininess, 0.0f, 1.0f);
}

/// What a ray sees that hits nothing, in the 0..255 units of the buffers.
inline Color3f color_beyond(const SceneDescription& scene, const Ray3f& ray, bool is_camera) {
  if (scene.sky == nullptr || (is_camera && !scene.is_sky_visible)) return 255.0f * scene.background;
  return 255.0f * scene.sky->radiance(glm::normalize(ray.direction));
}

}  // namespace raytracer
