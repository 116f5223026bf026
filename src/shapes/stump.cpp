#include "shapes/stump.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "shapes/checks.hpp"
#include "shapes/frame.hpp"
#include "shapes/hits.hpp"
#include "shapes/part_sampling.hpp"

namespace raytracer::shapes {

namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();

enum Part : std::uint32_t { kSide = 0, kBase = 1, kTop = 2 };

/// The straight line that turns around z: at height z from -1 to 1 its distance from the axis is middle +
/// slope z, from 0 to 1.
struct Profile {
  double middle, slope;

  double radius_at(double z) const { return middle + slope * z; }
};

/// Where the line is between the planes z = -1 and z = 1. Empty (near > far) where it is not.
Span<double> span_of_height(const LocalRay& ray) {
  const double z = ray.origin.z, dz = ray.direction.z;
  if (dz == 0) return std::abs(z) <= 1 ? Span<double>{-kNever, kNever} : Span<double>{kNever, -kNever};
  const double at_base = (-1 - z) / dz, at_top = (1 - z) / dz;
  return {std::min(at_base, at_top), std::max(at_base, at_top)};
}

/// Where the line meets the endless double cone x^2 + y^2 = radius_at(z)^2, in order, and where it is inside
/// the half of the cone with radius_at(z) >= 0. Returns false where it meets nothing.
///
/// With f and d the vectors (x, y, radius_at(z)) of origin and direction and the product <a, b> = ax bx + ay
/// by - ar br, t solves <d, d> t^2 + 2 <f, d> t + <f, f> = 0. A quarter of the discriminant is, by Lagrange's
/// identity, a sum of squares of 2x2 determinants, which do not grow along the line: no digits are lost for
/// distant origins.
bool meet_side(const LocalRay& ray, const Profile& profile, Span<double>& roots, Span<double>& inside) {
  const Vector3d f(ray.origin.x, ray.origin.y, profile.radius_at(ray.origin.z));
  const Vector3d d(ray.direction.x, ray.direction.y, profile.slope * ray.direction.z);
  const double a = d.x * d.x + d.y * d.y - d.z * d.z;
  const double b = f.x * d.x + f.y * d.y - f.z * d.z;
  const double c = f.x * f.x + f.y * f.y - f.z * f.z;
  const double xr = f.x * d.z - f.z * d.x, yr = f.y * d.z - f.z * d.y, xy = f.x * d.y - f.y * d.x;
  const double discriminant = xr * xr + yr * yr - xy * xy;
  if (discriminant < 0 && a >= 0) return false;

  const double q = -(b + std::copysign(std::sqrt(std::max(discriminant, 0.0)), b));
  if (q == 0) {  // along the axis of a cylinder, or in touch at t = 0
    if (a == 0 && c > 0) return false;
    roots = {0, 0};
    inside = a == 0 ? Span<double>{-kNever, kNever} : roots;
    return true;
  }
  roots = {std::min(q / a, c / q), std::max(q / a, c / q)};
  if (a >= 0) {
    inside = roots;
  } else {  // steeper than the side: the line leaves one half of the double cone and enters the other
    inside = d.z > 0 ? Span<double>{roots.far, kNever} : Span<double>{-kNever, roots.near};
  }
  return true;
}

class Stump final : public Shape {
 public:
  Stump(const Transform& to_world, const Profile& profile, bool open)
      : frame_(to_world), profile_(profile), open_(open) {
    const glm::dmat3& m = to_world.linear;
    const Vector3d circle = glm::sqrt(m[0] * m[0] + m[1] * m[1]);
    const Vector3d base = profile.radius_at(-1) * circle, top = profile.radius_at(1) * circle;
    const Vector3d lower = to_world.translation + glm::min(-m[2] - base, m[2] - top);
    const Vector3d upper = to_world.translation + glm::max(-m[2] + base, m[2] + top);
    bounds_ = rounded_bounds(lower, upper);
    extent_ = upper - lower;
  }

