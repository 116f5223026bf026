// The dimensions of Sobol's sequence beyond the first two, for points of more dimensions than a pair has.
#pragma once

#include <array>
#include <cstdint>
#include <utility>

#include "sampling/sobol.hpp"

namespace raytracer::sampling {

/// The columns of a dimension's matrix: number `index` of the sequence is the sum modulo 2 of the columns
/// whose bits are set in it, as a 32-bit fraction with its bits reversed, as scrambles want it.
using SobolMatrix = std::array<std::uint32_t, 32>;

/// The degree of a primitive polynomial, its inner
/// coefficients as bits, and the first numbers m, as S. Joe and F. Y. Kuo have them ("Constructing Sobol
/// sequences with better two-dimensional projections", SIAM J. Sci. Comput. 30(5), 2008).
struct SobolDimension {
  std::uint32_t degree, coefficients;
  std::array<std::uint32_t, 4> first;
};

constexpr SobolMatrix sobol_matrix(const SobolDimension& dimension) {
  SobolMatrix columns{};
  const std::uint32_t degree = dimension.degree;
  for (std::uint32_t i = 0; i < 32; ++i) {
    if (i < degree) {
      columns[i] = dimension.first[i] << (31 - i);
      continue;
    }
    columns[i] = columns[i - degree] ^ (columns[i - degree] >> degree);
    for (std::uint32_t k = 1; k < degree; ++k) {
      if ((dimension.coefficients >> (degree - 1 - k) & 1U) != 0) columns[i] ^= columns[i - k];
    }
  }
  for (std::uint32_t& column : columns) column = reverse_bits(column);
  return columns;
}

/// Two dimensions that stand beside the first two: of all that polynomials of up to degree 6 give, they leave
/// the fewest boxes of 2^-a x 2^-b x 2^-c x 2^-d empty of 2^(a + b + c + d) points, for 16 to 1024 points.
inline constexpr std::array<SobolMatrix, 2> kSobolCompanions = {sobol_matrix({3, 1, {1, 1, 3}}),
                                                                sobol_matrix({2, 1, {1, 3}})};

/// Written out by the compiler, so that loops over indices compute many at once.
template <std::size_t kMatrix, std::size_t... kColumns>
constexpr std::uint32_t sobol_companion(std::uint32_t index, std::index_sequence<kColumns...> /*all*/) {
  return (... ^ (kSobolCompanions[kMatrix][kColumns] & (0U - (index >> kColumns & 1U))));
}
template <std::size_t kMatrix>
constexpr std::uint32_t sobol_companion(std::uint32_t index) {
  return sobol_companion<kMatrix>(index, std::make_index_sequence<32>());
}

}  // namespace raytracer::sampling
