#include "meshes/polygons.hpp"

#include <limits>
#include <span>

#include "meshes/chunks.hpp"
#include "meshes/ears.hpp"
#include "raytracer/error.hpp"

namespace raytracer::meshes {

bool Polygons::end_face(std::size_t begin) {
  const std::size_t size = corners.size() - begin;
  if (size < 3) {
    corners.resize(begin);
    ++left_out_;
    return false;
  }
  if (size != 3 && sizes_.empty()) sizes_.assign(faces_, 3);
  if (size != 3 || !sizes_.empty()) sizes_.push_back(static_cast<std::uint32_t>(size));
  ++faces_;
  return true;
}

void append_triangles(std::vector<Polygons>& pieces, MeshData& mesh) {
  std::vector<std::size_t> begins;
  std::size_t count = mesh.triangles.size();
  for (const Polygons& piece : pieces) {
    begins.push_back(count);
    count += piece.triangles();
  }
  if (count > std::numeric_limits<std::uint32_t>::max()) {
    throw Error(ErrorKind::kScene, "it has more than 4,294,967,295 triangles");
  }
  mesh.triangles.resize(count);
  for_each_chunk(pieces.size(), [&](std::size_t i) {
    const Polygons piece = std::move(pieces[i]);
    EarClipper clipper;
    std::array<std::uint32_t, 3>* out = mesh.triangles.data() + begins[i];
    const std::uint32_t* corner = piece.corners.data();
    for (std::size_t face = 0; face < piece.faces(); ++face) {
      const std::uint32_t size = piece.size_of(face);
      clipper.cut({corner, size}, mesh.positions, out);
      corner += size;
      out += size - 2;
    }
  });
}

}  // namespace raytracer::meshes
