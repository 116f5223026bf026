// Choosing directions in proportion to a table over the sphere.
#pragma once

#include <cstddef>
#include <vector>

#include "raytracer/vector3f.hpp"

namespace raytracer {

/// Where a direction (unit length) stands in a picture of all directions, as EnvironmentPicture has it:
/// column in [0, 1), row in [0, 1].
Vector2f place_of_direction(const Vector3f& direction);

/// Cells of equal angles around and from pole to pole; within a cell all directions are as likely. Rows are
/// chosen by the second number, columns by the first, so that evenly spread points stay so. Immutable.
class SphereDistribution {
 public:
  SphereDistribution() = default;
  /// `weights` (not negative, row by row from the top, columns as EnvironmentPicture has them) are how much
  /// each cell is worth per solid angle.
  ///
  /// What is about the mean is found well enough by sampling materials: of the choice three quarters go to
  /// what a cell has above the mean, O. Karlik, M. Šik, P. Vévoda, T. Skřivan, J. Křivánek, "MIS
  /// Compensation: Optimizing Sampling Techniques in Multiple Importance Sampling", ACM TOG 38(6), 2019; the
  /// rest to the cells as they are, so that sampling it alone still finds everything.
  SphereDistribution(int columns, int rows, std::vector<float> weights);

  bool is_empty() const { return sums_.empty(); }  ///< there is nothing to choose

  void sample(const Vector2f& u, Vector3f& direction, float& pdf) const;
  float pdf(const Vector3f& direction) const;

 private:
  float density(std::size_t row, std::size_t column) const;

  std::size_t columns_ = 0, rows_ = 0;
  std::vector<float> sums_;       // of each row, up to and with each cell; the last is 1
  std::vector<double> row_sums_;  // likewise of the rows
};

}  // namespace raytracer
