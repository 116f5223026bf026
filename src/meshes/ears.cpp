#include "meshes/ears.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace raytracer::meshes {
namespace {

// Tests of corners against ears: so many for each corner of a polygon, and no more than that for all. Faces
// drawn by hand or by programs need a few; one made to need them all would take the square of its size, and
// is cut without further tests instead.
constexpr std::uint64_t kTestsPerCorner = 1024, kMostTests = std::uint64_t{1} << 27U;

constexpr std::uint32_t kConvex = std::numeric_limits<std::uint32_t>::max();

}  // namespace

void EarClipper::cut(std::span<const std::uint32_t> corners, const std::vector<Vector3f>& positions,
                     std::array<std::uint32_t, 3>* out) {
  if (corners.size() == 3) {
    *out = {corners[0], corners[1], corners[2]};
    return;
  }
  project(corners, positions);
  if (corners.size() == 4) {
    const auto& p = points_;
    const bool first = area(p[0], p[1], p[2]) > 0 && area(p[0], p[2], p[3]) > 0;
    const bool other = !first && area(p[1], p[2], p[3]) > 0 && area(p[1], p[3], p[0]) > 0;
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
    cut_off(corner);
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
  budget_ = std::min(kTestsPerCorner * left_, kMostTests);
  next_.resize(left_);
  previous_.resize(left_);
  for (std::size_t i = 0; i < left_; ++i) {
    next_[i] = static_cast<std::uint32_t>(i + 1 < left_ ? i + 1 : 0);
    previous_[i] = static_cast<std::uint32_t>(i > 0 ? i - 1 : left_ - 1);
  }
  reflex_.clear();
  reflex_place_.assign(left_, kConvex);
  for (std::size_t i = 0; i < left_; ++i) {
    if (area_at(i) > 0) continue;
    reflex_place_[i] = static_cast<std::uint32_t>(reflex_.size());
    reflex_.push_back({points_[i], static_cast<std::uint32_t>(i)});
  }
}

// The first ear; where there is none, a corner that spans no area, or else the one to begin with.
std::size_t EarClipper::find_ear(std::size_t from) {
  std::size_t corner = from, flat = from;
  bool has_flat = false;
  for (std::size_t i = 0; i < left_ && budget_ > 0; ++i, corner = next_[corner]) {
    --budget_;
    const double size = area_at(corner);
    if (size > 0 && is_ear(corner)) return corner;
    if (size == 0 && !has_flat) {
      has_flat = true;
      flat = corner;
    }
  }
  // Without ears it crosses itself: no way to cut it is right, so less and less is spent on it.
  if (!has_flat) budget_ /= 8;
  return flat;
}

// Whether no other corner of the polygon lies in the triangle that is to be cut off, its edges included. Only
// reflex ones need be asked; a point that coincides with one of the triangle's is not in the way.
bool EarClipper::is_ear(std::size_t corner) {
  const Vector2d a = points_[previous_[corner]], b = points_[corner], c = points_[next_[corner]];
  const Vector2d lower = glm::min(a, glm::min(b, c)), upper = glm::max(a, glm::max(b, c));
  for (std::size_t i = 0; i < reflex_.size(); ++i) {
    const Vector2d& p = reflex_[i].point;
    if (p.x < lower.x || p.x > upper.x || p.y < lower.y || p.y > upper.y) continue;
    if (p == a || p == b || p == c) continue;
    if (area(a, b, p) >= 0 && area(b, c, p) >= 0 && area(c, a, p) >= 0) {
      budget_ -= std::min<std::uint64_t>(budget_, i);
      return false;
    }
  }
  budget_ -= std::min<std::uint64_t>(budget_, reflex_.size());
  return true;
}

double EarClipper::area(const Vector2d& a, const Vector2d& b, const Vector2d& c) {
  const Vector2d u = b - a, v = c - a;
  return u.x * v.y - u.y * v.x;
}

double EarClipper::area_at(std::size_t corner) const {
  return area(points_[previous_[corner]], points_[corner], points_[next_[corner]]);
}

void EarClipper::cut_off(std::size_t corner) {
  const std::uint32_t before = previous_[corner], after = next_[corner];
  next_[before] = after;
  previous_[after] = before;
  forget(corner);
  forget_if_convex(before);
  forget_if_convex(after);
}

void EarClipper::forget_if_convex(std::size_t corner) {
  if (area_at(corner) > 0) forget(corner);
}

void EarClipper::forget(std::size_t corner) {
  const std::uint32_t place = reflex_place_[corner];
  if (place == kConvex) return;
  reflex_[place] = reflex_.back();
  reflex_place_[reflex_[place].corner] = place;
  reflex_.pop_back();
  reflex_place_[corner] = kConvex;
}

}  // namespace raytracer::meshes
