// The two ways in which a PLY file's numbers are written.
#pragma once

#include <string_view>

#include "meshes/mesh_data.hpp"
#include "meshes/ply_header.hpp"
#include "meshes/polygons.hpp"

namespace raytracer::meshes {

/// Where a body's reader puts what it reads. Triangles that `mesh` gets at once are not among the faces.
struct PlyResult {
  MeshData mesh;
  std::vector<Polygons> faces;
  std::uint64_t not_finite = 0;
};

/// Both throw Failure at what is wrong.
void read_ply_text(std::string_view file, const PlyHeader& header, std::size_t chunk_bytes,
                   PlyResult& result);
void read_ply_binary(std::string_view file, const PlyHeader& header, PlyResult& result);

}  // namespace raytracer::meshes
