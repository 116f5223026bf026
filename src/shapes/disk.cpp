#include <algorithm>
#include <cmath>

#include "raytracer/shapes.hpp"
#include "shapes/checks.hpp"
#include "shapes/frame.hpp"
#include "shapes/hits.hpp"
#include "shapes/part_sampling.hpp"

namespace raytracer {

namespace {

using shapes::Frame;
using shapes::LocalRay;

/// The unit disk across z in a frame. u runs once around from the frame's first axis towards the second, v
/// from the centre to the rim. For the normal y and radius 1, before the transform:
///
///     point       u     v
///      0  0  0    any   0
///      1  0  0    0     1
///      0  0 -1    0.25  1
///     -0.5 0 0    0.5   0.5
class Disk final : public Shape {
 public:
  explicit Disk(const Transform& to_world) : frame_(to_world) {
    const Vector3d x = to_world.linear[0], y = to_world.linear[1];
    const Vector3d reach = glm::sqrt(x * x + y * y);
    bounds_ = shapes::rounded_bounds(to_world.translation - reach, to_world.translation + reach);
    extent_ = 2.0 * reach;
  }

  Box3f bounds() const override { return bounds_; }

  bool is_hit(const Ray3f& ray, Hit& hit) const override {
    const LocalRay local = frame_.to_local(ray);
    const double t = -local.origin.z / local.direction.z;
    if (!shapes::is_on_ray(ray, t)) return false;
    const Vector3d point = local.at(t);
    if (!(point.x * point.x + point.y * point.y <= 1)) return false;
    shapes::set_hit(hit, t);
    return true;
  }

  SurfacePoint surface_at(const Ray3f& ray, const Hit& hit) const override {
    return surface_of(local_point(ray, hit));
  }

  SurfaceDetail detail_at(const Ray3f& ray, const Hit& hit) const override {
    const Vector3d point = local_point(ray, hit);
    const double distance = std::hypot(point.x, point.y);
    const Vector2f uv(shapes::turn_share(point.x, point.y), static_cast<float>(std::min(distance, 1.0)));
    const Vector3d along_v = distance > 0 ? point / distance : Vector3d(1, 0, 0);
    return shapes::detail_of(frame_, uv, 2 * kPi * Vector3d(-point.y, point.x, 0), along_v);
  }

  std::uint32_t part_count() const override { return 1; }

  PartExtent part_extent(std::uint32_t) const override {
    const Vector3d normal = world_normal();
    return shapes::flat_extent(bounds_, kPi * frame_.area_scale(normal), normal);
  }

  /// Uniform over the area, whatever the frame makes of the disk.
  bool sample_part(std::uint32_t, const Vector3f& from, const Vector2f& u,
                   ShapeSample& sample) const override {
    const SurfacePoint point = surface_of(Vector3d(shapes::point_of_disk(u), 0));
    return shapes::set_sample(point, part_pdf(0, from, point), sample);
  }

  float part_pdf(std::uint32_t, const Vector3f& from, const SurfacePoint& point) const override {
    // The height of `from` above the plane, free of the rounding of the point.
    const Vector3d origin(from), normal = world_normal();
    const Vector3d way = Vector3d(point.position) - origin;
    const double squared = glm::dot(way, way);
    const double facing = std::abs(glm::dot(normal, frame_.to_world(Vector3d(0.0)) - origin));
    return shapes::usable_density(squared * std::sqrt(squared) / (kPi * frame_.area_scale(normal) * facing));
  }

 private:
  Vector3d world_normal() const { return frame_.normal_to_world(Vector3d(0, 0, 1)); }

  Vector3d local_point(const Ray3f& ray, const Hit& hit) const {
    const Vector3d found = frame_.to_local(ray).at(static_cast<double>(hit.t));
    const double distance = std::hypot(found.x, found.y);
    const double shrink = distance > 1 ? 1 / distance : 1.0;
    return {found.x * shrink, found.y * shrink, 0};
  }

  SurfacePoint surface_of(const Vector3d& point) const {
    return frame_.surface_at(point, Vector3d(0, 0, 1), 0, extent_);
  }

  Frame frame_;
  Box3f bounds_;
  Vector3d extent_{0.0};
};

}  // namespace

std::unique_ptr<Shape> make_disk(const Vector3d& center, const Vector3d& normal, double radius,
                                 const Transform& transform) {
  shapes::require_finite(center, "center");
  shapes::require_nonzero(normal, "normal");
  shapes::require_positive(radius, "radius");
  shapes::require_regular(transform);
  return std::make_unique<Disk>(
      Transform{transform.linear * (radius * shapes::axes_around(normal)), transform.point(center)});
}

}  // namespace raytracer
