// What every shape demands of its parameters. Each function throws Error (kScene) with a sentence that names
// the property.
#pragma once

#include "raytracer/vector3f.hpp"

namespace raytracer::shapes {

void require_finite(double value, const char* property);
void require_finite(const Vector3d& value, const char* property);

/// Finite and greater than 0.
void require_positive(double value, const char* property);

/// Finite and not below 0.
void require_not_negative(double value, const char* property);

/// Finite and not the zero vector.
void require_nonzero(const Vector3d& value, const char* property);

/// The ends of an axis: finite and not the same point.
void require_apart(const Vector3d& base, const Vector3d& top);

/// Finite and invertible.
void require_regular(const Transform& transform);

/// Whether the sine of the angle between two vectors is too small to tell them from parallel ones, or one is
/// zero.
bool are_parallel(const Vector3d& a, const Vector3d& b);

/// Rounds a box in world space outwards, with a few units in the last place to spare for points that are
/// rounded to float. Throws where it reaches beyond 1e18: squares of larger coordinates leave the range of
/// float.
Box3f rounded_bounds(const Vector3d& lower, const Vector3d& upper);

}  // namespace raytracer::shapes