  Box3f bounds() const override { return bounds_; }

  bool is_hit(const Ray3f& ray, Hit& hit) const override {
    const LocalRay local = frame_.to_local(ray);
    const Span<double> height = span_of_height(local);
    Span<double> roots, inside;
    if (!meet_side(local, profile_, roots, inside)) return false;
    return open_ ? is_open_hit(ray, height, roots, hit) : is_closed_hit(ray, local, height, inside, hit);
  }

  SurfacePoint surface_at(const Ray3f& ray, const Hit& hit) const override {
    return surface_of(place_at(ray, hit), hit.primitive);
  }

  SurfaceDetail detail_at(const Ray3f& ray, const Hit& hit) const override {
    const Place place = place_at(ray, hit);
    const float u = turn_share(place.outwards.x, place.outwards.y);
    const Vector3d along_u = 2 * kPi * place.radius * Vector3d(-place.outwards.y, place.outwards.x, 0);
    if (hit.primitive == kSide) {
      return detail_of(frame_, {u, static_cast<float>(0.5 + 0.5 * place.z)}, along_u,
                       2.0 * Vector3d(0, 0, 1) + 2 * profile_.slope * place.outwards);
    }
    const double rim = profile_.radius_at(place.z);
    const float v = rim > 0 ? static_cast<float>(place.radius / rim) : 0.0f;
    return detail_of(frame_, {u, v}, along_u, rim * place.outwards);
  }

  std::uint32_t part_count() const override { return open_ ? 1 : 3; }

  PartExtent part_extent(std::uint32_t part) const override {
    if (part == kSide) {
      constexpr int kPoints = 64;  // there is no closed formula: the mean around the axis
      double sum = 0;
      for (int i = 0; i < kPoints; ++i) {
        const double a = 2 * kPi * i / kPoints;
        sum += frame_.area_scale(frame_.normal_to_world({std::cos(a), std::sin(a), -profile_.slope}));
      }
      return {bounds_, static_cast<float>(local_area(kSide) * sum / kPoints), Vector3f(0, 1, 0), -1};
    }
    const double z = part == kTop ? 1 : -1;
    const Vector3d normal = frame_.normal_to_world({0, 0, z});
    const Vector3d center = frame_.to_world(Vector3d(0, 0, z));
    const Vector3d x = frame_.vector_to_world({1, 0, 0}), y = frame_.vector_to_world({0, 1, 0});
    const Vector3d reach = profile_.radius_at(z) * glm::sqrt(x * x + y * y);
    return flat_extent(rounded_bounds(center - reach, center + reach),
                       local_area(part) * frame_.area_scale(normal), normal);
  }

  /// Uniform over the area that the part has in the frame.
  bool sample_part(std::uint32_t part, const Vector3f& from, const Vector2f& u,
                   ShapeSample& sample) const override {
    if (!(local_area(part) > 0)) return false;
    const double angle = 2 * kPi * static_cast<double>(u.x), share = static_cast<double>(u.y);
    Place place = {Vector3d(std::cos(angle), std::sin(angle), 0), 0, part == kTop ? 1.0 : -1.0};
    if (part == kSide) {
      const double low = profile_.radius_at(-1), high = profile_.radius_at(1);
      const double mean = std::sqrt(low * low + share * (high * high - low * low));
      place.z = std::clamp(low + mean > 0 ? 2 * share * (low + high) / (low + mean) - 1 : -1, -1.0, 1.0);
      place.radius = profile_.radius_at(place.z);
    } else {
      place.radius = std::sqrt(share) * profile_.radius_at(place.z);
    }
    const SurfacePoint point = surface_of(place, part);
    return set_sample(point, part_pdf(part, from, point), sample);
  }

