// What a surface does with light.
#pragma once

#include "raytracer/vector3f.hpp"

namespace raytracer {

/// Data alone; the paper's two words.
struct Material {
  Color3f color{0.8f};  ///< share of the light that the surface returns, per channel, 0..1
  float shininess = 0;  ///< share of a perfect mirror, clamped to 0..1: <= 0 is diffuse, >= 1 all mirror
};

}  // namespace raytracer
