#include "raytracer/image.hpp"

#include <png.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <string>
#include <utility>

#include "catch.hpp"
#include "core/parallel.hpp"
#include "raytracer/error.hpp"

using raytracer::Color3f;
using raytracer::encode_pfm;
using raytracer::encode_png;
using raytracer::Error;
using raytracer::ErrorKind;
using raytracer::Image;

namespace {

using Bytes = std::vector<std::uint8_t>;

/// The pixels of a PNG, three bytes each from the top left, read by libpng, which checks every checksum.
struct Decoded {
  unsigned width = 0, height = 0;
  Bytes rgb;
};

Decoded decode(const Bytes& file) {
  png_image png = {};
  png.version = PNG_IMAGE_VERSION;
  REQUIRE(png_image_begin_read_from_memory(&png, file.data(), file.size()));
  REQUIRE(png.format == PNG_FORMAT_RGB);
  Decoded result{png.width, png.height, Bytes(PNG_IMAGE_SIZE(png))};
  const int is_read = png_image_finish_read(&png, nullptr, result.rgb.data(), 0, nullptr);
  INFO(png.message);
  REQUIRE(is_read);
  REQUIRE(png.warning_or_error == 0);
  return result;
}

/// Name and contents of each chunk.
std::vector<std::pair<std::string, std::string>> chunks_of(const Bytes& file) {
  std::vector<std::pair<std::string, std::string>> chunks;
  for (std::size_t at = 8; at + 12 <= file.size();) {
    const std::size_t size = png_get_uint_32(file.data() + at);
    const auto* start = reinterpret_cast<const char*>(file.data() + at);
    chunks.emplace_back(std::string(start + 4, 4), std::string(start + 8, size));
    at += 12 + size;
  }
  return chunks;
}

/// Whole numbers that change in every direction and channel, with runs and jumps.
Image pattern(int width, int height) {
  Image image(width, height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const int noise = (x / 3 * 7919 + y * 10007) % 256;
      image.set(x, y, Color3f(x % 256, y % 256, noise));
    }
  }
  return image;
}

Bytes bytes_of(const Image& image) {
  Bytes bytes;
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      for (int c = 0; c < 3; ++c) bytes.push_back(static_cast<std::uint8_t>(image.at(x, y)[c]));
    }
  }
  return bytes;
}

void require_round_trip(int width, int height) {
  INFO(width << "x" << height);
  const Image image = pattern(width, height);
  const Decoded decoded = decode(encode_png(image));
  REQUIRE(decoded.width == static_cast<unsigned>(width));
  REQUIRE(decoded.height == static_cast<unsigned>(height));
  REQUIRE((decoded.rgb == bytes_of(image)));
}

template <typename Call>
ErrorKind kind_thrown(const Call& call) {
  try {
    call();
  } catch (const Error& error) {
    return error.kind();
  }
  FAIL("nothing was thrown");
  return {};
}

}  // namespace

TEST_CASE("an image starts black and keeps what is set", "[image]") {
  Image image(3, 2);
  REQUIRE(image.red == std::vector<float>(6, 0.0f));
  image.set(2, 1, {1, -2, 300});
  REQUIRE(image.at(2, 1) == Color3f(1, -2, 300));
  REQUIRE(image.blue[5] == 300);
  REQUIRE(image.at(1, 1) == Color3f(0, 0, 0));
}

TEST_CASE("impossible images are refused", "[image]") {
  REQUIRE(kind_thrown([] { Image(-1, 5); }) == ErrorKind::kUsage);
  REQUIRE(kind_thrown([] { Image(5, -1); }) == ErrorKind::kUsage);
  constexpr int kMost = std::numeric_limits<int>::max();
  REQUIRE(kind_thrown([] { Image(kMost, kMost); }) == ErrorKind::kFile);
  for (const auto encode : {encode_png, encode_pfm}) {
    REQUIRE(kind_thrown([&] { encode(Image()); }) == ErrorKind::kUsage);
    REQUIRE(kind_thrown([&] { encode(Image(0, 4)); }) == ErrorKind::kUsage);
    Image short_of_green(4, 4);
    short_of_green.green.pop_back();
    REQUIRE(kind_thrown([&] { encode(short_of_green); }) == ErrorKind::kUsage);
  }
}

