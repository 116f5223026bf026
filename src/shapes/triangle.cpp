#include <algorithm>
#include <cmath>

#include "raytracer/error.hpp"
#include "raytracer/shapes.hpp"
#include "shapes/checks.hpp"
#include "shapes/hits.hpp"
#include "shapes/surface.hpp"

namespace raytracer {

namespace {

/// Hit.u and Hit.v are the weights of b and c, and uv is the same:
///
///     point    u    v
///     a        0    0
///     b        1    0
///     c        0    1
///     middle   1/3  1/3
///
/// Watertight: a ray through a common edge or corner of two triangles hits at least one of them, because both compute
/// the very same number for the side on which it passes. S. Woop, C. Benthin, I. Wald, "Watertight Ray/Triangle
/// Intersection", JCGT 2(1), 2013. The corners are sheared in float and their products taken in double, where they are
/// exact and the sign needs no second try; t comes from the plane, so that a ray that starts beside it stays there.
class Triangle final : public Shape {
 public:
  Triangle(const Vector3d& a, const Vector3d& b, const Vector3d& c)
      : a_(a), b_(b), c_(c), normal_(glm::normalize(glm::cross(b - a, c - a))) {
    const Vector3d lower = glm::min(a, glm::min(b, c));
    const Vector3d upper = glm::max(a, glm::max(b, c));
    bounds_ = shapes::rounded_bounds(lower, upper);
    extent_ = upper - lower;
  }

  Box3f bounds() const override { return bounds_; }

  bool is_hit(const Ray3f& ray, Hit& hit) const override {
    const Vector3d origin(ray.origin);
    const Vector3d direction(ray.direction);
    const double t = glm::dot(normal_, a_ - origin) / glm::dot(normal_, direction);
    if (!shapes::is_on_ray(ray, t)) return false;

    const Vector3f size = glm::abs(ray.direction);
    const int z = size.x > size.y ? (size.x > size.z ? 0 : 2) : (size.y > size.z ? 1 : 2);
    const int x = (z + 1) % 3, y = (z + 2) % 3;
    const float shear_x = ray.direction[x] / ray.direction[z], shear_y = ray.direction[y] / ray.direction[z];
    const auto seen_along_ray = [&](const Vector3d& corner) {
      const Vector3f p(corner - origin);
      return glm::dvec2(p[x] - shear_x * p[z], p[y] - shear_y * p[z]);
    };
    const glm::dvec2 a = seen_along_ray(a_), b = seen_along_ray(b_), c = seen_along_ray(c_);
    const double weight_a = c.x * b.y - c.y * b.x;
    const double weight_b = a.x * c.y - a.y * c.x;
    const double weight_c = b.x * a.y - b.y * a.x;
    if ((weight_a < 0 || weight_b < 0 || weight_c < 0) && (weight_a > 0 || weight_b > 0 || weight_c > 0)) return false;
    const double sum = weight_a + weight_b + weight_c;
    if (sum == 0) return false;
    shapes::set_hit(hit, t, 0, static_cast<float>(weight_b / sum), static_cast<float>(weight_c / sum));
    return true;
  }

  SurfacePoint surface_at(const Ray3f&, const Hit& hit) const override {
    const double u = static_cast<double>(hit.u), v = static_cast<double>(hit.v);
    const Vector3d position = a_ + u * (b_ - a_) + v * (c_ - a_);
    shapes::SurfaceBound bound;
    bound.arithmetic = 8 * kDoubleRounding * (glm::length(a_) + glm::length(extent_));
    bound.extent = extent_;
    return shapes::rounded_surface(position, normal_, {hit.u, hit.v}, bound);
  }

 private:
  Vector3d a_, b_, c_;
  Vector3d normal_;
  Vector3d extent_{0.0};
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
