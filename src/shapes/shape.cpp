// What a shape does that does not say otherwise.
#include "raytracer/shape.hpp"

namespace raytracer {

SurfaceDetail Shape::detail_at(const Ray3f&, const Hit&) const { return {}; }

PartExtent Shape::part_extent(std::uint32_t) const { return {}; }

bool Shape::sample_part(std::uint32_t, const Vector3f&, const Vector2f&, ShapeSample&) const { return false; }

float Shape::part_pdf(std::uint32_t, const Vector3f&, const SurfacePoint&) const { return 0; }

}  // namespace raytracer
