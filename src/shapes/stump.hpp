// The body that cylinders and cones have in common: straight from one circle to a parallel one.
#pragma once

#include <memory>

#include "raytracer/shape.hpp"

namespace raytracer::shapes {

/// The stump of a cone with `base_radius` around `base` and `top_radius` around `top`, the radii not negative
/// and not both 0, base and top apart; without caps where `open`. Normal outwards. primitive 0 is the side, 1
/// the base cap, 2 the top cap.
///
/// u runs once around the axis; v on the side from base (0) to top (1), on the caps from the middle to the
/// rim. For the axis from 0 0 0 to 0 1 0 and the radii 1, before the transform:
///
///     part   point         u     v
///     side    1  0    0    0     0
///     side    0  0.5 -1    0.25  0.5
///     side   -1  1    0    0.5   1
///     base    0  0    0.5  0.75  0.5
///     top     0  1   -1    0.25  1
std::unique_ptr<Shape> make_stump(const Vector3d& base, double base_radius, const Vector3d& top,
                                  double top_radius, bool open, const Transform& transform);

}  // namespace raytracer::shapes
