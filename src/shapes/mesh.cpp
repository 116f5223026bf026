#include "shapes/mesh.hpp"

#include <algorithm>
#include <cmath>

#include "core/numeric.hpp"
#include "raytracer/error.hpp"
#include "shapes/checks.hpp"
#include "shapes/hit_block.hpp"
#include "shapes/part_sampling.hpp"
#include "shapes/surface.hpp"
#include "shapes/triangle_hit.hpp"
#include "shapes/triangle_sampling.hpp"

namespace raytracer {

namespace {

// All of this is without branches, and inline, so that it is done to blocks of points in vector instructions.

// How much of each corner a point is made of; in the triangle, also where traversal was a bit off.
struct Weights {
  double a, b, c;

  Weights(float u, float v) {
    b = within(static_cast<double>(u), 1);
    c = within(static_cast<double>(v), 1 - b);
    a = 1 - b - c;
  }
  explicit Weights(const Hit& hit) : Weights(hit.u, hit.v) {}

  template <class T>
  T mix(const T& at_a, const T& at_b, const T& at_c) const {
    using Number = typename T::value_type;
    return static_cast<Number>(a) * at_a + static_cast<Number>(b) * at_b + static_cast<Number>(c) * at_c;
  }

 private:
  static double within(double x, double most) {
    const double positive = x > 0 ? x : 0.0;
    return positive < most ? positive : most;
  }
};

// What the corners of a triangle have.
struct Corners {
  Vector3f a, b, c;
};

// As shapes::rounded_surface() bounds it, but all of it from above, so that single precision will do: the
// rounding of the position and of the origin of a ray that starts there, and of the normal over the extent of
// the triangle. On top comes what the traversal's own arithmetic, in single precision and relative to the
// ray's origin, is off beside a triangle: the corners seen from there are rounded (1), and the normal, a
// product of two edges made of those, once more (4 of the squared length of the longest edge).
inline float error_bound(const Vector3f& position, const Vector3f& normal, const Vector3f& extent,
                         float twice_area) {
  constexpr float kSlack = 1.01f, kRounding = static_cast<float>(kFloatRounding);
  const float rounding = glm::dot(glm::abs(normal), 2.0f * glm::abs(position) + extent);
  const float squared = glm::dot(extent, extent);
  // Of a sliver the normal is worth little, but the rays that could meet it again are few.
  constexpr float kMostSliver = 64;
  const float sliver = 4 * squared / twice_area;
  const float traversal = std::sqrt(squared) * (1 + (sliver < kMostSliver ? sliver : kMostSliver));
  return kSlack * kRounding * (rounding + traversal);
}

inline Vector3f extent_of(const Corners& p) {
  const auto extent = [](float a, float b, float c) {
    const float lower = a < b ? a : b, upper = a < b ? b : a;
    return (c < upper ? upper : c) - (lower < c ? lower : c);
  };
  return {extent(p.a.x, p.b.x, p.c.x), extent(p.a.y, p.b.y, p.c.y), extent(p.a.z, p.b.z, p.c.z)};
}

// A point of the triangle before it is rounded.
struct FlatPoint {
  Vector3d position, normal;
  double twice_area;
};

inline FlatPoint flat_point(const Corners& p, const Weights& weights) {
  const Vector3d a(p.a), ab = Vector3d(p.b) - a, ac = Vector3d(p.c) - a;
  const Vector3d across = glm::cross(ab, ac);
  const double twice_area = std::sqrt(glm::dot(across, across));
  return {a + weights.b * ab + weights.c * ac, (1 / twice_area) * across, twice_area};
}

inline SurfacePoint flat_surface(const Corners& p, const FlatPoint& flat) {
  SurfacePoint point;
  point.position = Vector3f(flat.position);
  point.normal = Vector3f(flat.normal);
  point.shading_normal = point.normal;
  point.position_error =
      error_bound(point.position, point.normal, extent_of(p), static_cast<float>(flat.twice_area));
  return point;
}

// J. Hanika, "Hacking the Shadow Terminator", Ray Tracing Gems II, 2021, chapter 4, listing 4-1: the point is
// lifted to where the planes at the corners, across their normals, lie above it, so that it looks over the
// facets of a curved surface as the surface itself would. `side` is -1 where the back is seen.
inline Vector3d lift(const Vector3d& position, const Corners& corners, const Corners& normals,
                     const Weights& weights, double side) {
  const auto share = [&](const Vector3f& corner, const Vector3f& corner_normal, double weight) {
    const Vector3d normal = side * Vector3d(corner_normal);
    const double height = glm::dot(position - Vector3d(corner), normal);
    return weight * (height < 0 ? -height : 0.0) * normal;
  };
  return share(corners.a, normals.a, weights.a) + share(corners.b, normals.b, weights.b) +
         share(corners.c, normals.c, weights.c);
}

// What the normals at the corners make of it, seen along `direction`.
struct Smoothed {
  Vector3f normal, offset;
  float length;  // of the mean of the normals
};

inline Smoothed smoothed(const Corners& p, const Corners& n, const Weights& weights, const FlatPoint& flat,
                         const Vector3f& direction) {
  const Vector3d smooth = weights.mix(Vector3d(n.a), Vector3d(n.b), Vector3d(n.c));
  const double length = std::sqrt(glm::dot(smooth, smooth));
  // Of normals that a file has the wrong way round.
  const double turn = glm::dot(smooth, flat.normal) < 0 ? -1.0 : 1.0;
  const double side = glm::dot(flat.normal, Vector3d(direction)) > 0 ? -1.0 : 1.0;
  return {Vector3f((turn / length) * smooth), Vector3f(lift(flat.position, p, n, weights, side * turn)),
          static_cast<float>(length)};
}

constexpr float kShortest = 1e-6f;  // of normals that mean something

// Corners of sixteen triangles.
struct CornerBlock {
  Vector3Block a{}, b{}, c{};

