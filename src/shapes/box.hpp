// The intersection of a line with an axis-aligned box.
#pragma once

#include <cstdint>
#include <limits>

namespace raytracer::shapes {

/// The stretch of a line inside a box, in units of |direction|, and the faces through which it comes and
/// goes: twice the axis that the face lies across, and one more for the upper of the two.
template <class T>
struct BoxSpan {
  T near, far;
  std::uint32_t near_face, far_face;
};

/// Where the line is inside the box lower..upper; it misses where near > far. Kay's slabs: T. Kay, J. Kajiya,
/// "Ray Tracing Complex Scenes", SIGGRAPH 1986. Without branches, for blocks of rays.
///
/// A direction along a face makes 0 * infinity where the line runs in the face itself; that NaN fails both
/// comparisons, so such a line counts as inside this slab.
template <class T, class Vector>
inline BoxSpan<T> intersect_box(const Vector& origin, const Vector& direction, const Vector& lower,
                                const Vector& upper) {
  BoxSpan<T> span = {-std::numeric_limits<T>::infinity(), std::numeric_limits<T>::infinity(), 0, 0};
  const auto cut = [&](T from, T along, T low, T high, std::uint32_t lower_face) {
    const T inverse = T(1) / along;
    const T at_lower = (low - from) * inverse, at_upper = (high - from) * inverse;
    const bool is_backwards = inverse<0, is_forwards = along> 0;
    const T enter = is_backwards ? at_upper : at_lower, leave = is_backwards ? at_lower : at_upper;
    span.near_face = enter > span.near ? lower_face + (is_forwards ? 0U : 1U) : span.near_face;
    span.near = enter > span.near ? enter : span.near;
    span.far_face = leave < span.far ? lower_face + (is_forwards ? 1U : 0U) : span.far_face;
    span.far = leave < span.far ? leave : span.far;
  };
  cut(origin.x, direction.x, lower.x, upper.x, 0);
  cut(origin.y, direction.y, lower.y, upper.y, 2);
  cut(origin.z, direction.z, lower.z, upper.z, 4);
  return span;
}

}  // namespace raytracer::shapes
