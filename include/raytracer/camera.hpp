// Where the picture is taken from.
#pragma once

#include "raytracer/vector3f.hpp"

namespace raytracer {

/// A pinhole camera. At `position`, looking along the unit vector `forward`; `right` and `up` are unit length
/// and across it.
class Camera {
 public:
  Camera() = default;

  /// Looks from `position` to `look_at` with `up` upwards in the picture. `half_width` is the tangent of half
  /// the horizontal field of view, `half_height` of half the vertical one. Throws Error (kScene) where
  /// position and look_at coincide or `up` lies along the view.
  Camera(const Vector3d& position, const Vector3d& look_at, const Vector3d& up, double half_width,
         double half_height);

  /// The ray through the picture at x, y in 0..1, (0, 0) the upper left corner; unit length direction.
  Ray3f ray_through(double x, double y) const;

  Vector3f position() const { return position_; }
  Vector3f forward() const { return forward_; }
  Vector3f right() const { return right_; }  ///< times half_width
  Vector3f up() const { return up_; }        ///< times half_height

 private:
  Vector3f position_{0};
  Vector3f forward_{0, 0, -1};
  Vector3f right_{1, 0, 0};
  Vector3f up_{0, 1, 0};
};

}  // namespace raytracer
