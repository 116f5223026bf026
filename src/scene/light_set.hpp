// All that shines in a scene, and which of it to look at from a point.
#pragma once

#include <cstdint>
#include <memory>

#include "raytracer/scene.hpp"
#include "shapes/places_seen.hpp"

namespace raytracer {

struct LightSample {
  Vector3f direction{0};  ///< unit length, from the point to the light
  Vector3f target{0};  ///< where the shadow ray ends, a little off the light's own surface; not of far lights
  bool is_far = false;    ///< directional or sky: the shadow ray never ends
  bool is_delta = false;  ///< point, spot, directional: no ray hits it by chance
  Color3f radiance{0};    ///< that arrives; of a delta the irradiance across `direction`
  float pdf = 0;  ///< per steradian, the choice of the light included; of a delta that choice's probability

  /// From a point that is already off its surface.
  Ray3f shadow_ray(const Vector3f& offset_position) const {
    if (is_far) return {offset_position, direction};
    return {offset_position, target - offset_position, 0, 1};
  }
};

/// What sixteen vertices ask LightSet::sample() at once. Lanes from `count` on hold anything.
struct LightQueries {
  int count = 0;
  shapes::PlacesToSeeFrom from{};
  Vector3Block normal{};
  float u_light[kBlockSize]{};
};

/// The answers, as LightSample has them; pdf 0: nothing.
struct LightSamples {
  Vector3Block direction, target;
  ColorBlock radiance;
  alignas(64) float pdf[kBlockSize];
  alignas(64) std::uint32_t is_far[kBlockSize], is_delta[kBlockSize];  // 0 or 1
};

/// Immutable. Does not keep the description's shapes: the description must outlive it and not move.
class LightSet {
 public:
  explicit LightSet(const SceneDescription& scene);
  ~LightSet();
  LightSet(const LightSet&) = delete;
  LightSet& operator=(const LightSet&) = delete;

  /// Whether there is anything to sample: lights, shapes that shine, a sky that is worth it.
  bool is_empty() const;

  /// Chooses one light, and a direction to it. `normal` (unit length) is of a surface that scatters on its
  /// own side only; 0 for one that lets light through: all directions count. False: nothing can arrive.
  bool sample(const Vector3f& position, const Vector3f& normal, float u_light, const Vector2f& u,
              LightSample& sample) const;

  /// The very same for sixteen at once.
  void sample(const LightQueries& queries, LightSamples& samples) const;

  /// The density per steradian, choice included, with which sample() from there chooses the direction of
  /// `point`, a hit on a shape that shines. 0 where it never does.
  float pdf(const Vector3f& position, const Vector3f& normal, const Hit& hit,
            const SurfacePoint& point) const;

  /// Likewise for a direction into the sky or background. 0: left to the material's sampling (a constant
  /// one).
  float sky_pdf(const Vector3f& position, const Vector3f& normal, const Vector3f& direction) const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace raytracer
