#include "raytracer/error.hpp"
#include "raytracer/shapes.hpp"
#include "shapes/checks.hpp"
#include "shapes/part_sampling.hpp"
#include "shapes/surface.hpp"
#include "shapes/triangle_hit.hpp"
#include "shapes/triangle_sampling.hpp"

namespace raytracer {

namespace {

/// Hit.u and Hit.v are the weights of b and c, and uv is the same.
class Triangle final : public Shape {
 public:
  Triangle(const Vector3d& a, const Vector3d& b, const Vector3d& c, bool is_mirrored)
      : corners_(a, b, c),
        normal_(is_mirrored ? -corners_.normal() : corners_.normal()),
        bounds_(shapes::rounded_bounds(glm::min(a, glm::min(b, c)), glm::max(a, glm::max(b, c)))) {}

  Box3f bounds() const override { return bounds_; }

  bool is_hit(const Ray3f& ray, Hit& hit) const override { return corners_.is_hit(ray, 0, hit); }

  SurfacePoint surface_at(const Ray3f&, const Hit& hit) const override {
    return surface_of({static_cast<double>(hit.u), static_cast<double>(hit.v)});
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
    const double area = 0.5 * glm::length(glm::cross(corners_[1] - corners_[0], corners_[2] - corners_[0]));
    return shapes::flat_extent(bounds_, area, normal_);
  }

  bool sample_part(std::uint32_t, const Vector3f& from, const Vector2f& u,
                   ShapeSample& sample) const override {
    const shapes::SeenTriangle seen = seen_from(from);
    if (!seen.is_seen()) return false;
    const glm::dvec2 weights = seen.sample(u);
    sample.u = static_cast<float>(weights.x);
    sample.v = static_cast<float>(weights.y);
    return shapes::set_sample(surface_of(weights), shapes::usable_density(seen.pdf(point_of(weights))),
                              sample);
  }

  float part_pdf(std::uint32_t, const Vector3f& from, const SurfacePoint& point) const override {
    const shapes::SeenTriangle seen = seen_from(from);
    return seen.is_seen() ? shapes::usable_density(seen.pdf(Vector3d(point.position))) : 0;
  }

 private:
  shapes::SeenTriangle seen_from(const Vector3f& from) const {
    return {corners_[0], corners_[1], corners_[2], corners_.normal(), Vector3d(from)};
  }

  /// `weights` of b and c.
  Vector3d point_of(const glm::dvec2& weights) const {
    return corners_[0] + weights.x * (corners_[1] - corners_[0]) + weights.y * (corners_[2] - corners_[0]);
  }

  SurfacePoint surface_of(const glm::dvec2& weights) const {
    shapes::SurfaceBound bound;
    bound.arithmetic = 8 * kDoubleRounding * (glm::length(corners_[0]) + glm::length(corners_.extent()));
    bound.extent = corners_.extent();
    return shapes::rounded_surface(point_of(weights), normal_, bound);
  }

  shapes::TriangleCorners corners_;
  Vector3d normal_;
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
  return std::make_unique<Triangle>(transform.point(a), transform.point(b), transform.point(c),
                                    transform.is_mirror());
}

}  // namespace raytracer
