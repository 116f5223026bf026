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
  double area(std::size_t a, std::size_t b, std::size_t c) const;
  bool is_within(std::size_t point, std::size_t a, std::size_t b, std::size_t c) const;

  std::vector<Vector2d> points_;
  std::vector<std::uint32_t> next_, previous_;
  std::vector<std::uint32_t> reflex_;  // corners that may lie in the way of an ear
  std::size_t left_ = 0;               // corners not cut off yet
  std::uint64_t budget_ = 0;           // how many more corners are tested against ears
};

}  // namespace raytracer::meshes
