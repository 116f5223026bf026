// The intersection of a line with an axis-aligned box.
#pragma once

#include <limits>

namespace raytracer::shapes {

/// Where the line is inside the box lower..upper, and through which pair of faces (an axis) it comes and
/// goes; returns false where it misses. Kay's slabs: T. Kay, J. Kajiya, "Ray Tracing Complex Scenes",
/// SIGGRAPH 1986.
///
/// A direction along a face makes 0 * infinity where the line runs in the face itself; that NaN fails both
/// comparisons, so such a line counts as inside this slab.
template <class T, class Vector>
inline bool intersect_box(const Vector& origin, const Vector& direction, const Vector& lower,
                          const Vector& upper, T& near, T& far, int& near_axis, int& far_axis) {
  near = -std::numeric_limits<T>::infinity();
  far = std::numeric_limits<T>::infinity();
  near_axis = far_axis = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const T inverse = T(1) / direction[axis];
    const T at_lower = (lower[axis] - origin[axis]) * inverse;
    const T at_upper = (upper[axis] - origin[axis]) * inverse;
    const T enter = inverse < 0 ? at_upper : at_lower;
    const T leave = inverse < 0 ? at_lower : at_upper;
    near_axis = enter > near ? axis : near_axis;
    near = enter > near ? enter : near;
    far_axis = leave < far ? axis : far_axis;
    far = leave < far ? leave : far;
  }
  return near <= far;
}

}  // namespace raytracer::shapes
