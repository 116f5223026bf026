// Shapes that stand in many places.
#include <algorithm>
#include <cmath>
#include <utility>

#include "core/numeric.hpp"
#include "raytracer/error.hpp"
#include "raytracer/scene.hpp"
#include "scene/accelerator.hpp"
#include "scene/placed_surface.hpp"
#include "scene/vertex_colors.hpp"

namespace raytracer {
namespace {

glm::dmat3 magnitudes(const glm::dmat3& m) { return {glm::abs(m[0]), glm::abs(m[1]), glm::abs(m[2])}; }

// How far m can stretch a length, at most: its spectral norm is the root of that of mᵀm, which no sum of a
// row of magnitudes is below. Exact where the axes stay at right angles.
double stretch(const glm::dmat3& m) {
  const glm::dmat3 square = glm::transpose(m) * m;
  double largest = 0;
  for (int i = 0; i < 3; ++i) {
    const Vector3d row = glm::abs(square[i]);
    largest = std::max(largest, row.x + row.y + row.z);
  }
  return std::sqrt(largest);
}

}  // namespace

SharedShapes::SharedShapes(std::vector<std::unique_ptr<Shape>> shapes, std::vector<std::uint32_t> material_of,
                           std::vector<Material> materials)
    : shapes_(std::move(shapes)), material_of_(std::move(material_of)), materials_(std::move(materials)) {
  if (material_of_.size() != shapes_.size()) {
    throw Error(ErrorKind::kUsage, "shared shapes need one material index per shape");
  }
  for (const std::uint32_t index : material_of_) {
    if (index >= materials_.size()) throw Error(ErrorKind::kUsage, "a shape's material does not exist");
  }
  for (const auto& shape : shapes_) bounds_.extend(shape->bounds());
  if (!bounds_.is_empty() && !bounds_.is_finite())
    throw Error(ErrorKind::kUsage, "an endless shape can't be shared");
  has_vertex_colors_ = any_vertex_colors(shapes_);
  accelerator_ = std::make_unique<Accelerator>(shapes_);
}

SharedShapes::~SharedShapes() = default;

Box3f Instance::bounds(const Box3f& own) const {
  Box3f box;
  if (own.is_empty()) return box;
  const Vector3d middle = 0.5 * (Vector3d(own.lower) + Vector3d(own.upper));
  const Vector3d half = 0.5 * (Vector3d(own.upper) - Vector3d(own.lower));
  const glm::dmat3 m(linear);
  const Vector3d center = m * middle + Vector3d(translation);
  const Vector3d reach = magnitudes(m) * half;
  for (int i = 0; i < 3; ++i) {
    box.lower[i] = float_below(center[i] - reach[i]);
    box.upper[i] = float_above(center[i] + reach[i]);
  }
  return box;
}

namespace {

// The ray in an instance's own space; t means the same there.
Ray3f own_ray_of(const Ray3f& ray, const glm::dmat3& to_own, const Vector3d& translation) {
  Ray3f own = ray;
  own.origin = Vector3f(to_own * (Vector3d(ray.origin) - translation));
  own.direction = Vector3f(to_own * Vector3d(ray.direction));
  return own;
}

}  // namespace

SurfaceDetail Scene::instance_detail_at(const Ray3f& ray, const Hit& hit) const {
  const Instance& instance = description_.instances[hit.instance];
  const Shape& shape = description_.shared[instance.shared]->shape(hit.shape);
  if (instance.is_identity()) return shape.detail_at(ray, hit);
  const glm::dmat3 to_own = glm::inverse(glm::dmat3(instance.linear));
  SurfaceDetail detail = shape.detail_at(own_ray_of(ray, to_own, Vector3d(instance.translation)), hit);
  detail.along_u = instance.linear * detail.along_u;
  detail.along_v = instance.linear * detail.along_v;
  return detail;
}

SurfacePoint Scene::instance_surface_at(const Ray3f& ray, const Hit& hit) const {
  const Instance& instance = description_.instances[hit.instance];
  const Shape& shape = description_.shared[instance.shared]->shape(hit.shape);
  if (instance.is_identity()) return shape.surface_at(ray, hit);
  const glm::dmat3 to_world(instance.linear);
  const glm::dmat3 to_own = glm::inverse(to_world);
  const Vector3d translation(instance.translation);
  return placed_surface(shape.surface_at(own_ray_of(ray, to_own, translation), hit), to_world, to_own,
                        translation);
}

SurfacePoint placed_surface(const SurfacePoint& own, const glm::dmat3& to_world, const glm::dmat3& to_own,
                            const Vector3d& translation) {
  SurfacePoint point = own;
  const Vector3d position = to_world * Vector3d(own.position) + translation;
  point.position = Vector3f(position);
  const glm::dmat3 normals = glm::transpose(to_own);
  point.normal = Vector3f(glm::normalize(normals * Vector3d(own.normal)));
  point.shading_normal = Vector3f(glm::normalize(normals * Vector3d(own.shading_normal)));
  point.shadow_offset = Vector3f(to_world * Vector3d(own.shadow_offset));
  // Besides the shape's own error: what a further ray loses whose origin Embree takes into the shapes' own
  // space in single precision (a sum of three products and a translation that is such a sum itself) by a
  // matrix that it has inverted in single precision; and twice the rounding of a position in the world.
  constexpr double kSums = 3, kInverse = 8;
  const Vector3d lost =
      kSums * (glm::abs(position) + glm::abs(translation)) + kInverse * glm::abs(position - translation);
  const Vector3d lost_here = magnitudes(to_world) * (magnitudes(to_own) * lost);
  point.position_error = float_above(stretch(to_world) * own.position_error +
                                     kFloatRounding * (glm::length(lost_here) + 2 * glm::length(position)));
  return point;
}

}  // namespace raytracer
