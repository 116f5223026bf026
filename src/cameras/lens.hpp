// The opening of a lens.
#pragma once

#include "raytracer/vector3f.hpp"

namespace raytracer {

/// A point of a lens's opening of radius 1, by area, for u in [0, 1)^2. With 3 blades or more the opening is
/// the regular polygon in that circle, a corner at the angle `turn` (radians, from x to y).
Vector2f point_on_lens(const Vector2f& u, int blades, float turn);

}  // namespace raytracer
