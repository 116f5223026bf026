// Where the picture is taken from, and through what.
#pragma once

#include <cmath>
#include <cstdint>

#include "raytracer/vector3f.hpp"

namespace raytracer {

/// How the directions around the eye become a flat picture.
enum class Projection : std::uint8_t {
  kPerspective,   ///< straight lines stay straight
  kOrthographic,  ///< all rays are parallel
  kFisheye,       ///< equidistant: the angle to the view grows evenly with the way from the picture's middle
  kPanorama,      ///< equirectangular: all directions; columns are angles around `up`, rows angles to it
  kCubeMap,       ///< all directions, on the six sides of a cube
};

/// What a camera is besides a pinhole.
struct Optics {
  Projection projection = Projection::kPerspective;
  /// What the picture shows to each side of its middle. kPerspective: the tangents of the half angles;
  /// kOrthographic: scene units; kFisheye: half angles in radians; else without meaning.
  double half_width = 1, half_height = 1;
  double lens_radius = 0;     ///< scene units; 0: a pinhole, all is sharp
  double focus_distance = 1;  ///< what is sharp, along the view; of kFisheye and all around: from the eye
  int blades = 0;             ///< the corners of the lens's opening; below 3 it is round
  double blade_turn = 0;      ///< radians; 0: one corner points along `right`
  /// Moves what the picture shows to the right and up, in widths and heights of it; not of what is all
  /// around.
  double shift_x = 0, shift_y = 0;
  /// Turns the plane that is sharp about the picture's vertical and horizontal, where the view meets it;
  /// radians. Positive: what is to the right, or above, is sharp further away.
  double tilt_x = 0, tilt_y = 0;
  /// Above 0: the left half of the picture is what the left of two eyes this far apart sees, the right half
  /// what the right one sees. What is at the focus distance is at the same place in both.
  double eye_distance = 0;
  /// Of a cube map: 3, two rows of sides, or 6, one. In order right, left, up, down, front, back; each as
  /// seen from inside, up and down with their edge to the front at the bottom and at the top.
  int cube_columns = 3;
};

/// How a ray changes to the next sample to the right (dx) and below (dy).
struct RayDifferential {
  Vector3f origin_dx{0}, origin_dy{0};
  Vector3f direction_dx{0}, direction_dy{0};  ///< of the unit direction
};

/// At `position`, looking along the unit vector `forward`; `right` and `up` are unit length and across it.
class Camera {
 public:
  Camera() = default;

  /// A pinhole that looks from `position` to `look_at` with `up` upwards in the picture. `half_width` is the
  /// tangent of half the horizontal field of view, `half_height` of half the vertical one. Throws Error
  /// (kScene) where position and look_at coincide or `up` lies along the view.
  Camera(const Vector3d& position, const Vector3d& look_at, const Vector3d& up, double half_width,
         double half_height);
  /// Likewise any other camera.
  Camera(const Vector3d& position, const Vector3d& look_at, const Vector3d& up, const Optics& optics);

  /// The ray through the picture at x, y in 0..1, (0, 0) the upper left corner, and the middle of the lens;
  /// unit length direction.
  Ray3f ray_through(double x, double y) const;

  /// The ray through the picture at x, y and the lens at `lens` in [0, 1)^2, which evenly spread numbers
  /// spread evenly over its opening. Without a lens the very ray of ray_through(x, y).
  Ray3f ray_through(double x, double y, const Vector2f& lens) const;
  bool has_lens() const { return lens_radius_ > 0; }

  /// How that ray changes when x or y grows by that much.
  RayDifferential differential(double x, double y, const Vector2f& lens, double x_step, double y_step) const;

  Projection projection() const { return projection_; }
  Vector3f position() const { return position_; }
  Vector3f forward() const { return forward_; }
  Vector3f right() const { return right_; }  ///< times half_width
  Vector3f up() const { return up_; }        ///< times half_height
  /// Whether all rays start in one point and what they see is a pyramid around `forward`.
  bool is_pinhole() const { return is_plain_; }
  /// Whether what it sees is no pyramid or prism around `forward`.
  bool sees_all_around() const {
    const bool is_flat = projection_ == Projection::kPerspective || projection_ == Projection::kOrthographic;
    return !is_flat || shift_x_ != 0 || shift_y_ != 0;
  }
  /// How far a ray may start from `position`, but for orthographic cameras.
  float reach() const { return lens_radius_ + std::abs(half_eye_distance_); }

 private:
  // A ray through the middle of the lens, not normalised; `right`, `up`: the plane of the lens there.
  struct Chief {
    Vector3f origin, direction, right, up;
    float inverse_focus;  // 1 / the multiple of `direction` that is sharp
  };
  Ray3f ray_on_lens(double x, double y, const Vector2f& on_lens) const;
  Chief chief_ray(double x, double y) const;
  Chief round_ray(const Vector3f& direction) const;
  Vector3f fisheye_direction(float across, float upwards) const;
  Vector3f cube_direction(double x, double y) const;

  Vector3f position_{0};
  Vector3f forward_{0, 0, -1};
  Vector3f right_{1, 0, 0};
  Vector3f up_{0, 1, 0};
  Projection projection_ = Projection::kPerspective;
  bool is_plain_ = true;  // a pinhole and nothing else
  int blades_ = 0, cube_columns_ = 3;
  Vector3f unit_right_{1, 0, 0}, unit_up_{0, 1, 0};
  Vector3f focus_normal_{0, 0, -1};  // across the plane that is sharp; 1 / focus distance along `forward`
  float half_width_ = 1, half_height_ = 1;
  float lens_radius_ = 0, blade_turn_ = 0, half_eye_distance_ = 0, focus_distance_ = 1;
  float shift_x_ = 0, shift_y_ = 0;
};

}  // namespace raytracer
