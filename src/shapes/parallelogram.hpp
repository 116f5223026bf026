// Flat parts with four corners, seen from somewhere.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>

#include "raytracer/shape.hpp"
#include "shapes/part_sampling.hpp"
#include "shapes/places_seen.hpp"
#include "shapes/spherical_rectangle.hpp"

namespace raytracer::shapes {

/// The points corner + s width + t height with s, t in [0, 1]. World space.
struct Parallelogram {
  Vector3d corner{0.0}, width{0.0}, height{0.0};
  Vector3d normal{0.0};  ///< unit length, along width x height or against it

  Parallelogram() = default;
  Parallelogram(const Vector3d& from_corner, const Vector3d& along_width, const Vector3d& along_height,
                const Vector3d& unit_normal);

  Vector3d at(const glm::dvec2& st) const { return corner + st.x * width + st.y * height; }
  double area() const { return area_; }
  Box3f bounds() const;

  /// Chooses s and t as seen from `from`: uniform over the directions where it is a rectangle close by,
  /// uniform over the area otherwise. Returns the density per steradian; 0 where `from` lies in its plane.
  float choose(const Vector3d& from, const Vector2f& u, glm::dvec2& st) const {
    if (is_near_rectangle(from)) return choose_near(from, u, st);
    st = {static_cast<double>(u.x), static_cast<double>(u.y)};
    return area_density(from, at(st));
  }
  /// Likewise for sixteen at once, to the last bit.
  void choose(const PlacesToSeeFrom& from, PlacesSeen& seen) const;
  /// The density per steradian with which choose() takes the direction of `position`, a point of it.
  float pdf(const Vector3d& from, const Vector3d& position) const {
    return is_near_rectangle(from) ? pdf_near(from, position) : area_density(from, position);
  }

 private:
  bool is_near_rectangle(const Vector3d& from) const {
    const Vector3d way = from - middle_;
    return glm::dot(way, way) < near_squared_;
  }
  float choose_near(const Vector3d& from, const Vector2f& u, glm::dvec2& st) const;
  void choose_near(const PlacesToSeeFrom& from, const std::array<std::uint32_t, kBlockSize>& is_near,
                   PlacesSeen& seen) const;
  float pdf_near(const Vector3d& from, const Vector3d& position) const;
  float area_density(const Vector3d& from, const Vector3d& position) const {
    // The height of `from` above the plane, free of the rounding of `position`.
    const Vector3d way = position - from;
    const double squared = glm::dot(way, way);
    const double facing = std::abs(glm::dot(from - corner, normal));
    return usable_density(squared * std::sqrt(squared) *
                          (1 / (area_ * facing)));  // root and quotient at once
  }

  Rectangle rectangle_;  // where near_squared_ > 0
  Vector3d middle_{0.0};
  double area_ = 0;
  double near_squared_ = 0;  // closer to the middle than this it is chosen by directions; 0: no rectangle
};

}  // namespace raytracer::shapes
