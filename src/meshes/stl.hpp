// Stereolithography files (STL): triangles that share nothing, as text or in binary. M. Burns, "Automated
// Fabrication", 1993, section 6.5.
#pragma once

#include <string_view>

#include "meshes/chunks.hpp"
#include "meshes/mesh_data.hpp"

namespace raytracer::meshes {

/// Whether the bytes may be those of an STL file, text or binary.
bool looks_like_stl(std::string_view file);

/// Equal corners become one position. The facets' normals are not read: the corners' order says as much.
MeshData read_stl(std::string_view file, std::size_t chunk_bytes = kChunkBytes);

}  // namespace raytracer::meshes
