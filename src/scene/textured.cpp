// A surface with what its textures say of it.
#include <cmath>

#include "raytracer/scene.hpp"
#include "textures/material_at.hpp"

namespace raytracer {
namespace {

// The change of uv that moves the point by `way` along the surface: the least squares solution.
Vector2f uv_along(const SurfaceDetail& detail, const Vector3f& way) {
  const float uu = glm::dot(detail.along_u, detail.along_u), uv = glm::dot(detail.along_u, detail.along_v),
              vv = glm::dot(detail.along_v, detail.along_v);
  const float determinant = uu * vv - uv * uv;
  if (!(determinant > 0)) return Vector2f(0);
  const float u = glm::dot(detail.along_u, way), v = glm::dot(detail.along_v, way);
  return {(vv * u - uv * v) / determinant, (uu * v - uv * u) / determinant};
}

// `v` from a point on the ray to one beside it, carried along the ray back onto the surface's plane. Seen
// from the side that is long, but ends.
Vector3f onto_plane(const Vector3f& direction, const Vector3f& normal, const Vector3f& v) {
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

// Of that width, its edges along u and v; false where the surface has none.
bool set_rough(const SurfaceDetail& detail, float width, TexturePoint& point) {
  const float uu = glm::dot(detail.along_u, detail.along_u), vv = glm::dot(detail.along_v, detail.along_v);
  if (!(uu > 0) || !(vv > 0)) return false;
  point.uv_dx.x = width / std::sqrt(uu);
  point.uv_dy.y = width / std::sqrt(vv);
  point.position_dx = point.uv_dx.x * detail.along_u;
  point.position_dy = point.uv_dy.y * detail.along_v;
  return true;
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
  point.uv += uv_along(detail, move);
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
  if (footprint.is_rough && set_rough(detail, footprint.width, point)) return point;
  const Vector3f direction = glm::normalize(ray.direction);
  if (footprint.dx == Vector3f(0) || footprint.dy == Vector3f(0)) {
    set_square(direction, surface.normal, footprint.width, point);
  } else {
    point.is_coarse = footprint.is_coarse;
    point.position_dx = onto_plane(direction, surface.normal, footprint.dx);
    point.position_dy = onto_plane(direction, surface.normal, footprint.dy);
  }
  point.uv_dx = uv_along(detail, point.position_dx);
  point.uv_dy = uv_along(detail, point.position_dy);
  if (footprint.aside != Vector3f(0)) move_to_middle(ray, surface, detail, footprint.aside, point);
  return point;
}

}  // namespace

MaterialValues Scene::textured(const Ray3f& ray, const Hit& hit, const Footprint& footprint,
                               SurfacePoint& surface) const {
  const Material& material = material_of(hit);
  const SurfaceDetail detail = detail_at(ray, hit);
  const TexturePoint point = texture_point(ray, surface, detail, footprint);
  if (material.textures != nullptr) {
    surface.shading_normal = perturbed_normal(material, detail, point, surface.shading_normal);
  }
  MaterialValues here = material_at(material, point);
  if (here.takes_vertex_colors) here.color *= detail.color;
  return here;
}

Color3f Scene::textured_color(const Ray3f& ray, const Hit& hit, const Footprint& footprint,
                              const SurfacePoint& surface) const {
  return raytracer::color_at(material_of(hit), texture_point(ray, surface, detail_at(ray, hit), footprint));
}

float Scene::alpha_at(const Ray3f& ray, const Hit& hit) const {
  const Material& material = material_of(hit);
  if (material.textures == nullptr || material.textures->alpha == nullptr) return material.alpha;
  return raytracer::alpha_at(material, texture_point(ray, surface_at(ray, hit), detail_at(ray, hit), {}));
}

}  // namespace raytracer
