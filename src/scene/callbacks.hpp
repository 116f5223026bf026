// What Embree calls back while it walks its tree: bounds and hits of our own shapes.
#pragma once

#include <cstdint>
#include <vector>

#include "raytracer/shape.hpp"
#include "scene/embree.hpp"

namespace raytracer {

/// The shapes of one user geometry: primitive i is shape indices[i] of the scene, ascending.
struct FiniteShapes {
  std::vector<const Shape*> shapes;
  std::vector<std::uint32_t> indices;
};

/// Lets `geometry` ask the shapes, which must outlive it, for everything. A hit leaves its Hit::primitive, as
/// bits, in the place of the normal's x: surface_at() knows the normal better.
void set_callbacks(RTCGeometry geometry, FiniteShapes& finite);

}  // namespace raytracer
