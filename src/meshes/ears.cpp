#include "meshes/ears.hpp"

#include <cmath>
#include <utility>

namespace raytracer::meshes {
namespace {

// Tests against ears for each corner of a polygon. Faces drawn by hand or by programs need a few; one made to
// need them all would take the square of its size, and is cut without further tests instead.
constexpr std::uint64_t kTestsPerCorner = 4096;

}  // namespace

void EarClipper::cut(std::span<const std::uint32_t> corners, const std::vector<Vector3f>& positions,
                     std::array<std::uint32_t, 3>* out) {
  if (corners.size() == 3) {
    *out = {corners[0], corners[1], corners[2]};
    return;
  }
  project(corners, positions);
  if (corners.size() == 4) {
    const bool other = !(area(0, 1, 2) > 0 && area(0, 2, 3) > 0) && area(1, 2, 3) > 0 && area(1, 3, 0) > 0;
    const std::size_t a = other ? 1 : 0;
    *out++ = {corners[a], corners[a + 1], corners[a + 2]};
    *out = {corners[a], corners[a + 2], corners[(a + 3) % 4]};
    return;
  }
  find_bulges();
  std::size_t corner = 1;
  for (; left_ > 2; --left_) {
    corner = find_ear(corner);
    const std::uint32_t before = previous_[corner], after = next_[corner];
    *out++ = {corners[before], corners[corner], corners[after]};
    next_[before] = after;
    previous_[after] = before;
    next_[corner] = static_cast<std::uint32_t>(corner);  // gone
    corner = after;
  }
}

// Onto the plane of two axes that the polygon is flattest in; so turned that it runs counter-clockwise.
void EarClipper::project(std::span<const std::uint32_t> corners, const std::vector<Vector3f>& positions) {
  const Vector3d origin(positions[corners[0]]);
  Vector3d normal(0);  // twice the area along each axis (M. Newell)
  for (std::size_t i = 1; i + 1 < corners.size(); ++i) {
    normal +=
        glm::cross(Vector3d(positions[corners[i]]) - origin, Vector3d(positions[corners[i + 1]]) - origin);
  }
  const Vector3d size = glm::abs(normal);
  const int axis = size.x > size.y ? (size.x > size.z ? 0 : 2) : (size.y > size.z ? 1 : 2);
  int u = (axis + 1) % 3, v = (axis + 2) % 3;
  if (normal[axis] < 0) std::swap(u, v);
  points_.resize(corners.size());
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vector3d point = Vector3d(positions[corners[i]]) - origin;
    points_[i] = {point[u], point[v]};
  }
}

void EarClipper::find_bulges() {
  left_ = points_.size();
  budget_ = kTestsPerCorner * left_;
  next_.resize(left_);
  previous_.resize(left_);
  reflex_.clear();
  for (std::size_t i = 0; i < left_; ++i) {
    next_[i] = static_cast<std::uint32_t>(i + 1 < left_ ? i + 1 : 0);
    previous_[i] = static_cast<std::uint32_t>(i > 0 ? i - 1 : left_ - 1);
  }
  for (std::size_t i = 0; i < left_; ++i) {
    if (!(area(previous_[i], i, next_[i]) > 0)) reflex_.push_back(static_cast<std::uint32_t>(i));
  }
}

// The first ear; where there is none, a corner that spans no area, or else the one to begin with.
std::size_t EarClipper::find_ear(std::size_t from) {
  std::size_t corner = from, flat = from;
  bool has_flat = false;
  for (std::size_t i = 0; i < left_ && budget_ > 0; ++i, corner = next_[corner]) {
    --budget_;
    const double size = area(previous_[corner], corner, next_[corner]);
    if (size > 0 && is_ear(corner)) return corner;
    if (size == 0 && !has_flat) {
      has_flat = true;
      flat = corner;
    }
  }
  return flat;
}

// Whether no other corner of the polygon lies in the triangle that is to be cut off. Only reflex ones need
// be asked; those that have become convex or are gone are dropped on the way.
bool EarClipper::is_ear(std::size_t corner) {
  const std::size_t a = previous_[corner], c = next_[corner];
  for (std::size_t i = 0; i < reflex_.size();) {
    const std::size_t p = reflex_[i];
    if (budget_ > 0) --budget_;
    if (next_[p] == p || area(previous_[p], p, next_[p]) > 0) {
      reflex_[i] = reflex_.back();
      reflex_.pop_back();
      continue;
    }
    if (p != a && p != corner && p != c && is_within(p, a, corner, c)) return false;
    ++i;
  }
  return true;
}

double EarClipper::area(std::size_t a, std::size_t b, std::size_t c) const {
  const Vector2d u = points_[b] - points_[a], v = points_[c] - points_[a];
  return u.x * v.y - u.y * v.x;
}

// The edges are part of it; a point that coincides with a corner is not in the way.
bool EarClipper::is_within(std::size_t point, std::size_t a, std::size_t b, std::size_t c) const {
  const Vector2d& p = points_[point];
  if (p == points_[a] || p == points_[b] || p == points_[c]) return false;
  return area(a, b, point) >= 0 && area(b, c, point) >= 0 && area(c, a, point) >= 0;
}

}  // namespace raytracer::meshes
