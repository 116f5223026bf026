// The intersection of a line with a ball.
#pragma once

#include <cmath>
#include <glm/glm.hpp>
#include <limits>

#include "shapes/hits.hpp"

namespace raytracer::shapes {

/// Where the line from + t direction is inside the ball of `radius` around the origin. Returns false where it
/// misses.
///
/// The discriminant is taken from the point of the line that is closest to the centre, and the end close to
/// `from` as a quotient: E. Haines, J. Günther, T. Akenine-Möller, "Precision Improvements for Ray/Sphere
/// Intersection", Ray Tracing Gems, 2019, chapter 7. T is float or double; Vector is any three of them.
/// Without kBranches it computes all in any case, for loops that the compiler shall vectorise.
template <bool kBranches = true, class T, class Vector>
inline bool intersect_ball(const Vector& from, const Vector& direction, T radius, Span<T>& span) {
  const T b = -glm::dot(from, direction);
  const T squared_radius = radius * radius;
  const T squared_distance = glm::dot(from, from), a = glm::dot(direction, direction);
  if constexpr (kBranches) {
    // So far past that no rounding matters: most lines that miss are told without a quotient.
    constexpr T kRounding = 1e4f * std::numeric_limits<T>::epsilon();
    if (squared_distance * a - b * b > (squared_radius + kRounding * squared_distance) * a) return false;
  }
  const T c = squared_distance - squared_radius;
  const T inverse_a = T(1) / a;
  const Vector closest = from + (b * inverse_a) * direction;
  const T discriminant = squared_radius - glm::dot(closest, closest);
  if constexpr (kBranches) {
    if (!(discriminant >= 0)) return false;
  }
  const T half_chord = std::sqrt(discriminant * inverse_a);
  const T middle = b * inverse_a;
  const T larger = middle + std::copysign(half_chord, b);
  const T smaller = c * inverse_a / larger;
  span.near = smaller < larger ? smaller : larger;
  span.far = smaller < larger ? larger : smaller;
  return discriminant >= 0;
}

}  // namespace raytracer::shapes
