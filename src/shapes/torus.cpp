#include <algorithm>
#include <array>
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

/// Finds the root of a function in [low, high], given that its sign differs at the two ends and it is
/// monotonic in between: Newton's steps, halving instead wherever they leave the bracket or converge too
/// slowly. `Function` returns value and derivative as a pair.
template <class Function>
double monotonic_root(const Function& function, double low, double high, bool is_low_negative) {
  constexpr double kConverged = 4 * kDoubleRounding;
  constexpr int kEnough = 100;  // halving alone is done after 54
  double x = 0.5 * (low + high);
  double last_step = high - low;
  for (int i = 0; i < kEnough; ++i) {
    const auto [value, derivative] = function(x);
    ((value < 0) == is_low_negative ? low : high) = x;
    const double newton = x - value / derivative;
    const bool is_good = newton > low && newton < high && std::abs(newton - x) < 0.5 * std::abs(last_step);
    const double next = is_good ? newton : 0.5 * (low + high);
    last_step = next - x;
    x = next;
    if (std::abs(last_step) <= kConverged) break;
  }
  return x;
}

/// x^4 + c2 x^2 + c1 x + c0, with no cubic term.
struct Quartic {
  double c2, c1, c0;

  double value(double x) const { return (x * x + c2) * x * x + c1 * x + c0; }
  double slope(double x) const { return (4 * x * x + 2 * c2) * x + c1; }
  double bend(double x) const { return 12 * x * x + 2 * c2; }
};

/// Up to N numbers in ascending order.
template <std::size_t N>
struct Ascending {
  std::array<double, N> items;
  std::size_t size = 0;

  void add(double item) { items[size++] = item; }
};

/// -reach, the places in between where the slope of the quartic is zero, and reach: between neighbours it is
/// monotonic. Those places lie in turn between the places where the slope's own slope is zero, which are
/// known.
Ascending<5> monotonic_stretches(const Quartic& quartic, double reach) {
  Ascending<4> slope_stretches;
  slope_stretches.add(-reach);
  const double squared = -quartic.c2 / 6;
  if (squared > 0 && squared < reach * reach) {
    slope_stretches.add(-std::sqrt(squared));
    slope_stretches.add(std::sqrt(squared));
  }
  slope_stretches.add(reach);

  Ascending<5> stretches;
  stretches.add(-reach);
  const auto slope = [&](double x) { return std::pair(quartic.slope(x), quartic.bend(x)); };
  for (std::size_t i = 0; i + 1 < slope_stretches.size; ++i) {
    const double low = slope_stretches.items[i], high = slope_stretches.items[i + 1];
    const bool is_low_negative = quartic.slope(low) < 0;
    if (is_low_negative != (quartic.slope(high) < 0)) {
      stretches.add(monotonic_root(slope, low, high, is_low_negative));
    }
  }
  stretches.add(reach);
  return stretches;
}

/// The torus around z with its ring of radius `ring` and its tube of radius `tube`, ring + tube = 1, in a
/// frame. u runs once around the axis, v once around the tube from the outside up. For axis y, radius 2 and
/// tube_radius 1, before the transform:
///
///     point      u     v
///      3  0  0   0     0
///      0  0 -3   0.25  0
///      2  1  0   0     0.25
///     -1  0  0   0.5   0.5
///      2 -1  0   0     0.75
class Torus final : public Shape {
 public:
  Torus(const Transform& to_world, double ring, double tube) : frame_(to_world), ring_(ring), tube_(tube) {
    // A torus is a circle with a ball around each of its points.
    const glm::dmat3& m = to_world.linear;
    const Vector3d circle = m[0] * m[0] + m[1] * m[1];
    const Vector3d reach = ring * glm::sqrt(circle) + tube * glm::sqrt(circle + m[2] * m[2]);
    bounds_ = shapes::rounded_bounds(to_world.translation - reach, to_world.translation + reach);
  }

  Box3f bounds() const override { return bounds_; }