TEST_CASE("a PNG holds clamped and rounded values", "[image][png]") {
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN(),
                  kInfinity = std::numeric_limits<float>::infinity();
  const std::vector<std::pair<float, int>> table = {{0, 0},
                                                    {-0.0f, 0},
                                                    {0.49999997f, 0},
                                                    {0.5f, 1},
                                                    {1.4999999f, 1},
                                                    {1.5f, 2},
                                                    {2.5f, 3},
                                                    {127.5f, 128},
                                                    {253.49998f, 253},
                                                    {254.49998f, 254},
                                                    {254.5f, 255},
                                                    {255, 255},
                                                    {256, 255},
                                                    {1e30f, 255},
                                                    {kInfinity, 255},
                                                    {-kInfinity, 0},
                                                    {-1, 0},
                                                    {-1e30f, 0},
                                                    {kNan, 0},
                                                    {-kNan, 0},
                                                    {std::numeric_limits<float>::denorm_min(), 0}};
  Image image(static_cast<int>(table.size()), 1);
  for (std::size_t i = 0; i < table.size(); ++i) image.green[i] = table[i].first;
  const Decoded decoded = decode(encode_png(image));
  for (std::size_t i = 0; i < table.size(); ++i) {
    INFO(table[i].first);
    REQUIRE(decoded.rgb[3 * i] == 0);
    REQUIRE(decoded.rgb[3 * i + 1] == table[i].second);
    REQUIRE(decoded.rgb[3 * i + 2] == 0);
  }
}

TEST_CASE("libpng reads back pictures of any size", "[image][png]") {
  for (const int width : {1, 2, 3, 5, 16, 17, 63, 64, 65, 257}) {
    for (const int height : {1, 2, 3, 15, 16, 17, 64, 65}) require_round_trip(width, height);
  }
}

TEST_CASE("libpng reads back pictures cut into stripes of rows", "[image][png]") {
  // At 2000 pixels a stripe has ten rows; a row of 21845 pixels fills one, one of 30000 is longer than one
  // should be.
  for (const int height : {9, 10, 11, 19, 20, 21, 101}) require_round_trip(2000, height);
  for (const int width : {21844, 21845, 21846, 30000}) {
    for (const int height : {1, 2, 5}) require_round_trip(width, height);
  }
  require_round_trip(1, 70000);
}

TEST_CASE("a picture of one colour becomes a small PNG", "[image][png]") {
  REQUIRE(encode_png(Image(1920, 1080)).size() < 40000);
}

TEST_CASE("a PNG names its maker and no date", "[image][png]") {
  const auto chunks = chunks_of(encode_png(pattern(2000, 30)));
  std::vector<std::string> names;
  for (const auto& [name, contents] : chunks) names.push_back(name);
  std::sort(names.begin() + 1, names.begin() + 4);  // versions of libpng have them in different order
  REQUIRE(names == std::vector<std::string>{"IHDR", "cHRM", "gAMA", "sRGB", "tEXt", "tEXt", "IDAT", "IDAT",
                                            "IDAT", "IEND"});
  REQUIRE(chunks[4].second == std::string("Software\0raytracer", 18));
  REQUIRE(chunks[5].second.substr(0, 8) == std::string("Version\0", 8));
  REQUIRE(chunks[5].second.find_first_not_of("0123456789.", 8) == std::string::npos);
  REQUIRE(chunks[5].second.size() > 8);
}

TEST_CASE("a PNG is the same for any number of threads", "[image][png]") {
  const Image image = pattern(700, 500);
  const Bytes expected = encode_png(image);
  for (const int threads : {1, 2, 8}) {
    raytracer::run_with_threads(threads, [&] { REQUIRE((encode_png(image) == expected)); });
  }
}

TEST_CASE("a PFM holds the values divided by 255, the bottom row first", "[image][pfm]") {
  Image image(2, 3);
  image.set(0, 2, {255, 510, -255});
  image.set(1, 2, {0.5f, std::numeric_limits<float>::infinity(), std::numeric_limits<float>::quiet_NaN()});
  image.set(1, 0, {1, 2, 3});
  const Bytes file = encode_pfm(image);
  const std::string header = "PF\n2 3\n-1.0\n";
  REQUIRE(file.size() == header.size() + 2 * 3 * 3 * sizeof(float));
  REQUIRE(std::string(file.begin(), file.begin() + static_cast<std::ptrdiff_t>(header.size())) == header);
  const auto value = [&](int x, int row_from_bottom, int channel) {
    float result;
    const auto index = static_cast<std::size_t>((row_from_bottom * 2 + x) * 3 + channel);
    std::memcpy(&result, file.data() + header.size() + index * sizeof(float), sizeof result);
    return result;
  };
  REQUIRE(value(0, 0, 0) == 1);
  REQUIRE(value(0, 0, 1) == 2);
  REQUIRE(value(0, 0, 2) == -1);
  REQUIRE(value(1, 0, 0) == 0.5f / 255.0f);
  REQUIRE(std::isinf(value(1, 0, 1)));
  REQUIRE(std::isnan(value(1, 0, 2)));
  REQUIRE(value(0, 1, 0) == 0);
  REQUIRE(value(1, 2, 2) == 3.0f / 255.0f);
  // 1 as a little-endian float
  REQUIRE(Bytes(file.begin() + 12, file.begin() + 16) == Bytes{0, 0, 0x80, 0x3f});
}
