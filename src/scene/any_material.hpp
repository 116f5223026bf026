// Asks all that a scene may be made of. It looks at every shape that is shared: once per picture, not per
// tile.
#pragma once

#include <algorithm>

#include "raytracer/scene.hpp"

namespace raytracer {

/// Whether a material of the scene, or of the shapes that stand in it, fits.
inline bool any_material(const SceneDescription& scene, bool (*fits)(const Material&)) {
  if (std::ranges::any_of(scene.materials, fits)) return true;
  return std::ranges::any_of(scene.shared, [&](const auto& shared) {
    for (std::uint32_t i = 0; i < shared->size(); ++i) {
      if (fits(shared->material_of(i))) return true;
    }
    return false;
  });
}

}  // namespace raytracer
