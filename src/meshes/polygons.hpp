// Faces of any number of corners, and the triangles that they become.
#pragma once

#include <cstdint>
#include <vector>

#include "meshes/mesh_data.hpp"

namespace raytracer::meshes {

/// Faces one after the other, each a run of corners. A face is added by appending its corners and calling
/// end_face.
class Polygons {
 public:
  std::vector<std::uint32_t> corners;

  /// Ends the face whose corners begin at `begin` of `corners`. With fewer than three it is not kept, and
  /// its corners are taken back; returns whether it was kept.
  bool end_face(std::size_t begin);

  std::size_t faces() const { return faces_; }
  /// A face of n corners becomes n - 2 triangles.
  std::size_t triangles() const { return corners.size() - 2 * faces_; }
  std::uint32_t size_of(std::size_t face) const { return sizes_.empty() ? 3 : sizes_[face]; }
  /// How many faces were not kept.
  std::uint64_t left_out() const { return left_out_; }

 private:
  std::vector<std::uint32_t> sizes_;  // none as long as every face is a triangle
  std::size_t faces_ = 0;
  std::uint64_t left_out_ = 0;
};

/// Appends the triangles of the faces, piece by piece, whose corners are positions of the mesh. A triangle
/// keeps its corners' order; a quad is cut along its first diagonal that lies within it; larger faces have
/// their ears clipped (G. H. Meisters, "Polygons Have Ears", 1975). Frees the pieces.
void append_triangles(std::vector<Polygons>& pieces, MeshData& mesh);

}  // namespace raytracer::meshes
