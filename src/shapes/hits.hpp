// Choosing the hit among the places where a line meets a surface.
#pragma once

#include "raytracer/shape.hpp"

namespace raytracer::shapes {

/// The stretch of a line inside a convex body, in units of |direction|.
template <class T>
struct Span {
  T near, far;
};

/// Whether t, rounded to float, is on the ray; the comparison is of floats, so that a hit found once is on
/// the ray exactly as long as t_min < hit.t < t_max. False for NaN.
inline bool is_on_ray(const Ray3f& ray, double t) {
  const float rounded = static_cast<float>(t);
  return rounded > ray.t_min && rounded < ray.t_max;
}

inline void set_hit(Hit& hit, double t, std::uint32_t primitive = 0, float u = 0, float v = 0) {
  hit.t = static_cast<float>(t);
  hit.primitive = primitive;
  hit.u = u;
  hit.v = v;
}

}  // namespace raytracer::shapes
