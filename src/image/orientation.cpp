#include "image/orientation.hpp"

#include <cstring>
#include <utility>

namespace raytracer {

Picture turned(Picture stored, const Orientation& orientation) {
  const auto& [is_sideways, is_right_to_left, is_bottom_up] = orientation;
  if (!is_sideways && !is_right_to_left && !is_bottom_up) return stored;
  Picture picture(is_sideways ? stored.height : stored.width, is_sideways ? stored.width : stored.height,
                  stored.channels, stored.type, stored.curve);
  picture.exponent = stored.exponent;
  picture.scale = stored.scale;
  const std::size_t size = stored.texel_bytes();
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x) {
      const int from_x = is_right_to_left ? picture.width - 1 - x : x;
      const int from_y = is_bottom_up ? picture.height - 1 - y : y;
      const int row = is_sideways ? from_x : from_y, column = is_sideways ? from_y : from_x;
      std::memcpy(picture.row(y) + size * static_cast<std::size_t>(x),
                  stored.row(row) + size * static_cast<std::size_t>(column), size);
    }
  }
  return picture;
}

namespace {

/// Numbers of a TIFF structure, in the order of bytes that it declares; 0 beyond its end.
class Tiff {
 public:
  explicit Tiff(ByteSpan bytes) : bytes_(bytes), is_big_endian_(!bytes.empty() && bytes[0] == 'M') {}

  std::uint32_t number(std::size_t at, std::size_t size) const {
    if (at > bytes_.size() || size > bytes_.size() - at) return 0;
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < size; ++i)
      value = value << 8U | bytes_[at + (is_big_endian_ ? i : size - 1 - i)];
    return value;
  }
  bool is_sound() const {
    return bytes_.size() >= 8 && bytes_[0] == bytes_[1] && (bytes_[0] == 'M' || bytes_[0] == 'I') &&
           number(2, 2) == 42;
  }

 private:
  ByteSpan bytes_;
  bool is_big_endian_;
};

}  // namespace

Orientation exif_orientation(ByteSpan exif) {
  constexpr std::uint32_t kOrientation = 0x0112, kShort = 3;
  constexpr std::size_t kEntry = 12;
  // As the standard numbers them, from 1: where the stored first row and first column are in the picture.
  constexpr Orientation kOrientations[] = {
      {false, false, false},  // top, left
      {false, true, false},   // top, right
      {false, true, true},    // bottom, right
      {false, false, true},   // bottom, left
      {true, false, false},   // left, top
      {true, true, false},    // right, top
      {true, true, true},     // right, bottom
      {true, false, true},    // left, bottom
  };
  const Tiff tiff(exif);
  if (!tiff.is_sound()) return {};
  const std::size_t directory = tiff.number(4, 4);
  const std::size_t count = tiff.number(directory, 2);
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t entry = directory + 2 + kEntry * i;
    if (tiff.number(entry, 2) != kOrientation) continue;
    const std::uint32_t value = tiff.number(entry + 8, 2);
    const bool is_known = tiff.number(entry + 2, 2) == kShort && value >= 1 && value <= 8;
    return is_known ? kOrientations[value - 1] : Orientation{};
  }
  return {};
}

}  // namespace raytracer
