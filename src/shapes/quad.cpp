#include <algorithm>

#include "raytracer/error.hpp"
#include "raytracer/shapes.hpp"
#include "shapes/checks.hpp"
#include "shapes/hits.hpp"
#include "shapes/surface.hpp"

namespace raytracer {

namespace {

/// Hit.u and Hit.v are the weights of the edges, and uv is the same:
///
///     point             u   v
///     origin            0   0
///     origin + width    1   0
///     origin + height   0   1
///     the middle        0.5 0.5
class Quad final : public Shape {
 public:
  Quad(const Vector3d& origin, const Vector3d& width, const Vector3d& height)
      : origin_(origin), width_(width), height_(height) {
    const Vector3d area = glm::cross(width, height);
    normal_ = glm::normalize(area);
    along_width_ = glm::cross(height, area) / glm::dot(area, area);
    along_height_ = glm::cross(area, width) / glm::dot(area, area);
    const Vector3d corners[] = {origin, origin + width, origin + height, origin + width + height};
    Vector3d lower = corners[0], upper = corners[0];
    for (const Vector3d& corner : corners) {
      lower = glm::min(lower, corner);
      upper = glm::max(upper, corner);
    }
    bounds_ = shapes::rounded_bounds(lower, upper);
    extent_ = upper - lower;
  }

  Box3f bounds() const override { return bounds_; }

  bool is_hit(const Ray3f& ray, Hit& hit) const override {
    const Vector3d direction(ray.direction);
    const Vector3d from = Vector3d(ray.origin) - origin_;
    const double t = -glm::dot(normal_, from) / glm::dot(normal_, direction);
    if (!shapes::is_on_ray(ray, t)) return false;
    const Vector3d point = from + t * direction;
    const double u = glm::dot(along_width_, point);
    const double v = glm::dot(along_height_, point);
    // So wide a rim that two quads with a common edge leave no gap between them.
    constexpr double kRim = 1e-12;
    if (!(u >= -kRim && u <= 1 + kRim && v >= -kRim && v <= 1 + kRim)) return false;
    shapes::set_hit(hit, t, 0, static_cast<float>(std::clamp(u, 0.0, 1.0)),
                    static_cast<float>(std::clamp(v, 0.0, 1.0)));
    return true;
  }

  SurfacePoint surface_at(const Ray3f&, const Hit& hit) const override {
    const Vector3d position =
        origin_ + static_cast<double>(hit.u) * width_ + static_cast<double>(hit.v) * height_;
    shapes::SurfaceBound bound;
    bound.arithmetic = 8 * kDoubleRounding * (glm::length(origin_) + glm::length(extent_));
    bound.extent = extent_;
    return shapes::rounded_surface(position, normal_, {hit.u, hit.v}, bound);
  }

 private:
  Vector3d origin_, width_, height_;
  Vector3d normal_;
  Vector3d along_width_, along_height_;  // the product with a point of the plane, from origin_, is its u or v
  Vector3d extent_{0.0};
  Box3f bounds_;
};

}  // namespace

std::unique_ptr<Shape> make_quad(const Vector3d& origin, const Vector3d& width, const Vector3d& height,
                                 const Transform& transform) {
  shapes::require_finite(origin, "origin");
  shapes::require_nonzero(width, "width");
  shapes::require_nonzero(height, "height");
  shapes::require_regular(transform);
  if (shapes::are_parallel(width, height)) {
    throw Error(ErrorKind::kScene, "'width' and 'height' are parallel: they span no surface");
  }
  return std::make_unique<Quad>(transform.point(origin), transform.vector(width), transform.vector(height));
}

}  // namespace raytracer
