#include "lights/sphere_distribution.hpp"

#include <algorithm>
#include <cmath>

#include "core/numeric.hpp"
#include "core/parallel.hpp"

namespace raytracer {

namespace {

constexpr double kShareOfCompensated = 0.75;

/// Cosine of the polar angle where a row begins.
double cosine_above(std::size_t row, std::size_t rows) {
  if (row == rows) return -1;
  return std::cos(kPi * static_cast<double>(row) / static_cast<double>(rows));
}

double height_of_row(std::size_t row, std::size_t rows) {
  // Free of cancellation at the poles: cos a - cos b = 2 sin((a + b) / 2) sin((b - a) / 2).
  const double half = 0.5 * kPi / static_cast<double>(rows);
  return 2 * std::sin(half * static_cast<double>(2 * row + 1)) * std::sin(half);
}

std::size_t cell_at(float share, std::size_t count) {
  const float place = share * static_cast<float>(count);
  return place > 0 ? std::min(static_cast<std::size_t>(place), count - 1) : 0;
}

/// The first whose sum is above u, and where between its neighbours u stands.
template <class T>
std::size_t chosen(const T* sums, std::size_t count, double u, double& rest) {
  const T* at = std::upper_bound(sums, sums + count - 1, static_cast<T>(u));
  const double low = at == sums ? 0.0 : static_cast<double>(at[-1]);
  const double width = static_cast<double>(*at) - low;
  rest = width > 0 ? std::clamp((u - low) / width, 0.0, 1.0) : 0.5;
  return static_cast<std::size_t>(at - sums);
}

}  // namespace

Vector2f place_of_direction(const Vector3f& direction) {
  const auto turn = static_cast<float>(1 / (2 * kPi));
  float column = std::atan2(direction.x, -direction.z) * turn;
  if (column < 0) column += 1;
  if (!(column < 1)) column = 0;
  // By atan2, since acos knows little near the poles.
  const float across = std::hypot(direction.x, direction.z);
  return {column, 2 * turn * std::atan2(across, direction.y)};
}

SphereDistribution::SphereDistribution(int columns, int rows, std::vector<float> weights)
    : columns_(static_cast<std::size_t>(columns)),
      rows_(static_cast<std::size_t>(rows)),
      sums_(std::move(weights)) {
  std::vector<double> row_totals(rows_);
  parallel_for(rows_, [&](std::size_t row) {
    double sum = 0;
    const float* cells = sums_.data() + row * columns_;
    for (std::size_t i = 0; i < columns_; ++i) sum += static_cast<double>(cells[i]);
    row_totals[row] = sum * height_of_row(row, rows_);
  });
  double total = 0;
  for (const double one : row_totals) total += one;
  if (!(total > 0) || !std::isfinite(total)) {
    sums_.clear();
    return;
  }
  const double mean = total / (2 * static_cast<double>(columns_));  // the heights add up to 2

  const auto excess_of_row = [&](const float* cells) {
    double sum = 0;
    for (std::size_t i = 0; i < columns_; ++i) sum += std::max(static_cast<double>(cells[i]) - mean, 0.0);
    return sum;
  };
  std::vector<double> row_excess(rows_);
  parallel_for(rows_, [&](std::size_t row) {
    row_excess[row] = excess_of_row(sums_.data() + row * columns_) * height_of_row(row, rows_);
  });
  double excess = 0;
  for (const double one : row_excess) excess += one;
  const double for_excess = excess > 1e-6 * total ? kShareOfCompensated / excess : 0;
  const double for_all = (for_excess > 0 ? 1 - kShareOfCompensated : 1) / total;

  row_sums_.resize(rows_);
  parallel_for(rows_, [&](std::size_t row) {
    float* cells = sums_.data() + row * columns_;
    double sum = 0;
    for (std::size_t i = 0; i < columns_; ++i) {
      const auto weight = static_cast<double>(cells[i]);
      sum += for_excess * std::max(weight - mean, 0.0) + for_all * weight;
    }
    row_sums_[row] = sum * height_of_row(row, rows_);
    const double scale = sum > 0 ? 1 / sum : 0;
    double so_far = 0;
    for (std::size_t i = 0; i < columns_; ++i) {
      const auto weight = static_cast<double>(cells[i]);
      so_far += for_excess * std::max(weight - mean, 0.0) + for_all * weight;
      cells[i] = static_cast<float>(so_far * scale);
    }
    if (sum > 0) cells[columns_ - 1] = 1;
  });
  double so_far = 0;
  for (double& one : row_sums_) one = so_far += one;
  for (double& one : row_sums_) one /= so_far;
}

float SphereDistribution::density(std::size_t row, std::size_t column) const {
  const float* cells = sums_.data() + row * columns_;
  const float share = cells[column] - (column > 0 ? cells[column - 1] : 0);
  const double row_share = row_sums_[row] - (row > 0 ? row_sums_[row - 1] : 0);
  const double solid_angle = 2 * kPi / static_cast<double>(columns_) * height_of_row(row, rows_);
  return static_cast<float>(row_share * static_cast<double>(share) / solid_angle);
}

void SphereDistribution::sample(const Vector2f& u, Vector3f& direction, float& pdf) const {
  double down, around;
  const std::size_t row = chosen(row_sums_.data(), rows_, static_cast<double>(u.y), down);
  const std::size_t column =
      chosen(sums_.data() + row * columns_, columns_, static_cast<double>(u.x), around);
  const double y = cosine_above(row, rows_) - down * height_of_row(row, rows_);
  const double across = std::sqrt(std::max(1 - y * y, 0.0));
  const double angle = 2 * kPi * (static_cast<double>(column) + around) / static_cast<double>(columns_);
  direction = Vector3f(Vector3d(std::sin(angle) * across, y, -std::cos(angle) * across));
  pdf = density(row, column);
}

float SphereDistribution::pdf(const Vector3f& direction) const {
  if (is_empty()) return 0;
  const Vector2f place = place_of_direction(direction);
  return density(cell_at(place.y, rows_), cell_at(place.x, columns_));
}

}  // namespace raytracer
