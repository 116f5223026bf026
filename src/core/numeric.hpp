// Rounding from double to float with a known direction, and how large its error is.
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>

#include "raytracer/vector3f.hpp"

namespace raytracer {

/// The largest relative error of rounding a number to float.
inline constexpr double kFloatRounding = 0x1p-24;

/// The largest relative error of one operation in double.
inline constexpr double kDoubleRounding = 0x1p-53;

inline constexpr double kPi = 3.14159265358979323846;

/// The least float that is not below x.
inline float float_above(double x) {
  const float rounded = static_cast<float>(x);
  return rounded < x ? std::nextafter(rounded, kInfinity) : rounded;
}

/// The next float above x, which is positive and finite.
inline float next_above(float x) { return std::bit_cast<float>(std::bit_cast<std::uint32_t>(x) + 1); }

/// float_above() of x >= 0, without branches.
inline float float_above_positive(double x) {
  const float rounded = static_cast<float>(x);
  const std::uint32_t step = static_cast<double>(rounded) < x ? 1 : 0;
  return std::bit_cast<float>(std::bit_cast<std::uint32_t>(rounded) + step);
}

/// The greatest float that is not above x.
inline float float_below(double x) {
  const float rounded = static_cast<float>(x);
  return rounded > x ? std::nextafter(rounded, -kInfinity) : rounded;
}

/// v rounded to float. Through memory: where GCC 12 vectorises Vector3d(Vector3f(v)) it drops both
/// conversions.
inline Vector3d as_float(const Vector3d& v) {
  const volatile float x = static_cast<float>(v.x), y = static_cast<float>(v.y), z = static_cast<float>(v.z);
  return {x, y, z};
}

inline bool is_finite(const Vector3d& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

}  // namespace raytracer
