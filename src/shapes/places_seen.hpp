// Sixteen places side by side that points of a part are chosen from, as seen from there.
#pragma once

#include "core/lanes.hpp"

namespace raytracer::shapes {

/// Where sixteen observers are, and the two numbers in [0, 1) each chooses a point by.
struct PlacesToSeeFrom {
  Vector3Block position{};
  alignas(64) float u[kBlockSize]{}, v[kBlockSize]{};
};

/// What each has chosen, with the density per steradian; 0: nothing.
struct PlacesSeen {
  Vector3Block position;
  alignas(64) float pdf[kBlockSize];

  void set(int i, const Vector3d& point, float density) {
    position.set(i, Vector3f(point));
    pdf[i] = density;
  }
};

}  // namespace raytracer::shapes
