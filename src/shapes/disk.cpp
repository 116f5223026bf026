#include <algorithm>
#include <cmath>

#include "raytracer/shapes.hpp"
#include "shapes/checks.hpp"
#include "shapes/frame.hpp"
#include "shapes/hits.hpp"

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
    const Vector3d found = frame_.to_local(ray).at(static_cast<double>(hit.t));
    const double distance = std::hypot(found.x, found.y);
    const double shrink = distance > 1 ? 1 / distance : 1.0;
    const Vector3d point(found.x * shrink, found.y * shrink, 0);
    const Vector2f uv(shapes::turn_share(point.x, point.y), static_cast<float>(std::min(distance, 1.0)));
    return frame_.surface_at(point, Vector3d(0, 0, 1), uv, 0, extent_);
  }

 private:
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
