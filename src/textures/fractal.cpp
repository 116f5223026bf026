#include "textures/fractal.hpp"

#include <algorithm>
#include <cmath>

#include "sampling/sobol.hpp"
#include "textures/pattern.hpp"

namespace raytracer {
namespace {

constexpr std::uint32_t kAlongX = 0x9E3779B1U, kAlongY = 0x85EBCA77U, kAlongZ = 0xC2B2AE3DU;

float gradient(std::uint32_t hash, float x, float y, float z) {
  const std::uint32_t direction = ((hash >> 16U) * 12U) >> 16U;
  const float first = direction < 8 ? x : y;
  const float second = direction < 4 ? y : z;
  return ((direction & 1U) != 0 ? -first : first) + ((direction & 2U) != 0 ? -second : second);
}

float fade(float t) { return t * t * t * (t * (t * 6 - 15) + 10); }
float blend(float a, float b, float share) { return a + (b - a) * share; }

// Adds term(noise, what is left of it) for each octave, weighted, over the sum of the weights.
template <class Term>
float sum_of_octaves(Vector3f p, int octaves, float gain, float width, const Term& term) {
  float sum = 0, weights = 0, weight = 1;
  for (int i = 0; i < octaves; ++i) {
    const float left = width < kNoDetail ? detail_left(width) : 0.0F;
    sum += weight * term(left > 0 ? lattice_noise(p) : 0.0F, left);
    weights += weight;
    weight *= gain;
    width *= 2;
    // Moved aside, so that the zeros of the octaves do not meet.
    p = 2.0F * p + Vector3f(17.31F, 5.77F, 11.13F);
  }
  return sum / weights;
}

}  // namespace

std::uint32_t cell_hash(const glm::ivec3& cell) {
  const auto x = static_cast<std::uint32_t>(cell.x), y = static_cast<std::uint32_t>(cell.y),
             z = static_cast<std::uint32_t>(cell.z);
  return hash_bits(x * kAlongX + hash_bits(y * kAlongY + hash_bits(z + kAlongZ)));
}

glm::ivec3 cell_of(const Vector3f& p) {
  const Vector3f cell = glm::floor(glm::clamp(p, -1e9F, 1e9F));
  return {static_cast<int>(cell.x), static_cast<int>(cell.y), static_cast<int>(cell.z)};
}

// The eight corners of the cell side by side, the first two along x, so that the compiler does them at once.
float lattice_noise(const Vector3f& p) {
  const glm::ivec3 cell = cell_of(p);
  const Vector3f f = glm::clamp(p - Vector3f(cell), 0.0F, 1.0F);
  const Vector3f share = {fade(f.x), fade(f.y), fade(f.z)};
  std::uint32_t hash[8];
  for (std::uint32_t i = 0; i < 8; ++i)
    hash[i] = hash_bits(static_cast<std::uint32_t>(cell.z) + (i >> 2U) + kAlongZ);
  for (std::uint32_t i = 0; i < 8; ++i)
    hash[i] = hash_bits((static_cast<std::uint32_t>(cell.y) + (i >> 1U & 1U)) * kAlongY + hash[i]);
  for (std::uint32_t i = 0; i < 8; ++i)
    hash[i] = hash_bits((static_cast<std::uint32_t>(cell.x) + (i & 1U)) * kAlongX + hash[i]);
  float corner[8];
  for (std::uint32_t i = 0; i < 8; ++i) {
    corner[i] = gradient(hash[i], f.x - static_cast<float>(i & 1U), f.y - static_cast<float>(i >> 1U & 1U),
                         f.z - static_cast<float>(i >> 2U));
  }
  float along_y[4], along_z[2];
  for (std::uint32_t i = 0; i < 4; ++i) along_y[i] = blend(corner[2 * i], corner[2 * i + 1], share.x);
  for (std::uint32_t i = 0; i < 2; ++i) along_z[i] = blend(along_y[2 * i], along_y[2 * i + 1], share.y);
  return std::clamp(blend(along_z[0], along_z[1], share.z), -1.0F, 1.0F);
}

float fractal_noise(const Vector3f& p, int octaves, float gain, float width) {
  return sum_of_octaves(p, octaves, gain, width, [](float noise, float left) { return noise * left; });
}

float turbulence_noise(const Vector3f& p, int octaves, float gain, float width) {
  return sum_of_octaves(p, octaves, gain, width, [](float noise, float left) {
    return blend(kMeanAbsoluteNoise, std::abs(noise), left);
  });
}

}  // namespace raytracer
