#include "raytracer/shapes.hpp"
#include "shapes/checks.hpp"
#include "shapes/stump.hpp"

namespace raytracer {

std::unique_ptr<Shape> make_cylinder(const Vector3d& base, const Vector3d& top, double radius, bool open,
                                     const Transform& transform) {
  shapes::require_apart(base, top);
  shapes::require_positive(radius, "radius");
  shapes::require_regular(transform);
  return shapes::make_stump(base, radius, top, radius, open, transform);
}

}  // namespace raytracer
