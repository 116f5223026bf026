// What the shapes that shine have in common when a point of them is chosen as seen from somewhere.
#pragma once

#include <cmath>

#include "core/numeric.hpp"
#include "raytracer/shape.hpp"

namespace raytracer::shapes {

/// A density per steradian as float; 0 where it is no number or too large for one, so that what lies there
/// weighs nothing.
inline float usable_density(double per_steradian) {
  constexpr double kMost = 1e30;
  return ((per_steradian > 0) & (per_steradian < kMost)) ? static_cast<float>(per_steradian) : 0.0f;
}

/// The density per steradian, as seen from `from`, of a choice that has the density `per_area` at `position`,
/// where the surface has the unit normal `normal`. 0 for a surface seen edge-on.
inline float seen_density(double per_area, const Vector3d& from, const Vector3d& position,
                          const Vector3d& normal) {
  const Vector3d way = position - from;
  const double squared = glm::dot(way, way);
  const double facing = std::abs(glm::dot(normal, way));  // distance times cosine
  return usable_density(per_area * squared * std::sqrt(squared) / facing);
}

/// The sample at a point that was chosen with this density; false where it is of no use.
inline bool set_sample(const SurfacePoint& point, float pdf, ShapeSample& sample) {
  sample.position = point.position;
  sample.position_error = point.position_error;
  sample.normal = point.normal;
  sample.pdf = pdf;
  return pdf > 0;
}

/// Everything known of a flat part.
inline PartExtent flat_extent(const Box3f& bounds, double area, const Vector3d& normal) {
  return {bounds, static_cast<float>(area), Vector3f(normal), 1};
}

/// A point of the unit disk, uniform by area; the first of `u` goes around.
inline glm::dvec2 point_of_disk(const Vector2f& u) {
  const double radius = std::sqrt(static_cast<double>(u.y)), angle = 2 * kPi * static_cast<double>(u.x);
  return {radius * std::cos(angle), radius * std::sin(angle)};
}

}  // namespace raytracer::shapes
