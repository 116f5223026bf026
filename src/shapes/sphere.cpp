#include <algorithm>
#include <cmath>

#include "raytracer/shapes.hpp"
#include "shapes/ball.hpp"
#include "shapes/ball_sampling.hpp"
#include "shapes/checks.hpp"
#include "shapes/frame.hpp"
#include "shapes/hit_block.hpp"
#include "shapes/hits.hpp"
#include "shapes/part_sampling.hpp"

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

/// How the point of the unit sphere with this normal moves with u and with v: circles of latitude and of
/// longitude, once around and half around. At the poles, where u means nothing, u = 0.
void sphere_tangents(const Vector3d& normal, Vector3d& along_u, Vector3d& along_v) {
  const double c = std::hypot(normal.x, normal.z);
  const Vector3d outwards = c > 0 ? Vector3d(normal.x / c, 0, normal.z / c) : Vector3d(1, 0, 0);
  along_u = 2 * kPi * Vector3d(normal.z, 0, -normal.x);
  along_v = kPi * (Vector3d(0, c, 0) - normal.y * outwards);
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
    return surface_along(normal_at(ray, hit));
  }

  void surfaces_at(const RayBlock& rays, const HitBlock& hits, const BlockMask& asked,
                   SurfaceBlock& surfaces) const override {
    const Sphere sphere = *this;  // that no store can change it
    shapes::round_lanes(
        asked,
        [&](int i) {
          return sphere.exact_along(sphere.normal_at(rays.origin(i), rays.direction(i), hits.t[i]));
        },
        surfaces);
  }

  SurfaceDetail detail_at(const Ray3f& ray, const Hit& hit) const override {
    const Vector3d normal = normal_at(ray, hit);
    Vector3d along_u, along_v;
    sphere_tangents(normal, along_u, along_v);
    SurfaceDetail detail;
    detail.uv = sphere_uv(normal);
    detail.along_u = Vector3f(radius_ * along_u);
    detail.along_v = Vector3f(radius_ * along_v);
    return detail;
  }

  std::uint32_t part_count() const override { return 1; }

  PartExtent part_extent(std::uint32_t) const override {
    return {bounds_, static_cast<float>(4 * kPi * radius_ * radius_), Vector3f(0, 1, 0), -1};
  }

  bool sample_part(std::uint32_t, const Vector3f& from, const Vector2f& u,
                   ShapeSample& sample) const override {
    const Vector3d local = (Vector3d(from) - center_) / radius_;
    const SurfacePoint point = surface_along(shapes::choose_point_of_ball(local, local_rounding(from), u));
    return shapes::set_sample(point, part_pdf(0, from, point), sample);
  }

  float part_pdf(std::uint32_t, const Vector3f& from, const SurfacePoint& point) const override {
    const Vector3d local = (Vector3d(from) - center_) / radius_;
    return shapes::usable_density(shapes::ball_density(local, local_rounding(from), Vector3d(point.normal)));
  }

 private:
  Vector3d normal_at(const Vector3f& origin, const Vector3f& direction, float t) const {
    const Vector3d found = Vector3d(origin) + static_cast<double>(t) * Vector3d(direction);
    return glm::normalize(found - center_);
  }
  Vector3d normal_at(const Ray3f& ray, const Hit& hit) const {
    return normal_at(ray.origin, ray.direction, hit.t);
  }

  /// How far off a place may be that was rounded to float a few times, in radii.
  double local_rounding(const Vector3f& place) const {
    constexpr double kTimes = 8;
    return kTimes * kFloatRounding * (1 + static_cast<double>(glm::length(place)) / radius_);
  }

  SurfacePoint surface_along(const Vector3d& normal) const {
    return shapes::rounded_surface(exact_along(normal));
  }

  shapes::ExactPoint exact_along(const Vector3d& normal) const {
    const Vector3d position = center_ + radius_ * normal;
    shapes::SurfaceBound bound;
    // The least that a tangent turned by the rounding of the normal needs to clear the sphere is its square.
    constexpr double kTilt = kFloatRounding * kFloatRounding;
    const Vector3d rounding = 2 * kFloatRounding * glm::abs(position);
    const double squared = glm::dot(rounding, rounding), bend = 0.5 * squared / radius_,
                 length = std::sqrt(squared);
    bound.bend = kTilt * radius_ + (length < bend ? length : bend);
    bound.arithmetic = arithmetic_;
    return {position, normal, bound};
  }

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
    return surface_along(normal_at(ray, hit));
  }

  SurfaceDetail detail_at(const Ray3f& ray, const Hit& hit) const override {
    const Vector3d normal = normal_at(ray, hit);
    Vector3d along_u, along_v;
    sphere_tangents(normal, along_u, along_v);
    return shapes::detail_of(frame_, sphere_uv(normal), along_u, along_v);
  }

  std::uint32_t part_count() const override { return 1; }

  PartExtent part_extent(std::uint32_t) const override {
    // There is no closed formula: the mean over evenly spread points (a spiral by the golden angle).
    constexpr int kPoints = 256;
    constexpr double kGoldenAngle = 2.399963229728653;
    double sum = 0;
    for (int i = 0; i < kPoints; ++i) {
      const double z = (2 * i + 1.0) / kPoints - 1, r = std::sqrt(1 - z * z), a = kGoldenAngle * i;
      sum += frame_.area_scale(frame_.normal_to_world({r * std::cos(a), r * std::sin(a), z}));
    }
    return {bounds_, static_cast<float>(4 * kPi * sum / kPoints), Vector3f(0, 1, 0), -1};
  }

  bool sample_part(std::uint32_t, const Vector3f& from, const Vector2f& u,
                   ShapeSample& sample) const override {
    const Vector3d origin(from);
    const SurfacePoint point = surface_along(
        shapes::choose_point_of_ball(frame_.to_local(origin), frame_.local_rounding(origin), u));
    return shapes::set_sample(point, part_pdf(0, from, point), sample);
  }

  float part_pdf(std::uint32_t, const Vector3f& from, const SurfacePoint& point) const override {
    // A cone of directions w around a unit vector w is |det M| / |M w|^3 times as wide in the world.
    const Vector3d origin(from), local_from = frame_.to_local(origin);
    const Vector3d local = glm::normalize(frame_.to_local(Vector3d(point.position)));
    const Vector3d direction = glm::normalize(local - local_from);
    const double stretch = glm::length(frame_.vector_to_world(direction));
    return shapes::usable_density(shapes::ball_density(local_from, frame_.local_rounding(origin), local) *
                                  stretch * stretch * stretch / frame_.volume_scale());
  }

 private:
  Vector3d normal_at(const Ray3f& ray, const Hit& hit) const {
    return glm::normalize(frame_.to_local(ray).at(static_cast<double>(hit.t)));
  }

  SurfacePoint surface_along(const Vector3d& normal) const {
    return frame_.surface_at(normal, normal, 1, Vector3d(bounds_.diagonal()));
  }

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