  /// With s the distance along the line from its point p closest to the centre, p.d = 0, so |p + s d|^2 =
  /// |p|^2 + s^2 and the torus (|x|^2 + ring^2 - tube^2)^2 = 4 ring^2 (x1^2 + x2^2) becomes a quartic without
  /// a cubic term, its numbers all about 1 wherever the ray comes from. Signs at the ends of its monotonic
  /// stretches tell how many roots there are, so that no root is lost or invented by cancellation as in the
  /// closed formulas.
  bool is_hit(const Ray3f& ray, Hit& hit) const override {
    const LocalRay local = frame_.to_local(ray);
    const double speed = glm::length(local.direction);
    const Vector3d d = local.direction / speed;
    const double to_closest = -glm::dot(local.origin, d);
    const Vector3d p = local.origin + to_closest * d;
    constexpr double kAround =
        1 + 1e-6;  // all of the torus is inside this ball, and its rim outside the torus
    const double squared_reach = kAround * kAround - glm::dot(p, p);
    if (!(squared_reach > 0)) return false;
    const double reach = std::sqrt(squared_reach);
    const double low = static_cast<double>(ray.t_min) * speed - to_closest - kSpare;
    const double high = static_cast<double>(ray.t_max) * speed - to_closest + kSpare;
    if (low > reach || high < -reach) return false;

    const double k = glm::dot(p, p) + ring_ * ring_ - tube_ * tube_;
    const double four = 4 * ring_ * ring_;
    const Quartic quartic = {2 * k - four * (d.x * d.x + d.y * d.y), -2 * four * (p.x * d.x + p.y * d.y),
                             k * k - four * (p.x * p.x + p.y * p.y) - kTouch};
    const auto function = [&](double s) { return std::pair(quartic.value(s), quartic.slope(s)); };
    const Ascending<5> ends = monotonic_stretches(quartic, reach);
    bool is_inside = quartic.value(ends.items[0]) < 0;
    for (std::size_t i = 1; i < ends.size && ends.items[i - 1] <= high; ++i) {
      const bool was_inside = is_inside;
      is_inside = quartic.value(ends.items[i]) < 0;
      if (is_inside == was_inside || ends.items[i] < low) continue;
      const double s = monotonic_root(function, ends.items[i - 1], ends.items[i], was_inside);
      const double t = (to_closest + s) / speed;
      if (shapes::is_on_ray(ray, t)) {
        shapes::set_hit(hit, t);
        return true;
      }
    }
    return false;
  }

  SurfacePoint surface_at(const Ray3f& ray, const Hit& hit) const override {
    return surface_of(place_at(ray, hit));
  }

  SurfaceDetail detail_at(const Ray3f& ray, const Hit& hit) const override {
    const Place place = place_at(ray, hit);
    const Vector3d& outwards = place.outwards;
    const double cosine = glm::dot(place.normal, outwards), sine = place.normal.z;
    const Vector2f uv(shapes::turn_share(outwards.x, outwards.y), shapes::turn_share(cosine, sine));
    return shapes::detail_of(frame_, uv,
                             2 * kPi * (ring_ + tube_ * cosine) * Vector3d(-outwards.y, outwards.x, 0),
                             2 * kPi * tube_ * (Vector3d(0, 0, cosine) - sine * outwards));
  }

  std::uint32_t part_count() const override { return 1; }

  PartExtent part_extent(std::uint32_t) const override {
    constexpr int kPoints = 32;  // around and across: there is no closed formula
    double sum = 0, weights = 0;
    for (int i = 0; i < kPoints * kPoints; ++i) {
      const double a = 2 * kPi * (i % kPoints) / kPoints, b = 2 * kPi * (i / kPoints) / kPoints;
      const double weight = std::abs(ring_ + tube_ * std::cos(b));
      const Vector3d normal(std::cos(b) * std::cos(a), std::cos(b) * std::sin(a), std::sin(b));
      sum += weight * frame_.area_scale(frame_.normal_to_world(normal));
      weights += weight;
    }
    return {bounds_, static_cast<float>(local_area() * sum / weights), Vector3f(0, 1, 0), -1};
  }

  /// Uniform over the area that the torus has in the frame.
  bool sample_part(std::uint32_t, const Vector3f& from, const Vector2f& u,
                   ShapeSample& sample) const override {
    const double around = 2 * kPi * static_cast<double>(u.x);
    const Vector3d outwards(std::cos(around), std::sin(around), 0);
    const double across = angle_across(static_cast<double>(u.y));
    const Vector3d normal = std::cos(across) * outwards + Vector3d(0, 0, std::sin(across));
    const SurfacePoint point = surface_of({outwards, normal});
    return shapes::set_sample(point, part_pdf(0, from, point), sample);
  }

