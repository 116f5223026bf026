// Meshes for tests.
#pragma once

#include <cmath>
#include <map>
#include <memory>
#include <random>
#include <utility>

#include "meshes/prepare_mesh.hpp"
#include "shapes/mesh.hpp"

namespace raytracer {

/// The cube with corners at -1 and 1; faces outwards.
inline MeshData cube_mesh() {
  MeshData mesh;
  for (int i = 0; i < 8; ++i)
    mesh.positions.push_back(Vector3f((i & 1) != 0 ? 1 : -1, (i & 2) != 0 ? 1 : -1, (i & 4) != 0 ? 1 : -1));
  mesh.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                    {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  return mesh;
}

/// A ball of radius 1, or what `height` of a direction makes of it: an octahedron divided `level` times.
template <class Height>
MeshData ball_mesh(int level, const Height& height) {
  MeshData mesh;
  std::vector<Vector3d> points = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  mesh.triangles = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
  for (int i = 0; i < level; ++i) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
    const auto middle = [&](std::uint32_t a, std::uint32_t b) {
      const auto [known, is_new] = middles.try_emplace(std::minmax(a, b), std::uint32_t(points.size()));
      if (is_new) points.push_back(glm::normalize(points[a] + points[b]));
      return known->second;
    };
    auto coarse = std::move(mesh.triangles);
    mesh.triangles.clear();
    for (const auto& [a, b, c] : coarse) {
      const std::uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
      mesh.triangles.push_back({a, ab, ca});
      mesh.triangles.push_back({ab, b, bc});
      mesh.triangles.push_back({ca, bc, c});
      mesh.triangles.push_back({ab, bc, ca});
    }
  }
  for (const Vector3d& p : points) mesh.positions.push_back(Vector3f(height(p) * p));
  return mesh;
}

inline MeshData ball_mesh(int level) {
  return ball_mesh(level, [](const Vector3d&) { return 1.0; });
}

/// With bumps, dents and sharp valleys; closed.
inline MeshData rugged_mesh(int level) {
  return ball_mesh(level, [](const Vector3d& p) {
    return 1 + 0.2 * std::sin(5 * p.x) * std::cos(7 * p.y) + 0.1 * std::abs(std::sin(9 * p.z + 3 * p.x));
  });
}

inline std::unique_ptr<Shape> make_mesh(MeshData mesh, const Transform& placed = {},
                                        const MeshOptions& options = {}) {
  prepare_mesh(mesh, options, placed);
  const auto count = static_cast<std::uint32_t>(mesh.triangles.size());
  return std::make_unique<TriangleMesh>(std::make_shared<const MeshData>(std::move(mesh)), 0, count);
}

}  // namespace raytracer
