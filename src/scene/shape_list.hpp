// The plainest of all searches: every shape is asked. It serves endless shapes, and tests as the oracle of
// the tree.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "raytracer/shape.hpp"

namespace raytracer {

class ShapeList {
 public:
  ShapeList() = default;
  /// `indices` of the shapes in the scene, ascending.
  ShapeList(std::vector<const Shape*> shapes, std::vector<std::uint32_t> indices)
      : shapes_(std::move(shapes)), indices_(std::move(indices)) {}

  bool is_empty() const { return shapes_.empty(); }

  /// The nearest hit; among equal t that of the lower shape.
  bool is_hit(const Ray3f& ray, Hit& hit) const {
    Ray3f rest = ray;
    bool found = false;
    for (std::size_t i = 0; i < shapes_.size(); ++i) {
      if (!shapes_[i]->is_hit(rest, hit)) continue;
      hit.shape = indices_[i];
      hit.instance = kNoInstance;
      rest.t_max = hit.t;
      found = true;
    }
    return found;
  }

  bool is_occluded(const Ray3f& ray) const {
    Hit ignored;
    for (const Shape* shape : shapes_) {
      if (shape->is_hit(ray, ignored)) return true;
    }
    return false;
  }

 private:
  std::vector<const Shape*> shapes_;
  std::vector<std::uint32_t> indices_;
};

}  // namespace raytracer
