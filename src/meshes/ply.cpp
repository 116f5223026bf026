#include "meshes/ply.hpp"

#include "meshes/flat_faces.hpp"
#include "meshes/ply_bodies.hpp"

namespace raytracer::meshes {

MeshData read_ply(std::string_view file, std::size_t chunk_bytes) {
  PlyHeader header;
  with_lines(file, [&] { header = read_ply_header(file); });
  PlyResult result;
  if (header.format == PlyFormat::kAscii) {
    with_lines(file, [&] { read_ply_text(file, header, chunk_bytes, result); });
  } else {
    with_bytes(file, [&] { read_ply_binary(file, header, result); });
  }
  std::uint64_t left_out = 0;
  for (const Polygons& piece : result.faces) left_out += piece.left_out();
  append_triangles(result.faces, result.mesh);
  tell_not_finite(result.not_finite, result.mesh);
  leave_out_flat_faces(result.mesh, left_out);
  return std::move(result.mesh);
}

}  // namespace raytracer::meshes
