// How a surface scatters light at a point: the closure of a Material, textures resolved.
#pragma once

#include "raytracer/material.hpp"
#include "raytracer/vector3f.hpp"

namespace raytracer {

/// Where a Bsdf stands. All unit length, world space. `normal` and `tangent` need not be orthogonal.
struct BsdfFrame {
  Vector3f geometric_normal{0, 1, 0};  ///< of the surface: outwards on closed shapes, whichever side is seen
  Vector3f normal{0, 1, 0};            ///< shading normal, on the side of the geometric one
  Vector3f tangent{0};                 ///< along u, for anisotropy; 0: any
  /// The indices of refraction of what the geometric normal points into and of what is behind the surface;
  /// outside of everything: 1. Of a surface that lets light in, one of them is its own.
  float ior_outside = 1, ior_inside = 1;
};

struct BsdfSample {
  Vector3f direction{0};  ///< unit length, away from the surface
  Color3f weight{0};      ///< value * |cosine to the shading normal| / pdf; without the pdf for a delta
  float pdf = 0;          ///< per steradian, of all lobes together; of a delta the probability of its choice
  bool is_delta = false;  ///< mirror or clear glass: no other direction has anything to do with it
  bool is_transmission = false;  ///< it goes on on the other side of the surface
};

/// Directions are unit length, in world space, and point away from the surface: `out` to where the light goes
/// (the eye), `in` to where it comes from.
class Bsdf {
 public:
  /// The material must outlive it.
  Bsdf(const Material& material, const BsdfFrame& frame);

  /// value(out, in) * |cosine of in to the shading normal|, per channel, delta lobes left out. 0 where in or
  /// out is on the wrong side of either normal.
  Color3f evaluate(const Vector3f& out, const Vector3f& in) const;
  /// The density per steradian with which sample() chooses `in`, delta lobes left out.
  float pdf(const Vector3f& out, const Vector3f& in) const;
  /// Chooses where light comes from. `u_lobe` and `u` in [0, 1). False: the path ends here.
  bool sample(const Vector3f& out, float u_lobe, const Vector2f& u, BsdfSample& sample) const;

  /// Whether sample() never chooses anything but a delta, so that evaluate() is 0.
  bool is_delta() const;
};

}  // namespace raytracer
