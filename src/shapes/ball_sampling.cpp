#include "shapes/ball_sampling.hpp"

#include <algorithm>
#include <cmath>

#include "core/numeric.hpp"
#include "shapes/frame.hpp"

namespace raytracer::shapes {

namespace {

/// Whether a place at this squared distance from the middle is outside for certain.
bool is_outside(double squared_distance, double rounding) { return squared_distance > 1 + 2 * rounding; }

/// 1 - cosine of half the opening angle of the cone that touches the unit sphere; no digits lost far away.
double cone_height(double squared_distance) {
  const double squared_sine = 1 / squared_distance;
  return squared_sine / (1 + std::sqrt(1 - squared_sine));
}

}  // namespace

/// G. Ward, P. Shirley, C. Wang, K. Zimmerman, "Monte Carlo Techniques for Direct Lighting Calculations", ACM
/// TOG 15(1), 1996, section 3.2.2: uniform over the solid angle of the cone.
Vector3d choose_point_of_ball(const Vector3d& from, double rounding, const Vector2f& u) {
  const double squared = glm::dot(from, from);
  const double angle = 2 * kPi * static_cast<double>(u.x), share = static_cast<double>(u.y);
  if (!is_outside(squared, rounding)) {
    const double z = 1 - 2 * share;
    const double r = std::sqrt(std::max(1 - z * z, 0.0));
    return {r * std::cos(angle), r * std::sin(angle), z};
  }
  const double distance = std::sqrt(squared);
  const double height = share * cone_height(squared);  // 1 - cosine
  const double squared_sine = height * (2 - height);
  const double sine = std::sqrt(squared_sine);
  // The way to the near side; what is under the root, squared, is the distance of the ray from the centre.
  const double reach = distance * (1 - height) - std::sqrt(std::max(1 - squared * squared_sine, 0.0));
  const glm::dmat3 axes = axes_around(-from);
  return glm::normalize(
      from + reach * (axes * Vector3d(sine * std::cos(angle), sine * std::sin(angle), 1 - height)));
}

double ball_density(const Vector3d& from, double rounding, const Vector3d& point) {
  const double squared = glm::dot(from, from);
  if (is_outside(squared, rounding)) return 1 / (2 * kPi * cone_height(squared));
  const Vector3d way = point - from;
  const double distance_squared = glm::dot(way, way);
  const double facing = std::abs(glm::dot(point, way));
  return distance_squared * std::sqrt(distance_squared) / (4 * kPi * facing);
}

}  // namespace raytracer::shapes
