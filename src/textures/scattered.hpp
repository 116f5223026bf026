// Points scattered over space, one in each cell of a lattice.
#pragma once

#include "textures/pattern.hpp"

namespace raytracer {

struct NearestPoints {
  float nearest = 0, second = 0;  ///< the distances of the two that are nearest
  float number = 0;               ///< in [0, 1), of the nearest point alone
};

/// `jitter` 0 puts each point into the middle of its cell, 1 anywhere in it. Flat: z does not count.
NearestPoints nearest_points(const Vector3f& p, float jitter, bool is_flat);

struct NearestBlock {
  NumberBlock nearest, second, number;

  NearestPoints at(int i) const { return {nearest.at[i], second.at[i], number.at[i]}; }
};

/// The very same at sixteen points.
void nearest_points(const Vector3Block& p, float jitter, bool is_flat, NearestBlock& found);

}  // namespace raytracer
