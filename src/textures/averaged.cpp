#include "textures/averaged.hpp"

#include <algorithm>

namespace raytracer {
namespace {

struct Looks {
  Color3f sum{0}, least{kInfinity}, most{-kInfinity};
};

// At the middles of `count` x `count` equal parts.
Looks look(const Texture& texture, const TexturePoint& point, int count) {
  const float part = 1 / static_cast<float>(count);
  TexturePoint at = point;
  at.uv_dx *= part;
  at.uv_dy *= part;
  at.position_dx *= part;
  at.position_dy *= part;
  Looks looks;
  for (int y = 0; y < count; ++y) {
    for (int x = 0; x < count; ++x) {
      const float right = static_cast<float>(x) - 0.5F * static_cast<float>(count - 1);
      const float below = static_cast<float>(y) - 0.5F * static_cast<float>(count - 1);
      at.uv = point.uv + right * at.uv_dx + below * at.uv_dy;
      at.position = point.position + right * at.position_dx + below * at.position_dy;
      const Color3f color = texture.at(at);
      looks.sum += color;
      looks.least = glm::min(looks.least, color);
      looks.most = glm::max(looks.most, color);
    }
  }
  return looks;
}

}  // namespace

Color3f averaged(const Texture& texture, const TexturePoint& point) {
  if (!point.is_coarse || texture.is_exact()) return texture.at(point);
  const Looks four = look(texture, point, 2);
  constexpr float kSame = 1.0F / 12;  // of the larger: their mean is closer by far
  const Color3f difference = four.most - four.least, size = kSame * glm::abs(four.most);
  if (glm::all(glm::lessThanEqual(difference, size))) return four.sum / 4.0F;
  return look(texture, point, 4).sum / 16.0F;
}

}  // namespace raytracer
