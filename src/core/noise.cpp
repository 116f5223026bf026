#include "core/noise.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

#include "core/hash.hpp"

namespace raytracer {
namespace {

std::uint64_t hash_numbers(std::span<const double> numbers) {
  std::uint64_t hash = mix_bits(numbers.size());
  for (const double number : numbers) hash = mix_bits(hash ^ std::bit_cast<std::uint64_t>(number + 0.0));
  return hash;
}

// The product of the offset with one of the twelve edge directions of a cube, by the hash of the lattice
// point.
double gradient(std::uint64_t hash, const Vector3d& offset) {
  const auto direction = static_cast<unsigned>(((hash >> 32U) * 12U) >> 32U);
  const double first = direction < 8 ? offset.x : offset.y;
  const double second = direction < 4 ? offset.y : offset.z;
  return ((direction & 1U) != 0 ? -first : first) + ((direction & 2U) != 0 ? -second : second);
}

double fade(double t) { return t * t * t * (t * (t * 6 - 15) + 10); }

double blend(double a, double b, double share) { return a + (b - a) * share; }

}  // namespace

double random_number(std::span<const double> seeds) {
  return static_cast<double>(hash_numbers(seeds) >> 11U) * 0x1p-53;
}

double gradient_noise(const Vector3d& p) {
  const Vector3d cell = glm::floor(p);
  const Vector3d f = p - cell;
  const Vector3d share = {fade(f.x), fade(f.y), fade(f.z)};
  // The corners' hashes are hash_numbers() of their coordinates; those of one x or one y share its steps.
  const auto step = [](std::uint64_t hash, double number) {
    return mix_bits(hash ^ std::bit_cast<std::uint64_t>(number + 0.0));
  };
  const std::uint64_t start = mix_bits(3);
  double corner[2][2][2];
  for (int i = 0; i < 2; ++i) {
    const std::uint64_t x = step(start, cell.x + i);
    for (int j = 0; j < 2; ++j) {
      const std::uint64_t y = step(x, cell.y + j);
      for (int k = 0; k < 2; ++k) {
        corner[i][j][k] = gradient(step(y, cell.z + k), f - Vector3d(i, j, k));
      }
    }
  }
  double along_z[2];
  for (int k = 0; k < 2; ++k) {
    double along_y[2];
    for (int j = 0; j < 2; ++j) along_y[j] = blend(corner[0][j][k], corner[1][j][k], share.x);
    along_z[k] = blend(along_y[0], along_y[1], share.y);
  }
  return std::clamp(blend(along_z[0], along_z[1], share.z), -1.0, 1.0);
}

}  // namespace raytracer
