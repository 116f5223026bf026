#include "raytracer/camera.hpp"

#include <algorithm>

#include "cameras/lens.hpp"
#include "cameras/pinhole.hpp"
#include "core/numeric.hpp"
#include "raytracer/error.hpp"

namespace raytracer {

Camera::Camera(const Vector3d& position, const Vector3d& look_at, const Vector3d& up, double half_width,
               double half_height)
    : Camera(position, look_at, up, [&] {
        Optics optics;
        optics.half_width = half_width;
        optics.half_height = half_height;
        return optics;
      }()) {}

Camera::Camera(const Vector3d& position, const Vector3d& look_at, const Vector3d& up, const Optics& optics)
    : position_(position), projection_(optics.projection), blades_(optics.blades) {
  const Vector3d view = look_at - position;
  if (!(glm::length(view) > 0))
    throw Error(ErrorKind::kScene, "the camera looks at the point where it stands");
  const Vector3d forward = glm::normalize(view);
  const Vector3d across = glm::cross(forward, glm::normalize(up));
  if (!(glm::length(across) > 1e-6)) throw Error(ErrorKind::kScene, "the camera looks along its 'up'");
  const Vector3d right = glm::normalize(across), upwards = glm::cross(right, forward);
  forward_ = Vector3f(forward);
  right_ = Vector3f(optics.half_width * right);
  up_ = Vector3f(optics.half_height * upwards);
  unit_right_ = Vector3f(right);
  unit_up_ = Vector3f(upwards);
  // The plane through the point on the view at the focus distance; a tilt about the picture's vertical mixes
  // `right` into its normal, one about the horizontal `up`.
  focus_normal_ = Vector3f((forward - std::tan(optics.tilt_x) * right - std::tan(optics.tilt_y) * upwards) /
                           optics.focus_distance);
  half_width_ = static_cast<float>(optics.half_width);
  half_height_ = static_cast<float>(optics.half_height);
  lens_radius_ = static_cast<float>(optics.lens_radius);
  blade_turn_ = static_cast<float>(optics.blade_turn);
  half_eye_distance_ = static_cast<float>(optics.eye_distance / 2);
  focus_distance_ = static_cast<float>(optics.focus_distance);
  shift_x_ = static_cast<float>(2 * optics.shift_x);
  shift_y_ = static_cast<float>(2 * optics.shift_y);
  cube_columns_ = optics.cube_columns == 6 ? 6 : 3;
  is_plain_ = projection_ == Projection::kPerspective && lens_radius_ == 0 && half_eye_distance_ == 0 &&
              shift_x_ == 0 && shift_y_ == 0;
}

Ray3f Camera::ray_through(double x, double y) const {
  return is_plain_ ? pinhole_ray(*this, x, y) : ray_on_lens(x, y, Vector2f(0));
}

Ray3f Camera::ray_through(double x, double y, const Vector2f& lens) const {
  if (lens_radius_ == 0) return ray_through(x, y);
  return ray_on_lens(x, y, lens_radius_ * point_on_lens(lens, blades_, blade_turn_));
}

// Two eyes are two points of one large lens: what is at the focus distance stays where it is.
Ray3f Camera::ray_on_lens(double x, double y, const Vector2f& on_lens) const {
  float eye = 0;
  if (half_eye_distance_ != 0) {
    const bool is_left = x < 0.5;
    eye = is_left ? -half_eye_distance_ : half_eye_distance_;
    x = is_left ? 2 * x : 2 * x - 1;
  }
  const Chief chief = chief_ray(x, y);
  const Vector3f offset = (eye + on_lens.x) * chief.right + on_lens.y * chief.up;
  Ray3f ray;
  ray.origin = chief.origin + offset;
  ray.direction = glm::normalize(chief.direction - chief.inverse_focus * offset);
  return ray;
}

Camera::Chief Camera::chief_ray(double x, double y) const {
  const auto across = static_cast<float>(2 * x - 1);
  const auto upwards = static_cast<float>(1 - 2 * y);
  switch (projection_) {
    case Projection::kPerspective: {
      const Vector3f direction = forward_ + (across + shift_x_) * right_ + (upwards + shift_y_) * up_;
      return {position_, direction, unit_right_, unit_up_, glm::dot(direction, focus_normal_)};
    }
    case Projection::kOrthographic: {
      const Vector3f place = (across + shift_x_) * right_ + (upwards + shift_y_) * up_;
      const float focus = focus_distance_ * (1 - glm::dot(place, focus_normal_));
      return {position_ + place, forward_, unit_right_, unit_up_, focus == 0 ? 0 : 1 / focus};
    }
    case Projection::kFisheye:
      return round_ray(fisheye_direction(across, upwards));
    case Projection::kPanorama: {
      const auto around = static_cast<float>(kPi) * across;
      const auto from_up = static_cast<float>(kPi * y);
      return round_ray(std::sin(from_up) * (std::sin(around) * unit_right_ + std::cos(around) * forward_) +
                       std::cos(from_up) * unit_up_);
    }
    case Projection::kCubeMap:
      return round_ray(glm::normalize(cube_direction(x, y)));
  }
  return {};
}

// Of cameras that see to all sides: the lens stands across every ray, an eye to the side of where it looks.
Camera::Chief Camera::round_ray(const Vector3f& direction) const {
  const Vector3f side =
      glm::dot(direction, forward_) * unit_right_ - glm::dot(direction, unit_right_) * forward_;
  const float length = glm::length(side);
  const Vector3f right = length > 1e-6F ? side / length : unit_right_;
  return {position_, direction, right, glm::cross(right, direction), 1 / focus_distance_};
}

Vector3f Camera::fisheye_direction(float across, float upwards) const {
  const Vector2f angles = {across * half_width_, upwards * half_height_};
  const float angle = glm::length(angles);
  if (angle == 0) return forward_;
  const Vector2f to = angles / angle;
  return std::cos(angle) * forward_ + std::sin(angle) * (to.x * unit_right_ + to.y * unit_up_);
}

Vector3f Camera::cube_direction(double x, double y) const {
  const int rows = 6 / cube_columns_;
  const int column = std::clamp(static_cast<int>(x * cube_columns_), 0, cube_columns_ - 1);
  const int row = std::clamp(static_cast<int>(y * rows), 0, rows - 1);
  const auto across = static_cast<float>(2 * (x * cube_columns_ - column) - 1);
  const auto upwards = static_cast<float>(1 - 2 * (y * rows - row));
  switch (row * cube_columns_ + column) {
    case 0:
      return unit_right_ - across * forward_ + upwards * unit_up_;
    case 1:
      return -unit_right_ + across * forward_ + upwards * unit_up_;
    case 2:
      return unit_up_ + across * unit_right_ - upwards * forward_;
    case 3:
      return -unit_up_ + across * unit_right_ + upwards * forward_;
    case 4:
      return forward_ + across * unit_right_ + upwards * unit_up_;
    default:
      return -forward_ - across * unit_right_ + upwards * unit_up_;
  }
}

RayDifferential Camera::differential(double x, double y, const Vector2f& lens, double x_step,
                                     double y_step) const {
  const Ray3f here = ray_through(x, y, lens);
  RayDifferential result;
  const auto difference = [&](double dx, double dy, Vector3f& origin, Vector3f& direction) {
    const Ray3f next = ray_through(x + dx, y + dy, lens);
    origin = next.origin - here.origin;
    direction = next.direction - here.direction;
    if (is_plain_) return;
    // Across the seam of a cube's sides or of two eyes the other neighbour is the true one.
    const Ray3f before = ray_through(x - dx, y - dy, lens);
    const Vector3f back = here.direction - before.direction;
    if (4 * glm::dot(back, back) < glm::dot(direction, direction)) {
      origin = here.origin - before.origin;
      direction = back;
    }
  };
  difference(x_step, 0, result.origin_dx, result.direction_dx);
  difference(0, y_step, result.origin_dy, result.direction_dy);
  return result;
}

}  // namespace raytracer
