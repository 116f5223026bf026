#include <algorithm>
#include <cmath>

#include "raytracer/shapes.hpp"
#include "shapes/ball.hpp"
#include "shapes/checks.hpp"
#include "shapes/frame.hpp"
#include "shapes/hits.hpp"

namespace raytracer {

namespace {

using shapes::Frame;
using shapes::LocalRay;
using shapes::Span;

/// Known points of the unit sphere, before the transform:
///
///     point      u     v
///      1  0  0   0     0.5
///      0  0 -1   0.25  0.5
///     -1  0  0   0.5   0.5
///      0  0  1   0.75  0.5
///      0 -1  0   0     0
///      0  1  0   0     1
Vector2f sphere_uv(const Vector3d& normal) {
  return {shapes::turn_share(normal.x, -normal.z),
          static_cast<float>(0.5 + std::asin(std::clamp(normal.y, -1.0, 1.0)) / kPi)};
}

bool set_ball_hit(const Ray3f& ray, const Span<double>& span, Hit& hit) {
  if (shapes::is_on_ray(ray, span.near)) {
    shapes::set_hit(hit, span.near);
  } else if (shapes::is_on_ray(ray, span.far)) {
    shapes::set_hit(hit, span.far);
  } else {
    return false;
  }
  return true;
}

/// A sphere that is one in the world too, with its own axes along the world's.
class Sphere final : public Shape {
 public:
  Sphere(const Vector3d& center, double radius)
      : center_(center),
        radius_(radius),
        arithmetic_(8 * kDoubleRounding * (2 * radius + glm::length(center))),
        bounds_(shapes::rounded_bounds(center - radius, center + radius)) {}

  Box3f bounds() const override { return bounds_; }

  bool is_hit(const Ray3f& ray, Hit& hit) const override {
    Span<double> span;
    return shapes::intersect_ball(Vector3d(ray.origin) - center_, Vector3d(ray.direction), radius_, span) &&
           set_ball_hit(ray, span, hit);
  }

  void find_hits(const RayPacket& rays, HitPacket& hits) const override {
    for (int i = 0; i < RayPacket::kSize; ++i) {
      Span<double> span;
      const bool crosses = shapes::intersect_ball<false>(Vector3d(rays.origin(i)) - center_,
                                                         Vector3d(rays.direction(i)), radius_, span);
      hits.t[i] = crosses ? shapes::first_on_ray(rays, i, span.near, span.far) : kInfinity;
    }
    shapes::clear_parameters(hits);
  }

  SurfacePoint surface_at(const Ray3f& ray, const Hit& hit) const override {
    const Vector3d found = Vector3d(ray.origin) + static_cast<double>(hit.t) * Vector3d(ray.direction);
    const Vector3d normal = glm::normalize(found - center_);
    const Vector3d position = center_ + radius_ * normal;
    shapes::SurfaceBound bound;
    // The least that a tangent turned by the rounding of the normal needs to clear the sphere is its square.
    constexpr double kTilt = kFloatRounding * kFloatRounding;
    const Vector3d rounding = 2 * kFloatRounding * glm::abs(position);
    bound.bend =
        kTilt * radius_ + std::min(0.5 * glm::dot(rounding, rounding) / radius_, glm::length(rounding));
    bound.arithmetic = arithmetic_;
    return shapes::rounded_surface(position, normal, sphere_uv(normal), bound);
  }

 private:
  Vector3d center_;
  double radius_;
  double arithmetic_;  // error of the arithmetic on a point of the surface
  Box3f bounds_;
};

/// The unit sphere in a frame.
class Ellipsoid final : public Shape {
 public:
  explicit Ellipsoid(const Transform& to_world) : frame_(to_world) {
    // The farthest point along an axis of the world is as far as that row of the matrix is long.
    const glm::dmat3 rows = glm::transpose(to_world.linear);
    const Vector3d reach(glm::length(rows[0]), glm::length(rows[1]), glm::length(rows[2]));
    bounds_ = shapes::rounded_bounds(to_world.translation - reach, to_world.translation + reach);
  }

  Box3f bounds() const override { return bounds_; }

  bool is_hit(const Ray3f& ray, Hit& hit) const override {
    const LocalRay local = frame_.to_local(ray);
    Span<double> span;
    return shapes::intersect_ball(local.origin, local.direction, 1.0, span) && set_ball_hit(ray, span, hit);
  }

  SurfacePoint surface_at(const Ray3f& ray, const Hit& hit) const override {
    const Vector3d normal = glm::normalize(frame_.to_local(ray).at(static_cast<double>(hit.t)));
    return frame_.surface_at(normal, normal, sphere_uv(normal), 1, Vector3d(bounds_.diagonal()));
  }

 private:
  Frame frame_;
  Box3f bounds_;
};

bool is_uniform_scale(const glm::dmat3& m) { return m[0][0] > 0 && m == glm::dmat3(m[0][0]); }

}  // namespace

std::unique_ptr<Shape> make_sphere(const Vector3d& center, double radius, const Transform& transform) {
  shapes::require_finite(center, "center");
  shapes::require_positive(radius, "radius");
  shapes::require_regular(transform);
  const Vector3d world_center = transform.point(center);
  if (is_uniform_scale(transform.linear)) {
    return std::make_unique<Sphere>(world_center, transform.linear[0][0] * radius);
  }
  return std::make_unique<Ellipsoid>(Transform{transform.linear * radius, world_center});
}

}  // namespace raytracer
