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
  /// From `position` to where rays to lights start that leave on the side that the surface was seen from; the
  /// step of position_error comes on top. A smooth mesh would else be shadowed by its own facets. 0 on exact
  /// shapes.
  Vector3f shadow_offset{0};
};

/// What only textures, brushed metals and coloured meshes need to know of a point; world space.
struct SurfaceDetail {
  Vector2f uv{0};
  Vector3f along_u{0}, along_v{0};  ///< how the position changes with u and v; 0 where that has no meaning
  Color3f color{1};                 ///< of a mesh's vertices
};

/// What is known of a part of a shape that may shine: enough to tell how much it may matter somewhere.
struct PartExtent {
  Box3f bounds;
  float area = 0;
  Vector3f axis{0, 1, 0};  ///< all normals of the part are within the angle of cos_spread around it
  float cos_spread = -1;   ///< -1: they go all ways
};

/// A point on a part of a shape, chosen as seen from somewhere.
struct ShapeSample {
  Vector3f position{0};
  float position_error = 0;  ///< as SurfacePoint has it
  Vector3f normal{0, 1, 0};  ///< geometric, unit length
  float pdf = 0;             ///< of the choice, per steradian as seen from there
  float u = 0, v = 0;        ///< as Hit has them: the shape's own meaning
};

class TriangleMesh;
namespace shapes {
struct Parallelogram;
}
struct RayPacket;
struct HitPacket;
struct RayBlock;
struct HitBlock;
struct BlockMask;
struct SurfaceBlock;

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

  /// The very same for the lanes that are asked about; the others keep what they hold. What this class does,
  /// asking surface_at() for each, is right for every shape.
  virtual void surfaces_at(const RayBlock& rays, const HitBlock& hits, const BlockMask& asked,
                           SurfaceBlock& surfaces) const;

  /// Likewise what textures need; apart from the surface, since most hits need none of it. By default:
  /// nothing.
  virtual SurfaceDetail detail_at(const Ray3f& ray, const Hit& hit) const;

  /// The shape as native triangles for the accelerator; null: it is asked by is_hit().
  virtual const TriangleMesh* as_mesh() const { return nullptr; }

  /// The shape as the one flat part with four corners that it is chosen from; null: it is something else.
  virtual const shapes::Parallelogram* as_parallelogram() const { return nullptr; }

  // --- for shapes that shine -------------------------------------------------------------------------------

  /// How many parts it is chosen from; the part of a hit is its `primitive`. 0: it can't shine (endless).
  virtual std::uint32_t part_count() const { return 0; }
  virtual PartExtent part_extent(std::uint32_t part) const;
  /// Chooses a point of the part as seen from `from`; false where none can be seen from there at all (a flat
  /// part from within its plane). Both sides count.
  virtual bool sample_part(std::uint32_t part, const Vector3f& from, const Vector2f& u,
                           ShapeSample& sample) const;
  /// The density per steradian with which sample_part() from `from` chooses the direction of `point`, which
  /// lies on the part.
  virtual float part_pdf(std::uint32_t part, const Vector3f& from, const SurfacePoint& point) const;
};

}  // namespace raytracer
