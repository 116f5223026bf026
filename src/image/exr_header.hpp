// What an EXR says of itself before its pixels, read without trust and before any memory is taken.
// https://openexr.com/en/latest/OpenEXRFileLayout.html
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "image/byte_span.hpp"

namespace raytracer {

struct ExrWindow {
  std::int32_t x0 = 0, y0 = 0, x1 = -1, y1 = -1;  // corners that belong to it

  std::int64_t width() const { return std::int64_t{x1} - x0 + 1; }
  std::int64_t height() const { return std::int64_t{y1} - y0 + 1; }
};

struct ExrChannel {
  std::string name;
  int type = 0;  // 0: unsigned, 1: half, 2: float
  int x_sampling = 1, y_sampling = 1;
};

/// Of the first part.
struct ExrHeader {
  ExrWindow data, display;
  std::vector<ExrChannel> channels;  // in the order of their names
  bool is_deep = false;
};

/// Throws Error (kScene) for what can't be: attributes beyond the file's end, tables larger than the file,
/// windows without pixels or too large, what is missing.
ExrHeader read_exr_header(ByteSpan file);

}  // namespace raytracer
