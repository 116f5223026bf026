// How a point that was found in double precision becomes a SurfacePoint in float, and how far a ray that
// starts there must step off the surface.
#pragma once

#include "core/numeric.hpp"
#include "raytracer/shape.hpp"

namespace raytracer::shapes {

/// What is known of the surface around a point; lengths in world space.
struct SurfaceBound {
  /// Error of the arithmetic in double precision, across the surface.
  double arithmetic = 0;
  /// How far the surface leaves its tangent plane within the rounding of the position to float and of the
  /// origin of a ray that starts there.
  double bend = 0;
  /// The size of the shape along each axis, where a ray could stay close to the tangent plane so long that
  /// the rounding of the normal matters: anything that is flat in some direction.
  Vector3d extent{0.0};
};

/// Rounds `position` and the unit vector `normal` to float. A ray that starts at position + position_error *
/// normal (computed in float), or as far on the other side, starts beyond the surface: the bound adds up how
/// far the rounded position is off along the normal, how far the rounded origin of the ray may be, and
/// `bound`.
inline SurfacePoint rounded_surface(const Vector3d& position, const Vector3d& normal,
                                    const SurfaceBound& bound) {
  constexpr double kSlack = 1.01;  // for the product and the terms of second order
  SurfacePoint point;
  point.position = Vector3f(position);
  point.normal = Vector3f(normal);
  point.shading_normal = point.normal;
  const Vector3d off = as_float(position) - position;
  const double rounding = kFloatRounding * glm::dot(glm::abs(normal), glm::abs(position));
  const double tilt = glm::dot(glm::abs(as_float(normal) - normal), bound.extent);
  const double error = std::abs(glm::dot(off, normal)) + rounding + tilt + bound.bend + bound.arithmetic;
  point.position_error = float_above(kSlack * error);
  return point;
}

/// The same for all points of a flat part at once: the greatest of their bounds stands for all, so that a
/// point costs no more than its rounding.
class FlatSurface {
 public:
  FlatSurface() = default;
  /// `farthest` holds the greatest |x|, |y| and |z| of its points.
  FlatSurface(const Vector3d& farthest, const Vector3d& normal, const SurfaceBound& bound) {
    // Once for the position, once for the origin of a ray that starts there.
    SurfaceBound both = bound;
    both.arithmetic += kFloatRounding * glm::dot(glm::abs(normal), farthest);
    point_ = rounded_surface(as_float(farthest), normal, both);
  }

  SurfacePoint at(const Vector3d& position) const {
    SurfacePoint point = point_;
    point.position = Vector3f(position);
    return point;
  }
  const SurfacePoint& anywhere() const { return point_; }  ///< all but its position

 private:
  SurfacePoint point_;
};

}  // namespace raytracer::shapes
