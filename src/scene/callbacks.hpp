// What Embree calls back while it walks its tree: bounds and hits of our own shapes.
#pragma once

#include <cstdint>
#include <vector>

#include "raytracer/shape.hpp"
#include "scene/embree.hpp"

namespace raytracer {

inline constexpr unsigned kAskedShapes = 0;

/// The finite shapes of one tree. Those that are asked are the primitives of one user geometry, number
/// kAskedShapes: primitive i is shape indices[i] of the scene, ascending. Mesh i is geometry i + 1, and shape
/// mesh_indices[i].
struct FiniteShapes {
  std::vector<const Shape*> shapes;
  std::vector<std::uint32_t> indices;
  std::vector<const TriangleMesh*> meshes;
  std::vector<std::uint32_t> mesh_indices;

  std::uint32_t index_of(unsigned geometry, unsigned primitive) const {
    return geometry == kAskedShapes ? indices[primitive] : mesh_indices[geometry - 1];
  }
};

/// Lets `geometry` ask the shapes, which must outlive it, for everything. A hit leaves its Hit::primitive, as
/// bits, in the place of the normal's x: surface_at() knows the normal better.
void set_callbacks(RTCGeometry geometry, FiniteShapes& finite);

}  // namespace raytracer
