// Rays through a pinhole, one by one and by the block.
#pragma once

#include "core/lanes.hpp"
#include "raytracer/camera.hpp"

namespace raytracer {

/// Of a camera that is one (is_pinhole()): the ray through the picture at x, y in 0..1.
inline Ray3f pinhole_ray(const Camera& camera, double x, double y) {
  const auto across = static_cast<float>(2 * x - 1);
  const auto upwards = static_cast<float>(1 - 2 * y);
  return {camera.position(),
          glm::normalize(camera.forward() + across * camera.right() + upwards * camera.up())};
}

/// Places in the picture.
struct alignas(64) PlaceBlock {
  double x[kBlockSize], y[kBlockSize];
};

inline void pinhole_rays(const Camera& camera, const PlaceBlock& places, RayBlock& __restrict rays) {
  const Camera own = camera;  // that no store to the rays can change it
  for (int i = 0; i < kBlockSize; ++i) rays.set(i, pinhole_ray(own, places.x[i], places.y[i]));
}

}  // namespace raytracer
