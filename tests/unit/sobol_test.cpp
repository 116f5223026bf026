#include "sampling/sobol.hpp"

#include <cstdint>
#include <set>
#include <vector>

#include "catch.hpp"

using raytracer::sobol_point;
using raytracer::Vector2f;

namespace {

/// Whether each rectangle of 2^-a by 2^-b of the unit square holds exactly one of the 2^(a + b) points.
bool has_one_point_each(const std::vector<Vector2f>& points, std::uint32_t a, std::uint32_t b) {
  std::vector<bool> taken(points.size(), false);
  for (const Vector2f& p : points) {
    const auto column = static_cast<std::size_t>(p.x * static_cast<float>(1U << a));
    const auto row = static_cast<std::size_t>(p.y * static_cast<float>(1U << b));
    const std::size_t cell = (row << a) + column;
    if (cell >= taken.size() || taken[cell]) return false;
    taken[cell] = true;
  }
  return true;
}

}  // namespace

TEST_CASE("every power of two of points is a (0, 2)-net", "[sobol]") {
  for (const std::uint32_t seed : {0U, 1U, 2U, 12345U, 0x80000000U, 0xFFFFFFFFU}) {
    std::vector<Vector2f> points;
    for (std::uint32_t log_count = 0; log_count <= 10; ++log_count) {
      while (points.size() < (std::size_t{1} << log_count)) {
        points.push_back(sobol_point(static_cast<std::uint32_t>(points.size()), seed));
      }
      for (std::uint32_t a = 0; a <= log_count; ++a) {
        INFO("seed " << seed << ", " << points.size() << " points, columns 2^" << a);
        REQUIRE(has_one_point_each(points, a, log_count - a));
      }
    }
  }
}

TEST_CASE("later stretches of the sequence are nets too", "[sobol]") {
  constexpr std::uint32_t kCount = 64;
  for (std::uint32_t stretch = 1; stretch < 200; ++stretch) {
    std::vector<Vector2f> points;
    for (std::uint32_t i = 0; i < kCount; ++i) points.push_back(sobol_point(stretch * kCount + i, 7));
    for (std::uint32_t a = 0; a <= 6; ++a) REQUIRE(has_one_point_each(points, a, 6 - a));
  }
}

TEST_CASE("points are in the half-open unit square, the last of them too", "[sobol]") {
  for (std::uint32_t i = 0; i < 100000; ++i) {
    const Vector2f p = sobol_point(0xFFFFFFFFU - i, i);
    REQUIRE((p.x >= 0 && p.x < 1 && p.y >= 0 && p.y < 1));
  }
  REQUIRE(raytracer::unit_float(0xFFFFFFFFU) < 1);
  REQUIRE(raytracer::unit_float(0) == 0);
}

TEST_CASE("the unscrambled second dimension is Sobol's", "[sobol]") {
  // By hand from the primitive polynomial x + 1 with m = 1, the first eight.
  const double expected[] = {0, 0.5, 0.75, 0.25, 0.625, 0.125, 0.375, 0.875};
  for (std::uint32_t i = 0; i < 8; ++i) {
    REQUIRE(raytracer::sobol_second(i) * 0x1p-32 == expected[i]);
  }
}

TEST_CASE("each seed has points of its own", "[sobol]") {
  std::set<std::pair<float, float>> first_points;
  for (std::uint32_t seed = 0; seed < 1000; ++seed) {
    const Vector2f p = sobol_point(0, seed);
    first_points.insert({p.x, p.y});
  }
  REQUIRE(first_points.size() == 1000);
}

TEST_CASE("over all seeds a point is everywhere alike often", "[sobol]") {
  constexpr std::uint32_t kSeeds = 65536;
  for (const std::uint32_t index : {0U, 1U, 5U, 7U, 100U}) {
    std::vector<double> counts(64, 0.0);
    for (std::uint32_t seed = 0; seed < kSeeds; ++seed) {
      const Vector2f p = sobol_point(index, seed);
      counts[static_cast<std::size_t>(p.x * 8) * 8 + static_cast<std::size_t>(p.y * 8)] += 1;
    }
    const double expected = kSeeds / 64.0;
    double chi_square = 0;
    for (const double count : counts) chi_square += (count - expected) * (count - expected) / expected;
    INFO("point " << index << ": chi-square " << chi_square);
    REQUIRE(chi_square < 103);  // with 63 degrees of freedom exceeded by chance once in a thousand
    REQUIRE(chi_square > 33);
  }
}
