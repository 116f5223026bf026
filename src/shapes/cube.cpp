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

/// Chooses between the two ends of the line's stretch in the box.
template <class T>
bool is_box_hit(const Ray3f& ray, const shapes::BoxSpan<T>& span, Hit& hit) {
  if (!(span.near <= span.far)) return false;
  const double near = static_cast<double>(span.near), far = static_cast<double>(span.far);
  if (shapes::is_on_ray(ray, near)) {
    shapes::set_hit(hit, near, span.near_face);
  } else if (shapes::is_on_ray(ray, far)) {
    shapes::set_hit(hit, far, span.far_face);
  } else {
    return false;
  }
  return true;
}

/// The same for a packet; span_of(i) is the stretch of its ray i. Two loops, since a choice between what is
/// dear to compute becomes a branch.
template <class SpanOf>
void find_box_hits(const RayPacket& rays, const SpanOf& span_of, HitPacket& hits) {
  constexpr int kSize = RayPacket::kSize;
  float near[kSize], far[kSize];
  std::uint32_t near_face[kSize], far_face[kSize];
  for (int i = 0; i < kSize; ++i) {
    const auto span = span_of(i);
    const bool crosses = span.near <= span.far;
    near[i] = crosses ? static_cast<float>(span.near) : kInfinity;
    far[i] = crosses ? static_cast<float>(span.far) : kInfinity;
    near_face[i] = span.near_face;
    far_face[i] = span.far_face;
  }
  for (int i = 0; i < kSize; ++i) {
    const bool is_near = (near[i] > rays.t_min[i]) & (near[i] < rays.t_max[i]);
    const bool is_far = (far[i] > rays.t_min[i]) & (far[i] < rays.t_max[i]);
    hits.t[i] = is_near ? near[i] : is_far ? far[i] : kInfinity;
    hits.primitive[i] = is_near ? near_face[i] : far_face[i];
    hits.u[i] = hits.v[i] = 0;
  }
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

// These two without branches, for blocks of points.
inline Vector3d face_normal(std::uint32_t face) {
  const auto along = [face](std::uint32_t lower) {
    return face == lower ? -1.0 : face == lower + 1 ? 1.0 : 0.0;
  };
  return {along(0), along(2), along(4)};
}

/// The point of the box that a place about there is, exactly on that face.
inline Vector3d put_on_face(const Vector3d& place, std::uint32_t face, const Vector3d& lower,
                            const Vector3d& upper) {
  const auto put = [face](double x, double low, double high, std::uint32_t lower_face) {
    const double above = x < low ? low : x, within = above > high ? high : above;
    return face == lower_face ? low : face == lower_face + 1 ? high : within;
  };
  return {put(place.x, lower.x, upper.x, 0), put(place.y, lower.y, upper.y, 2),
          put(place.z, lower.z, upper.z, 4)};
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
    return is_box_hit(ray, span_along(ray.origin, ray.direction), hit);
  }

  void find_hits(const RayPacket& rays, HitPacket& hits) const override {
    const AlignedCube cube = *this;  // that no store can change it
    find_box_hits(
        rays, [&](int i) { return cube.span_along(rays.origin(i), rays.direction(i)); }, hits);
  }

  SurfacePoint surface_at(const Ray3f& ray, const Hit& hit) const override {
    return shapes::rounded_surface(point_at(ray, hit), face_normal(hit.primitive), {});
  }

  void surfaces_at(const RayBlock& rays, const HitBlock& hits, const BlockMask& asked,
                   SurfaceBlock& surfaces) const override {
    const AlignedCube cube = *this;  // that no store can change it
    shapes::round_lanes(
        asked,
        [&](int i) {
          return shapes::ExactPoint{
              cube.point_at(rays.origin(i), rays.direction(i), hits.t[i], hits.primitive[i]),
              face_normal(hits.primitive[i]),
              {}};
        },
        surfaces);
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
  shapes::BoxSpan<float> span_along(const Vector3f& origin, const Vector3f& direction) const {
    return shapes::intersect_box<float>(origin, direction, lower_, upper_);
  }

  Vector3d point_at(const Vector3f& origin, const Vector3f& direction, float t, std::uint32_t face) const {
    const Vector3d place = Vector3d(origin) + static_cast<double>(t) * Vector3d(direction);
    return put_on_face(place, face, Vector3d(lower_), Vector3d(upper_));
  }
  Vector3d point_at(const Ray3f& ray, const Hit& hit) const {
    return point_at(ray.origin, ray.direction, hit.t, hit.primitive);
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

  bool is_hit(const Ray3f& ray, Hit& hit) const override { return is_box_hit(ray, span_along(ray), hit); }

  void find_hits(const RayPacket& rays, HitPacket& hits) const override {
    const FramedCube cube = *this;  // that no store can change it
    find_box_hits(
        rays, [&](int i) { return cube.span_along(rays.ray(i)); }, hits);
  }

  SurfacePoint surface_at(const Ray3f& ray, const Hit& hit) const override {
    return surface_of(local_point(ray, hit), hit.primitive);
  }

  void surfaces_at(const RayBlock& rays, const HitBlock& hits, const BlockMask& asked,
                   SurfaceBlock& surfaces) const override {
    const FramedCube cube = *this;  // that no store can change it
    shapes::round_lanes(
        asked,
        [&](int i) {
          const std::uint32_t face = hits.primitive[i];
          return cube.exact_of(cube.local_point(rays.ray(i), hits.t[i], face), face);
        },
        surfaces);
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
  shapes::BoxSpan<double> span_along(const Ray3f& ray) const {
    const LocalRay local = frame_.to_local(ray);
    return shapes::intersect_box<double>(local.origin, local.direction, Vector3d(-1.0), Vector3d(1.0));
  }

  static Vector3d local_of(std::uint32_t face, const glm::dvec2& signed_uv) {
    const FaceAxes axes = face_axes(face);
    return face_normal(face) + signed_uv.x * axes.u + signed_uv.y * axes.v;
  }

  Vector3d local_point(const Ray3f& ray, float t, std::uint32_t face) const {
    return put_on_face(frame_.to_local(ray).at(static_cast<double>(t)), face, Vector3d(-1.0), Vector3d(1.0));
  }
  Vector3d local_point(const Ray3f& ray, const Hit& hit) const {
    return local_point(ray, hit.t, hit.primitive);
  }

  shapes::ExactPoint exact_of(const Vector3d& point, std::uint32_t face) const {
    return frame_.exact_at(point, face_normal(face), 0, Vector3d(bounds_.diagonal()));
  }
  SurfacePoint surface_of(const Vector3d& point, std::uint32_t face) const {
    return shapes::rounded_surface(exact_of(point, face));
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
