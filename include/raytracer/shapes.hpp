// The exact shapes. Each function builds one from its parameters in the shape's own space and the transform
// that places it in the world, and throws Error (kScene) where the parameters span no surface.
#pragma once

#include <memory>

#include "raytracer/shape.hpp"

namespace raytracer {

/// The ball of `radius` > 0 around `center`. Any affine transform; a non-uniform scale gives an ellipsoid.
/// Normal outwards. u runs once around y from +x towards -z (east seen from above), v from the pole -y (0) to
/// the pole +y (1).
std::unique_ptr<Shape> make_sphere(const Vector3d& center, double radius, const Transform& = {});

/// The parallelogram origin + u width + v height with u, v in [0, 1]; normal along width x height,
/// before the transform.
std::unique_ptr<Shape> make_quad(const Vector3d& origin, const Vector3d& width, const Vector3d& height,
                                 const Transform& = {});

/// The triangle a b c; normal along (b - a) x (c - a), before the transform; u, v are the weights of b and c.
std::unique_ptr<Shape> make_triangle(const Vector3d& a, const Vector3d& b, const Vector3d& c,
                                     const Transform& = {});

/// The box with edges of length `size` along the axes around `center`; normal outwards. primitive 0..5 is the
/// face -x +x -y +y -z +z.
std::unique_ptr<Shape> make_cube(const Vector3d& center, const Vector3d& size, const Transform& = {});

/// The endless plane through `point`; `normal` need not be unit length.
std::unique_ptr<Shape> make_plane(const Vector3d& point, const Vector3d& normal, const Transform& = {});

/// The flat disk of `radius` > 0 around `center`; `normal` need not be unit length.
std::unique_ptr<Shape> make_disk(const Vector3d& center, const Vector3d& normal, double radius,
                                 const Transform& = {});

/// The cylinder of `radius` > 0 around the axis from `base` to `top`, closed by caps unless `open`. Normal
/// outwards. primitive 0 is the side, 1 the base cap, 2 the top cap.
std::unique_ptr<Shape> make_cylinder(const Vector3d& base, const Vector3d& top, double radius, bool open,
                                     const Transform& = {});

/// The cone, or its stump, of `radius` >= 0 at `base` and `top_radius` >= 0 at `top` (not both 0), closed by
/// caps unless `open`. Normal outwards. primitive 0 is the side, 1 the base cap, 2 the top cap.
std::unique_ptr<Shape> make_cone(const Vector3d& base, double radius, const Vector3d& top, double top_radius,
                                 bool open, const Transform& = {});

/// The ring: all points `tube_radius` > 0 away from the circle of `radius` > 0 around `center` in the plane
/// across `axis`. A tube_radius above radius makes it cross itself (a spindle). Normal outwards from the
/// tube.
std::unique_ptr<Shape> make_torus(const Vector3d& center, const Vector3d& axis, double radius,
                                  double tube_radius, const Transform& = {});

}  // namespace raytracer
