// The intersection of a ray with a triangle, for all that is made of triangles.
#pragma once

#include <array>

#include "raytracer/shape.hpp"

namespace raytracer::shapes {

/// A triangle as is_hit() wants it.
class TriangleCorners {
 public:
  TriangleCorners(const Vector3d& a, const Vector3d& b, const Vector3d& c);

  const Vector3d& operator[](std::size_t i) const { return corners_[i]; }
  /// Unit length, along (b - a) x (c - a); NaN where they lie on one line.
  const Vector3d& normal() const { return normal_; }
  /// The size along each axis.
  const Vector3d& extent() const { return extent_; }

  /// As Shape::is_hit(); the hit is of `primitive`, and its u and v are the weights of b and c:
  ///
  ///     point    u    v
  ///     a        0    0
  ///     b        1    0
  ///     c        0    1
  ///     middle   1/3  1/3
  ///
  /// Watertight: a ray through a common edge or corner of two triangles hits at least one of them, because
  /// both compute the very same number for the side on which it passes. S. Woop, C. Benthin, I. Wald,
  /// "Watertight Ray/Triangle Intersection", JCGT 2(1), 2013; here in double, and with every edge taken from
  /// its lesser end to the greater. t comes from the plane, so that a ray that starts beside it stays there.
  bool is_hit(const Ray3f& ray, std::uint32_t primitive, Hit& hit) const;

 private:
  std::array<Vector3d, 3> corners_;
  std::array<std::size_t, 3> ascending_ = {0, 1, 2};  // the corners from the least to the greatest
  Vector3d normal_;
  Vector3d extent_;
};

}  // namespace raytracer::shapes
