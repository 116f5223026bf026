#include "shapes/mesh.hpp"

#include <algorithm>
#include <cmath>

#include "core/numeric.hpp"
#include "raytracer/error.hpp"
#include "shapes/checks.hpp"
#include "shapes/part_sampling.hpp"
#include "shapes/triangle_hit.hpp"
#include "shapes/triangle_sampling.hpp"

namespace raytracer {

namespace {

// How much of each corner a point is made of; in the triangle, also where traversal was a bit off.
struct Weights {
  double a, b, c;

  explicit Weights(const Hit& hit) {
    b = std::clamp(static_cast<double>(hit.u), 0.0, 1.0);
    c = std::clamp(static_cast<double>(hit.v), 0.0, 1 - b);
    a = 1 - b - c;
  }
  template <class T>
  T mix(const T& at_a, const T& at_b, const T& at_c) const {
    using Number = typename T::value_type;
    return static_cast<Number>(a) * at_a + static_cast<Number>(b) * at_b + static_cast<Number>(c) * at_c;
  }
};

// As shapes::rounded_surface() bounds it, but all of it from above, so that single precision will do: the
// rounding of the position and of the origin of a ray that starts there, and of the normal over the extent of
// the triangle. On top comes what the traversal's own arithmetic, in single precision and relative to the
// ray's origin, is off beside a triangle: the corners seen from there are rounded (1), and the normal, a
// product of two edges made of those, once more (4 of the squared length of the longest edge).
float error_bound(const Vector3f& position, const Vector3f& normal, const Vector3f& extent,
                  float twice_area) {
  constexpr float kSlack = 1.01f, kRounding = static_cast<float>(kFloatRounding);
  const float rounding = glm::dot(glm::abs(normal), 2.0f * glm::abs(position) + extent);
  const float squared = glm::dot(extent, extent);
  // Of a sliver the normal is worth little, but the rays that could meet it again are few.
  constexpr float kMostSliver = 64;
  const float traversal = std::sqrt(squared) * (1 + std::min(kMostSliver, 4 * squared / twice_area));
  return kSlack * kRounding * (rounding + traversal);
}

// J. Hanika, "Hacking the Shadow Terminator", Ray Tracing Gems II, 2021, chapter 4, listing 4-1: the point is
// lifted to where the planes at the corners, across their normals, lie above it, so that it looks over the
// facets of a curved surface as the surface itself would. `side` is -1 where the back is seen.
Vector3d lift(const Vector3d& position, const std::array<Vector3d, 3>& corners,
              const std::array<Vector3d, 3>& normals, const Weights& weights, double side) {
  Vector3d offset(0.0);
  const double share[3] = {weights.a, weights.b, weights.c};
  for (std::size_t i = 0; i < 3; ++i) {
    const Vector3d normal = side * normals[i];
    const double height = glm::dot(position - corners[i], normal);
    if (height < 0) offset -= share[i] * height * normal;
  }
  return offset;
}

}  // namespace

TriangleMesh::TriangleMesh(std::shared_ptr<const MeshData> data, std::uint32_t begin, std::uint32_t end)
    : data_(std::move(data)), begin_(begin), count_(end - begin) {
  const std::size_t vertices = data_->positions.size();
  Vector3f lower(kInfinity), upper(-kInfinity);
  for (std::uint32_t i = begin; i < end; ++i) {
    for (const std::uint32_t vertex : data_->triangles[i]) {
      if (vertex >= vertices) throw Error(ErrorKind::kScene, "a triangle has a corner that is no vertex");
      lower = glm::min(lower, data_->positions[vertex]);
      upper = glm::max(upper, data_->positions[vertex]);
    }
  }
  if (count_ > 0) bounds_ = shapes::rounded_bounds(Vector3d(lower), Vector3d(upper));
}

bool TriangleMesh::is_hit(const Ray3f& ray, Hit& hit) const {
  Ray3f rest = ray;
  bool found = false;
  for (std::uint32_t i = 0; i < count_; ++i) {
    const Triangle& t = triangle(i);
    if (!shapes::TriangleCorners(corner(t[0]), corner(t[1]), corner(t[2])).is_hit(rest, i, hit)) continue;
    rest.t_max = hit.t;
    found = true;
  }
  return found;
}

SurfacePoint TriangleMesh::surface_at(const Ray3f& ray, const Hit& hit) const {
  const Triangle& t = triangle(hit.primitive);
  const Weights weights(hit);
  const std::array<Vector3d, 3> p = {corner(t[0]), corner(t[1]), corner(t[2])};
  const Vector3d ab = p[1] - p[0], ac = p[2] - p[0];
  const Vector3d position = p[0] + weights.b * ab + weights.c * ac;
  const Vector3d across = glm::cross(ab, ac);
  const double twice_area = std::sqrt(glm::dot(across, across));
  const Vector3d normal = (1 / twice_area) * across;

  SurfacePoint point;
  point.position = Vector3f(position);
  point.normal = Vector3f(normal);
  point.shading_normal = point.normal;
  const Vector3f &a = data_->positions[t[0]], &b = data_->positions[t[1]], &c = data_->positions[t[2]];
  const Vector3f extent = glm::max(a, glm::max(b, c)) - glm::min(a, glm::min(b, c));
  point.position_error = error_bound(point.position, point.normal, extent, static_cast<float>(twice_area));
  if (data_->normals.empty()) return point;

  const std::array<Vector3d, 3> n = {Vector3d(data_->normals[t[0]]), Vector3d(data_->normals[t[1]]),
                                     Vector3d(data_->normals[t[2]])};
  const Vector3d smooth = weights.mix(n[0], n[1], n[2]);
  const double length = glm::length(smooth);
  if (!(length > 1e-6)) return point;
  const double turn =
      glm::dot(smooth, normal) < 0 ? -1 : 1;  // of normals that a file has the wrong way round
  point.shading_normal = Vector3f(turn / length * smooth);
  const double side = glm::dot(normal, Vector3d(ray.direction)) > 0 ? -1 : 1;
  point.shadow_offset = Vector3f(lift(position, p, n, weights, side * turn));
  return point;
}

SurfaceDetail TriangleMesh::detail_at(const Ray3f&, const Hit& hit) const {
  const Triangle& t = triangle(hit.primitive);
  const Weights weights(hit);
  SurfaceDetail detail;
  detail.uv = {hit.u, hit.v};
  if (!data_->colors.empty())
    detail.color = weights.mix(data_->colors[t[0]], data_->colors[t[1]], data_->colors[t[2]]);
  if (data_->uvs.empty()) return detail;
  const Vector2f uv_a = data_->uvs[t[0]], uv_b = data_->uvs[t[1]], uv_c = data_->uvs[t[2]];
  detail.uv = weights.mix(uv_a, uv_b, uv_c);
  const glm::dvec2 b = glm::dvec2(uv_b) - glm::dvec2(uv_a), c = glm::dvec2(uv_c) - glm::dvec2(uv_a);
  const double determinant = b.x * c.y - c.x * b.y;
  if (determinant == 0) return detail;
  const Vector3d ab = corner(t[1]) - corner(t[0]), ac = corner(t[2]) - corner(t[0]);
  detail.along_u = Vector3f((c.y * ab - b.y * ac) / determinant);
  detail.along_v = Vector3f((b.x * ac - c.x * ab) / determinant);
  return detail;
}

PartExtent TriangleMesh::part_extent(std::uint32_t part) const {
  const Triangle& t = triangle(part);
  PartExtent extent;
  for (const std::uint32_t vertex : t) extent.bounds.extend(data_->positions[vertex]);
  const Vector3d across = glm::cross(corner(t[1]) - corner(t[0]), corner(t[2]) - corner(t[0]));
  const double twice_area = glm::length(across);
  extent.area = static_cast<float>(0.5 * twice_area);
  if (!(twice_area > 0)) return extent;
  extent.axis = Vector3f(across / twice_area);
  extent.cos_spread = 1;
  return extent;
}

bool TriangleMesh::sample_part(std::uint32_t part, const Vector3f& from, const Vector2f& u,
                               ShapeSample& sample) const {
  const Triangle& t = triangle(part);
  const Vector3d a = corner(t[0]), ab = corner(t[1]) - a, ac = corner(t[2]) - a;
  const Vector3d normal = glm::normalize(glm::cross(ab, ac));
  const shapes::SeenTriangle seen(a, a + ab, a + ac, normal, Vector3d(from));
  if (!seen.is_seen()) return false;
  const glm::dvec2 weights = seen.sample(u);
  Hit hit;
  hit.primitive = part;
  hit.u = static_cast<float>(weights.x);
  hit.v = static_cast<float>(weights.y);
  const SurfacePoint point = surface_at({from, Vector3f(a) - from}, hit);
  sample.u = hit.u;
  sample.v = hit.v;
  return shapes::set_sample(point, shapes::usable_density(seen.pdf(a + weights.x * ab + weights.y * ac)),
                            sample);
}

float TriangleMesh::part_pdf(std::uint32_t part, const Vector3f& from, const SurfacePoint& point) const {
  const Triangle& t = triangle(part);
  const Vector3d a = corner(t[0]), b = corner(t[1]), c = corner(t[2]);
  const shapes::SeenTriangle seen(a, b, c, glm::normalize(glm::cross(b - a, c - a)), Vector3d(from));
  return seen.is_seen() ? shapes::usable_density(seen.pdf(Vector3d(point.position))) : 0;
}

}  // namespace raytracer
