// Equal corners become one.
#pragma once

#include <array>
#include <vector>

#include "meshes/mesh_data.hpp"

namespace raytracer::meshes {

/// Makes `mesh` the triangles whose corners, three each, are these: positions in the order in which they
/// first appear, every one once, and indices to them. All are finite. Frees the corners.
void weld(std::vector<Vector3f>& corners, MeshData& mesh);

}  // namespace raytracer::meshes
