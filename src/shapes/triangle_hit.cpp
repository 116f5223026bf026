#include "shapes/triangle_hit.hpp"

#include <algorithm>
#include <cstddef>

#include "shapes/hits.hpp"

namespace raytracer::shapes {

namespace {

/// Twice the area of the triangle from 0 0 to p and q. Never inlined: whether the compiler fuses a product
/// with the subtraction must not differ between the two triangles that ask for the same edge.
[[gnu::noinline]] double area_seen(const glm::dvec2& p, const glm::dvec2& q) { return p.x * q.y - p.y * q.x; }

bool is_before(const Vector3d& p, const Vector3d& q) {
  return p.x != q.x ? p.x < q.x : p.y != q.y ? p.y < q.y : p.z < q.z;
}

}  // namespace

TriangleCorners::TriangleCorners(const Vector3d& a, const Vector3d& b, const Vector3d& c)
    : corners_{a, b, c},
      normal_(glm::normalize(glm::cross(b - a, c - a))),
      extent_(glm::max(a, glm::max(b, c)) - glm::min(a, glm::min(b, c))) {
  std::sort(ascending_.begin(), ascending_.end(),
            [&](std::size_t i, std::size_t j) { return is_before(corners_[i], corners_[j]); });
}

bool TriangleCorners::is_hit(const Ray3f& ray, std::uint32_t primitive, Hit& hit) const {
  const Vector3d origin(ray.origin);
  const Vector3d direction(ray.direction);
  const Vector3d to_a = corners_[0] - origin;
  const double t = glm::dot(normal_, to_a) / glm::dot(normal_, direction);
  if (!is_on_ray(ray, t)) return false;
  // Beside a ray in the plane, but for rounding, the edges say little: t must be near the triangle.
  const Vector3d from_a = t * direction - to_a;
  if (glm::dot(from_a, from_a) > 4 * glm::dot(extent_, extent_)) return false;

  const Vector3f size = glm::abs(ray.direction);
  const int z = size.x > size.y ? (size.x > size.z ? 0 : 2) : (size.y > size.z ? 1 : 2);
  const int x = (z + 1) % 3, y = (z + 2) % 3;
  const double shear_x = direction[x] / direction[z], shear_y = direction[y] / direction[z];
  const auto seen_along_ray = [&](const Vector3d& corner) {
    const Vector3d p = corner - origin;
    return glm::dvec2(p[x] - shear_x * p[z], p[y] - shear_y * p[z]);
  };
  const auto [first, second, third] = ascending_;
  const glm::dvec2 p = seen_along_ray(corners_[first]), q = seen_along_ray(corners_[second]),
                   r = seen_along_ray(corners_[third]);
  std::array<double, 3> weight;  // of each corner: the area on the far side of the edge across from it
  weight[first] = area_seen(q, r);
  weight[second] = -area_seen(p, r);
  weight[third] = area_seen(p, q);
  const auto [least, most] = std::minmax({weight[0], weight[1], weight[2]});
  if (least < 0 && most > 0) return false;
  const double sum = weight[0] + weight[1] + weight[2];
  if (sum == 0) return false;
  set_hit(hit, t, primitive, static_cast<float>(weight[1] / sum), static_cast<float>(weight[2] / sum));
  return true;
}

}  // namespace raytracer::shapes
