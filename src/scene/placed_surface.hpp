// A point of a shape that stands in a place of its own.
#pragma once

#include "raytracer/shape.hpp"

namespace raytracer {

/// The surface point in the world, its error bound included, of a point in the space of shared shapes that an
/// instance places by `to_world` (with its inverse) and `translation`.
SurfacePoint placed_surface(const SurfacePoint& own, const glm::dmat3& to_world, const glm::dmat3& to_own,
                            const Vector3d& translation);

}  // namespace raytracer
