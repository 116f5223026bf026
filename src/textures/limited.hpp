// What a texture says made into what is wanted.
#pragma once

#include <algorithm>

#include "raytracer/vector3f.hpp"

namespace raytracer {

/// The nearest value of the range. What is not a number becomes `least`.
inline float limited(float value, float least, float most) {
  return value > least ? std::min(value, most) : least;
}

inline Color3f limited(const Color3f& value, float least, float most) {
  return {limited(value.x, least, most), limited(value.y, least, most), limited(value.z, least, most)};
}

/// What a colour says where a number is wanted: its channels' mean.
inline float number_of(const Color3f& color) {
  const bool is_grey = color.x == color.y && color.y == color.z;
  return is_grey ? color.x : (color.x + color.y + color.z) / 3;
}

}  // namespace raytracer
