#include "raytracer/texture.hpp"

#include "textures/texture_block.hpp"

namespace raytracer {

void Texture::colors_at(const TextureBlock& points, ColorBlock& colors) const {
  for (int i = 0; i < points.count; ++i) colors.set(i, at(points.at(i)));
}

}  // namespace raytracer
