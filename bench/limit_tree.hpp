// The world as Embree holds it.
#pragma once

#include <vector>

#include "limit_world.hpp"
#include "scene/embree.hpp"

namespace raytracer::limit {

struct Tree {
  RTCScene scene;
  std::vector<Surface> surfaces;  // by the number of the geometry
};

/// Reads the world's own buffers, which have to stay.
Tree build_tree(const World& world);

}  // namespace raytracer::limit
