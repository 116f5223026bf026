// A shape's own space: where it has its simplest form, about one unit across, around the origin.
#pragma once

#include "core/numeric.hpp"
#include "raytracer/shape.hpp"
#include "shapes/surface.hpp"

namespace raytracer::shapes {

/// A ray in a shape's own space; t means the same there as in the world, so its direction has any length.
struct LocalRay {
  Vector3d origin;
  Vector3d direction;

  Vector3d at(double t) const { return origin + t * direction; }
};

/// The affine map between a shape's own space and the world. In double precision, so that what remains of the
/// error is the rounding of the ray that comes in.
class Frame {
 public:
  /// `to_world` must be regular; the shape must lie around the local origin.
  explicit Frame(const Transform& to_world);

  LocalRay to_local(const Ray3f& ray) const {
    return {to_local_ * (Vector3d(ray.origin) - translation_), to_local_ * Vector3d(ray.direction)};
  }
  Vector3d to_local(const Vector3d& point) const { return to_local_ * (point - translation_); }
  Vector3d to_world(const Vector3d& point) const { return to_world_ * point + translation_; }
  Vector3d vector_to_world(const Vector3d& vector) const { return to_world_ * vector; }
  /// The unit normal in the world of a surface with this normal in the local space.
  Vector3d normal_to_world(const Vector3d& normal) const {
    return glm::normalize(glm::transpose(to_local_) * normal);
  }

  /// How far off a place in the world may be, in the local space, that was rounded to float a few times.
  double local_rounding(const Vector3d& point) const {
    constexpr double kTimes = 8;
    return kTimes * kFloatRounding * glm::length(absolute_to_local_ * glm::abs(point)) + kFloatRounding;
  }

  /// How much larger than in the local space a volume is in the world.
  double volume_scale() const { return volume_scale_; }
  /// How much larger a piece of surface is whose unit normal in the world is `normal`. By Nanson's formula it
  /// is |det M| |M^-T n| for the local normal n; that n is along M^T `normal`.
  double area_scale(const Vector3d& normal) const {
    return volume_scale_ / glm::length(glm::transpose(to_world_) * normal);
  }

  /// The point of the surface at the local `point` with the local unit normal `normal` (outwards stays
  /// outwards, also where the frame mirrors). `curvature` is the largest curvature of the surface there and
  /// `extent` the size of the shape in the world, see SurfaceBound. `amplification` is how much more than the
  /// rounding of a number about 1 the shape's own arithmetic is off, across the surface. Without branches,
  /// for blocks of points.
  ExactPoint exact_at(const Vector3d& point, const Vector3d& normal, double curvature, const Vector3d& extent,
                      double amplification = 1) const {
    // The gradient of a function of the local point, seen from the world: its length turns local heights
    // above the surface into heights in the world.
    const Vector3d gradient = glm::transpose(to_local_) * normal;
    const double steepness = std::sqrt(glm::dot(gradient, gradient));
    const Vector3d position = to_world(point);

    // Position and ray origin are rounded one after the other, each by half a unit in the last place per
    // coordinate.
    const Vector3d rounding = 2 * kFloatRounding * glm::abs(position);
    const Vector3d local_rounding = absolute_to_local_ * rounding;
    const double bend = 0.5 * curvature * glm::dot(local_rounding, local_rounding) / steepness,
                 most_bend = std::sqrt(glm::dot(rounding, rounding));
    SurfaceBound bound;
    bound.bend = most_bend < bend ? most_bend : bend;
    // Some thirty operations on numbers about 1, and the round trip through two matrices; the translation is
    // taken off before the matrix but rounds by its own magnitude.
    constexpr double kOperations = 32;
    const Vector3d shift = absolute_to_local_ * (glm::abs(position) + glm::abs(translation_));
    bound.arithmetic = kOperations * kDoubleRounding *
                       (amplification + glm::dot(glm::abs(normal), round_trip_ + 0.125 * shift)) / steepness;
    bound.extent = extent;
    return {position, gradient / steepness, bound};
  }
  SurfacePoint surface_at(const Vector3d& point, const Vector3d& normal, double curvature,
                          const Vector3d& extent, double amplification = 1) const {
    return rounded_surface(exact_at(point, normal, curvature, extent, amplification));
  }

 private:
  glm::dmat3 to_world_;
  glm::dmat3 to_local_;
  glm::dmat3 absolute_to_local_;
  Vector3d translation_;
  double volume_scale_;
  Vector3d round_trip_;  // per local axis, how much the map to the world and back magnifies rounding
};

/// What textures need of a point: uv, and how the local point moves with u and v.
inline SurfaceDetail detail_of(const Frame& frame, const Vector2f& uv, const Vector3d& along_u,
                               const Vector3d& along_v) {
  SurfaceDetail detail;
  detail.uv = uv;
  detail.along_u = Vector3f(frame.vector_to_world(along_u));
  detail.along_v = Vector3f(frame.vector_to_world(along_v));
  return detail;
}

/// Right-handed axes with `axis` (not zero) as the third, of unit length. The first lies across y, as seen
/// with y up it points to the right of one who looks against `axis`; for an axis along +y the first two are
/// +x and -z.
glm::dmat3 axes_around(const Vector3d& axis);

/// The angle of (x, y) as a share of the full turn, in [0, 1).
float turn_share(double x, double y);

}  // namespace raytracer::shapes
