#include "textures/fractal.hpp"

#include <algorithm>
#include <cmath>

#include "sampling/sobol.hpp"
#include "textures/pattern.hpp"

namespace raytracer {
namespace {

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
    const float left = detail_left(width);
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
  return hash_bits(x * 0x9E3779B1U + hash_bits(y * 0x85EBCA77U + hash_bits(z + 0xC2B2AE3DU)));
}

glm::ivec3 cell_of(const Vector3f& p) {
  const Vector3f cell = glm::floor(glm::clamp(p, -1e9F, 1e9F));
  return {static_cast<int>(cell.x), static_cast<int>(cell.y), static_cast<int>(cell.z)};
}

float lattice_noise(const Vector3f& p) {
  const glm::ivec3 cell = cell_of(p);
  const Vector3f f = glm::clamp(p - Vector3f(cell), 0.0F, 1.0F);
  const Vector3f share = {fade(f.x), fade(f.y), fade(f.z)};
  float along_z[2];
  for (int k = 0; k < 2; ++k) {
    float along_y[2];
    for (int j = 0; j < 2; ++j) {
      const float y = f.y - static_cast<float>(j), z = f.z - static_cast<float>(k);
      const float left = gradient(cell_hash(cell + glm::ivec3(0, j, k)), f.x, y, z);
      const float right = gradient(cell_hash(cell + glm::ivec3(1, j, k)), f.x - 1, y, z);
      along_y[j] = blend(left, right, share.x);
    }
    along_z[k] = blend(along_y[0], along_y[1], share.y);
  }
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
