#include "scene_file/noise.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

#include "core/hash.hpp"

namespace raytracer::scene_file {
namespace {

std::uint64_t hash_numbers(std::span<const double> numbers) {
  std::uint64_t hash = mix_bits(numbers.size());
  for (const double number : numbers) hash = mix_bits(hash ^ std::bit_cast<std::uint64_t>(number + 0.0));
  return hash;
}

// The product of the offset with one of the twelve edge directions of a cube, by the hash of the lattice
// point.
double gradient(double x, double y, double z, const Vector3d& offset) {
  const double point[] = {x, y, z};
  const std::uint64_t hash = hash_numbers(point);
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
  double along_z[2];
  for (int k = 0; k < 2; ++k) {
    double along_y[2];
    for (int j = 0; j < 2; ++j) {
      double along_x[2];
      for (int i = 0; i < 2; ++i) {
        along_x[i] = gradient(cell.x + i, cell.y + j, cell.z + k, f - Vector3d(i, j, k));
      }
      along_y[j] = blend(along_x[0], along_x[1], share.x);
    }
    along_z[k] = blend(along_y[0], along_y[1], share.y);
  }
  return std::clamp(blend(along_z[0], along_z[1], share.z), -1.0, 1.0);
}

}  // namespace raytracer::scene_file
