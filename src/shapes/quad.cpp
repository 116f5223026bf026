#include <algorithm>

#include "raytracer/error.hpp"
#include "raytracer/shapes.hpp"
#include "shapes/checks.hpp"
#include "shapes/hits.hpp"
#include "shapes/parallelogram.hpp"
#include "shapes/part_sampling.hpp"
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
  Quad(const Vector3d& origin, const Vector3d& width, const Vector3d& height, bool is_mirrored)
      : origin_(origin), width_(width), height_(height) {
    const Vector3d area = glm::cross(width, height);
    normal_ = glm::normalize(is_mirrored ? -area : area);
    face_ = {origin, width, height, normal_};
    along_width_ = glm::cross(height, area) / glm::dot(area, area);
    along_height_ = glm::cross(area, width) / glm::dot(area, area);
    const Vector3d corners[] = {origin, origin + width, origin + height, origin + width + height};
    Vector3d lower = corners[0], upper = corners[0];
    for (const Vector3d& corner : corners) {
      lower = glm::min(lower, corner);
      upper = glm::max(upper, corner);
    }
    bounds_ = shapes::rounded_bounds(lower, upper);
    shapes::SurfaceBound bound;
    bound.extent = upper - lower;
    bound.arithmetic = 8 * kDoubleRounding * (glm::length(origin_) + glm::length(bound.extent));
    flat_ = shapes::FlatSurface(glm::max(glm::abs(lower), glm::abs(upper)), normal_, bound);
  }

  Box3f bounds() const override { return bounds_; }

  bool is_hit(const Ray3f& ray, Hit& hit) const override {
    const PlaneHit plane = meet_plane(ray.origin, ray.direction);
    if (!shapes::is_on_ray(ray, plane.t) || !is_within(plane)) return false;
    shapes::set_hit(hit, plane.t, 0, clamped(plane.u), clamped(plane.v));
    return true;
  }

  void find_hits(const RayPacket& rays, HitPacket& hits) const override {
    for (int i = 0; i < RayPacket::kSize; ++i) {
      const PlaneHit plane = meet_plane(rays.origin(i), rays.direction(i));
      const float t = shapes::first_on_ray(rays, i, plane.t, plane.t);
      hits.t[i] = is_within(plane) ? t : kInfinity;
      hits.primitive[i] = 0;
      hits.u[i] = clamped(plane.u);
      hits.v[i] = clamped(plane.v);
    }
  }

  SurfacePoint surface_at(const Ray3f&, const Hit& hit) const override {
    return surface_of({static_cast<double>(hit.u), static_cast<double>(hit.v)});
  }

  void surfaces_at(const RayBlock&, const HitBlock& hits, const BlockMask& asked,
                   SurfaceBlock& surfaces) const override {
    const shapes::Parallelogram face = face_;
    flat_.fill(
        asked,
        [&](int i) {
          return face.at({static_cast<double>(hits.u[i]), static_cast<double>(hits.v[i])});
        },
        surfaces);
  }

  SurfaceDetail detail_at(const Ray3f&, const Hit& hit) const override {
    SurfaceDetail detail;
    detail.uv = {hit.u, hit.v};
    detail.along_u = Vector3f(width_);
    detail.along_v = Vector3f(height_);
    return detail;
  }

  const shapes::Parallelogram* as_parallelogram() const override { return &face_; }

  std::uint32_t part_count() const override { return 1; }

  PartExtent part_extent(std::uint32_t) const override {
    return shapes::flat_extent(bounds_, face_.area(), normal_);
  }

  bool sample_part(std::uint32_t, const Vector3f& from, const Vector2f& u,
                   ShapeSample& sample) const override {
    glm::dvec2 weights;
    const float pdf = face_.choose(Vector3d(from), u, weights);
    if (!(pdf > 0)) return false;
    sample.position = Vector3f(face_.at(weights));
    sample.position_error = flat_.anywhere().position_error;
    sample.normal = flat_.anywhere().normal;
    sample.pdf = pdf;
    sample.u = static_cast<float>(weights.x);
    sample.v = static_cast<float>(weights.y);
    return true;
  }

  float part_pdf(std::uint32_t, const Vector3f& from, const SurfacePoint& point) const override {
    return face_.pdf(Vector3d(from), Vector3d(point.position));
  }

 private:
  SurfacePoint surface_of(const glm::dvec2& weights) const { return flat_.at(face_.at(weights)); }

  struct PlaneHit {
    double t, u, v;
  };
  PlaneHit meet_plane(const Vector3f& origin, const Vector3f& direction) const {
    const Vector3d from = Vector3d(origin) - origin_;
    const double t = -glm::dot(normal_, from) / glm::dot(normal_, Vector3d(direction));
    const Vector3d point = from + t * Vector3d(direction);
    return {t, glm::dot(along_width_, point), glm::dot(along_height_, point)};
  }

  static bool is_within(const PlaneHit& hit) {
    // So wide a rim that two quads with a common edge leave no gap between them.
    constexpr double kRim = 1e-12;
    return (hit.u >= -kRim) & (hit.u <= 1 + kRim) & (hit.v >= -kRim) & (hit.v <= 1 + kRim);
  }

  static float clamped(double share) { return static_cast<float>(share < 0 ? 0 : share > 1 ? 1 : share); }

  Vector3d origin_, width_, height_;
  Vector3d normal_;
  Vector3d along_width_, along_height_;  // the product with a point of the plane, from origin_, is its u or v
  shapes::Parallelogram face_;
  shapes::FlatSurface flat_;
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
  return std::make_unique<Quad>(transform.point(origin), transform.vector(width), transform.vector(height),
                                transform.is_mirror());
}

}  // namespace raytracer
