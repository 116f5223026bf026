#include "shapes/triangle_sampling.hpp"

#include <algorithm>
#include <cmath>

#include "core/numeric.hpp"

namespace raytracer::shapes {

namespace {

// Below the first, evenly over the area is as good; above the second (a full side of the sphere is 2 pi) the
// point is all but in the triangle, and the angles say little.
constexpr double kLeastSolidAngle = 3e-4, kMostSolidAngle = 6.2;

// A. van Oosterom, J. Strackee, "The Solid Angle of a Plane Triangle", IEEE Trans. Biomed. Eng. 30(2), 1983,
// equation 8.
double solid_angle(const Vector3d& a, const Vector3d& b, const Vector3d& c) {
  const double over = std::abs(glm::dot(a, glm::cross(b, c)));
  const double under = 1 + glm::dot(a, b) + glm::dot(b, c) + glm::dot(c, a);
  const double angle = 2 * std::atan2(over, under);
  return angle < 0 ? angle + 2 * kPi : angle;
}

// The part of v across the unit vector n, of unit length.
Vector3d across(const Vector3d& v, const Vector3d& n) { return glm::normalize(v - glm::dot(v, n) * n); }

glm::dvec2 evenly_over_area(const Vector2f& u) {
  const double root = std::sqrt(static_cast<double>(u.x));
  return {root * (1 - static_cast<double>(u.y)), root * static_cast<double>(u.y)};
}

}  // namespace

SeenTriangle::SeenTriangle(const Vector3d& a, const Vector3d& b, const Vector3d& c, const Vector3d& normal,
                           const Vector3d& from)
    : a_(a), b_(b), c_(c), normal_(normal), from_(from) {
  area_ = 0.5 * glm::length(glm::cross(b - a, c - a));
  const double height = std::abs(glm::dot(from - a, normal));
  is_seen_ = area_ > 0 && height > 0 && from != a && from != b && from != c;
  if (!is_seen_) return;
  solid_angle_ = solid_angle(glm::normalize(a - from), glm::normalize(b - from), glm::normalize(c - from));
  by_solid_angle_ = solid_angle_ > kLeastSolidAngle && solid_angle_ < kMostSolidAngle;
}

// J. Arvo, "Stratified Sampling of Spherical Triangles", SIGGRAPH 1995, section 2: the first number cuts off
// a triangle of that share of the area by moving the corner C along the edge AC, the second goes from B to
// the moved corner.
glm::dvec2 SeenTriangle::sample_solid_angle(const Vector2f& u) const {
  const Vector3d a = glm::normalize(a_ - from_), b = glm::normalize(b_ - from_),
                 c = glm::normalize(c_ - from_);
  const Vector3d side = glm::normalize(glm::cross(a, b));
  const double cos_c = glm::dot(a, b);  // of the arc from A to B
  const double cos_alpha = glm::clamp(glm::dot(side, glm::normalize(glm::cross(a, c))), -1.0, 1.0);
  const double alpha = std::acos(cos_alpha), sin_alpha = std::sin(alpha);
  const double phi = static_cast<double>(u.x) * solid_angle_ - alpha;
  const double s = std::sin(phi), t = std::cos(phi);
  const double p = t - cos_alpha, q = s + sin_alpha * cos_c;
  const double over = (q * t - p * s) * cos_alpha - q;
  const double under = (q * s + p * t) * sin_alpha;
  const double cos_moved = under == 0 ? 1 : glm::clamp(over / under, -1.0, 1.0);
  const Vector3d moved = cos_moved * a + std::sqrt(std::max(0.0, 1 - cos_moved * cos_moved)) * across(c, a);
  const double z = 1 - static_cast<double>(u.y) * (1 - glm::dot(moved, b));
  const Vector3d direction = z * b + std::sqrt(std::max(0.0, 1 - z * z)) * across(moved, b);

  const Vector3d ab = b_ - a_, ac = c_ - a_;
  const double distance = glm::dot(normal_, a_ - from_) / glm::dot(normal_, direction);
  const Vector3d from_a = from_ + distance * direction - a_;
  const double twice_area = 2 * area_;
  const glm::dvec2 weights(glm::dot(normal_, glm::cross(from_a, ac)) / twice_area,
                           glm::dot(normal_, glm::cross(ab, from_a)) / twice_area);
  return weights;
}

glm::dvec2 SeenTriangle::sample(const Vector2f& u) const {
  if (!by_solid_angle_) return evenly_over_area(u);
  const glm::dvec2 weights = sample_solid_angle(u);
  if (!std::isfinite(weights.x) || !std::isfinite(weights.y)) return evenly_over_area(u);
  const double x = glm::clamp(weights.x, 0.0, 1.0);
  return {x, glm::clamp(weights.y, 0.0, 1 - x)};
}

double SeenTriangle::pdf(const Vector3d& point) const {
  if (!is_seen_) return 0;
  if (by_solid_angle_) return 1 / solid_angle_;
  const Vector3d to_point = point - from_;
  const double squared = glm::dot(to_point, to_point);
  const double cosine = std::abs(glm::dot(to_point, normal_)) / std::sqrt(squared);
  return cosine > 0 ? squared / (cosine * area_) : 0;
}

}  // namespace raytracer::shapes