  Corners at(int i) const { return {a.at(i), b.at(i), c.at(i)}; }
  void set(int i, const std::vector<Vector3f>& of_vertices, const std::array<std::uint32_t, 3>& triangle) {
    a.set(i, of_vertices[triangle[0]]);
    b.set(i, of_vertices[triangle[1]]);
    c.set(i, of_vertices[triangle[2]]);
  }
};

void set_flat(const CornerBlock& positions, const HitBlock& hits, SurfaceBlock& __restrict surfaces) {
  for (int i = 0; i < kBlockSize; ++i) {
    const Corners p = positions.at(i);
    surfaces.set(i, flat_surface(p, flat_point(p, {hits.u[i], hits.v[i]})));
  }
}

// Two loops, since a choice between what is dear to compute becomes a branch.
void set_smooth(const CornerBlock& positions, const CornerBlock& normals, const RayBlock& rays,
                const HitBlock& hits, SurfaceBlock& __restrict surfaces) {
  Vector3Block shading, offset;
  alignas(64) float length[kBlockSize];
  for (int i = 0; i < kBlockSize; ++i) {
    const Corners p = positions.at(i);
    const Weights weights(hits.u[i], hits.v[i]);
    const FlatPoint flat = flat_point(p, weights);
    const Smoothed smooth = smoothed(p, normals.at(i), weights, flat, rays.direction(i));
    surfaces.set(i, flat_surface(p, flat));
    shading.set(i, smooth.normal);
    offset.set(i, smooth.offset);
    length[i] = smooth.length;
  }
  for (int i = 0; i < kBlockSize; ++i) {
    const bool is_smooth = length[i] > kShortest;
    surfaces.shading_normal.choose(i, is_smooth, shading.at(i));
    surfaces.shadow_offset.choose(i, is_smooth, offset.at(i));
  }
}

Corners corners_of(const std::vector<Vector3f>& of_vertices, const std::array<std::uint32_t, 3>& triangle) {
  return {of_vertices[triangle[0]], of_vertices[triangle[1]], of_vertices[triangle[2]]};
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
  const Corners p = corners_of(data_->positions, triangle(hit.primitive));
  const Weights weights(hit);
  const FlatPoint flat = flat_point(p, weights);
  SurfacePoint point = flat_surface(p, flat);
  if (data_->normals.empty()) return point;
  const Corners n = corners_of(data_->normals, triangle(hit.primitive));
  const Smoothed smooth = smoothed(p, n, weights, flat, ray.direction);
  if (smooth.length > kShortest) {
    point.shading_normal = smooth.normal;
    point.shadow_offset = smooth.offset;
  }
  return point;
}

void TriangleMesh::surfaces_at(const RayBlock& rays, const HitBlock& hits, const BlockMask& asked,
                               SurfaceBlock& surfaces) const {
  CornerBlock positions, normals;
  const bool is_smooth = !data_->normals.empty();
  for (int i = 0; i < kBlockSize; ++i) {
    if (asked.has(i)) prefetch(hits.primitive[i]);
  }
  for (int i = 0; i < kBlockSize; ++i) {
    if (!asked.has(i)) continue;
    positions.set(i, data_->positions, triangle(hits.primitive[i]));
    if (is_smooth) normals.set(i, data_->normals, triangle(hits.primitive[i]));
  }
  SurfaceBlock own;
  if (is_smooth) {
    set_smooth(positions, normals, rays, hits, own);
  } else {
    set_flat(positions, hits, own);
  }
  shapes::set_lanes(surfaces, asked, own);
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
