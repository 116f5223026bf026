// The points that paths take: evenly spread over a pixel's samples and over neighbouring pixels, independent
// between pairs.
#include "sampling/path_points.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "catch.hpp"

namespace {

using raytracer::PathNumber;
using raytracer::PathPoints;
using raytracer::Vector2f;

std::vector<Vector2f> points_of(const PathPoints& points, std::uint32_t pair,
                                const std::vector<PathNumber>& numbers) {
  std::vector<Vector2f> result(numbers.size());
  points.fill(pair, numbers, result);
  return result;
}

std::vector<PathNumber> numbers_of_pixel(const PathPoints& points, int x, int y, int samples) {
  std::vector<PathNumber> numbers;
  for (int i = 0; i < samples; ++i) numbers.push_back(points.number(x, y, i));
  return numbers;
}

// Whether every box of 2^-k x 2^(k - bits), for every k, holds exactly one of 2^bits points.
bool is_net(const std::vector<Vector2f>& points, int bits) {
  for (int k = 0; k <= bits; ++k) {
    std::vector<int> count(points.size());
    for (const Vector2f& p : points) {
      const auto column = static_cast<std::size_t>(p.x * static_cast<float>(1 << k));
      const auto row = static_cast<std::size_t>(p.y * static_cast<float>(1 << (bits - k)));
      ++count[(column << (bits - k)) + row];
    }
    for (const int n : count) {
      if (n != 1) return false;
    }
  }
  return true;
}

}  // namespace

TEST_CASE("the second dimension without a loop is the second dimension") {
  for (std::uint32_t i = 0; i < 10000; ++i) {
    const std::uint32_t x = raytracer::hash_bits(i);
    REQUIRE(raytracer::sampling::sobol_second_reversed(x) ==
            raytracer::reverse_bits(raytracer::sobol_second(x)));
  }
}

TEST_CASE("the samples of a pixel are a net in every pair") {
  const PathPoints points(64, 7);
  for (const auto& [x, y] : {std::pair{0, 0}, {5, 9}, {1919, 1079}}) {
    const std::vector<PathNumber> numbers = numbers_of_pixel(points, x, y, 64);
    for (std::uint32_t pair = 0; pair < 40; ++pair) REQUIRE(is_net(points_of(points, pair, numbers), 6));
  }
}

TEST_CASE("the first samples of blocks of pixels are a net too") {
  const PathPoints points(1, 3);
  std::vector<PathNumber> numbers;
  for (int y = 8; y < 16; ++y) {
    for (int x = 16; x < 24; ++x) numbers.push_back(points.number(x, y, 0));
  }
  for (std::uint32_t pair = 0; pair < 20; ++pair) REQUIRE(is_net(points_of(points, pair, numbers), 6));
}

TEST_CASE("pairs, seeds and pixels have points of their own") {
  const PathPoints points(256, 0), others(256, 1);
  const auto numbers = numbers_of_pixel(points, 3, 4, 256), neighbours = numbers_of_pixel(points, 4, 4, 256);
  const auto correlation = [](const std::vector<Vector2f>& a, const std::vector<Vector2f>& b) {
    double sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
      sum += (static_cast<double>(a[i].x) - 0.5) * (static_cast<double>(b[i].x) - 0.5);
    }
    return 12 * sum / static_cast<double>(a.size());
  };
  const auto first = points_of(points, 2, numbers);
  // The standard deviation of the correlation of 256 independent pairs is 1/16.
  CHECK(std::abs(correlation(first, points_of(points, 3, numbers))) < 0.25);
  CHECK(std::abs(correlation(first, points_of(others, 2, numbers_of_pixel(others, 3, 4, 256)))) < 0.25);
  CHECK(std::abs(correlation(first, points_of(points, 2, neighbours))) < 0.25);
  CHECK(correlation(first, first) > 0.9);
}

// How many of the 4^4 boxes of a grid in four dimensions hold one of 256 points.
int boxes_taken(const std::vector<Vector2f>& a, const std::vector<Vector2f>& b) {
  std::vector<bool> taken(256);
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t box = 0;
    for (const float x : {a[i].x, a[i].y, b[i].x, b[i].y}) box = 4 * box + static_cast<std::size_t>(4 * x);
    taken[box] = true;
  }
  return static_cast<int>(std::count(taken.begin(), taken.end(), true));
}

TEST_CASE("companions are evenly spread in each dimension and in four") {
  const PathPoints points(256, 5);
  for (const auto& [x, y] : {std::pair{0, 0}, {5, 9}, {1919, 1079}}) {
    const std::vector<PathNumber> numbers = numbers_of_pixel(points, x, y, 256);
    const std::vector<Vector2f> pair = points_of(points, 4, numbers), other = points_of(points, 5, numbers);
    // Of boxes that points take at random a share 1 / e stays empty.
    CHECK(boxes_taken(pair, other) < 190);
    for (const std::uint32_t companion : {0U, 2U}) {
      std::vector<Vector2f> beside(numbers.size());
      points.fill_companion(4, companion, numbers, beside);
      CHECK(boxes_taken(pair, beside) == 256);
      for (const int axis : {0, 1}) {
        std::vector<int> count(256);
        for (const Vector2f& p : beside) ++count[static_cast<std::size_t>(256 * p[axis])];
        CHECK(count == std::vector<int>(256, 1));
      }
    }
  }
}

TEST_CASE("pictures of more than 2^32 samples still get points") {
  const PathPoints points(1 << 20, 0);
  const auto numbers = numbers_of_pixel(points, 60000, 50000, 16);
  REQUIRE(is_net(points_of(points, 5, numbers), 4));
}
