// Sixteen places side by side that points of a part are chosen from, as seen from there.
#pragma once

#include <cstddef>

#include "raytracer/vector3f.hpp"

namespace raytracer::shapes {

/// Where sixteen observers are, and the two numbers in [0, 1) each chooses a point by.
struct PlacesToSeeFrom {
  static constexpr std::size_t kSize = 16;
  alignas(64) float x[kSize], y[kSize], z[kSize], u[kSize], v[kSize];

  Vector3d place(std::size_t i) const {
    return {static_cast<double>(x[i]), static_cast<double>(y[i]), static_cast<double>(z[i])};
  }
};

/// What each has chosen, with the density per steradian; 0: nothing.
struct PlacesSeen {
  static constexpr std::size_t kSize = PlacesToSeeFrom::kSize;
  alignas(64) float x[kSize], y[kSize], z[kSize], pdf[kSize];

  void set(std::size_t i, const Vector3d& point, float density) {
    x[i] = static_cast<float>(point.x);
    y[i] = static_cast<float>(point.y);
    z[i] = static_cast<float>(point.z);
    pdf[i] = density;
  }
};

}  // namespace raytracer::shapes
