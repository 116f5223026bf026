// Chance without chance: pure functions that look random and give the same numbers on every machine, for
// ever.
#pragma once

#include <span>

#include "raytracer/vector3f.hpp"

namespace raytracer {

/// A number in [0, 1) that depends on every bit of the seeds (and takes -0 for 0).
double random_number(std::span<const double> seeds);

/// Perlin's improved gradient noise (Perlin 2002, "Improving noise") over a lattice without period, in [-1,
/// 1]; 0 at points with whole coordinates.
double gradient_noise(const Vector3d& p);

}  // namespace raytracer