  float part_pdf(std::uint32_t part, const Vector3f& from, const SurfacePoint& point) const override {
    const double area = local_area(part);
    if (!(area > 0)) return 0;
    const Vector3d normal(point.normal);
    return seen_density(1 / (area * frame_.area_scale(normal)), Vector3d(from), Vector3d(point.position),
                        normal);
  }

 private:
  /// A point of the local surface: radius * outwards, z high.
  struct Place {
    Vector3d outwards;  // unit length, across the axis
    double radius, z;
  };

  Place place_at(const Ray3f& ray, const Hit& hit) const {
    const Vector3d found = frame_.to_local(ray).at(static_cast<double>(hit.t));
    const double distance = std::hypot(found.x, found.y);
    const Vector3d outwards =
        distance > 0 ? Vector3d(found.x / distance, found.y / distance, 0) : Vector3d(1, 0, 0);
    if (hit.primitive == kSide) {
      const double z = std::clamp(found.z, -1.0, 1.0);
      return {outwards, std::max(profile_.radius_at(z), 0.0), z};
    }
    const double z = hit.primitive == kTop ? 1 : -1;
    return {outwards, std::min(distance, profile_.radius_at(z)), z};
  }

  SurfacePoint surface_of(const Place& place, std::uint32_t part) const {
    const Vector3d point = place.radius * place.outwards + Vector3d(0, 0, place.z);
    if (part != kSide) return frame_.surface_at(point, Vector3d(0, 0, place.z), 0, extent_);
    constexpr double kTip = 1e-30;  // the tip of a cone bends infinitely
    return frame_.surface_at(point, glm::normalize(place.outwards - Vector3d(0, 0, profile_.slope)),
                             1 / std::max(place.radius, kTip), extent_);
  }

  double local_area(std::uint32_t part) const {
    const double low = profile_.radius_at(-1), high = profile_.radius_at(1);
    if (part == kSide) return kPi * (low + high) * std::hypot(2.0, high - low);
    return part == kTop ? kPi * high * high : kPi * low * low;
  }

  static bool is_open_hit(const Ray3f& ray, const Span<double>& height, const Span<double>& roots, Hit& hit) {
    for (const double t : {roots.near, roots.far}) {
      if (t >= height.near && t <= height.far && is_on_ray(ray, t)) {
        set_hit(hit, t, kSide);
        return true;
      }
    }
    return false;
  }

  /// The body is convex: what the line has in common with it is what two stretches have in common. Side and
  /// caps leave no gap because there is no test where one ends and the other begins.
  static bool is_closed_hit(const Ray3f& ray, const LocalRay& local, const Span<double>& height,
                            const Span<double>& inside, Hit& hit) {
    const double near = std::max(height.near, inside.near);
    const double far = std::min(height.far, inside.far);
    if (!(near <= far)) return false;
    const bool is_upwards = local.direction.z > 0;
    if (is_on_ray(ray, near)) {
      set_hit(hit, near, near == inside.near ? kSide : is_upwards ? kBase : kTop);
    } else if (is_on_ray(ray, far)) {
      set_hit(hit, far, far == inside.far ? kSide : is_upwards ? kTop : kBase);
    } else {
      return false;
    }
    return true;
  }

  Frame frame_;
  Profile profile_;
  bool open_;
  Box3f bounds_;
  Vector3d extent_{0.0};
};

}  // namespace

std::unique_ptr<Shape> make_stump(const Vector3d& base, double base_radius, const Vector3d& top,
                                  double top_radius, bool open, const Transform& transform) {
  const double largest = std::max(base_radius, top_radius);
  const Vector3d half_axis = 0.5 * (top - base);
  glm::dmat3 axes = largest * axes_around(half_axis);
  axes[2] = half_axis;
  const Profile profile = {0.5 * (base_radius + top_radius) / largest,
                           0.5 * (top_radius - base_radius) / largest};
  return std::make_unique<Stump>(Transform{transform.linear * axes, transform.point(base + half_axis)},
                                 profile, open);
}

}  // namespace raytracer::shapes
