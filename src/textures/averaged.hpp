// The average of any texture over what a sample of the picture stands for.
#pragma once

#include "raytracer/texture.hpp"

namespace raytracer {

/// Of a coarse point whose texture's own average is not exact the parts of the footprint are looked at one by
/// one: first four, and four times as many where those differ.
Color3f averaged(const Texture& texture, const TexturePoint& point);

}  // namespace raytracer
