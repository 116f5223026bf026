#include <algorithm>
#include <array>
#include <limits>

#include "raytracer/shapes.hpp"
#include "shapes/box.hpp"
#include "shapes/checks.hpp"
#include "shapes/frame.hpp"
#include "shapes/hits.hpp"
#include "shapes/parallelogram.hpp"
#include "shapes/part_sampling.hpp"

namespace raytracer {

namespace {

using shapes::Frame;
using shapes::LocalRay;

/// The face of the pair across `axis` through which a line with this direction comes (or goes).
template <class Vector>
std::uint32_t face_of(int axis, const Vector& direction, bool leaving) {
  return static_cast<std::uint32_t>(2 * axis) + static_cast<std::uint32_t>((direction[axis] > 0) == leaving);
}

/// Chooses between the two ends of the line's stretch in the box.
template <class T, class Vector>
bool is_box_hit(const Ray3f& ray, const Vector& origin, const Vector& direction, const Vector& lower,
                const Vector& upper, Hit& hit) {
  T near, far;
  int near_axis, far_axis;
  if (!shapes::intersect_box(origin, direction, lower, upper, near, far, near_axis, far_axis)) return false;
  if (shapes::is_on_ray(ray, static_cast<double>(near))) {
    shapes::set_hit(hit, static_cast<double>(near), face_of(near_axis, direction, false));
  } else if (shapes::is_on_ray(ray, static_cast<double>(far))) {
    shapes::set_hit(hit, static_cast<double>(far), face_of(far_axis, direction, true));
  } else {
    return false;
  }
  return true;
}

/// uv of a point of the cube from -1 to 1: u to the right and v upwards for one who looks at the face from
/// outside, y (for the faces across y: -z on +y, z on -y) up.
///
///     face   u = 0 -> 1   v = 0 -> 1
///      -x     -z -> z      -y -> y
///      +x      z -> -z     -y -> y
///      -y     -x -> x      -z -> z
///      +y     -x -> x       z -> -z
///      -z      x -> -x     -y -> y
///      +z     -x -> x      -y -> y
struct FaceAxes {
  Vector3d u, v;  ///< unit vectors, the way that u and v grow
};
FaceAxes face_axes(std::uint32_t face) {
  static const std::array<FaceAxes, 6> axes = {{{{0, 0, 1}, {0, 1, 0}},
                                                {{0, 0, -1}, {0, 1, 0}},
                                                {{1, 0, 0}, {0, 0, 1}},
                                                {{1, 0, 0}, {0, 0, -1}},
                                                {{-1, 0, 0}, {0, 1, 0}},
                                                {{1, 0, 0}, {0, 1, 0}}}};
  return axes[face];
}

Vector2f cube_uv(std::uint32_t face, const Vector3d& p) {
  const FaceAxes axes = face_axes(face);
  return 0.5f * Vector2f(glm::dot(axes.u, p), glm::dot(axes.v, p)) + 0.5f;
}

Vector3d face_normal(std::uint32_t face) {
  Vector3d normal(0.0);
  normal[static_cast<int>(face / 2)] = face % 2 == 0 ? -1 : 1;
  return normal;
}

/// A cube with its edges along the axes of the world. Its faces lie at floats, so that a ray on a face is
/// there exactly, and cubes with a common face leave no gap.
class AlignedCube final : public Shape {
 public:
  AlignedCube(const Vector3d& center, const Vector3d& half_size)
      : lower_(center - half_size),
        upper_(center + half_size),
        bounds_(shapes::rounded_bounds(center - half_size, center + half_size)) {}

  Box3f bounds() const override { return bounds_; }

  bool is_hit(const Ray3f& ray, Hit& hit) const override {
    return is_box_hit<float>(ray, ray.origin, ray.direction, lower_, upper_, hit);
  }

  SurfacePoint surface_at(const Ray3f& ray, const Hit& hit) const override {
    return shapes::rounded_surface(point_at(ray, hit), face_normal(hit.primitive), {});
  }

  SurfaceDetail detail_at(const Ray3f& ray, const Hit& hit) const override {
    const Vector3d lower(lower_), upper(upper_), size = upper - lower;
    const Vector3d half_size = glm::max(0.5 * size, Vector3d(std::numeric_limits<double>::min()));
    const Vector3d local = (point_at(ray, hit) - 0.5 * (lower + upper)) / half_size;
    const FaceAxes axes = face_axes(hit.primitive);
    SurfaceDetail detail;
    detail.uv = cube_uv(hit.primitive, local);
    detail.along_u = Vector3f(axes.u * size);
    detail.along_v = Vector3f(axes.v * size);
    return detail;
  }

  std::uint32_t part_count() const override { return 6; }

  PartExtent part_extent(std::uint32_t part) const override {
    const shapes::Parallelogram face = parallelogram(part);
    return shapes::flat_extent(face.bounds(), face.area(), face.normal);
  }

  bool sample_part(std::uint32_t part, const Vector3f& from, const Vector2f& u,
                   ShapeSample& sample) const override {
    const shapes::Parallelogram face = parallelogram(part);
    glm::dvec2 weights;
    const float pdf = face.choose(Vector3d(from), u, weights);
    if (!(pdf > 0)) return false;
    const SurfacePoint point = shapes::rounded_surface(face.at(weights), face.normal, {});
    return shapes::set_sample(point, pdf, sample);
  }

  float part_pdf(std::uint32_t part, const Vector3f& from, const SurfacePoint& point) const override {
    return parallelogram(part).pdf(Vector3d(from), Vector3d(point.position));
  }

