#include "raytracer/camera.hpp"

#include "raytracer/error.hpp"

namespace raytracer {

Camera::Camera(const Vector3d& position, const Vector3d& look_at, const Vector3d& up, double half_width,
               double half_height)
    : position_(position) {
  const Vector3d view = look_at - position;
  if (!(glm::length(view) > 0))
    throw Error(ErrorKind::kScene, "the camera looks at the point where it stands");
  const Vector3d forward = glm::normalize(view);
  const Vector3d across = glm::cross(forward, glm::normalize(up));
  if (!(glm::length(across) > 1e-6)) throw Error(ErrorKind::kScene, "the camera looks along its 'up'");
  const Vector3d right = glm::normalize(across);
  forward_ = Vector3f(forward);
  right_ = Vector3f(half_width * right);
  up_ = Vector3f(half_height * glm::cross(right, forward));
}

Ray3f Camera::ray_through(double x, double y) const {
  const auto across = static_cast<float>(2 * x - 1);
  const auto upwards = static_cast<float>(1 - 2 * y);
  Ray3f ray;
  ray.origin = position_;
  ray.direction = glm::normalize(forward_ + across * right_ + upwards * up_);
  return ray;
}

}  // namespace raytracer
