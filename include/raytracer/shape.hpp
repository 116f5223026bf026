// The interface of everything a ray can hit.
#pragma once

#include <cstdint>

#include "raytracer/vector3f.hpp"

namespace raytracer {

/// The `instance` of a hit on a shape that stands in the scene itself.
inline constexpr std::uint32_t kNoInstance = 0xFFFFFFFF;

/// Where a ray meets a shape, as little as traversal needs; only the nearest hit becomes a SurfacePoint.
struct Hit {
  float t = kInfinity;          ///< along the ray, in units of |direction|
  std::uint32_t shape = 0;      ///< index in the scene; written by the scene, not by the shape
  std::uint32_t primitive = 0;  ///< which part of the shape: the shape's own numbering
  float u = 0, v = 0;           ///< parameters on that part: the shape's own meaning
  std::uint32_t instance =
      kNoInstance;  ///< the place of shared shapes that `shape` counts in; written by the scene
};

/// A point on a surface, in world space.
struct SurfacePoint {
  Vector3f position{0};  ///< as close to the true surface as float allows (closer than ray.at(t))
  /// An upper bound on how far `position`, and the rounding of a ray that starts there, may be off the true
  /// surface, in scene units. It follows the magnitudes in the computation, never the size of the scene.
  float position_error = 0;
  Vector3f normal{0, 1, 0};          ///< geometric, unit length; outwards on closed shapes
  Vector3f shading_normal{0, 1, 0};  ///< unit length, same side as `normal`; equal to it on exact shapes
  Vector2f uv{0};
};

struct RayPacket;
struct HitPacket;

/// Pure geometry in world space: it knows no text, no material and no acceleration structure. Immutable.
class Shape {
 public:
  virtual ~Shape() = default;

  /// A box that contains every point of the shape, rounding included. Infinite for endless shapes.
  virtual Box3f bounds() const = 0;

  /// Finds the nearest hit with t_min < t < t_max, from outside or inside. Fills `hit` (all but `shape` and
  /// `instance`) and returns true; returns false and leaves `hit` untouched where there is none. The hit does
  /// not depend on t_max beyond being nearer than it.
  virtual bool is_hit(const Ray3f& ray, Hit& hit) const = 0;

  /// The very same for eight rays at once. What this class does, asking is_hit() for each, is right for every
  /// shape; shapes that are asked often do it faster.
  virtual void find_hits(const RayPacket& rays, HitPacket& hits) const;

  /// The full surface at a hit that is_hit() returned for this ray.
  virtual SurfacePoint surface_at(const Ray3f& ray, const Hit& hit) const = 0;
};

}  // namespace raytracer
