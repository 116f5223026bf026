// What the inside of a material takes away from light.
#pragma once

#include <algorithm>

#include "raytracer/material.hpp"

namespace raytracer {

/// The share that is lost per scene unit, per channel: exp(-absorption * way) is left (Beer's law), which is
/// attenuation_color after attenuation_distance (glTF's KHR_materials_volume). At most so much that it stays
/// a number.
inline Color3f absorption_of(const Material& material) {
  if (!(material.attenuation_distance < kInfinity)) return Color3f(0);
  constexpr float kDarkest = 1e-30F;
  const Color3f left = glm::clamp(material.attenuation_color, kDarkest, 1.0F);
  return -glm::log(left) / std::max(material.attenuation_distance, kDarkest);
}

}  // namespace raytracer
