#include "raytracer/error.hpp"
#include "raytracer/shapes.hpp"
#include "shapes/checks.hpp"
#include "shapes/surface.hpp"
#include "shapes/triangle_hit.hpp"

namespace raytracer {

namespace {

/// Hit.u and Hit.v are the weights of b and c, and uv is the same.
class Triangle final : public Shape {
 public:
  Triangle(const Vector3d& a, const Vector3d& b, const Vector3d& c)
      : corners_(a, b, c),
        bounds_(shapes::rounded_bounds(glm::min(a, glm::min(b, c)), glm::max(a, glm::max(b, c)))) {}

  Box3f bounds() const override { return bounds_; }

  bool is_hit(const Ray3f& ray, Hit& hit) const override { return corners_.is_hit(ray, 0, hit); }

  SurfacePoint surface_at(const Ray3f&, const Hit& hit) const override {
    const double u = static_cast<double>(hit.u), v = static_cast<double>(hit.v);
    const Vector3d position = corners_[0] + u * (corners_[1] - corners_[0]) + v * (corners_[2] - corners_[0]);
    shapes::SurfaceBound bound;
    bound.arithmetic = 8 * kDoubleRounding * (glm::length(corners_[0]) + glm::length(corners_.extent()));
    bound.extent = corners_.extent();
    return shapes::rounded_surface(position, corners_.normal(), {hit.u, hit.v}, bound);
  }

 private:
  shapes::TriangleCorners corners_;
  Box3f bounds_;
};

}  // namespace

std::unique_ptr<Shape> make_triangle(const Vector3d& a, const Vector3d& b, const Vector3d& c,
                                     const Transform& transform) {
  shapes::require_finite(a, "a");
  shapes::require_finite(b, "b");
  shapes::require_finite(c, "c");
  shapes::require_regular(transform);
  if (shapes::are_parallel(b - a, c - a)) {
    throw Error(ErrorKind::kScene, "'a', 'b' and 'c' lie on one line: the triangle has no area");
  }
  return std::make_unique<Triangle>(transform.point(a), transform.point(b), transform.point(c));
}

}  // namespace raytracer
