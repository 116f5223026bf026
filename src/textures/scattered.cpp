#include "textures/scattered.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include "sampling/sobol.hpp"
#include "textures/fractal.hpp"

namespace raytracer {
namespace {

// What has been found so far: distances squared as bits, whose order is theirs and which compilers compare
// without a thought of what is not a number.
struct Found {
  std::uint32_t nearest = std::bit_cast<std::uint32_t>(kInfinity), second = nearest;
  std::uint32_t hash = 0;  // of the cell of the nearest
};

// As many places along each axis may a cell's point have: ten bits of its hash tell which.
constexpr float kPlaces = 1024;

// From a place in a cell to the least coordinates that the cell's own point may have.
Vector3f to_first_corner(const Vector3f& within, float jitter) {
  return 0.5F + jitter * (0.5F / kPlaces - 0.5F) - within;
}

// Looks at the point of one more cell, `aside` from the one that the place is in, of that hash. Without
// branches: it is done to blocks of places.
template <bool kIsFlat>
[[gnu::always_inline]] inline Found with_cell(const Found& found, std::uint32_t hash, const Vector3f& aside,
                                              const Vector3f& corner, float step) {
  const auto part = [&](std::uint32_t bits) {
    return step * static_cast<float>(static_cast<std::int32_t>(bits));
  };
  const float x = aside.x + corner.x + part(hash & 0x3FFU);
  const float y = aside.y + corner.y + part(hash >> 10U & 0x3FFU);
  const float z = kIsFlat ? 0.0F : aside.z + corner.z + part(hash >> 22U);
  const auto distance = std::bit_cast<std::uint32_t>(x * x + y * y + z * z);
  const bool is_nearer = distance < found.nearest;
  return {std::min(distance, found.nearest), std::min(found.second, std::max(distance, found.nearest)),
          is_nearer ? hash : found.hash};
}

// Calls function(aside) for each of the cells around one.
template <bool kIsFlat, class Function>
void for_neighbours(const Function& function) {
  constexpr int kDepth = kIsFlat ? 0 : 1;
  for (int k = -kDepth; k <= kDepth; ++k) {
    for (int j = -1; j <= 1; ++j) {
      for (int i = -1; i <= 1; ++i) function(glm::ivec3(i, j, k));
    }
  }
}

NearestPoints finished(const Found& found) {
  return {std::sqrt(std::bit_cast<float>(found.nearest)), std::sqrt(std::bit_cast<float>(found.second)),
          unit_float(hash_bits(found.hash))};
}

template <bool kIsFlat>
void find_nearest(const Vector3Block& p, float jitter, NearestBlock& result) {
  Vector3Block corner;
  alignas(64) std::uint32_t number[kBlockSize], nearest[kBlockSize], second[kBlockSize], hash[kBlockSize];
  for (int lane = 0; lane < kBlockSize; ++lane) {
    const glm::ivec3 cell = cell_of(p.at(lane));
    corner.set(lane, to_first_corner(p.at(lane) - Vector3f(cell), jitter));
    number[lane] = cell_number(cell);
    nearest[lane] = second[lane] = Found{}.nearest;
    hash[lane] = 0;
  }
  const float step = jitter / kPlaces;
  for_neighbours<kIsFlat>([&](const glm::ivec3& aside) {
    for (int lane = 0; lane < kBlockSize; ++lane) {
      const Found found = with_cell<kIsFlat>({nearest[lane], second[lane], hash[lane]},
                                             hash_bits(number[lane] + cell_number(aside)), Vector3f(aside),
                                             corner.at(lane), step);
      nearest[lane] = found.nearest;
      second[lane] = found.second;
      hash[lane] = found.hash;
    }
  });
  for (int lane = 0; lane < kBlockSize; ++lane) {
    const NearestPoints points = finished({nearest[lane], second[lane], hash[lane]});
    result.nearest.at[lane] = points.nearest;
    result.second.at[lane] = points.second;
    result.number.at[lane] = points.number;
  }
}

}  // namespace

NearestPoints nearest_points(const Vector3f& p, float jitter, bool is_flat) {
  const glm::ivec3 cell = cell_of(p);
  const Vector3f corner = to_first_corner(p - Vector3f(cell), jitter);
  const float step = jitter / kPlaces;
  return with_constant<true, false>(is_flat, [&](auto flat) {
    Found found;
    for_neighbours<flat>([&](const glm::ivec3& aside) {
      const std::uint32_t hash = hash_bits(cell_number(cell) + cell_number(aside));
      found = with_cell<flat>(found, hash, Vector3f(aside), corner, step);
    });
    return finished(found);
  });
}

void nearest_points(const Vector3Block& p, float jitter, bool is_flat, NearestBlock& found) {
  with_constant<true, false>(is_flat, [&](auto flat) { find_nearest<flat>(p, jitter, found); });
}

}  // namespace raytracer