  float part_pdf(std::uint32_t, const Vector3f& from, const SurfacePoint& point) const override {
    const Vector3d normal(point.normal);
    return shapes::seen_density(1 / (local_area() * frame_.area_scale(normal)), Vector3d(from),
                                Vector3d(point.position), normal);
  }

 private:
  /// A point of the local surface: ring * outwards + tube * normal.
  struct Place {
    Vector3d outwards;  // unit length, across the axis
    Vector3d normal;    // unit length
  };

  Place place_at(const Ray3f& ray, const Hit& hit) const {
    const Vector3d found = frame_.to_local(ray).at(static_cast<double>(hit.t));
    const double distance = std::hypot(found.x, found.y);
    Vector3d outwards =
        distance > 0 ? Vector3d(found.x / distance, found.y / distance, 0) : Vector3d(1, 0, 0);
    // Where the torus crosses itself, the tube may be the one around the far side of the ring.
    const auto error = [&](const Vector3d& side) {
      return std::abs(glm::length(found - ring_ * side) - tube_);
    };
    if (error(-outwards) < error(outwards)) outwards = -outwards;
    return {outwards, glm::normalize(found - ring_ * outwards)};
  }

  SurfacePoint surface_of(const Place& place) const {
    const Vector3d point = ring_ * place.outwards + tube_ * place.normal;
    constexpr double kOnAxis = 1e-6;
    const double from_axis = std::max(std::hypot(point.x, point.y), kOnAxis);
    // The gradient of the quartic is 8 ring tube from_axis long; twice, for its rounding and for kTouch.
    return frame_.surface_at(point, place.normal, std::max(1 / tube_, 1 / from_axis),
                             Vector3d(bounds_.diagonal()), 1 / (4 * ring_ * tube_ * from_axis));
  }

  // Around the tube from the outside the distance from the axis is ring + tube cos(angle); below 0 the tube
  // has crossed the axis. Its integral, and the angle where that happens:
  double integral(double angle) const { return ring_ * angle + tube_ * std::sin(angle); }
  double turning_angle() const { return tube_ > ring_ ? std::acos(-ring_ / tube_) : kPi; }

  // Of the upper half of the tube, a share of the area.
  double half_integral() const { return 2 * integral(turning_angle()) - integral(kPi); }
  double local_area() const { return 4 * kPi * tube_ * half_integral(); }

  /// The angle around the tube with the share `u` of the area below it, upper half first.
  double angle_across(double u) const {
    const double sign = u < 0.5 ? 1 : -1;
    const double wanted = (u < 0.5 ? 2 * u : 2 * u - 1) * half_integral();
    const double turn = turning_angle(), at_turn = integral(turn);
    const bool is_first = wanted <= at_turn;
    const auto function = [&](double angle) {
      const double rising = integral(angle), slope = ring_ + tube_ * std::cos(angle);
      return is_first ? std::pair(rising - wanted, slope) : std::pair(2 * at_turn - rising - wanted, -slope);
    };
    return sign *
           (is_first ? monotonic_root(function, 0, turn, true) : monotonic_root(function, turn, kPi, true));
  }

  static constexpr double kSpare = 1e-9;  // about t_min and t_max, until a root is known
  // Added to the inside, about the rounding of the quartic: a line along the axis of a spindle only touches
  // its tips, and is to hit them.
  static constexpr double kTouch = 16 * kDoubleRounding;

  Frame frame_;
  double ring_, tube_;
  Box3f bounds_;
};

}  // namespace

std::unique_ptr<Shape> make_torus(const Vector3d& center, const Vector3d& axis, double radius,
                                  double tube_radius, const Transform& transform) {
  shapes::require_finite(center, "center");
  shapes::require_nonzero(axis, "axis");
  shapes::require_positive(radius, "radius");
  shapes::require_positive(tube_radius, "tube_radius");
  shapes::require_regular(transform);
  const double outer = radius + tube_radius;
  return std::make_unique<Torus>(
      Transform{transform.linear * (outer * shapes::axes_around(axis)), transform.point(center)},
      radius / outer, tube_radius / outer);
}

}  // namespace raytracer
