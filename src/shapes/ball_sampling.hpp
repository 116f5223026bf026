// Choosing a point of a ball as seen from somewhere.
#pragma once

#include "raytracer/vector3f.hpp"

namespace raytracer::shapes {

/// Chooses a point of the unit sphere as seen from `from`, in the space where it is the unit sphere: from
/// outside uniform over the directions that meet it, on its near side; from inside, or where `from` may be
/// inside for being off by `rounding`, uniform over its area.
Vector3d choose_point_of_ball(const Vector3d& from, double rounding, const Vector2f& u);

/// The density per steradian (of that space) with which choose_point_of_ball() takes the direction of
/// `point`, which lies on the sphere. 0: never, though it may lie there.
double ball_density(const Vector3d& from, double rounding, const Vector3d& point);

}  // namespace raytracer::shapes
