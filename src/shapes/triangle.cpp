#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "raytracer/error.hpp"
#include "raytracer/shapes.hpp"
#include "shapes/checks.hpp"
#include "shapes/hits.hpp"
#include "shapes/part_sampling.hpp"
#include "shapes/surface.hpp"

namespace raytracer {

namespace {

/// Twice the area of the triangle from 0 0 to p and q. Never inlined: whether the compiler fuses a product
/// with the subtraction must not differ between the two triangles that ask for the same edge.
[[gnu::noinline]] double area_seen(const glm::dvec2& p, const glm::dvec2& q) { return p.x * q.y - p.y * q.x; }

bool is_before(const Vector3d& p, const Vector3d& q) {
  return p.x != q.x ? p.x < q.x : p.y != q.y ? p.y < q.y : p.z < q.z;
}

/// Hit.u and Hit.v are the weights of b and c, and uv is the same:
///
///     point    u    v
///     a        0    0
///     b        1    0
///     c        0    1
///     middle   1/3  1/3
///
/// Watertight: a ray through a common edge or corner of two triangles hits at least one of them, because both
/// compute the very same number for the side on which it passes. S. Woop, C. Benthin, I. Wald, "Watertight
/// Ray/Triangle Intersection", JCGT 2(1), 2013; here in double, and with every edge taken from its lesser end
/// to the greater. t comes from the plane, so that a ray that starts beside it stays there.
class Triangle final : public Shape {
 public:
  Triangle(const Vector3d& a, const Vector3d& b, const Vector3d& c)
      : corners_{a, b, c}, normal_(glm::normalize(glm::cross(b - a, c - a))) {
    std::sort(ascending_.begin(), ascending_.end(),
              [&](std::size_t i, std::size_t j) { return is_before(corners_[i], corners_[j]); });
    const Vector3d lower = glm::min(a, glm::min(b, c));
    const Vector3d upper = glm::max(a, glm::max(b, c));
    bounds_ = shapes::rounded_bounds(lower, upper);
    extent_ = upper - lower;
  }

  Box3f bounds() const override { return bounds_; }

  bool is_hit(const Ray3f& ray, Hit& hit) const override {
    const Vector3d origin(ray.origin);
    const Vector3d direction(ray.direction);
    const Vector3d to_a = corners_[0] - origin;
    const double t = glm::dot(normal_, to_a) / glm::dot(normal_, direction);
    if (!shapes::is_on_ray(ray, t)) return false;
    // Beside a ray in the plane, but for rounding, the edges say little: t must be near the triangle.
    const Vector3d from_a = t * direction - to_a;
    if (glm::dot(from_a, from_a) > 4 * glm::dot(extent_, extent_)) return false;

    const Vector3f size = glm::abs(ray.direction);
    const int z = size.x > size.y ? (size.x > size.z ? 0 : 2) : (size.y > size.z ? 1 : 2);
    const int x = (z + 1) % 3, y = (z + 2) % 3;
    const double shear_x = direction[x] / direction[z], shear_y = direction[y] / direction[z];
    const auto seen_along_ray = [&](const Vector3d& corner) {
      const Vector3d p = corner - origin;
      return glm::dvec2(p[x] - shear_x * p[z], p[y] - shear_y * p[z]);
    };
    const auto [first, second, third] = ascending_;
    const glm::dvec2 p = seen_along_ray(corners_[first]), q = seen_along_ray(corners_[second]),
                     r = seen_along_ray(corners_[third]);
    std::array<double, 3> weight;  // of each corner: the area on the far side of the edge across from it
    weight[first] = area_seen(q, r);
    weight[second] = -area_seen(p, r);
    weight[third] = area_seen(p, q);
    const auto [least, most] = std::minmax({weight[0], weight[1], weight[2]});
    if (least < 0 && most > 0) return false;
    const double sum = weight[0] + weight[1] + weight[2];
    if (sum == 0) return false;
    shapes::set_hit(hit, t, 0, static_cast<float>(weight[1] / sum), static_cast<float>(weight[2] / sum));
    return true;
  }

  SurfacePoint surface_at(const Ray3f&, const Hit& hit) const override {
    return surface_of(static_cast<double>(hit.u), static_cast<double>(hit.v));
  }

  SurfaceDetail detail_at(const Ray3f&, const Hit& hit) const override {
    SurfaceDetail detail;
    detail.uv = {hit.u, hit.v};
    detail.along_u = Vector3f(corners_[1] - corners_[0]);
    detail.along_v = Vector3f(corners_[2] - corners_[0]);
    return detail;
  }

  std::uint32_t part_count() const override { return 1; }

  PartExtent part_extent(std::uint32_t) const override {
    return shapes::flat_extent(bounds_, area(), normal_);
  }

  /// Uniform over the area.
  bool sample_part(std::uint32_t, const Vector3f& from, const Vector2f& u,
                   ShapeSample& sample) const override {
    const double root = std::sqrt(static_cast<double>(u.x)), along = static_cast<double>(u.y);
    sample.u = static_cast<float>(root * (1 - along));
    sample.v = static_cast<float>(root * along);
    const SurfacePoint point = surface_of(root * (1 - along), root * along);
    return shapes::set_sample(point, part_pdf(0, from, point), sample);
  }

  float part_pdf(std::uint32_t, const Vector3f& from, const SurfacePoint& point) const override {
    // The height of `from` above the plane, free of the rounding of the point.
    const Vector3d origin(from), way = Vector3d(point.position) - origin;
    const double squared = glm::dot(way, way);
    const double facing = std::abs(glm::dot(normal_, corners_[0] - origin));
    return shapes::usable_density(squared * std::sqrt(squared) / (area() * facing));
  }

 private:
  double area() const {
    return 0.5 * glm::length(glm::cross(corners_[1] - corners_[0], corners_[2] - corners_[0]));
  }

  SurfacePoint surface_of(double u, double v) const {
    const Vector3d position = corners_[0] + u * (corners_[1] - corners_[0]) + v * (corners_[2] - corners_[0]);
    shapes::SurfaceBound bound;
    bound.arithmetic = 8 * kDoubleRounding * (glm::length(corners_[0]) + glm::length(extent_));
    bound.extent = extent_;
    return shapes::rounded_surface(position, normal_, bound);
  }

  std::array<Vector3d, 3> corners_;
  std::array<std::size_t, 3> ascending_ = {0, 1, 2};  // the corners from the least to the greatest
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
