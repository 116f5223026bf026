// The plainest of all searches: every shape is asked. It serves endless shapes, and tests as the oracle of
// the tree.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "raytracer/shape.hpp"
#include "shapes/hit_block.hpp"
#include "shapes/ray_packet.hpp"

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

  /// The same for the lanes that are asked about; tells which of them have a hit.
  BlockMask find_hits(const RayBlock& rays, const BlockMask& asked, HitBlock& hits) const {
    BlockMask found = BlockMask::none();
    for_each_packet(rays, asked, [&](RayPacket& packet, int first) {
      for (std::size_t k = 0; k < shapes_.size(); ++k) {
        HitPacket nearer;
        shapes_[k]->find_hits(packet, nearer);
        for (int i = 0; i < RayPacket::kSize; ++i) {
          if (!(nearer.t[i] < kInfinity)) continue;
          hits.set(first + i, {nearer.t[i], indices_[k], nearer.primitive[i], nearer.u[i], nearer.v[i]});
          packet.t_max[i] = nearer.t[i];
          found.set(first + i, true);
        }
      }
    });
    return found;
  }

  BlockMask are_occluded(const RayBlock& rays, const BlockMask& asked) const {
    BlockMask hidden = BlockMask::none();
    for_each_packet(rays, asked, [&](RayPacket& packet, int first) {
      for (const Shape* shape : shapes_) {
        HitPacket hits;
        shape->find_hits(packet, hits);
        for (int i = 0; i < RayPacket::kSize; ++i) {
          if (hits.t[i] < kInfinity) hidden.set(first + i, true);
        }
      }
    });
    return hidden;
  }

 private:
  // Calls function(packet, its first lane); lanes that are not asked about are idle.
  template <class Function>
  static void for_each_packet(const RayBlock& rays, const BlockMask& asked, const Function& function) {
    for (int first = 0; first < kBlockSize; first += RayPacket::kSize) {
      RayPacket packet;
      for (int i = 0; i < RayPacket::kSize; ++i) {
        packet.set(i, rays.ray(first + i));
        packet.t_max[i] = asked.has(first + i) ? packet.t_max[i] : -kInfinity;
      }
      function(packet, first);
    }
  }

  std::vector<const Shape*> shapes_;
  std::vector<std::uint32_t> indices_;
};

}  // namespace raytracer
