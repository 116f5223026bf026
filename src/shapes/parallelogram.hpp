// Flat parts with four corners, seen from somewhere.
#pragma once

#include "raytracer/shape.hpp"

namespace raytracer::shapes {

/// The points corner + s width + t height with s, t in [0, 1]. World space.
struct Parallelogram {
  Vector3d corner, width, height;
  Vector3d normal;  ///< unit length, along width x height or against it

  Vector3d at(const glm::dvec2& st) const { return corner + st.x * width + st.y * height; }
  double area() const { return glm::length(glm::cross(width, height)); }
  Box3f bounds() const;

  /// Chooses s and t as seen from `from`: uniform over the directions where it is a rectangle close by,
  /// uniform over the area otherwise. Returns the density per steradian; 0 where `from` lies in its plane.
  float choose(const Vector3d& from, const Vector2f& u, glm::dvec2& st) const;
  /// The density per steradian with which choose() takes the direction of `position`, a point of it.
  float pdf(const Vector3d& from, const Vector3d& position) const;

 private:
  float area_density(const Vector3d& from, const Vector3d& position) const;
};

}  // namespace raytracer::shapes
