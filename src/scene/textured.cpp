// A surface with what its textures say of it.
#include <cmath>

#include "raytracer/scene.hpp"
#include "sampling/hemisphere.hpp"
#include "scene/texture_queries.hpp"
#include "textures/material_at.hpp"

namespace raytracer {
namespace {

// What follows without branches is done to blocks of hits.

// The change of uv that moves the point by `way` along the surface: the least squares solution.
[[gnu::always_inline]] inline Vector2f uv_along(const Vector3f& along_u, const Vector3f& along_v,
                                                const Vector3f& way) {
  const float uu = glm::dot(along_u, along_u), uv = glm::dot(along_u, along_v),
              vv = glm::dot(along_v, along_v);
  const float determinant = uu * vv - uv * uv;
  const float u = glm::dot(along_u, way), v = glm::dot(along_v, way);
  const bool has_uv = determinant > 0;
  const float scale = has_uv ? determinant : 1.0F;
  const Vector2f change((vv * u - uv * v) / scale, (uu * v - uv * u) / scale);
  return {has_uv ? change.x : 0.0F, has_uv ? change.y : 0.0F};
}

// `v` from a point on the ray to one beside it, carried along the ray back onto the surface's plane. Seen
// from the side that is long, but ends.
[[gnu::always_inline]] inline Vector3f onto_plane(const Vector3f& direction, const Vector3f& normal,
                                                  const Vector3f& v) {
  constexpr float kLeastCosine = 1e-3F;
  const float approach = glm::dot(direction, normal);
  const float cosine = std::copysign(std::max(std::abs(approach), kLeastCosine), approach);
  return v - direction * (glm::dot(v, normal) / cosine);
}

// The edges of a square of that width across the ray, one of them along the surface.
void set_square(const Vector3f& direction, const Vector3f& normal, float width, TexturePoint& point) {
  const Vector3f across = glm::cross(direction, normal);
  const float sine = glm::length(across);
  const Vector3f side =
      sine > 1e-4F ? across / sine
                   : glm::normalize(std::abs(direction.x) > 0.5F ? glm::cross(direction, Vector3f(0, 1, 0))
                                                                 : glm::cross(direction, Vector3f(1, 0, 0)));
  point.position_dx = width * side;
  point.position_dy = onto_plane(direction, normal, width * glm::cross(direction, side));
}

struct Edges {
  Vector3f position_dx, position_dy;
  Vector2f uv_dx, uv_dy;
};

// Of two squares of that width: one anyhow on the surface, one along u and v.
[[gnu::always_inline]] inline Edges rough_edges(const Vector3f& along_u, const Vector3f& along_v,
                                                const Vector3f& normal, float width) {
  Vector3f first, second;
  complete_frame(normal, first, second);
  const float uu = glm::dot(along_u, along_u), vv = glm::dot(along_v, along_v);
  const bool has_uv = (uu > 0) & (vv > 0);
  const float u = has_uv ? width / std::sqrt(uu) : 0.0F, v = has_uv ? width / std::sqrt(vv) : 0.0F;
  return {width * first, width * second, {u, 0}, {0, v}};
}

// To where the ray through ray.at(hit.t) + aside meets the surface's plane. Not farther than the footprint
// reaches: over an edge, or beyond a horizon, there is nothing to ask.
void move_to_middle(const Ray3f& ray, const SurfacePoint& surface, const SurfaceDetail& detail,
                    const Vector3f& aside, TexturePoint& point) {
  const Vector3f way = surface.position + aside - ray.origin;
  const float approach = glm::dot(way, surface.normal);
  if (approach == 0) return;
  const Vector3f move = aside - way * (glm::dot(aside, surface.normal) / approach);
  const float reach = glm::length(point.position_dx) + glm::length(point.position_dy);
  if (!(glm::dot(move, move) <= reach * reach)) return;
  point.position += move;
  point.uv += uv_along(detail.along_u, detail.along_v, move);
}

// Where the footprint lies on the surface: the longer the more it is seen from the side.
TexturePoint texture_point(const Ray3f& ray, const SurfacePoint& surface, const SurfaceDetail& detail,
                           const Footprint& footprint) {
  TexturePoint point;
  point.uv = detail.uv;
  point.position = surface.position;
  point.normal = surface.shading_normal;
  if (!(footprint.width > 0)) return point;
  point.is_rough = footprint.is_rough;
  if (footprint.is_rough) {
    const Edges edges = rough_edges(detail.along_u, detail.along_v, point.normal, footprint.width);
    point.position_dx = edges.position_dx;
    point.position_dy = edges.position_dy;
    point.uv_dx = edges.uv_dx;
    point.uv_dy = edges.uv_dy;
    return point;
  }
  const Vector3f direction = glm::normalize(ray.direction);
  if (footprint.dx == Vector3f(0) || footprint.dy == Vector3f(0)) {
    set_square(direction, surface.normal, footprint.width, point);
  } else {
    point.is_coarse = footprint.is_coarse;
    point.position_dx = onto_plane(direction, surface.normal, footprint.dx);
    point.position_dy = onto_plane(direction, surface.normal, footprint.dy);
  }
  point.uv_dx = uv_along(detail.along_u, detail.along_v, point.position_dx);
  point.uv_dy = uv_along(detail.along_u, detail.along_v, point.position_dy);
  if (footprint.aside != Vector3f(0)) move_to_middle(ray, surface, detail, footprint.aside, point);
  return point;
}

}  // namespace

void texture_points(const TextureQueries& queries, const Vector3Block& position, const Vector3Block& normal,
                    TextureBlock& points) {
  points.count = queries.count;
  points.is_rough = queries.is_rough;
  points.position = position;
  points.normal = normal;
  if (queries.is_uv_asked) points.uv = queries.uv;
  if (queries.is_rough) {
    for (int i = 0; i < kBlockSize; ++i) {
      const Edges edges =
          rough_edges(queries.along_u.at(i), queries.along_v.at(i), points.normal.at(i), queries.width[i]);
      points.position_dx.set(i, edges.position_dx);
      points.position_dy.set(i, edges.position_dy);
      points.uv_dx.set(i, edges.uv_dx);
      points.uv_dy.set(i, edges.uv_dy);
    }
    return;
  }
  Vector3Block position_dx, position_dy;
  for (int i = 0; i < kBlockSize; ++i) {
    const Vector3f direction = glm::normalize(queries.direction.at(i)), upright = points.normal.at(i);
    position_dx.set(i, onto_plane(direction, upright, queries.dx.at(i)));
    position_dy.set(i, onto_plane(direction, upright, queries.dy.at(i)));
  }
  points.position_dx = position_dx;
  points.position_dy = position_dy;
  if (!queries.is_uv_asked) return;
  for (int i = 0; i < kBlockSize; ++i) {
    const Vector3f along_u = queries.along_u.at(i), along_v = queries.along_v.at(i);
    points.uv_dx.set(i, uv_along(along_u, along_v, position_dx.at(i)));
    points.uv_dy.set(i, uv_along(along_u, along_v, position_dy.at(i)));
  }
}

MaterialValues Scene::textured(const Ray3f& ray, const Hit& hit, const Footprint& footprint,
                               SurfacePoint& surface) const {
  const Material& material = material_of(hit);
  const SurfaceDetail detail = detail_at(ray, hit);
  const TexturePoint point = raytracer::texture_point(ray, surface, detail, footprint);
  if (material.textures != nullptr) {
    surface.shading_normal = perturbed_normal(material, detail, point, surface.shading_normal);
  }
  MaterialValues here = material_at(material, point);
  if (here.takes_vertex_colors) here.color *= detail.color;
  return here;
}

TexturePoint Scene::texture_point(const Ray3f& ray, const Hit& hit, const Footprint& footprint,
                                  const SurfacePoint& surface) const {
  return raytracer::texture_point(ray, surface, detail_at(ray, hit), footprint);
}

float Scene::alpha_at(const Ray3f& ray, const Hit& hit) const {
  const Material& material = material_of(hit);
  if (material.textures == nullptr || material.textures->alpha == nullptr) return material.alpha;
  return raytracer::alpha_at(material, texture_point(ray, hit, {}, surface_at(ray, hit)));
}

}  // namespace raytracer
