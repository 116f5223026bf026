// Points for whole paths: as many pairs of numbers per path as it asks for, each pair evenly spread over the
// samples of a pixel and, so that what noise is left looks fine-grained, over the pixels of a neighbourhood.
//
// All samples of all pixels number off one Sobol' sequence along a Morton curve through the picture (Ahmed
// and Wonka 2020, "Screen-space blue-noise diffusion of Monte Carlo sampling error via hierarchical ordering
// of pixels"). Each pair of dimensions takes the sequence's first two, shuffled and scrambled by Owen's
// method anew
// ("padding"), with the hashes of Laine and Karras 2011. A block of 2^k neighbours along the curve always
// gets a (0, k, 2)-net. Loops over paths have no branches, so that compilers compute many at once.
#pragma once

#include <bit>
#include <span>

#include "sampling/sobol.hpp"
#include "sampling/sobol_matrices.hpp"

namespace raytracer {

namespace sampling {

/// The hash inside owen_scramble(), for numbers whose bits are reversed already.
constexpr std::uint32_t scramble_reversed(std::uint32_t x, std::uint32_t seed) {
  x ^= x * 0x3D20ADEAU;
  x += seed;
  x *= (seed >> 16U) | 1U;
  x ^= x * 0x05526C56U;
  x ^= x * 0x53A22864U;
  return x;
}

/// reverse_bits(sobol_second(x)) without a loop: the second dimension's matrix is Pascal's triangle modulo 2,
/// which is a product of five sparse ones.
constexpr std::uint32_t sobol_second_reversed(std::uint32_t x) {
  x ^= (x & 0xFFFF0000U) >> 16U;
  x ^= (x & 0xFF00FF00U) >> 8U;
  x ^= (x & 0xF0F0F0F0U) >> 4U;
  x ^= (x & 0xCCCCCCCCU) >> 2U;
  return x ^ ((x & 0xAAAAAAAAU) >> 1U);
}

/// Every second bit of a number that is x, the others 0.
constexpr std::uint32_t spread_bits(std::uint32_t x) {
  x &= 0xFFFFU;
  x = (x | x << 8U) & 0x00FF00FFU;
  x = (x | x << 4U) & 0x0F0F0F0FU;
  x = (x | x << 2U) & 0x33333333U;
  return (x | x << 1U) & 0x55555555U;
}

}  // namespace sampling

/// A path's number in the one sequence, its bits reversed, and the seed for what does not fit into 32 of
/// them.
struct PathNumber {
  std::uint32_t reversed = 0;
};

class PathPoints {
 public:
  /// `samples` per pixel are taken in all. Pictures of more than 2^32 samples repeat the sequence.
  PathPoints(int samples, std::uint32_t seed)
      : sample_bits_(static_cast<std::uint32_t>(std::bit_width(static_cast<std::uint32_t>(samples) - 1U))),
        seed_(hash_bits(seed ^ 0x5BD1E995U)) {}

  PathNumber number(int x, int y, int sample) const {
    const std::uint32_t curve = sampling::spread_bits(static_cast<std::uint32_t>(x)) |
                                sampling::spread_bits(static_cast<std::uint32_t>(y)) << 1U;
    const std::uint32_t first = sample_bits_ < 32 ? curve << sample_bits_ : 0;
    return {reverse_bits(first | static_cast<std::uint32_t>(sample))};
  }

  /// The pair `dimension` (0, 1, …) of each path, in [0, 1)^2.
  void fill(std::uint32_t dimension, std::span<const PathNumber> paths, std::span<Vector2f> points) const {
    const std::uint32_t shuffle = shuffle_of(dimension);
    const std::uint32_t first = hash_bits(shuffle ^ 0x85EBCA6BU), second = hash_bits(first ^ 0xC2B2AE35U);
    for (std::size_t i = 0; i < paths.size(); ++i) {
      const std::uint32_t index = reverse_bits(sampling::scramble_reversed(paths[i].reversed, shuffle));
      // The first dimension is the index reversed, and the scramble reverses it once more.
      points[i] = {unit_float(reverse_bits(sampling::scramble_reversed(index, first))),
                   unit_float(reverse_bits(
                       sampling::scramble_reversed(sampling::sobol_second_reversed(index), second)))};
    }
  }

  /// Likewise a pair that is spread together with the pair `dimension`. It may have several companions; to
  /// each other they mean nothing.
  void fill_companion(std::uint32_t dimension, std::uint32_t companion, std::span<const PathNumber> paths,
                      std::span<Vector2f> points) const {
    const std::uint32_t shuffle = shuffle_of(dimension);
    const std::uint32_t first = hash_bits(shuffle ^ hash_bits(0x27D4EB2FU + companion));
    const std::uint32_t second = hash_bits(first ^ 0xC2B2AE35U);
    for (std::size_t i = 0; i < paths.size(); ++i) {
      const std::uint32_t index = reverse_bits(sampling::scramble_reversed(paths[i].reversed, shuffle));
      points[i] = {
          unit_float(reverse_bits(sampling::scramble_reversed(sampling::sobol_companion<0>(index), first))),
          unit_float(reverse_bits(sampling::scramble_reversed(sampling::sobol_companion<1>(index), second)))};
    }
  }

 private:
  std::uint32_t shuffle_of(std::uint32_t dimension) const {
    return hash_bits(seed_ + 0x9E3779B9U * (dimension + 1));
  }

  std::uint32_t sample_bits_;
  std::uint32_t seed_;
};

}  // namespace raytracer
