#include <fmt/format.h>

#include <bit>
#include <string>

#include "image/encode.hpp"
#include "raytracer/image.hpp"

namespace raytracer {
namespace {

void append_little_endian(std::vector<std::uint8_t>& out, float value) {
  const auto bits = std::bit_cast<std::uint32_t>(value);
  for (const int shift : {0, 8, 16, 24}) out.push_back(static_cast<std::uint8_t>(bits >> shift));
}

std::vector<std::uint8_t> pfm_of(const Image& image) {
  // The sign of the third line's number says little-endian.
  const std::string header = fmt::format("PF\n{} {}\n-1.0\n", image.width, image.height);
  std::vector<std::uint8_t> out(header.begin(), header.end());
  out.reserve(header.size() + 3 * sizeof(float) * image.red.size());
  for (int y = image.height - 1; y >= 0; --y) {
    for (int x = 0; x < image.width; ++x) {
      const Color3f color = image.at(x, y) / 255.0f;
      for (int c = 0; c < 3; ++c) append_little_endian(out, color[c]);
    }
  }
  return out;
}

}  // namespace

std::vector<std::uint8_t> encode_pfm(const Image& image) {
  return encode_checked(image, [&] { return pfm_of(image); });
}

}  // namespace raytracer
