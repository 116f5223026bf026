// Angles as points of the unit circle, and what that costs least: no branches and no calls, so that loops
// over many of them become the processor's own vectors.
#pragma once

#include <cmath>

#include "core/numeric.hpp"

namespace raytracer {

/// A number on the unit circle of the complex plane; a product has the sum of the angles.
struct Turn {
  double cosine, sine;

  Turn operator*(const Turn& other) const {
    return {cosine * other.cosine - sine * other.sine, cosine * other.sine + sine * other.cosine};
  }
  Turn conjugate() const { return {cosine, -sine}; }
};

/// The turn by an angle from 0 to 2 pi, within 1e-13: Taylor's series about the nearest quarter.
[[gnu::always_inline]] inline Turn turn_by(double angle) {
  const double quarters = angle * (2 / kPi) + 0.5;
  const auto quarter = static_cast<int>(quarters < 5 ? quarters : 0.0);  // what is no angle stays none
  const double x = angle - static_cast<double>(quarter) * (kPi / 2), x2 = x * x;
  const double sine =
      x * (1 + x2 * (-1.0 / 6 +
                     x2 * (1.0 / 120 + x2 * (-1.0 / 5040 + x2 * (1.0 / 362880 + x2 * (-1.0 / 39916800 +
                                                                                      x2 / 6227020800.0))))));
  const double cosine =
      1 + x2 * (-0.5 + x2 * (1.0 / 24 +
                             x2 * (-1.0 / 720 +
                                   x2 * (1.0 / 40320 + x2 * (-1.0 / 3628800 +
                                                             x2 * (1.0 / 479001600 - x2 / 87178291200.0))))));
  const bool is_odd = (quarter & 1) != 0;
  const double a = is_odd ? sine : cosine, b = is_odd ? cosine : sine;
  const bool is_left = (quarter == 1) | (quarter == 2), is_lower = (quarter == 2) | (quarter == 3);
  return {is_left ? -a : a, is_lower ? -b : b};
}

/// The angle of a turn, from 0 to 2 pi; of a small one with all its digits, within 1e-12 of itself. Thrice
/// halved, then Taylor's series of the arc tangent.
[[gnu::always_inline]] inline double angle_of(const Turn& turn) {
  // Half of it, up to pi, by the better conditioned of its two coordinates first.
  const double larger = std::sqrt(0.5 * (1 + std::abs(turn.cosine)));
  const double smaller = 0.5 * std::abs(turn.sine) / larger;
  const bool is_right = turn.cosine > 0;
  const double half_sine = is_right ? smaller : larger, half_cosine = is_right ? larger : smaller;
  const bool is_half_obtuse = turn.sine < 0;
  // The tangents of a quarter of it, or of what it lacks to a right angle, and of a quarter of that.
  const double t = half_sine / (1 + half_cosine);
  const double t2 = t / (1 + std::sqrt(1 + t * t)), t3 = t2 / (1 + std::sqrt(1 + t2 * t2)), s = t3 * t3;
  const double arc =
      t3 *
      (1 + s * (-1.0 / 3 +
                s * (1.0 / 5 +
                     s * (-1.0 / 7 + s * (1.0 / 9 + s * (-1.0 / 11 + s * (1.0 / 13 - s * (1.0 / 15))))))));
  return is_half_obtuse ? 2 * kPi - 16 * arc : 16 * arc;
}

}  // namespace raytracer
