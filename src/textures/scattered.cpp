#include "textures/scattered.hpp"

#include <cmath>

#include "sampling/sobol.hpp"
#include "textures/fractal.hpp"

namespace raytracer {
namespace {

/// What has been found so far, distances squared.
struct Found {
  float nearest = kInfinity, second = kInfinity;
  std::uint32_t hash = 0;  // of the cell of the nearest
};

// Looks at the point of one more cell, `aside` from the one that the place is in, at `within` there. Without
// branches: it is done to blocks of places.
template <bool kIsFlat>
[[gnu::always_inline]] inline Found with_cell(const Found& found, const glm::ivec3& cell,
                                              const glm::ivec3& aside, const Vector3f& within, float jitter) {
  const std::uint32_t hash = cell_hash(cell + aside);
  const auto part = [&](unsigned shift) {
    return static_cast<float>(static_cast<std::int32_t>((hash >> shift) & 0x3FFU)) * (1.0F / 1024) - 0.5F +
           0.5F / 1024;
  };
  const Vector3f offset = Vector3f(aside) + 0.5F + jitter * Vector3f(part(0), part(10), part(20)) - within;
  const float flat = offset.x * offset.x + offset.y * offset.y;
  const float distance = kIsFlat ? flat : flat + offset.z * offset.z;
  const bool is_nearer = distance < found.nearest;
  const float other = is_nearer ? found.nearest : distance;
  return {is_nearer ? distance : found.nearest, other < found.second ? other : found.second,
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
  return {std::sqrt(found.nearest), std::sqrt(found.second), unit_float(hash_bits(found.hash))};
}

template <bool kIsFlat>
void find_nearest(const Vector3Block& p, float jitter, NearestBlock& result) {
  Vector3Block within;
  alignas(64) std::int32_t x[kBlockSize], y[kBlockSize], z[kBlockSize];
  alignas(64) std::uint32_t hash[kBlockSize];
  NumberBlock nearest, second;
  for (int lane = 0; lane < kBlockSize; ++lane) {
    const glm::ivec3 cell = cell_of(p.at(lane));
    within.set(lane, p.at(lane) - Vector3f(cell));
    x[lane] = cell.x;
    y[lane] = cell.y;
    z[lane] = cell.z;
    nearest.at[lane] = second.at[lane] = kInfinity;
    hash[lane] = 0;
  }
  for_neighbours<kIsFlat>([&](const glm::ivec3& aside) {
    for (int lane = 0; lane < kBlockSize; ++lane) {
      const Found found = with_cell<kIsFlat>({nearest.at[lane], second.at[lane], hash[lane]},
                                             {x[lane], y[lane], z[lane]}, aside, within.at(lane), jitter);
      nearest.at[lane] = found.nearest;
      second.at[lane] = found.second;
      hash[lane] = found.hash;
    }
  });
  for (int lane = 0; lane < kBlockSize; ++lane) {
    const NearestPoints points = finished({nearest.at[lane], second.at[lane], hash[lane]});
    result.nearest.at[lane] = points.nearest;
    result.second.at[lane] = points.second;
    result.number.at[lane] = points.number;
  }
}

}  // namespace

NearestPoints nearest_points(const Vector3f& p, float jitter, bool is_flat) {
  const glm::ivec3 cell = cell_of(p);
  const Vector3f within = p - Vector3f(cell);
  return with_constant<true, false>(is_flat, [&](auto flat) {
    Found found;
    for_neighbours<flat>(
        [&](const glm::ivec3& aside) { found = with_cell<flat>(found, cell, aside, within, jitter); });
    return finished(found);
  });
}

void nearest_points(const Vector3Block& p, float jitter, bool is_flat, NearestBlock& found) {
  with_constant<true, false>(is_flat, [&](auto flat) { find_nearest<flat>(p, jitter, found); });
}

}  // namespace raytracer
