// Whether directions are distributed as a density says.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <vector>

#include "raytracer/vector3f.hpp"
#include "sampling/hemisphere.hpp"

namespace sphere_statistics {

using raytracer::Vector3f;

constexpr double kTurn = 6.283185307179586;

/// The whole sphere cut into cells about an axis, small ones near it: even in t / (t + scale^2) with t the
/// square of the tangent of half the angle to the axis, and in the angle around. A density is asked at 8^2
/// points of each, twice as many along both axes for each of `refinements`, and more where it varies.
class Cells {
 public:
  static constexpr int kRings = 24, kSectors = 24;

  Cells(const Vector3f& axis, float scale) : axis_(axis), scale2_(double(scale) * double(scale)) {
    raytracer::complete_frame(axis_, first_, second_);
  }

  static int count() { return kRings * kSectors; }

  int of(const Vector3f& direction) const {
    const double x = glm::dot(direction, first_), y = glm::dot(direction, second_);
    const double z = glm::dot(direction, axis_);
    const double t = z > 0 ? (x * x + y * y) / ((1 + z) * (1 + z)) : (1 - z) * (1 - z) / (x * x + y * y);
    const double q = t < 1e30 ? t / (t + scale2_) : 1, turn = std::atan2(y, x) / kTurn + 0.5;
    return std::min(kRings - 1, int(q * kRings)) * kSectors + std::min(kSectors - 1, int(turn * kSectors));
  }

  /// The integral of a density of directions over each cell, to half a percent: by 8^2 points in each and
  /// more where it varies. Where many of the `counts` fell, a narrow peak may hide between those: there by
  /// 64^2.
  std::vector<double> integrals(const std::function<double(const Vector3f&)>& density,
                                const std::vector<double>& counts) const {
    std::vector<double> result;
    for (int r = 0; r < kRings; ++r) {
      for (int s = 0; s < kSectors; ++s) {
        const Patch patch{double(r) / kRings, double(s) / kSectors, 1.0 / kRings, 1.0 / kSectors};
        result.push_back(refined(density, patch, sum(density, patch), counts[result.size()] > 100 ? -3 : 0));
      }
    }
    return result;
  }

 private:
  /// A part of the unit square that the sphere is cut open to.
  struct Patch {
    double q, turn, width, height;
  };

  /// By 4 x 4 points.
  double sum(const std::function<double(const Vector3f&)>& density, const Patch& patch) const {
    double result = 0;
    for (int r = 0; r < 4; ++r) {
      const double q = patch.q + patch.width * (r + 0.5) / 4, t = scale2_ * q / (1 - q);
      const double z = (1 - t) / (1 + t), sine = std::sqrt(std::max(0.0, 1 - z * z));
      const double steradian = 2 * kTurn * scale2_ / ((1 + t) * (1 + t) * (1 - q) * (1 - q));
      for (int s = 0; s < 4; ++s) {
        const double angle = kTurn * (patch.turn + patch.height * (s + 0.5) / 4 - 0.5);
        result += steradian * density(float(sine * std::cos(angle)) * first_ +
                                      float(sine * std::sin(angle)) * second_ + float(z) * axis_);
      }
    }
    return result / 16 * patch.width * patch.height;
  }

  double refined(const std::function<double(const Vector3f&)>& density, const Patch& patch, double coarse,
                 int depth) const {
    const double width = patch.width / 2, height = patch.height / 2;
    std::array<Patch, 4> parts{{{patch.q, patch.turn, width, height},
                                {patch.q + width, patch.turn, width, height},
                                {patch.q, patch.turn + height, width, height},
                                {patch.q + width, patch.turn + height, width, height}}};
    std::array<double, 4> sums{};
    double fine = 0;
    for (std::size_t k = 0; k < 4; ++k) fine += sums[k] = sum(density, parts[k]);
    if (depth >= 5 || (depth >= 0 && std::abs(fine - coarse) < 1e-5 + 3e-3 * fine)) return fine;
    fine = 0;
    for (std::size_t k = 0; k < 4; ++k) fine += refined(density, parts[k], sums[k], depth + 1);
    return fine;
  }

  Vector3f axis_, first_, second_;
  double scale2_;
};

/// The level of each of n independent tests that together fail by chance once in a hundred times (Sidak).
inline double sidak_level(int tests) { return 1 - std::pow(1 - 0.01, 1.0 / tests); }

/// The probability that counts deviate from what is expected as much as these, by chance (Pearson's
/// chi-square; the tail by Wilson and Hilferty). Cells where less than 5 are expected are pooled.
inline double chi_square_probability(const std::vector<double>& counts, const std::vector<double>& expected) {
  double sum = 0, pooled_count = 0, pooled_expected = 0;
  int cells = 0;
  const auto add = [&](double count, double expectation) {
    sum += (count - expectation) * (count - expectation) / expectation;
    ++cells;
  };
  for (std::size_t k = 0; k < counts.size(); ++k) {
    if (expected[k] >= 5) {
      add(counts[k], expected[k]);
      continue;
    }
    pooled_count += counts[k];
    pooled_expected += expected[k];
    if (pooled_expected >= 5) {
      add(pooled_count, pooled_expected);
      pooled_count = pooled_expected = 0;
    }
  }
  if (pooled_expected < 0.5 && pooled_count > 5) return 0;  // where nothing ever should be
  const double freedom = std::max(1, cells - 1), a = 2 / (9 * freedom);
  return 0.5 * std::erfc((std::cbrt(sum / freedom) - (1 - a)) / std::sqrt(2 * a));
}

}  // namespace sphere_statistics
