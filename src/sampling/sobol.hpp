// Points that fill the unit square evenly however many are taken: the first two dimensions of Sobol's
// sequence, each pixel's with a scramble of its own (Owen 1995), by hashing (Laine and Karras 2011,
// "Stratified sampling for stochastic transparency", with the constants of Vegdahl 2021).
#pragma once

#include <cstdint>

#include "raytracer/vector3f.hpp"

namespace raytracer {

constexpr std::uint32_t reverse_bits(std::uint32_t x) {
  x = ((x >> 1U) & 0x55555555U) | ((x & 0x55555555U) << 1U);
  x = ((x >> 2U) & 0x33333333U) | ((x & 0x33333333U) << 2U);
  x = ((x >> 4U) & 0x0F0F0F0FU) | ((x & 0x0F0F0F0FU) << 4U);
  x = ((x >> 8U) & 0x00FF00FFU) | ((x & 0x00FF00FFU) << 8U);
  return (x >> 16U) | (x << 16U);
}

/// A well-mixed 32-bit hash (the finaliser of MurmurHash3, Appleby).
constexpr std::uint32_t hash_bits(std::uint32_t x) {
  x = (x ^ (x >> 16U)) * 0x85EBCA6BU;
  x = (x ^ (x >> 13U)) * 0xC2B2AE35U;
  return x ^ (x >> 16U);
}

/// Owen's nested scramble of the bits of x, the highest first.
constexpr std::uint32_t owen_scramble(std::uint32_t x, std::uint32_t seed) {
  x = reverse_bits(x);
  x ^= x * 0x3D20ADEAU;
  x += seed;
  x *= (seed >> 16U) | 1U;
  x ^= x * 0x05526C56U;
  x ^= x * 0x53A22864U;
  return reverse_bits(x);
}

/// The second dimension of Sobol's sequence as a 32-bit fraction; the first is reverse_bits(index).
constexpr std::uint32_t sobol_second(std::uint32_t index) {
  std::uint32_t result = 0;
  for (std::uint32_t direction = 1U << 31U; index != 0; index >>= 1U, direction ^= direction >> 1U) {
    if ((index & 1U) != 0) result ^= direction;
  }
  return result;
}

/// The upper 24 bits as a number in [0, 1).
constexpr float unit_float(std::uint32_t bits) { return static_cast<float>(bits >> 8U) * 0x1p-24F; }

/// Point `index` of the sequence before any scramble, as two 32-bit fractions.
struct SobolBits {
  std::uint32_t x, y;
  constexpr explicit SobolBits(std::uint32_t index) : x(reverse_bits(index)), y(sobol_second(index)) {}
};

/// That point of the sequence that belongs to `seed`, in [0, 1)^2. Without branches, for blocks of pixels.
constexpr Vector2f sobol_point(const SobolBits& bits, std::uint32_t seed) {
  // The second seed is a hash of the first: hashes of two numbers that differ by a constant are not
  // independent enough.
  const std::uint32_t first = hash_bits(seed), second = hash_bits(first ^ 0x9E3779B9U);
  return {unit_float(owen_scramble(bits.x, first)), unit_float(owen_scramble(bits.y, second))};
}
constexpr Vector2f sobol_point(std::uint32_t index, std::uint32_t seed) {
  return sobol_point(SobolBits(index), seed);
}

}  // namespace raytracer
