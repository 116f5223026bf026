#include "scene_file/placing.hpp"

#include <cmath>

#include "core/lane_math.hpp"

namespace raytracer::scene_file {
namespace {

glm::dmat3 rotation_about(const Vector3d& axis, double degrees) {
  // Rodrigues' formula as a matrix; glm's columns are written one per line.
  const Vector3d n = glm::normalize(axis);
  const double s = sine_of_degrees(degrees), c = cosine_of_degrees(degrees);
  const Vector3d m = (1 - c) * n;
  return {Vector3d(m.x * n.x + c, m.x * n.y + s * n.z, m.x * n.z - s * n.y),
          Vector3d(m.y * n.x - s * n.z, m.y * n.y + c, m.y * n.z + s * n.x),
          Vector3d(m.z * n.x + s * n.y, m.z * n.y - s * n.x, m.z * n.z + c)};
}

Vector3d vector_of(const Argument& a) { return {a.numbers[0], a.numbers[1], a.numbers[2]}; }

Transform matrix_of(const Argument& a) {
  Transform transform;
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) {
      transform.linear[column][row] = a.numbers[static_cast<std::size_t>(4 * row + column)];
    }
    transform.translation[row] = a.numbers[static_cast<std::size_t>(4 * row + 3)];
  }
  return transform;
}

bool is_flat(const glm::dmat3& m) {
  const double volume = glm::length(m[0]) * glm::length(m[1]) * glm::length(m[2]);
  return !(std::abs(glm::determinant(m)) > 1e-12 * volume);
}

}  // namespace

Transform PlacingWords::about(const Vector3d& spot) const {
  if (matrix) return *matrix;
  const Vector3d fixed = pivot.value_or(spot);
  return {linear, fixed - linear * fixed + translation};
}

std::string add_placing(std::string_view word, const Argument& argument, PlacingWords& placing) {
  if (word == "translate") {
    placing.translation += vector_of(argument);
  } else if (word == "rotate") {
    const Vector3d turns = vector_of(argument);
    placing.linear = rotation_about({0, 0, 1}, turns.z) * rotation_about({0, 1, 0}, turns.y) *
                     rotation_about({1, 0, 0}, turns.x) * placing.linear;
  } else if (word == "rotate_axis") {
    if (glm::length(vector_of(argument)) == 0) return "the axis of 'rotate_axis' has no length";
    placing.linear = rotation_about(vector_of(argument), argument.numbers[3]) * placing.linear;
  } else if (word == "scale") {
    const Vector3d factors = vector_of(argument);
    if (factors.x == 0 || factors.y == 0 || factors.z == 0) return "'scale' must not be 0";
    for (int column = 0; column < 3; ++column) placing.linear[column] *= factors;
  } else if (word == "pivot") {
    placing.pivot = vector_of(argument);
  } else {
    placing.matrix = matrix_of(argument);
    if (is_flat(placing.matrix->linear)) return "'matrix' is flat: it can't be inverted";
  }
  return {};
}

}  // namespace raytracer::scene_file
