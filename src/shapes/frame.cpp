#include "shapes/frame.hpp"

#include <algorithm>
#include <cmath>

namespace raytracer::shapes {

namespace {

glm::dmat3 absolute(const glm::dmat3& m) { return {glm::abs(m[0]), glm::abs(m[1]), glm::abs(m[2])}; }

}  // namespace

Frame::Frame(const Transform& to_world)
    : to_world_(to_world.linear),
      to_local_(glm::inverse(to_world.linear)),
      absolute_to_local_(absolute(to_local_)),
      translation_(to_world.translation),
      volume_scale_(std::abs(glm::determinant(to_world.linear))),
      round_trip_(absolute_to_local_ * (absolute(to_world_) * Vector3d(1.0))) {}

SurfacePoint Frame::surface_at(const Vector3d& point, const Vector3d& normal, double curvature,
                               const Vector3d& extent, double amplification) const {
  // The gradient of a function of the local point, seen from the world: its length turns local heights above
  // the surface into heights in the world.
  const Vector3d gradient = glm::transpose(to_local_) * normal;
  const double steepness = glm::length(gradient);
  const Vector3d position = to_world(point);

  // Position and ray origin are rounded one after the other, each by half a unit in the last place per
  // coordinate.
  const Vector3d rounding = 2 * kFloatRounding * glm::abs(position);
  const Vector3d local_rounding = absolute_to_local_ * rounding;
  SurfaceBound bound;
  bound.bend =
      std::min(0.5 * curvature * glm::dot(local_rounding, local_rounding) / steepness, glm::length(rounding));
  // Some thirty operations on numbers about 1, and the round trip through two matrices; the translation is
  // taken off before the matrix but rounds by its own magnitude.
  constexpr double kOperations = 32;
  const Vector3d shift = absolute_to_local_ * (glm::abs(position) + glm::abs(translation_));
  bound.arithmetic = kOperations * kDoubleRounding *
                     (amplification + glm::dot(glm::abs(normal), round_trip_ + 0.125 * shift)) / steepness;
  bound.extent = extent;
  return rounded_surface(position, gradient / steepness, bound);
}

glm::dmat3 axes_around(const Vector3d& axis) {
  // Scaled first: the squares of very small or large parts would leave the range of double.
  const double largest = std::max({std::abs(axis.x), std::abs(axis.y), std::abs(axis.z)});
  const Vector3d third = glm::normalize(axis / largest);
  const Vector3d across(third.z, 0, -third.x);  // y cross axis
  const Vector3d first = across == Vector3d(0.0) ? Vector3d(1, 0, 0) : glm::normalize(across);
  return {first, glm::cross(third, first), third};
}

float turn_share(double x, double y) {
  const float share = static_cast<float>(std::atan2(y, x) / (2 * kPi));
  const float positive = share < 0 ? share + 1 : share;
  return positive < 1 ? positive : 0.0f;
}

}  // namespace raytracer::shapes
