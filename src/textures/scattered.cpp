#include "textures/scattered.hpp"

#include <algorithm>
#include <cmath>

#include "sampling/sobol.hpp"
#include "textures/fractal.hpp"

namespace raytracer {

NearestPoints nearest_points(const Vector3f& p, float jitter, bool is_flat) {
  const glm::ivec3 cell = cell_of(p);
  const Vector3f within = p - Vector3f(cell);
  NearestPoints found;
  float nearest = kInfinity, second = kInfinity;
  const int depth = is_flat ? 0 : 1;
  for (int k = -depth; k <= depth; ++k) {
    for (int j = -1; j <= 1; ++j) {
      for (int i = -1; i <= 1; ++i) {
        const std::uint32_t hash = cell_hash(cell + glm::ivec3(i, j, k));
        const auto part = [&](unsigned shift) {
          return static_cast<float>((hash >> shift) & 0x3FFU) * (1.0F / 1024) - 0.5F + 0.5F / 1024;
        };
        Vector3f offset = Vector3f(i, j, k) + 0.5F + jitter * Vector3f(part(0), part(10), part(20)) - within;
        if (is_flat) offset.z = 0;
        const float distance = glm::dot(offset, offset);
        if (distance < nearest) {
          second = nearest;
          nearest = distance;
          found.number = unit_float(hash_bits(hash));
        } else {
          second = std::min(second, distance);
        }
      }
    }
  }
  found.nearest = std::sqrt(nearest);
  found.second = std::sqrt(second);
  return found;
}

}  // namespace raytracer
