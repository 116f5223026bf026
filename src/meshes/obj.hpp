// Wavefront OBJ: text, a statement a line. "Object Files", appendix B1 of the Advanced Visualizer's manual
// (Wavefront, 1995); colours behind a vertex's position are an extension that most programs know.
#pragma once

#include <string>
#include <string_view>

#include "meshes/chunks.hpp"
#include "meshes/mesh_data.hpp"
#include "meshes/read_mesh.hpp"

namespace raytracer::meshes {

/// `folder`: where the file stands, and its material files are looked for.
MeshData read_obj(std::string_view text, const std::string& folder, const MayRead& may_read,
                  std::size_t chunk_bytes = kChunkBytes);

}  // namespace raytracer::meshes
