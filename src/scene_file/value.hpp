// What an expression computes.
#pragma once

#include <cstdint>
#include <string_view>

#include "raytracer/vector3f.hpp"

namespace raytracer::scene_file {

enum class ValueType : std::uint8_t {
  kUnknown,  ///< the expression was wrong, which has been reported; whatever is made of it is unknown too
  kNumber,
  kBoolean,
  kVector,
  kColor,  ///< a vector that was written as a colour
  kString,
};

struct Value {
  ValueType type = ValueType::kUnknown;
  bool is_display =
      false;  ///< a colour as a display shows it (#rrggbb, a name, hsv), untouched by arithmetic
  bool depends_on_time = false;
  Vector3d vector{0};     ///< x alone of a number; 0 or 1 of a boolean
  std::string_view text;  ///< of a string; lives as long as the scene's sources

  static Value number(double x) { return {ValueType::kNumber, false, false, Vector3d(x, 0, 0), {}}; }
  static Value boolean(bool b) { return {ValueType::kBoolean, false, false, Vector3d(b ? 1 : 0, 0, 0), {}}; }
  static Value of_vector(const Vector3d& v) { return {ValueType::kVector, false, false, v, {}}; }
  static Value color(const Vector3d& v) { return {ValueType::kColor, false, false, v, {}}; }
  static Value display_color(const Vector3d& v) { return {ValueType::kColor, true, false, v, {}}; }
  static Value string(std::string_view s) { return {ValueType::kString, false, false, Vector3d(0), s}; }

  double x() const { return vector.x; }
  bool is_known() const { return type != ValueType::kUnknown; }
  bool is_number() const { return type == ValueType::kNumber; }
  bool is_boolean() const { return type == ValueType::kBoolean; }
  bool is_vector() const { return type == ValueType::kVector || type == ValueType::kColor; }
  bool is_true() const { return vector.x != 0; }
};

/// "a number", "a vector" …
std::string_view describe(ValueType type);

}  // namespace raytracer::scene_file
