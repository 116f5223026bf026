// Choosing the hit among the places where a line meets a surface.
#pragma once

#include "shapes/ray_packet.hpp"

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

/// The first of the two values, rounded to float, that is on the ray of lane i; kInfinity where none is.
/// Without branches, as is everything that is done to a packet.
inline float first_on_ray(const RayPacket& rays, int i, double near, double far) {
  const float first = static_cast<float>(near), second = static_cast<float>(far);
  const float second_or_none = ((second > rays.t_min[i]) & (second < rays.t_max[i])) ? second : kInfinity;
  return ((first > rays.t_min[i]) & (first < rays.t_max[i])) ? first : second_or_none;
}

/// For shapes whose hits are known by t alone.
inline void clear_parameters(HitPacket& hits) {
  for (int i = 0; i < RayPacket::kSize; ++i) {
    hits.primitive[i] = 0;
    hits.u[i] = hits.v[i] = 0;
  }
}

inline void set_hit(Hit& hit, double t, std::uint32_t primitive = 0, float u = 0, float v = 0) {
  hit.t = static_cast<float>(t);
  hit.primitive = primitive;
  hit.u = u;
  hit.v = v;
}

}  // namespace raytracer::shapes
