#include "raytracer/shapes.hpp"
#include "shapes/checks.hpp"
#include "shapes/frame.hpp"
#include "shapes/hits.hpp"
#include "shapes/surface.hpp"

namespace raytracer {

namespace {

/// The plane through `point` across `normal`. The normal is rounded to float before anything else: what rays
/// meet is exactly across the normal that surface_at() reports, however far away. uv is the place in the
/// plane in the shape's own units, from `point`; before the transform, for the normals y and z:
///
///     point + …   u  v          point + …   u  v
///      1  0  0    1  0           1  0  0    1  0
///      0  0 -1    0  1           0  1  0    0  1
class Plane final : public Shape {
 public:
  Plane(const Vector3d& point, const Vector3d& normal, const Vector3d& along_u, const Vector3d& along_v)
      : point_(point), normal_(normal), along_u_(along_u), along_v_(along_v) {}

  Box3f bounds() const override { return Box3f::infinite(); }

  bool is_hit(const Ray3f& ray, Hit& hit) const override {
    const double t = distance_along(ray.origin, ray.direction);
    if (!shapes::is_on_ray(ray, t)) return false;
    shapes::set_hit(hit, t);
    return true;
  }

  void find_hits(const RayPacket& rays, HitPacket& hits) const override {
    for (int i = 0; i < RayPacket::kSize; ++i) {
      const double t = distance_along(rays.origin(i), rays.direction(i));
      hits.t[i] = shapes::first_on_ray(rays, i, t, t);
    }
    shapes::clear_parameters(hits);
  }

  SurfacePoint surface_at(const Ray3f& ray, const Hit& hit) const override {
    return shapes::rounded_surface(exact_at(ray.origin, ray.direction, hit.t));
  }

  void surfaces_at(const RayBlock& rays, const HitBlock& hits, const BlockMask& asked,
                   SurfaceBlock& surfaces) const override {
    const Plane plane = *this;  // that no store can change it
    shapes::round_lanes(
        asked, [&](int i) { return plane.exact_at(rays.origin(i), rays.direction(i), hits.t[i]); }, surfaces);
  }

  SurfaceDetail detail_at(const Ray3f& ray, const Hit& hit) const override {
    const Vector3d offset = offset_at(ray.origin, ray.direction, hit.t), normal(normal_);
    SurfaceDetail detail;
    detail.uv = Vector2f(glm::dot(along_u_, offset), glm::dot(along_v_, offset));
    // In the plane, 1 along the one gradient and across the other.
    const Vector3d across_v = glm::cross(along_v_, normal), across_u = glm::cross(normal, along_u_);
    detail.along_u = Vector3f(across_v / glm::dot(along_u_, across_v));
    detail.along_v = Vector3f(across_u / glm::dot(along_v_, across_u));
    return detail;
  }

 private:
  double distance_along(const Vector3f& origin, const Vector3f& direction) const {
    const Vector3d normal(normal_), from = Vector3d(origin) - point_;
    return -glm::dot(normal, from) / glm::dot(normal, Vector3d(direction));
  }

  Vector3d offset_at(const Vector3f& origin, const Vector3f& direction, float t) const {
    const Vector3d normal(normal_);
    const Vector3d found = Vector3d(origin) - point_ + static_cast<double>(t) * Vector3d(direction);
    return found - glm::dot(normal, found) / glm::dot(normal, normal) * normal;
  }

  shapes::ExactPoint exact_at(const Vector3f& origin, const Vector3f& direction, float t) const {
    const Vector3d offset = offset_at(origin, direction, t);
    shapes::SurfaceBound bound;
    bound.arithmetic = 8 * kDoubleRounding * (glm::length(point_) + glm::length(offset));
    return {point_ + offset, Vector3d(normal_), bound};
  }

  Vector3d point_;
  Vector3f normal_;             // unit length but for the rounding to float
  Vector3d along_u_, along_v_;  // the gradients of u and v
};

}  // namespace

std::unique_ptr<Shape> make_plane(const Vector3d& point, const Vector3d& normal, const Transform& transform) {
  shapes::require_finite(point, "point");
  shapes::require_nonzero(normal, "normal");
  shapes::require_regular(transform);
  const Vector3d world_point = transform.point(point);
  shapes::rounded_bounds(world_point, world_point);  // only to refuse a point that is out of range
  // Normals, and the gradients of u and v, map by the inverse transpose.
  const glm::dmat3 axes = glm::transpose(glm::inverse(transform.linear)) * shapes::axes_around(normal);
  const Vector3d world_normal = glm::normalize(axes[2]);
  return std::make_unique<Plane>(world_point, world_normal, axes[0], axes[1]);
}

}  // namespace raytracer
