// Points on a triangle that shines, chosen as they are seen from somewhere.
#pragma once

#include "raytracer/shape.hpp"

namespace raytracer::shapes {

/// A triangle and the place it is seen from. Directions are chosen evenly over the solid angle where it is
/// large enough to matter, else points evenly over the area: there the two hardly differ, and what is
/// computed from the angles of a very small spherical triangle has lost its digits.
class SeenTriangle {
 public:
  /// `normal` is that of the triangle, of unit length.
  SeenTriangle(const Vector3d& a, const Vector3d& b, const Vector3d& c, const Vector3d& normal,
               const Vector3d& from);

  /// False where the triangle is seen from its edge.
  bool is_seen() const { return is_seen_; }
  /// Maps `u` in [0, 1)² to the weights of b and c of a point of the triangle.
  glm::dvec2 sample(const Vector2f& u) const;
  /// The density per steradian with which sample() chooses the direction to `point`, a point of the triangle.
  double pdf(const Vector3d& point) const;

 private:
  glm::dvec2 sample_solid_angle(const Vector2f& u) const;

  Vector3d a_, b_, c_;
  Vector3d normal_, from_;
  double area_ = 0;
  double solid_angle_ = 0;
  bool is_seen_ = false;
  bool by_solid_angle_ = false;
};

}  // namespace raytracer::shapes
