#include "textures/pattern.hpp"

#include <algorithm>
#include <cmath>

#include "core/with_constant.hpp"

namespace raytracer {
namespace {

// Surfaces often lie just where two cells meet; what counts is the cell beneath them.
constexpr float kBeneath = 1e-4F;

}  // namespace

void TextureInput::colors_at(const TextureBlock& points, ColorBlock& colors) const {
  if (texture) {
    texture->colors_at(points, colors);
  } else {
    for (int i = 0; i < kBlockSize; ++i) colors.set(i, color);
  }
}

namespace {

Vector3f own_normal(const glm::mat3& linear, const Vector3f& normal) {
  const Vector3f own = linear * normal;
  const float length = glm::length(own), scale = length > 0 ? length : 1.0F;
  const float z = length > 0 ? own.z : 1.0F;
  return Vector3f(own.x, own.y, z) / scale;
}

float mixed(float a, float b, float share) {
  const float mean = (1 - share) * a + share * b;
  return share == 0 ? a : share == 1 ? b : mean;
}

// Without branches: it is done to blocks of points.
template <PatternMap kMap>
[[gnu::always_inline]] inline PatternPoint own_point(const PatternSpace& space, const TexturePoint& point) {
  PatternPoint own;
  own.is_rough = point.is_rough;
  if constexpr (kMap == PatternMap::kUv) {
    own.position = space.linear * Vector3f(point.uv, 0) + space.translation;
    own.dx = space.linear * Vector3f(point.uv_dx, 0);
    own.dy = space.linear * Vector3f(point.uv_dy, 0);
  } else {
    own.normal = own_normal(space.linear, point.normal);
    own.position = space.linear * point.position + space.translation - kBeneath * own.normal;
    own.dx = space.linear * point.position_dx;
    own.dy = space.linear * point.position_dy;
  }
  return own;
}

PatternPoint own_point(const PatternSpace& space, const TexturePoint& point) {
  return space.map == PatternMap::kUv ? own_point<PatternMap::kUv>(space, point)
                                      : own_point<PatternMap::kPosition>(space, point);
}

void set_own_points(const PatternSpace& in_space, const TextureBlock& points, PatternBlock& own) {
  own.count = points.count;
  own.is_rough = points.is_rough;
  const PatternSpace space = in_space;
  with_constant<PatternMap::kUv, PatternMap::kPosition>(space.map, [&](auto map) {
    for (int i = 0; i < kBlockSize; ++i) own.set(i, own_point<map>(space, points.at(i)));
  });
}

}  // namespace

Color3f Pattern::at(const TexturePoint& point) const {
  const float b = std::clamp(share(own_point(setup_.space, point)), 0.0F, 1.0F);
  if (b == 0) return setup_.a.at(point);
  if (b == 1) return setup_.b.at(point);
  return (1 - b) * setup_.a.at(point) + b * setup_.b.at(point);
}

void Pattern::colors_at(const TextureBlock& points, ColorBlock& colors) const {
  PatternBlock own;
  set_own_points(setup_.space, points, own);
  NumberBlock share{};
  shares(own, share);
  // Not more of both than the points alone would ask: a chain of patterns in patterns must not double at
  // each.
  bool is_some_a = false, is_some_b = false;
  for (int i = 0; i < points.count; ++i) {
    is_some_a |= !(share.at[i] >= 1);
    is_some_b |= !(share.at[i] <= 0);
  }
  const bool are_textures = setup_.a.texture != nullptr && setup_.b.texture != nullptr;
  if (is_some_a && is_some_b && are_textures) return Texture::colors_at(points, colors);
  ColorBlock b{};
  colors = b;
  if (is_some_a) setup_.a.colors_at(points, colors);
  if (is_some_b) setup_.b.colors_at(points, b);
  for (int i = 0; i < kBlockSize; ++i) {
    const float s = std::clamp(share.at[i], 0.0F, 1.0F);
    colors.set(i,
               {mixed(colors.x[i], b.x[i], s), mixed(colors.y[i], b.y[i], s), mixed(colors.z[i], b.z[i], s)});
  }
}

void Pattern::shares(const PatternBlock& points, NumberBlock& share) const {
  for (int i = 0; i < points.count; ++i) share.at[i] = this->share(points.at(i));
}

}  // namespace raytracer