 private:
  Vector3d point_at(const Ray3f& ray, const Hit& hit) const {
    const Vector3d lower(lower_), upper(upper_);
    Vector3d point = Vector3d(ray.origin) + static_cast<double>(hit.t) * Vector3d(ray.direction);
    point = glm::clamp(point, lower, upper);
    const int axis = static_cast<int>(hit.primitive / 2);
    point[axis] = hit.primitive % 2 == 0 ? lower[axis] : upper[axis];
    return point;
  }

  shapes::Parallelogram parallelogram(std::uint32_t face) const {
    const Vector3d lower(lower_), upper(upper_), half_size = 0.5 * (upper - lower);
    const Vector3d normal = face_normal(face);
    const FaceAxes axes = face_axes(face);
    const Vector3d corner = 0.5 * (lower + upper) + half_size * (normal - axes.u - axes.v);
    return {corner, 2.0 * half_size * axes.u, 2.0 * half_size * axes.v, normal};
  }

  Vector3f lower_, upper_;
  Box3f bounds_;
};

/// The cube from -1 to 1 in a frame.
class FramedCube final : public Shape {
 public:
  explicit FramedCube(const Transform& to_world) : frame_(to_world) {
    const glm::dmat3& m = to_world.linear;
    const Vector3d reach = glm::abs(m[0]) + glm::abs(m[1]) + glm::abs(m[2]);
    bounds_ = shapes::rounded_bounds(to_world.translation - reach, to_world.translation + reach);
  }

  Box3f bounds() const override { return bounds_; }

  bool is_hit(const Ray3f& ray, Hit& hit) const override {
    const LocalRay local = frame_.to_local(ray);
    return is_box_hit<double>(ray, local.origin, local.direction, Vector3d(-1.0), Vector3d(1.0), hit);
  }

  SurfacePoint surface_at(const Ray3f& ray, const Hit& hit) const override {
    return surface_of(local_point(ray, hit), hit.primitive);
  }

  SurfaceDetail detail_at(const Ray3f& ray, const Hit& hit) const override {
    const FaceAxes axes = face_axes(hit.primitive);
    return shapes::detail_of(frame_, cube_uv(hit.primitive, local_point(ray, hit)), 2.0 * axes.u,
                             2.0 * axes.v);
  }

  std::uint32_t part_count() const override { return 6; }

  PartExtent part_extent(std::uint32_t part) const override {
    const shapes::Parallelogram face = parallelogram(part);
    return shapes::flat_extent(face.bounds(), face.area(), face.normal);
  }

  bool sample_part(std::uint32_t part, const Vector3f& from, const Vector2f& u,
                   ShapeSample& sample) const override {
    const shapes::Parallelogram face = parallelogram(part);
    glm::dvec2 weights;
    const float pdf = face.choose(Vector3d(from), u, weights);
    if (!(pdf > 0)) return false;
    const SurfacePoint point = surface_of(local_of(part, 2.0 * weights - 1.0), part);
    return shapes::set_sample(point, pdf, sample);
  }

  float part_pdf(std::uint32_t part, const Vector3f& from, const SurfacePoint& point) const override {
    return parallelogram(part).pdf(Vector3d(from), Vector3d(point.position));
  }

 private:
  static Vector3d local_of(std::uint32_t face, const glm::dvec2& signed_uv) {
    const FaceAxes axes = face_axes(face);
    return face_normal(face) + signed_uv.x * axes.u + signed_uv.y * axes.v;
  }

  static Vector3d clamped_to_face(Vector3d point, std::uint32_t face) {
    point = glm::clamp(point, Vector3d(-1.0), Vector3d(1.0));
    const int axis = static_cast<int>(face / 2);
    point[axis] = face % 2 == 0 ? -1 : 1;
    return point;
  }

  Vector3d local_point(const Ray3f& ray, const Hit& hit) const {
    return clamped_to_face(frame_.to_local(ray).at(static_cast<double>(hit.t)), hit.primitive);
  }

  SurfacePoint surface_of(const Vector3d& point, std::uint32_t face) const {
    return frame_.surface_at(point, face_normal(face), 0, Vector3d(bounds_.diagonal()));
  }

  shapes::Parallelogram parallelogram(std::uint32_t face) const {
    const FaceAxes axes = face_axes(face);
    return {frame_.to_world(local_of(face, {-1, -1})), frame_.vector_to_world(2.0 * axes.u),
            frame_.vector_to_world(2.0 * axes.v), frame_.normal_to_world(face_normal(face))};
  }

  Frame frame_;
  Box3f bounds_;
};

bool is_positive_diagonal(const glm::dmat3& m) {
  glm::dmat3 diagonal(0.0);
  for (int i = 0; i < 3; ++i) diagonal[i][i] = m[i][i];
  return m == diagonal && m[0][0] > 0 && m[1][1] > 0 && m[2][2] > 0;
}

}  // namespace

std::unique_ptr<Shape> make_cube(const Vector3d& center, const Vector3d& size, const Transform& transform) {
  shapes::require_finite(center, "center");
  shapes::require_finite(size, "size");
  for (int i = 0; i < 3; ++i) shapes::require_positive(size[i], "size");
  shapes::require_regular(transform);
  const glm::dmat3& m = transform.linear;
  const Vector3d half = 0.5 * size;
  const Vector3d world_center = transform.point(center);
  if (is_positive_diagonal(m)) {
    return std::make_unique<AlignedCube>(world_center, half * Vector3d(m[0][0], m[1][1], m[2][2]));
  }
  const glm::dmat3 edges(m[0] * half.x, m[1] * half.y, m[2] * half.z);
  return std::make_unique<FramedCube>(Transform{edges, world_center});
}

}  // namespace raytracer
