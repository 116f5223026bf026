// What a light without extent does at a point.
#pragma once

#include "raytracer/light.hpp"

namespace raytracer {

struct Illumination {
  Color3f color{0};  ///< what a white surface returns of it if nothing stands between, 0..255 units; 0: nothing arrives
  Ray3f shadow_ray;  ///< from the offset point to the light; t = 1 is the light
};

/// The light that arrives at `position` with unit `normal`: the paper's lambda <S-P, N> / |S-P|^2 and its kin.
/// The shadow ray starts at `offset_position`.
Illumination illuminate(const Light& light, const Vector3f& position, const Vector3f& normal,
                        const Vector3f& offset_position);

}  // namespace raytracer
