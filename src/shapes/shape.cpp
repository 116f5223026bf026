// What a shape does that does not say otherwise.
#include "raytracer/shape.hpp"

#include "shapes/hit_block.hpp"

namespace raytracer {

void Shape::surfaces_at(const RayBlock& rays, const HitBlock& hits, const BlockMask& asked,
                        SurfaceBlock& surfaces) const {
  for (int i = 0; i < kBlockSize; ++i) {
    if (asked.has(i)) surfaces.set(i, surface_at(rays.ray(i), hits.at(i)));
  }
}

SurfaceDetail Shape::detail_at(const Ray3f&, const Hit&) const { return {}; }

PartExtent Shape::part_extent(std::uint32_t) const { return {}; }

bool Shape::sample_part(std::uint32_t, const Vector3f&, const Vector2f&, ShapeSample&) const { return false; }

float Shape::part_pdf(std::uint32_t, const Vector3f&, const SurfacePoint&) const { return 0; }

}  // namespace raytracer
