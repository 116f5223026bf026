// What every reader ends with: triangles that nobody can see are left out.
#pragma once

#include <cstdint>

#include "meshes/mesh_data.hpp"

namespace raytracer::meshes {

/// Leaves out the triangles that have no area, two equal corners among them, and tells of them in one remark,
/// with `faces_left_out` that the reader has left out already. Throws Error where none is left.
void leave_out_flat_faces(MeshData& mesh, std::uint64_t faces_left_out);

/// A remark on normals, uvs and colours that were no finite numbers and became 0.
void tell_not_finite(std::uint64_t count, MeshData& mesh);

}  // namespace raytracer::meshes
