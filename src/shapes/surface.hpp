// How a point that was found in double precision becomes a SurfacePoint in float, and how far a ray that
// starts there must step off the surface.
#pragma once

#include "core/numeric.hpp"
#include "raytracer/shape.hpp"
#include "shapes/hit_block.hpp"

namespace raytracer::shapes {

/// What is known of the surface around a point; lengths in world space.
struct SurfaceBound {
  /// Error of the arithmetic in double precision, across the surface.
  double arithmetic = 0;
  /// How far the surface leaves its tangent plane within the rounding of the position to float and of the
  /// origin of a ray that starts there.
  double bend = 0;
  /// The size of the shape along each axis, where a ray could stay close to the tangent plane so long that
  /// the rounding of the normal matters: anything that is flat in some direction.
  Vector3d extent{0.0};
};

/// SurfacePoint::position_error of a point whose position and unit normal are rounded to float. A ray that
/// starts at position + position_error * normal (computed in float), or as far on the other side, starts
/// beyond the surface: the bound adds up how far the rounded position is off along the normal, how far the
/// rounded origin of the ray may be, and `bound`. Without branches, for blocks of points.
inline float surface_error(const Vector3d& position, const Vector3d& normal, const Vector3d& rounded_position,
                           const Vector3d& rounded_normal, const SurfaceBound& bound) {
  constexpr double kSlack = 1.01;  // for the product and the terms of second order
  const Vector3d off = rounded_position - position;
  const double rounding = kFloatRounding * glm::dot(glm::abs(normal), glm::abs(position));
  const double tilt = glm::dot(glm::abs(rounded_normal - normal), bound.extent);
  const double error = std::abs(glm::dot(off, normal)) + rounding + tilt + bound.bend + bound.arithmetic;
  return float_above_positive(kSlack * error);
}

/// A point of a surface before it is rounded; the normal is of unit length.
struct ExactPoint {
  Vector3d position, normal;
  SurfaceBound bound;
};

/// Rounds it to float.
inline SurfacePoint rounded_surface(const ExactPoint& exact) {
  SurfacePoint point;
  point.position = Vector3f(exact.position);
  point.normal = Vector3f(exact.normal);
  point.shading_normal = point.normal;
  point.position_error = surface_error(exact.position, exact.normal, as_float(exact.position),
                                       as_float(exact.normal), exact.bound);
  return point;
}
inline SurfacePoint rounded_surface(const Vector3d& position, const Vector3d& normal,
                                    const SurfaceBound& bound) {
  return rounded_surface(ExactPoint{position, normal, bound});
}

/// Sets the lanes that are asked about.
inline void set_lanes(SurfaceBlock& __restrict surfaces, const BlockMask& asked, const SurfaceBlock& own) {
  for (int i = 0; i < kBlockSize; ++i) {
    const bool is_asked = asked.has(i);
    surfaces.position.choose(i, is_asked, own.position.at(i));
    surfaces.normal.choose(i, is_asked, own.normal.at(i));
    surfaces.shading_normal.choose(i, is_asked, own.shading_normal.at(i));
    surfaces.shadow_offset.choose(i, is_asked, own.shadow_offset.at(i));
    surfaces.position_error[i] = is_asked ? own.position_error[i] : surfaces.position_error[i];
  }
}

/// rounded_surface(exact(i)) for the lanes that are asked about. exact() is called for all lanes and must be
/// without branches. Two loops: the second reads from memory what the first has rounded.
template <class Exact>
inline void round_lanes(const BlockMask& asked, const Exact& exact, SurfaceBlock& surfaces) {
  struct alignas(64) Vectors {
    double x[kBlockSize], y[kBlockSize], z[kBlockSize];

    Vector3d at(int i) const { return {x[i], y[i], z[i]}; }
    void set(int i, const Vector3d& v) {
      x[i] = v.x;
      y[i] = v.y;
      z[i] = v.z;
    }
  };
  Vectors positions, normals, extents;
  alignas(64) double arithmetic[kBlockSize], bend[kBlockSize];
  SurfaceBlock own;
  for (int i = 0; i < kBlockSize; ++i) {
    const ExactPoint point = exact(i);
    positions.set(i, point.position);
    normals.set(i, point.normal);
    extents.set(i, point.bound.extent);
    arithmetic[i] = point.bound.arithmetic;
    bend[i] = point.bound.bend;
    own.position.set(i, Vector3f(point.position));
    own.normal.set(i, Vector3f(point.normal));
    own.shading_normal.set(i, Vector3f(point.normal));
    own.shadow_offset.set(i, Vector3f(0));
  }
  for (int i = 0; i < kBlockSize; ++i) {
    own.position_error[i] =
        surface_error(positions.at(i), normals.at(i), Vector3d(own.position.at(i)),
                      Vector3d(own.normal.at(i)), {arithmetic[i], bend[i], extents.at(i)});
  }
  set_lanes(surfaces, asked, own);
}

/// The same for all points of a flat part at once: the greatest of their bounds stands for all, so that a
/// point costs no more than its rounding.
class FlatSurface {
 public:
  FlatSurface() = default;
  /// `farthest` holds the greatest |x|, |y| and |z| of its points.
  FlatSurface(const Vector3d& farthest, const Vector3d& normal, const SurfaceBound& bound) {
    // Once for the position, once for the origin of a ray that starts there.
    SurfaceBound both = bound;
    both.arithmetic += kFloatRounding * glm::dot(glm::abs(normal), farthest);
    point_ = rounded_surface(as_float(farthest), normal, both);
  }

  /// Likewise for a block of points; position(i) is called for all lanes, asked about or not.
  template <class Position>
  void fill(const BlockMask& asked, const Position& position, SurfaceBlock& surfaces) const {
    SurfaceBlock own;
    const SurfacePoint anywhere = point_;
    for (int i = 0; i < kBlockSize; ++i) {
      own.set(i, anywhere);
      own.position.set(i, Vector3f(position(i)));
    }
    set_lanes(surfaces, asked, own);
  }

  SurfacePoint at(const Vector3d& position) const {
    SurfacePoint point = point_;
    point.position = Vector3f(position);
    return point;
  }
  const SurfacePoint& anywhere() const { return point_; }  ///< all but its position

 private:
  SurfacePoint point_;
};

}  // namespace raytracer::shapes
