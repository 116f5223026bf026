// What is done to a mesh between its file and its place in a scene.
#pragma once

#include <optional>

#include "meshes/mesh_data.hpp"

namespace raytracer {

struct MeshOptions {
  /// Two triangles that meet at no more than this angle (degrees, between their normals) look like one curved
  /// surface; 0: every triangle looks flat. None: as the file's normals say.
  std::optional<double> smooth;
  bool flip = false;           ///< turns it inside out
  bool recenter = false;       ///< moves the middle of its box to 0 0 0
  bool linear_colors = false;  ///< colours that were display values become linear
  double fit = 0;  ///< the length that the longest side of its box becomes, about 0 0 0; 0: as it is
};

/// Applies the options and then `to_world` to the mesh. Positions are computed in double precision and
/// rounded once; a transform that mirrors leaves what is outside outside. Throws Error (kScene) where the
/// numbers make no mesh: a position that is not finite, an index beyond the vertices, no extent to fit.
void prepare_mesh(MeshData& mesh, const MeshOptions& options, const Transform& to_world = {});

}  // namespace raytracer
