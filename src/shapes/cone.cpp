#include "raytracer/error.hpp"
#include "raytracer/shapes.hpp"
#include "shapes/checks.hpp"
#include "shapes/stump.hpp"

namespace raytracer {

std::unique_ptr<Shape> make_cone(const Vector3d& base, double radius, const Vector3d& top, double top_radius,
                                 bool open, const Transform& transform) {
  shapes::require_apart(base, top);
  shapes::require_not_negative(radius, "radius");
  shapes::require_not_negative(top_radius, "top_radius");
  if (radius == 0 && top_radius == 0) {
    throw Error(ErrorKind::kScene, "'radius' and 'top_radius' are both 0: one of them must be greater");
  }
  shapes::require_regular(transform);
  return shapes::make_stump(base, radius, top, top_radius, open, transform);
}

}  // namespace raytracer
