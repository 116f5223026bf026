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
