// Pixels as the bytes that a PNG compresses.
#pragma once

#include <cstdint>
#include <vector>

#include "raytracer/image.hpp"

namespace raytracer {

/// Clamped to 0..255 and rounded, a half upwards; NaN is 0.
std::uint8_t to_byte(float value);

/// Rows first_row … end_row - 1, each as its filter's number and its filtered bytes (PNG specification,
/// section 9).
std::vector<std::uint8_t> filtered_rows(const Image& image, int first_row, int end_row);

}  // namespace raytracer
