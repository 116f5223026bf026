// Normals that make triangles look like a curved surface.
#pragma once

#include "meshes/mesh_data.hpp"

namespace raytracer {

/// Gives every vertex the mean of the normals of the triangles around it, weighted by their angle at the
/// vertex (G. Thürmer, C. Wüthrich, "Computing Vertex Normals from Polygonal Facets", Journal of Graphics
/// Tools 3(1), 1998). Where two triangles meet at an edge by more than `crease` degrees the surface has an
/// edge too: the vertices there are split. Vertices at the same place count as one. Indices must be valid.
void smooth_normals(MeshData& mesh, double crease);

}  // namespace raytracer
