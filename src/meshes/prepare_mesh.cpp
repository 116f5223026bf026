#include "meshes/prepare_mesh.hpp"

#include <algorithm>
#include <cmath>

#include "core/display_curve.hpp"
#include "core/numeric.hpp"
#include "meshes/smooth_normals.hpp"
#include "raytracer/error.hpp"

namespace raytracer {
namespace {

void check(const MeshData& mesh) {
  for (const Vector3f& p : mesh.positions) {
    if (!is_finite(Vector3d(p))) throw Error(ErrorKind::kScene, "a vertex is not a finite number");
  }
  for (const auto& triangle : mesh.triangles) {
    for (const std::uint32_t vertex : triangle) {
      if (vertex >= mesh.positions.size())
        throw Error(ErrorKind::kScene, "a triangle has a corner that is no vertex");
    }
  }
}

// What `recenter` and `fit` amount to.
Transform own_transform(const MeshData& mesh, const MeshOptions& options) {
  Transform transform;
  if (!options.recenter && options.fit == 0) return transform;
  Box3f box;
  for (const auto& triangle : mesh.triangles) {
    for (const std::uint32_t vertex : triangle) box.extend(mesh.positions[vertex]);
  }
  if (box.is_empty()) return transform;
  const Vector3d lower(box.lower), upper(box.upper), size = upper - lower;
  if (options.recenter) transform.translation = -0.5 * (lower + upper);
  if (options.fit > 0) {
    const double longest = std::max({size.x, size.y, size.z});
    if (!(longest > 0)) throw Error(ErrorKind::kScene, "'fit': the mesh has no extent");
    const Transform grow{glm::dmat3(options.fit / longest), Vector3d(0.0)};
    return grow * transform;
  }
  return transform;
}

void turn_around(MeshData& mesh) {
  for (auto& triangle : mesh.triangles) std::swap(triangle[1], triangle[2]);
}

void make_linear(MeshData& mesh) {
  for (Color3f& color : mesh.colors) {
    for (int i = 0; i < 3; ++i)
      color[i] = static_cast<float>(linear_from_display(static_cast<double>(color[i])));
  }
  mesh.has_display_colors = false;
}

void apply(MeshData& mesh, const Transform& transform) {
  if (transform.is_identity()) return;
  for (Vector3f& p : mesh.positions) p = Vector3f(transform.point(Vector3d(p)));
  if (glm::determinant(transform.linear) < 0) turn_around(mesh);
  // Where a mirror turns the corners around, this matrix keeps normals on the outside.
  const glm::dmat3 for_normals = glm::transpose(glm::inverse(transform.linear));
  for (Vector3f& n : mesh.normals) {
    const Vector3d turned = for_normals * Vector3d(n);
    const double length = glm::length(turned);
    n = length > 0 ? Vector3f(turned / length) : Vector3f(0);
  }
}

}  // namespace

void prepare_mesh(MeshData& mesh, const MeshOptions& options, const Transform& to_world) {
  check(mesh);
  if (options.flip) {
    turn_around(mesh);
    for (Vector3f& n : mesh.normals) n = -n;
  }
  if (options.smooth) {
    mesh.normals.clear();
    if (*options.smooth > 0) smooth_normals(mesh, *options.smooth);
  }
  if (options.linear_colors && mesh.has_display_colors) make_linear(mesh);
  apply(mesh, to_world * own_transform(mesh, options));
  mesh.positions.reserve(mesh.positions.size() + 1);  // see TriangleMesh
}

}  // namespace raytracer
