// Noise for textures: single precision, and as many octaves as the footprint leaves.
#pragma once

#include <cmath>
#include <cstdint>

#include "raytracer/vector3f.hpp"
#include "sampling/sobol.hpp"
#include "textures/pattern.hpp"

namespace raytracer {

/// A number for each cell of the lattice, to be mixed by hash_bits(): of the sum of two cells the sum of
/// both. The factors are the powers of the inverse of the root of x^4 = x + 1 (Roberts 2018); cells of one
/// number are at least 1325 cells apart.
constexpr std::uint32_t cell_number(std::uint32_t x, std::uint32_t y, std::uint32_t z) {
  return x * 0xD1B54A33U + y * 0xABC98389U + z * 0x8CB92BA7U;
}
constexpr std::uint32_t cell_number(const glm::ivec3& cell) {
  return cell_number(static_cast<std::uint32_t>(cell.x), static_cast<std::uint32_t>(cell.y),
                     static_cast<std::uint32_t>(cell.z));
}

/// Of one coordinate; what is not a number counts as the least.
inline int cell_of(float x) {
  constexpr float kMost = 1e9F;
  const float below = x < kMost ? x : kMost;
  return static_cast<int>(std::floor(x > -kMost ? below : -kMost));
}

/// The cell of a point; points beyond a billion fall into the outermost ones.
inline glm::ivec3 cell_of(const Vector3f& p) { return {cell_of(p.x), cell_of(p.y), cell_of(p.z)}; }

/// Perlin's improved gradient noise (Perlin 2002) in [-1, 1]; 0 at whole coordinates.
float lattice_noise(const Vector3f& p);

/// The very same at sixteen points.
void lattice_noise(const Vector3Block& p, NumberBlock& noise);

/// The sum of octaves, each twice as fine and `gain` times as strong as the one before, in [-1, 1], mean 0.
/// An octave fades out where it is finer than `width`, the footprint's.
float fractal_noise(const Vector3f& p, int octaves, float gain, float width);

/// The very same at sixteen points.
void fractal_noise(const Vector3Block& p, int octaves, float gain, const NumberBlock& width,
                   NumberBlock& noise);

/// Likewise of the octaves' absolute values, in [0, 1]; a faded octave becomes its mean.
float turbulence_noise(const Vector3f& p, int octaves, float gain, float width);

/// The very same at sixteen points.
void turbulence_noise(const Vector3Block& p, int octaves, float gain, const NumberBlock& width,
                      NumberBlock& noise);

/// The mean of |lattice_noise|.
inline constexpr float kMeanAbsoluteNoise = 0.2202f;

/// What is bent by `strength` times fractal_noise() is blurred by bends that a footprint of that width hides:
/// the square of the width of the box that blurs as much.
inline float blur_of_lost_bends(float strength, float width) {
  constexpr float kVariance = 0.05F;  // of the noise
  const float lost = strength * (1 - detail_left(width));
  return 12 * kVariance * lost * lost;
}

}  // namespace raytracer
