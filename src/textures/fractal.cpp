#include "textures/fractal.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include "core/lane_math.hpp"

namespace raytracer {
namespace {

float with_sign(float number, std::uint32_t sign) {
  return std::bit_cast<float>(std::bit_cast<std::uint32_t>(number) ^ sign << 31U);
}

float gradient(std::uint32_t hash, float x, float y, float z) {
  const std::uint32_t direction = ((hash >> 16U) * 12U) >> 16U;
  return with_sign(chosen(direction < 8, x, y), direction & 1U) +
         with_sign(chosen(direction < 4, y, z), direction >> 1U & 1U);
}

float fade(float t) { return t * t * t * (t * (t * 6 - 15) + 10); }
float blend(float a, float b, float share) { return a + (b - a) * share; }

// To where the next octave of a sum is asked, and how wide the footprint is there.
void go_to_next_octave(Vector3f& p, float& width) {
  width *= 2;
  // Moved aside, so that the zeros of the octaves do not meet.
  p = 2.0F * p + Vector3f(17.31F, 5.77F, 11.13F);
}

// What the footprint leaves of an octave.
float left_of_octave(float width) {
  const float left = detail_left(width);
  return width < kNoDetail ? left : 0.0F;
}

// Adds term(noise, what is left of it) for each octave, weighted, over the sum of the weights.
template <class Term>
float sum_of_octaves(Vector3f p, int octaves, float gain, float width, const Term& term) {
  float sum = 0, weights = 0, weight = 1;
  for (int i = 0; i < octaves; ++i) {
    const float left = left_of_octave(width);
    sum += weight * term(left > 0 ? lattice_noise(p) : 0.0F, left);
    weights += weight;
    weight *= gain;
    go_to_next_octave(p, width);
  }
  return sum / weights;
}

// lattice_noise() for one lane of many. At a single point the other form is twice as fast, here it would
// leave lanes empty.
[[gnu::always_inline]] inline float lattice_noise_of_lane(const Vector3f& p) {
  const glm::ivec3 cell = cell_of(p);
  const Vector3f f = glm::clamp(p - Vector3f(cell), 0.0F, 1.0F);
  const Vector3f share = {fade(f.x), fade(f.y), fade(f.z)};
  const std::uint32_t number = cell_number(cell);
  const auto corner = [&](std::uint32_t x, std::uint32_t y, std::uint32_t z) {
    return gradient(hash_bits(number + cell_number(x, y, z)), f.x - static_cast<float>(x),
                    f.y - static_cast<float>(y), f.z - static_cast<float>(z));
  };
  const auto along_x = [&](std::uint32_t y, std::uint32_t z) {
    return blend(corner(0, y, z), corner(1, y, z), share.x);
  };
  const auto along_y = [&](std::uint32_t z) { return blend(along_x(0, z), along_x(1, z), share.y); };
  const float noise = blend(along_y(0), along_y(1), share.z);
  return noise < -1 ? -1.0F : noise > 1 ? 1.0F : noise;
}

// sum_of_octaves() at sixteen points.
template <class Term>
void sums_of_octaves(Vector3Block p, int octaves, float gain, NumberBlock width, const Term& term,
                     NumberBlock& result) {
  NumberBlock sum{}, noise{}, left;
  float weights = 0, weight = 1;
  for (int octave = 0; octave < octaves; ++octave) {
    for (int i = 0; i < kBlockSize; ++i) left.at[i] = left_of_octave(width.at[i]);
    if (left.is_any()) lattice_noise(p, noise);
    for (int i = 0; i < kBlockSize; ++i) {
      sum.at[i] += weight * term(chosen(left.at[i] > 0, noise.at[i], 0.0F), left.at[i]);
    }
    weights += weight;
    weight *= gain;
    for (int i = 0; i < kBlockSize; ++i) {
      Vector3f place = p.at(i);
      go_to_next_octave(place, width.at[i]);
      p.set(i, place);
    }
  }
  for (int i = 0; i < kBlockSize; ++i) result.at[i] = sum.at[i] / weights;
}

float faded(float noise, float left) { return noise * left; }
float faded_billow(float noise, float left) { return blend(kMeanAbsoluteNoise, std::abs(noise), left); }

}  // namespace

// The eight corners of the cell side by side, the first two along x, so that the compiler does them at once.
float lattice_noise(const Vector3f& p) {
  const glm::ivec3 cell = cell_of(p);
  const Vector3f f = glm::clamp(p - Vector3f(cell), 0.0F, 1.0F);
  const Vector3f share = {fade(f.x), fade(f.y), fade(f.z)};
  const std::uint32_t number = cell_number(cell);
  float corner[8];
  for (std::uint32_t i = 0; i < 8; ++i) {
    corner[i] = gradient(hash_bits(number + cell_number(i & 1U, i >> 1U & 1U, i >> 2U)),
                         f.x - static_cast<float>(i & 1U), f.y - static_cast<float>(i >> 1U & 1U),
                         f.z - static_cast<float>(i >> 2U));
  }
  float along_y[4], along_z[2];
  for (std::uint32_t i = 0; i < 4; ++i) along_y[i] = blend(corner[2 * i], corner[2 * i + 1], share.x);
  for (std::uint32_t i = 0; i < 2; ++i) along_z[i] = blend(along_y[2 * i], along_y[2 * i + 1], share.y);
  return std::clamp(blend(along_z[0], along_z[1], share.z), -1.0F, 1.0F);
}

float fractal_noise(const Vector3f& p, int octaves, float gain, float width) {
  return sum_of_octaves(p, octaves, gain, width, faded);
}

float turbulence_noise(const Vector3f& p, int octaves, float gain, float width) {
  return sum_of_octaves(p, octaves, gain, width, faded_billow);
}

void lattice_noise(const Vector3Block& p, NumberBlock& noise) {
  NumberBlock result;  // of its own, as compilers fear that `noise` is p
  for (int i = 0; i < kBlockSize; ++i) result.at[i] = lattice_noise_of_lane(p.at(i));
  noise = result;
}

void fractal_noise(const Vector3Block& p, int octaves, float gain, const NumberBlock& width,
                   NumberBlock& noise) {
  const auto term = [](float one, float left) { return faded(one, left); };
  sums_of_octaves(p, octaves, gain, width, term, noise);
}

void turbulence_noise(const Vector3Block& p, int octaves, float gain, const NumberBlock& width,
                      NumberBlock& noise) {
  const auto term = [](float one, float left) { return faded_billow(one, left); };
  sums_of_octaves(p, octaves, gain, width, term, noise);
}

}  // namespace raytracer
