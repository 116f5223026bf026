// Polygon files (PLY): a header in text that says what follows, then numbers as text or in binary. G. Turk,
// "The PLY Polygon File Format", 1994.
#pragma once

#include <string_view>

#include "meshes/chunks.hpp"
#include "meshes/mesh_data.hpp"

namespace raytracer::meshes {

MeshData read_ply(std::string_view file, std::size_t chunk_bytes = kChunkBytes);

}  // namespace raytracer::meshes
