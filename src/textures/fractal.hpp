// Noise for textures: single precision, and as many octaves as the footprint leaves.
#pragma once

#include <cstdint>

#include "raytracer/vector3f.hpp"

namespace raytracer {

/// 32 well-mixed bits about a cell of the lattice; the same on every machine.
std::uint32_t cell_hash(const glm::ivec3& cell);

/// The cell of a point; points beyond a billion fall into the outermost ones.
glm::ivec3 cell_of(const Vector3f& p);

/// Perlin's improved gradient noise (Perlin 2002) in [-1, 1]; 0 at whole coordinates.
float lattice_noise(const Vector3f& p);

/// The sum of octaves, each twice as fine and `gain` times as strong as the one before, in [-1, 1], mean 0.
/// An octave fades out where it is finer than `width`, the footprint's.
float fractal_noise(const Vector3f& p, int octaves, float gain, float width);

/// Likewise of the octaves' absolute values, in [0, 1]; a faded octave becomes its mean.
float turbulence_noise(const Vector3f& p, int octaves, float gain, float width);

/// The mean of |lattice_noise|.
inline constexpr float kMeanAbsoluteNoise = 0.2202f;

}  // namespace raytracer
