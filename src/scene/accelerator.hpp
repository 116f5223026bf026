// Finds the nearest of many shapes without asking all of them.
#pragma once

#include <memory>
#include <span>

#include "raytracer/shape.hpp"

namespace raytracer {

/// A bounding volume hierarchy over finite shapes, with the endless ones beside it. The shapes must outlive it.
class Accelerator {
 public:
  explicit Accelerator(std::span<const std::unique_ptr<Shape>> shapes);
  ~Accelerator();
  Accelerator(const Accelerator&) = delete;
  Accelerator& operator=(const Accelerator&) = delete;

  /// The nearest hit; among equal t that of the lower shape.
  bool is_hit(const Ray3f& ray, Hit& hit) const;
  bool is_occluded(const Ray3f& ray) const;

 private:
  struct Tree;
  std::unique_ptr<Tree> tree_;
};

}  // namespace raytracer
