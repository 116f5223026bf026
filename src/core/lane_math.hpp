// Functions without branches, for loops that are to become vector instructions: those of the standard library
// are calls. The same results on every machine.
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>

#include "core/numeric.hpp"

namespace raytracer {

/// One of two numbers. In bits, since compilers make branches of choices between numbers, and then no
/// vectors.
inline float chosen(bool is_first, float first, float other) {
  const std::uint32_t mask = 0U - static_cast<std::uint32_t>(is_first);
  return std::bit_cast<float>((std::bit_cast<std::uint32_t>(first) & mask) |
                              (std::bit_cast<std::uint32_t>(other) & ~mask));
}

/// The sine of 2 pi x, within 2e-7; from 2^22 on x has no fractions that count, and it is some number of
/// -1..1.
inline float sine_of_turns(float x) {
  const float turn = x - std::floor(x + 0.5F), size = std::abs(turn);
  const float t = static_cast<float>(2 * kPi) * (size > 0.25F ? 0.5F - size : size), z = t * t;
  // Taylor's series; what comes next is below 6e-8.
  const float series =
      1 +
      z * (-1.0F / 6 + z * (1.0F / 120 + z * (-1.0F / 5040 + z * (1.0F / 362880 + z * (-1.0F / 39916800)))));
  return std::copysign(t * series, turn);
}

/// Below it half turns are counted exactly.
inline constexpr double kMostDegrees = 1e15;

/// The sine of an angle in degrees, within 3e-16; exact at quarter turns, where scenes meet them: nobody
/// wants 6e-17 where a 0 belongs. |x| < kMostDegrees.
inline double sine_of_near_degrees(double x) {
  const double half_turns = std::floor(x / 180 + 0.5), rest = x - 180 * half_turns, size = std::abs(rest);
  // Taylor's series of the sine up to 45 degrees, from there on of the cosine of what is left to 90.
  const double t = (size > 45 ? 90 - size : size) * (kPi / 180), z = t * t;
  const double sine =
      1 + z * (-1.0 / 6 +
               z * (1.0 / 120 + z * (-1.0 / 5040 +
                                     z * (1.0 / 362880 + z * (-1.0 / 39916800 +
                                                              z * (1.0 / 6227020800 - z / 1307674368000))))));
  const double cosine =
      1 + z * (-1.0 / 2 +
               z * (1.0 / 24 +
                    z * (-1.0 / 720 +
                         z * (1.0 / 40320 +
                              z * (-1.0 / 3628800 +
                                   z * (1.0 / 479001600 + z * (-1.0 / 87178291200 + z / 20922789888000)))))));
  const double value = size > 45 ? cosine : t * sine;
  const bool is_odd = half_turns != 2 * std::floor(0.5 * half_turns);
  return std::copysign(value, is_odd ? -rest : rest) + 0.0;  // no negative 0
}

inline double cosine_of_near_degrees(double x) { return sine_of_near_degrees(x + 90); }

/// Likewise of any angle; with a branch.
inline double sine_of_degrees(double x) {
  return sine_of_near_degrees(std::abs(x) < kMostDegrees ? x : std::fmod(x, 360));
}
inline double cosine_of_degrees(double x) {
  return cosine_of_near_degrees(std::abs(x) < kMostDegrees ? x : std::fmod(x, 360));
}

/// The logarithm to the base 2 of a normal number above 0, within 2e-7 of it and of 1.
inline float log2_of(float x) {
  // x is m 2^e, m between the square roots of 1/2 and 2; its logarithm an area hyperbolic tangent.
  constexpr std::int32_t kRootOfHalf = 0x3F3504F3, kMantissa = 0x007FFFFF;
  const std::int32_t bits = std::bit_cast<std::int32_t>(x) - kRootOfHalf;
  const auto e = static_cast<float>(bits >> 23);
  const float m = std::bit_cast<float>((bits & kMantissa) + kRootOfHalf);
  const float s = (m - 1) / (m + 1), z = s * s;
  constexpr float kScale = 2.8853901F;  // 2 / ln 2
  return e + kScale * s * (1 + z * (1.0F / 3 + z * (1.0F / 5 + z * (1.0F / 7 + z * (1.0F / 9)))));
}

/// 2 to the power of x, within 3e-7 of it; beyond single precision's normal numbers their ends.
inline float exp2_of(float x) {
  const float near = x > -126 ? x < 127 ? x : 127.0F : -126.0F;
  const float whole = std::floor(near + 0.5F);
  constexpr float kLn2 = 0.69314718F;
  const float t = kLn2 * (near - whole);
  const float part =
      1 + t * (1 + t * (1.0F / 2 +
                        t * (1.0F / 6 + t * (1.0F / 24 + t * (1.0F / 120 + t * (1.0F / 720 + t / 5040))))));
  const std::int32_t exponent = static_cast<std::int32_t>(whole) + 127;
  return part * std::bit_cast<float>(exponent << 23);
}

/// base to the power of `exponent`, both above 0; 0 where base is below 1e-30.
inline float power_of(float base, float exponent) {
  constexpr float kLeast = 1e-30F;
  const float result = exp2_of(exponent * log2_of(base > kLeast ? base : kLeast));
  return base > kLeast ? result : 0.0F;
}

}  // namespace raytracer
