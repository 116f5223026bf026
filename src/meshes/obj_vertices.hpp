// OBJ's corners name a position, a uv and a normal each by an index of its own; a mesh's have one index.
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "meshes/mesh_data.hpp"
#include "meshes/polygons.hpp"

namespace raytracer::meshes {

/// The index of what a corner does not name.
inline constexpr std::uint32_t kUnnamed = std::numeric_limits<std::uint32_t>::max();

/// A piece of an OBJ's faces: the corners of `polygons` are positions.
struct ObjFaces {
  Polygons polygons;
  std::vector<std::uint32_t> uvs, normals;  ///< none, or one per corner, which may be kUnnamed
};

/// What the file holds of each, in its order; colours none or one per position.
struct ObjAttributes {
  std::vector<Vector3f> positions;
  std::vector<Color3f> colors;
  std::vector<Vector2f> uvs;
  std::vector<Vector3f> normals;
};

/// Fills the mesh's positions, colours, uvs and normals, and makes the faces' corners index them. Where no
/// corner names a uv or normal of another number than its position, the positions stay as they are; else
/// there is one vertex for each combination that a corner names. What a corner does not name is 0.
void unify_corners(std::vector<ObjFaces>& pieces, ObjAttributes attributes, MeshData& mesh);

}  // namespace raytracer::meshes
