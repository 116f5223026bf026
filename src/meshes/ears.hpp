// Cutting one polygon into triangles.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "raytracer/vector3f.hpp"

namespace raytracer::meshes {

/// Cuts polygons, one after the other; an object only to keep its memory between them.
class EarClipper {
 public:
  /// Writes the size - 2 triangles of the polygon to `out`, in its orientation. It may be concave and not
  /// quite flat; one that crosses itself is cut in some way.
  void cut(std::span<const std::uint32_t> corners, const std::vector<Vector3f>& positions,
           std::array<std::uint32_t, 3>* out);

 private:
  using Vector2d = glm::dvec2;

  void project(std::span<const std::uint32_t> corners, const std::vector<Vector3f>& positions);
  void find_bulges();
  std::size_t find_ear(std::size_t from);
  bool is_ear(std::size_t corner);
  static double area(const Vector2d& a, const Vector2d& b, const Vector2d& c);
  double area_at(std::size_t corner) const;
  void cut_off(std::size_t corner);
  void forget_if_convex(std::size_t corner);
  void forget(std::size_t corner);

  // A corner that bulges inward, and so may lie in the way of an ear.
  struct Reflex {
    Vector2d point;
    std::uint32_t corner;
  };

  std::vector<Vector2d> points_;
  std::vector<std::uint32_t> next_, previous_;
  std::vector<Reflex> reflex_;
  std::vector<std::uint32_t> reflex_place_;  // a corner's place in reflex_, or kConvex
  std::size_t left_ = 0;                     // corners not cut off yet
  std::uint64_t budget_ = 0;                 // how many more corners are tested against ears
};

}  // namespace raytracer::meshes
