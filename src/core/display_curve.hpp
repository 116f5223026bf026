// The curve between light and what a display is told (IEC 61966-2-1, sRGB), continued beyond 0..1 by
// symmetry about 0.
#pragma once

#include <cmath>

namespace raytracer {

inline double linear_from_display(double value) {
  const double size = std::abs(value);
  const double linear = size <= 0.04045 ? size / 12.92 : std::pow((size + 0.055) / 1.055, 2.4);
  return std::copysign(linear, value);
}

inline double display_from_linear(double value) {
  const double size = std::abs(value);
  const double display = size <= 0.0031308 ? size * 12.92 : 1.055 * std::pow(size, 1 / 2.4) - 0.055;
  return std::copysign(display, value);
}

}  // namespace raytracer
