// Finds the nearest of many shapes without asking all of them.
#pragma once

#include <memory>
#include <span>

#include "raytracer/scene.hpp"
#include "shapes/hit_block.hpp"

namespace raytracer {

/// A bounding volume hierarchy over finite shapes and over the places of shared ones, with endless shapes
/// beside it. All of them must outlive it.
class Accelerator {
 public:
  explicit Accelerator(std::span<const std::unique_ptr<Shape>> shapes,
                       std::span<const std::shared_ptr<const SharedShapes>> shared = {},
                       std::span<const Instance> instances = {});
  ~Accelerator();
  Accelerator(const Accelerator&) = delete;
  Accelerator& operator=(const Accelerator&) = delete;

  /// The nearest hit; among equal t that of the lower shape, and shapes of the scene itself come before
  /// instances.
  bool is_hit(const Ray3f& ray, Hit& hit) const;
  bool is_occluded(const Ray3f& ray) const;

  /// The very same for the lanes that are asked about; tells which of them are answered by yes.
  BlockMask is_hit(const RayBlock& rays, const BlockMask& asked, HitBlock& hits, Coherence coherence) const;
  BlockMask is_occluded(const RayBlock& rays, const BlockMask& asked, Coherence coherence) const;

  /// Whether there are triangle meshes among them.
  bool has_meshes() const;

 private:
  struct Tree;
  std::unique_ptr<Tree> tree_;
};

}  // namespace raytracer
