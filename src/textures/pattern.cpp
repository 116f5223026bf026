#include "textures/pattern.hpp"

#include <algorithm>
#include <cmath>

namespace raytracer {
namespace {

// Surfaces often lie just where two cells meet; what counts is the cell beneath them.
constexpr float kBeneath = 1e-4F;

}  // namespace

PatternPoint Pattern::own_point(const TexturePoint& point) const {
  const PatternSpace& space = setup_.space;
  PatternPoint own;
  own.is_rough = point.is_rough;
  if (space.map == PatternMap::kUv) {
    own.position = space.linear * Vector3f(point.uv, 0) + space.translation;
    own.dx = space.linear * Vector3f(point.uv_dx, 0);
    own.dy = space.linear * Vector3f(point.uv_dy, 0);
    return own;
  }
  own.position = space.linear * point.position + space.translation;
  own.dx = space.linear * point.position_dx;
  own.dy = space.linear * point.position_dy;
  const Vector3f normal = space.linear * point.normal;
  const float length = glm::length(normal);
  if (length > 0) own.normal = normal / length;
  own.position -= kBeneath * own.normal;
  return own;
}

Color3f Pattern::at(const TexturePoint& point) const {
  const float b = std::clamp(share(own_point(point)), 0.0F, 1.0F);
  if (b == 0) return setup_.a.at(point);
  if (b == 1) return setup_.b.at(point);
  return (1 - b) * setup_.a.at(point) + b * setup_.b.at(point);
}

PlanePoint plane_point(const PatternPoint& point, PatternMap map) {
  const Vector3f p = point.position, extent = point.extent(), n = glm::abs(point.normal);
  if (map == PatternMap::kUv || (n.z >= n.x && n.z >= n.y)) return {{p.x, p.y}, {extent.x, extent.y}};
  if (n.x > n.y) return {{p.z, p.y}, {extent.z, extent.y}};
  return {{p.x, p.z}, {extent.x, extent.z}};
}

float square_wave(float x, float duty, float width) {
  // In double, from near the origin: the two integrals are large and close to each other.
  const double at = static_cast<double>(x) - std::floor(static_cast<double>(x));
  if (!(width > 1e-5F)) return at < static_cast<double>(duty) ? 1.0F : 0.0F;
  const auto integral = [&](double to) {
    const double whole = std::floor(to);
    return static_cast<double>(duty) * whole + std::min(to - whole, static_cast<double>(duty));
  };
  const double half = static_cast<double>(width) / 2;
  return static_cast<float>((integral(at + half) - integral(at - half)) / (2 * half));
}

float detail_left(float width) { return 1 - glm::smoothstep(0.4F, kNoDetail, width); }

}  // namespace raytracer
