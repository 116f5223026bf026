#include "shapes/checks.hpp"

#include <fmt/format.h>

#include <cmath>

#include "core/numeric.hpp"
#include "raytracer/error.hpp"

namespace raytracer::shapes {

namespace {

constexpr double kLargestCoordinate = 1e18;
// Spare room around a box, in units in the last place of its coordinates: one for a point that was rounded to
// float, the rest for the traversal that meets the box.
constexpr double kSpareUnits = 4;
// The volume of the unit cube's image over the product of its edges; below this the inverse has lost its
// digits.
constexpr double kLeastRelativeVolume = 1e-9;

}  // namespace

void require_finite(double value, const char* property) {
  if (!std::isfinite(value))
    throw Error(ErrorKind::kScene, fmt::format("'{}' is not a finite number", property));
}

void require_finite(const Vector3d& value, const char* property) {
  if (!is_finite(value)) {
    throw Error(ErrorKind::kScene, fmt::format("'{}' has a part that is not a finite number", property));
  }
}

void require_positive(double value, const char* property) {
  require_finite(value, property);
  if (value <= 0) {
    throw Error(ErrorKind::kScene, fmt::format("'{}' must be greater than 0, not {}", property, value));
  }
}

void require_not_negative(double value, const char* property) {
  require_finite(value, property);
  if (value < 0) {
    throw Error(ErrorKind::kScene, fmt::format("'{}' must not be less than 0, as {} is", property, value));
  }
}

void require_nonzero(const Vector3d& value, const char* property) {
  require_finite(value, property);
  if (value == Vector3d(0.0)) {
    throw Error(ErrorKind::kScene, fmt::format("'{}' is 0 0 0: it has no direction", property));
  }
}

void require_apart(const Vector3d& base, const Vector3d& top) {
  require_finite(base, "base");
  require_finite(top, "top");
  if (base == top) throw Error(ErrorKind::kScene, "'base' and 'top' are the same point: there is no axis");
}

void require_regular(const Transform& transform) {
  const glm::dmat3& m = transform.linear;
  if (!is_finite(m[0]) || !is_finite(m[1]) || !is_finite(m[2]) || !is_finite(transform.translation)) {
    throw Error(ErrorKind::kScene, "the transform has a part that is not a finite number");
  }
  const double edges = glm::length(m[0]) * glm::length(m[1]) * glm::length(m[2]);
  if (!(std::abs(glm::determinant(m)) > kLeastRelativeVolume * edges)) {
    throw Error(ErrorKind::kScene, "the transform squeezes the shape flat");
  }
}

bool are_parallel(const Vector3d& a, const Vector3d& b) {
  constexpr double kLeastSine = 1e-9;
  return !(glm::length(glm::cross(a, b)) > kLeastSine * glm::length(a) * glm::length(b));
}

Box3f rounded_bounds(const Vector3d& lower, const Vector3d& upper) {
  Box3f box;
  for (int i = 0; i < 3; ++i) {
    const double largest = std::max(std::abs(lower[i]), std::abs(upper[i]));
    if (!(largest <= kLargestCoordinate)) {
      throw Error(ErrorKind::kScene, "the shape lies outside the range of coordinates, 1e18");
    }
    const double spare = kSpareUnits * 2 * kFloatRounding * largest;
    box.lower[i] = float_below(lower[i] - spare);
    box.upper[i] = float_above(upper[i] + spare);
  }
  return box;
}

}  // namespace raytracer::shapes
