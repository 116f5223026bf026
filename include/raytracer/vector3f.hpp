// The vocabulary of space: points, directions, colours, rays, boxes and affine transforms.
//
// Space is right-handed with y up. Lengths are in scene units, angles in degrees.
#pragma once

#include <algorithm>
#include <cstdint>
#include <glm/glm.hpp>
#include <limits>

namespace raytracer {

using Vector2f = glm::vec2;
using Vector3f = glm::vec3;
using Vector3d = glm::dvec3;  // what scenes are built with; shapes round to float once, at the end
using Color3f = glm::vec3;    // red, green, blue; 1 is white unless told otherwise

inline constexpr float kInfinity = std::numeric_limits<float>::infinity();

/// The points origin + t direction with t_min < t < t_max. The direction need not have unit length: t counts
/// in units of |direction|.
struct Ray3f {
  Vector3f origin{0};
  Vector3f direction{0, 0, -1};
  float t_min = 0;
  float t_max = kInfinity;

  Vector3f at(float t) const { return origin + t * direction; }
};

/// An axis-aligned box; empty while lower > upper, which is how it starts.
struct Box3f {
  Vector3f lower{kInfinity};
  Vector3f upper{-kInfinity};

  static Box3f infinite() { return {Vector3f(-kInfinity), Vector3f(kInfinity)}; }

  void extend(const Vector3f& point) {
    lower = glm::min(lower, point);
    upper = glm::max(upper, point);
  }
  void extend(const Box3f& other) {
    lower = glm::min(lower, other.lower);
    upper = glm::max(upper, other.upper);
  }
  bool is_empty() const { return lower.x > upper.x || lower.y > upper.y || lower.z > upper.z; }
  bool is_finite() const {
    return lower.x > -kInfinity && lower.y > -kInfinity && lower.z > -kInfinity && upper.x < kInfinity &&
           upper.y < kInfinity && upper.z < kInfinity;
  }
  Vector3f center() const { return 0.5f * lower + 0.5f * upper; }
  Vector3f diagonal() const { return upper - lower; }
};

/// An affine map p -> linear p + translation, in double precision: scenes compose many of them, shapes bake
/// the product once.
struct Transform {
  glm::dmat3 linear{1.0};
  Vector3d translation{0.0};

  Vector3d point(const Vector3d& p) const { return linear * p + translation; }
  Vector3d vector(const Vector3d& v) const { return linear * v; }

  /// Whether right hands become left ones. Flat shapes keep the side that they face: a mirror image of a lamp
  /// that shines down shines down.
  bool is_mirror() const { return glm::determinant(linear) < 0; }

  /// First other, then this.
  Transform operator*(const Transform& other) const {
    return {linear * other.linear, linear * other.translation + translation};
  }
  /// The inverse map; the linear part must not be singular.
  Transform inverse() const {
    const glm::dmat3 inverse_linear = glm::inverse(linear);
    return {inverse_linear, -(inverse_linear * translation)};
  }
  bool is_identity() const { return linear == glm::dmat3(1.0) && translation == Vector3d(0.0); }
};

}  // namespace raytracer
