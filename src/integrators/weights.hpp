// How much each of two strategies counts that could have made the same choice.
#pragma once

namespace raytracer {

/// The power heuristic with exponent 2 (Veach 1997, section 9.2.4): the weight of a choice with density a
/// that another strategy would have made with density b.
inline float power_heuristic(float a, float b) {
  // As a ratio: the squares of large densities leave the range of float.
  const float ratio = b / a;
  const float weight = a > 0 ? 1 / (1 + ratio * ratio) : 0.0F;
  return b > 0 ? weight : 1.0F;
}

}  // namespace raytracer
