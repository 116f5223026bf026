// Spheres and quads as Embree asks about them: for all rays of a packet at once, in single precision, and for
// what a ray outside of all spheres can see.
#pragma once

#include <vector>

#include "limit_world.hpp"
#include "scene/embree.hpp"

namespace raytracer::limit {

/// Geometries over the elements, which have to stay. Corner, width and height make a quad.
RTCGeometry sphere_geometry(RTCDevice device, const std::vector<glm::vec4>& spheres);
RTCGeometry quad_geometry(RTCDevice device, const std::vector<Quad>& quads);

}  // namespace raytracer::limit
