#include "cameras/lens.hpp"

#include <algorithm>
#include <cmath>

#include "core/numeric.hpp"

namespace raytracer {
namespace {

constexpr auto kPiF = static_cast<float>(kPi);

// Shirley, Chiu 1997, "A low distortion map between disk and square".
Vector2f point_on_disk(const Vector2f& u) {
  const Vector2f s = 2.0F * u - 1.0F;
  if (s.x == 0 && s.y == 0) return s;
  const bool is_wide = std::abs(s.x) > std::abs(s.y);
  const float radius = is_wide ? s.x : s.y;
  const float angle = is_wide ? kPiF / 4 * (s.y / s.x) : kPiF / 2 - kPiF / 4 * (s.x / s.y);
  return radius * Vector2f(std::cos(angle), std::sin(angle));
}

}  // namespace

Vector2f point_on_lens(const Vector2f& u, int blades, float turn) {
  if (blades < 3) return point_on_disk(u);
  // One of the triangles between the middle and two corners, then a point on it.
  const float scaled = u.x * static_cast<float>(blades);
  const int blade = std::min(static_cast<int>(scaled), blades - 1);
  const float along = scaled - static_cast<float>(blade);
  const auto corner = [&](int i) {
    const float angle = turn + 2 * kPiF * static_cast<float>(i) / static_cast<float>(blades);
    return Vector2f(std::cos(angle), std::sin(angle));
  };
  return std::sqrt(u.y) * glm::mix(corner(blade), corner(blade + 1), along);
}

}  // namespace raytracer
