// Pictures on surfaces.
#pragma once

#include <compare>
#include <cstdint>
#include <memory>

#include "image/picture.hpp"
#include "raytracer/texture.hpp"
#include "textures/texel_pyramid.hpp"

namespace raytracer {

/// How a picture lies in uv: the texture is asked at scale * rotate(uv) + offset. uv (0, 0) is the lower left
/// corner of the picture, (1, 1) the upper right.
struct TexturePlacement {
  Vector2f scale{1};
  Vector2f offset{0};
  float rotate = 0;  ///< degrees, counterclockwise, of uv around (0, 0)
  TextureWrap wrap = TextureWrap::kRepeat;
};

/// A texture over a picture. A point without a footprint is bilinear between the centres of the texels; a
/// larger one is averaged over mip levels along the longer axis of its ellipse, with the second moments of
/// the footprint (McCormack et al. 1999, "Feline", with its ellipse from the footprint's covariance).
TexturePointer make_image_texture(std::shared_ptr<const TexelPyramid> pyramid,
                                  const TexturePlacement& placement);

}  // namespace raytracer
