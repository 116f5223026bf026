// Stored values as numbers.
#pragma once

#include <bit>
#include <cstdint>
#include <cstring>

#include "raytracer/vector3f.hpp"

namespace raytracer {

/// IEEE 754 binary16; its infinities and NaNs are those of float.
inline float float_from_half(std::uint16_t half) {
  const std::uint32_t sign = (half & 0x8000U) << 16U, rest = half & 0x7FFFU;
  if (rest >= 0x7C00U) return std::bit_cast<float>(sign | 0x7F800000U | (rest & 0x3FFU) << 13U);
  if (rest < 0x0400U) {  // the denormal ones are multiples of 2^-24, all of them normal floats
    const float size = static_cast<float>(rest) * 0x1p-24F;
    return sign != 0 ? -size : size;
  }
  return std::bit_cast<float>(sign | (rest + ((127U - 15U) << 10U)) << 13U);
}

/// Radiance's four bytes: three mantissas of 8 bits and an exponent beyond 128 for all; 0 is black (Ward
/// 1991, "Real Pixels"). As most readers have it, a mantissa m stands for m / 256, not for the middle of its
/// step.
inline Vector3f rgb_from_rgbe(const std::uint8_t* rgbe) {
  if (rgbe[3] == 0) return Vector3f(0);
  // 2^(e - 136) = 2^(e - 127) * 2^-9, the first from its bits; 255 is those of infinity.
  if (rgbe[3] == 255) return Vector3f(rgbe[0], rgbe[1], rgbe[2]) * 0x1p119F;
  const auto power = std::bit_cast<float>(static_cast<std::uint32_t>(rgbe[3]) << 23U);
  return Vector3f(rgbe[0], rgbe[1], rgbe[2]) * (power * 0x1p-9F);
}

template <class Number>
Number load(const std::uint8_t* bytes) {
  Number number;
  std::memcpy(&number, bytes, sizeof number);
  return number;
}

}  // namespace raytracer
