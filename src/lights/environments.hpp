// Every kind of light from all around. Each function throws Error (kScene) for numbers that make no sky.
#pragma once

#include <memory>
#include <vector>

#include "raytracer/light.hpp"

namespace raytracer {

/// A turn about y, counter-clockwise for one who looks down on the scene; in degrees.
glm::dmat3 turn_about_y(double degrees);

/// The same from everywhere.
std::shared_ptr<const Environment> make_constant_sky(const Color3f& radiance);

/// Linear radiance all around. Column u in [0, 1) and row v in [0, 1] (0 at the top) show the direction
/// (sin(2 pi u) sin(pi v), cos(pi v), -cos(2 pi u) sin(pi v)):
///
///     u      v     direction
///     0      0.5    0  0 -1
///     0.25   0.5    1  0  0
///     0.5    0.5    0  0  1
///     0.75   0.5   -1  0  0
///     any    0      0  1  0
///     any    1      0 -1  0
///
/// Bilinear between the centres of the pixels; columns go on around, rows end at the poles.
struct EnvironmentPicture {
  int width = 0, height = 0;
  std::vector<float> rgb;  ///< rows from the top; negative values and what is no number count as 0
};

/// `to_world` (a rotation) turns the picture; `strength` multiplies it. A picture of one colour is a constant
/// sky.
std::shared_ptr<const Environment> make_image_sky(EnvironmentPicture picture, double strength = 1,
                                                  const glm::dmat3& to_world = glm::dmat3(1.0));

/// Radiance `horizon` at eye level that becomes `zenith` straight up and `ground` straight down, in
/// proportion to the sine of the elevation.
std::shared_ptr<const Environment> make_gradient_sky(const Color3f& zenith, const Color3f& horizon,
                                                     const Color3f& ground);

/// A clear sky over flat ground at sea level, by the light that air and haze scatter. Its unit: the sun
/// alone, without any air before it, gives a white surface across its rays the radiance 1.
struct SunSky {
  double elevation = 45;  ///< of the sun over the horizon, degrees, -90..90
  double azimuth = 0;     ///< degrees: 0 is -z, 90 is +x, as the columns of an environment picture
  double turbidity = 3;   ///< how much thicker than clean air the sky is, upwards, at 550 nm: 1..20
  Color3f ground{0.3F};   ///< share of the light that the ground returns, 0..1
  bool has_disk = true;   ///< whether the sun itself is there
  double disk_size = 1;   ///< times 0.533 degrees across; larger is softer, not brighter
  double strength = 1;    ///< multiplies it all
};
std::shared_ptr<const Environment> make_sun_sky(const SunSky& sky);

}  // namespace raytracer
