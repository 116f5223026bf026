// Triangles by the million over common vertices.
#pragma once

#include <array>
#include <cstdint>
#include <memory>

#include "meshes/mesh_data.hpp"
#include "raytracer/shape.hpp"

namespace raytracer {

/// Some of the triangles of a mesh: the part of one material, or all of it. The buffers exist once, whoever
/// else uses them: other parts, and the accelerator, which reads them as they are.
///
/// Hit.primitive is the triangle, counted from the first of this part; Hit.u and Hit.v are the weights of its
/// second and third corner. Seen from the front the corners run counter-clockwise; the normal points there.
class TriangleMesh final : public Shape {
 public:
  /// Triangles `begin` … `end` - 1 of `data`, in world space. Throws Error (kScene) where one names a vertex
  /// that does not exist, or a vertex lies beyond the range of coordinates. There must be room for one more
  /// position behind the last (prepare_mesh() sees to it): the accelerator reads four numbers at once.
  TriangleMesh(std::shared_ptr<const MeshData> data, std::uint32_t begin, std::uint32_t end);

  Box3f bounds() const override { return bounds_; }
  /// Asks one triangle after the other; among equal t the first counts. The accelerator's oracle.
  bool is_hit(const Ray3f& ray, Hit& hit) const override;
  SurfacePoint surface_at(const Ray3f& ray, const Hit& hit) const override;
  void surfaces_at(const RayBlock& rays, const HitBlock& hits, const BlockMask& asked,
                   SurfaceBlock& surfaces) const override;
  SurfaceDetail detail_at(const Ray3f& ray, const Hit& hit) const override;
  const TriangleMesh* as_mesh() const override { return this; }

  std::uint32_t part_count() const override { return count_; }
  PartExtent part_extent(std::uint32_t part) const override;
  bool sample_part(std::uint32_t part, const Vector3f& from, const Vector2f& u,
                   ShapeSample& sample) const override;
  float part_pdf(std::uint32_t part, const Vector3f& from, const SurfacePoint& point) const override;

  /// Has the memory fetched that surface_at() will read of that triangle. Of many at once the waits overlap.
  /// (A call, GCC holds, does nothing, and leaves it out.)
  [[gnu::always_inline]] void prefetch_numbers(std::uint32_t part) const {
    __builtin_prefetch(&triangle(part));
  }
  /// Reads the numbers: these are better there by then.
  [[gnu::always_inline]] void prefetch(std::uint32_t part) const {
    for (const std::uint32_t vertex : triangle(part)) {
      __builtin_prefetch(data_->positions.data() + vertex);
      if (!data_->normals.empty()) __builtin_prefetch(data_->normals.data() + vertex);
    }
  }

  const MeshData& data() const { return *data_; }
  std::uint32_t first_triangle() const { return begin_; }
  std::uint32_t triangle_count() const { return count_; }

 private:
  using Triangle = std::array<std::uint32_t, 3>;
  const Triangle& triangle(std::uint32_t part) const { return data_->triangles[begin_ + part]; }
  Vector3d corner(std::uint32_t vertex) const { return Vector3d(data_->positions[vertex]); }

  std::shared_ptr<const MeshData> data_;
  std::uint32_t begin_, count_;
  Box3f bounds_;
};

}  // namespace raytracer
