// Most surfaces are matt: sixteen vertices of paths on such, side by side, so that the processor shades many
// at once.
#pragma once

#include <cstddef>
#include <cstdint>

#include "core/lanes.hpp"
#include "materials/bsdf.hpp"
#include "raytracer/method.hpp"
#include "scene/light_set.hpp"

namespace raytracer {

/// What is done here is what Bsdf does of a purely matt material, to the last bit, on surfaces whose two
/// normals are one. Lanes from `count` on hold anything.
struct MattVertices {
  static constexpr std::size_t kSize = kBlockSize;

  // What is given.
  std::size_t count = 0;
  std::uint32_t path[kSize]{};
  Vector3Block position{}, normal{};   ///< the normal as SurfacePoint has it
  alignas(64) float side[kSize]{};     ///< 1 where the normal looks back along the ray, else -1
  alignas(64) float offset[kSize]{};   ///< how far off the surface rays start
  Vector3Block color{}, throughput{};  ///< the material's, as it is written; the path's so far
  LightQueries lights;
  alignas(64) float u[kSize]{}, v[kSize]{};  ///< for the direction

  // Towards the light.
  Vector3Block light{};                       ///< what arrives at the eye, if nothing is in its way
  Vector3Block start{};                       ///< of rays on the side that the ray came from
  alignas(64) std::uint32_t is_lit[kSize]{};  ///< whether there is any

  // The way on.
  Vector3Block direction{};
  alignas(64) float pdf[kSize]{};  ///< of that choice; 0: the path ends

  /// Where the next one stands that has been met by a ray of direction `way`.
  void add(std::uint32_t path_index, const SurfacePoint& surface, const Vector3f& way);
  void find_light(const LightSamples& samples, Sampling sampling);
  /// Also takes the colour to the throughput.
  void scatter();
};

}  // namespace raytracer
