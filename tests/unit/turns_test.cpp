// Angles without calls: as good as the library's.
#include "core/turns.hpp"

#include <cmath>

#include "catch.hpp"

using raytracer::angle_of;
using raytracer::kPi;
using raytracer::Turn;
using raytracer::turn_by;

TEST_CASE("turns agree with the library's sine and cosine") {
  for (int i = 0; i <= 100000; ++i) {
    const double angle = 2 * kPi * i / 100000;
    const Turn turn = turn_by(angle);
    REQUIRE(std::abs(turn.cosine - std::cos(angle)) < 1e-13);
    REQUIRE(std::abs(turn.sine - std::sin(angle)) < 1e-13);
  }
}

TEST_CASE("a turn tells its angle, small ones with all their digits") {
  for (int i = 1; i < 100000; ++i) {
    const double angle = 2 * kPi * i / 100000;
    REQUIRE(std::abs(angle_of({std::cos(angle), std::sin(angle)}) - angle) < 1e-11);
  }
  for (double angle = 1e-12; angle < 3; angle *= 1.01) {
    REQUIRE(std::abs(angle_of({std::cos(angle), std::sin(angle)}) / angle - 1) < 1e-11);
  }
  CHECK(angle_of({1, 0}) == 0);
}
