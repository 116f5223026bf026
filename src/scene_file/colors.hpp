// Colours by name and by hexadecimal digits, as CSS has them. All are display (sRGB) values.
#pragma once

#include <optional>
#include <span>
#include <string_view>

#include "raytracer/vector3f.hpp"

namespace raytracer::scene_file {

/// The 148 names of CSS Color Module Level 4, section 6.1; nothing for another word.
std::optional<Vector3d> named_color(std::string_view name);
std::span<const std::string_view> color_names();

/// From hue in degrees (any), saturation and value in 0..1 (Smith 1978, "Color gamut transform pairs").
Vector3d hsv(double hue_degrees, double saturation, double value);

/// The linear Rec.709 colour of a black body at a temperature in kelvin, scaled so that its largest component
/// is 1; components outside of the gamut are 0. Planck's law with the colour matching functions as fitted by
/// Wyman, Sloan, Shirley 2013, "Simple analytic approximations to the CIE XYZ color matching functions".
Vector3d black_body_color(double kelvin);

/// What a display makes of a display value (IEC 61966-2-1, the sRGB curve), continued beyond 0..1.
double linear_from_display(double value);
/// And back; of linear values beyond 1 as well.
double display_from_linear(double value);

/// Of `#rgb` or `#rrggbb`, which must be well-formed.
Vector3d hexadecimal_color(std::string_view text);

}  // namespace raytracer::scene_file
