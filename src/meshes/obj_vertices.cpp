#include "meshes/obj_vertices.hpp"

#include <array>
#include <atomic>
#include <map>

#include "meshes/chunks.hpp"
#include "raytracer/error.hpp"

namespace raytracer::meshes {
namespace {

bool any_names(const std::vector<ObjFaces>& pieces, std::vector<std::uint32_t> ObjFaces::*indices) {
  for (const ObjFaces& piece : pieces) {
    if (!(piece.*indices).empty()) return true;
  }
  return false;
}

// Whether every corner names the number of its position, and all corners name the same kinds of things.
bool all_as_positions(const std::vector<ObjFaces>& pieces, std::vector<std::uint32_t> ObjFaces::*indices) {
  if (!any_names(pieces, indices)) return true;
  std::atomic<bool> all = true;
  for_each_chunk(pieces.size(), [&](std::size_t i) {
    if (pieces[i].*indices != pieces[i].polygons.corners) all = false;
  });
  return all;
}

// Every combination of indices once, in the order of the corners. Those that share a position are linked, up
// to some length: at the tip of a cone many meet.
class Combinations {
 public:
  Combinations(const ObjAttributes& attributes, MeshData& mesh)
      : attributes_(attributes), mesh_(mesh), first_(attributes.positions.size(), kUnnamed) {}

  std::uint32_t find_or_add(std::uint32_t position, std::uint32_t uv, std::uint32_t normal) {
    std::uint32_t* link = &first_[position];
    int links = 0;
    for (; *link != kUnnamed && links < kMostLinks; link = &known_[*link].next, ++links) {
      if (known_[*link].uv == uv && known_[*link].normal == normal) return *link;
    }
    if (known_.size() == kUnnamed) throw Error(ErrorKind::kScene, "it has more than 4,294,967,295 vertices");
    const auto vertex = static_cast<std::uint32_t>(known_.size());
    if (links == kMostLinks) {
      const auto [place, is_new] = others_.try_emplace({position, uv, normal}, vertex);
      if (!is_new) return place->second;
    } else {
      *link = vertex;
    }
    known_.push_back({uv, normal, kUnnamed});
    mesh_.positions.push_back(attributes_.positions[position]);
    if (!attributes_.colors.empty()) mesh_.colors.push_back(attributes_.colors[position]);
    if (has_uvs) mesh_.uvs.push_back(uv == kUnnamed ? Vector2f(0) : attributes_.uvs[uv]);
    if (has_normals) mesh_.normals.push_back(normal == kUnnamed ? Vector3f(0) : attributes_.normals[normal]);
    return vertex;
  }

  bool has_uvs = false, has_normals = false;

 private:
  static constexpr int kMostLinks = 32;
  struct Known {
    std::uint32_t uv, normal, next;
  };
  const ObjAttributes& attributes_;
  MeshData& mesh_;
  std::vector<std::uint32_t> first_;
  std::vector<Known> known_;
  std::map<std::array<std::uint32_t, 3>, std::uint32_t> others_;
};

void combine(std::vector<ObjFaces>& pieces, const ObjAttributes& attributes, MeshData& mesh) {
  Combinations combinations(attributes, mesh);
  combinations.has_uvs = any_names(pieces, &ObjFaces::uvs);
  combinations.has_normals = any_names(pieces, &ObjFaces::normals);
  for (ObjFaces& piece : pieces) {
    for (std::size_t i = 0; i < piece.polygons.corners.size(); ++i) {
      std::uint32_t& corner = piece.polygons.corners[i];
      corner = combinations.find_or_add(corner, piece.uvs.empty() ? kUnnamed : piece.uvs[i],
                                        piece.normals.empty() ? kUnnamed : piece.normals[i]);
    }
    piece.uvs = {};
    piece.normals = {};
  }
}

}  // namespace

void unify_corners(std::vector<ObjFaces>& pieces, ObjAttributes attributes, MeshData& mesh) {
  const bool has_uvs = any_names(pieces, &ObjFaces::uvs);
  const bool has_normals = any_names(pieces, &ObjFaces::normals);
  if (!all_as_positions(pieces, &ObjFaces::uvs) || !all_as_positions(pieces, &ObjFaces::normals)) {
    return combine(pieces, attributes, mesh);
  }
  mesh.positions = std::move(attributes.positions);
  mesh.colors = std::move(attributes.colors);
  if (has_uvs) {
    mesh.uvs = std::move(attributes.uvs);
    mesh.uvs.resize(mesh.positions.size(), Vector2f(0));
  }
  if (has_normals) {
    mesh.normals = std::move(attributes.normals);
    mesh.normals.resize(mesh.positions.size(), Vector3f(0));
  }
}

}  // namespace raytracer::meshes
