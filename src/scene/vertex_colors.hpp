// Meshes that bring colours.
#pragma once

#include <algorithm>
#include <memory>
#include <span>

#include "shapes/mesh.hpp"

namespace raytracer {

inline bool any_vertex_colors(std::span<const std::unique_ptr<Shape>> shapes) {
  return std::ranges::any_of(shapes, [](const auto& shape) {
    const TriangleMesh* mesh = shape->as_mesh();
    return mesh != nullptr && !mesh->data().colors.empty();
  });
}

}  // namespace raytracer
