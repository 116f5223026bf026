// Functions without branches against those of the standard library.
#include "core/lane_math.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "catch.hpp"

using namespace raytracer;

TEST_CASE("sines, logarithms and powers without branches are those of the standard library") {
  double sine = 0, logarithm = 0, exponential = 0, power = 0;
  for (int i = 0; i < 400000; ++i) {
    const float x = -40 + 2e-4F * static_cast<float>(i);
    const auto exact = static_cast<double>(x);
    sine = std::max(sine, std::abs(static_cast<double>(sine_of_turns(x)) - std::sin(2 * kPi * exact)));
    const double two_to = std::exp2(exact);
    exponential = std::max(exponential, std::abs(static_cast<double>(exp2_of(x)) / two_to - 1));
    const auto value = static_cast<float>(two_to);
    const double logarithm_of_value = std::log2(static_cast<double>(value));
    logarithm = std::max(logarithm, std::abs(static_cast<double>(log2_of(value)) - logarithm_of_value) /
                                        std::max(1.0, std::abs(logarithm_of_value)));
    const float share = (static_cast<float>(i) + 1) / 400001;
    power = std::max(power, std::abs(static_cast<double>(power_of(share, 2.5F)) -
                                     std::pow(static_cast<double>(share), 2.5)));
  }
  CHECK(sine < 2e-7);
  CHECK(exponential < 3e-7);
  CHECK(logarithm < 2e-7);
  CHECK(power < 5e-7);
}

TEST_CASE("sines of degrees are those of the standard library, and exact at quarter turns") {
  double worst = 0;
  for (int i = -200000; i <= 200000; ++i) {
    const double x = 0.0137 * i;
    worst = std::max(worst, std::abs(sine_of_degrees(x) - std::sin(std::remainder(x, 360) * (kPi / 180))));
  }
  CHECK(worst < 5e-16);
  for (int quarter = -9; quarter <= 9; ++quarter) {
    constexpr double kSines[] = {0, 1, 0, -1};
    CHECK(sine_of_degrees(90.0 * quarter) == kSines[(quarter + 12) % 4]);
    CHECK(cosine_of_degrees(90.0 * quarter) == kSines[(quarter + 13) % 4]);
  }
  CHECK(sine_of_degrees(36e16 + 64) == Approx(std::sin(64 * (kPi / 180))));
  CHECK(cosine_of_degrees(36e16 + 64) == Approx(std::cos(64 * (kPi / 180))));
  CHECK(std::abs(sine_of_degrees(1e300)) <= 1);
}

TEST_CASE("sines and powers keep their known points") {
  CHECK(sine_of_turns(0) == 0);
  CHECK(sine_of_turns(0.5F) == 0);
  CHECK(sine_of_turns(-3) == 0);
  CHECK(std::abs(sine_of_turns(0.25F) - 1) < 2e-7F);
  CHECK(exp2_of(0) == 1);
  CHECK(exp2_of(10) == 1024);
  CHECK(exp2_of(-1000) == 0x1p-126F);
  CHECK(log2_of(1) == 0);
  CHECK(power_of(0, 3) == 0);
  CHECK(power_of(1, 0.3F) == 1);
}
