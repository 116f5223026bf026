#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfInputFile.h>

#include <array>
#include <cmath>
#include <limits>
#include <string>

#include "catch.hpp"
#include "core/parallel.hpp"
#include "raytracer/error.hpp"
#include "raytracer/image.hpp"
#include "unit/temporary_folder.hpp"

using raytracer::Color3f;
using raytracer::encode_exr;
using raytracer::Error;
using raytracer::Image;

namespace {

Image pattern(int width, int height) {
  Image image(width, height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      image.set(x, y,
                255.0f * Color3f(0.37f * static_cast<float>(x), -1.5f * static_cast<float>(y),
                                 std::exp(0.5f * static_cast<float>(x - y))));
    }
  }
  return image;
}

}  // namespace

TEST_CASE("an EXR holds value / 255 as 32-bit floats, unclamped, and three channels") {
  const TemporaryFolder folder;
  Image image = pattern(37, 21);
  image.set(3, 4, Color3f(std::numeric_limits<float>::infinity(), 1e30f, -1e-30f));
  raytracer::write_file(folder / "a.exr", encode_exr(image));

  Imf::InputFile file((folder / "a.exr").c_str());
  const auto window = file.header().dataWindow();
  REQUIRE(window.min.x == 0);
  REQUIRE(window.min.y == 0);
  REQUIRE(window.max.x == 36);
  REQUIRE(window.max.y == 20);
  std::string names;
  for (auto it = file.header().channels().begin(); it != file.header().channels().end(); ++it) {
    names += it.name();
    REQUIRE(it.channel().type == Imf::FLOAT);
  }
  REQUIRE(names == "BGR");

  std::array<std::vector<float>, 3> planes;
  Imf::FrameBuffer pixels;
  for (std::size_t c = 0; c < 3; ++c) {
    planes[c].resize(37 * 21);
    pixels.insert(std::string(1, "RGB"[c]), Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(planes[c].data()),
                                                       sizeof(float), sizeof(float) * 37));
  }
  file.setFrameBuffer(pixels);
  file.readPixels(0, 20);
  bool is_equal = true;
  for (std::size_t i = 0; i < image.red.size(); ++i) {
    is_equal = is_equal && planes[0][i] == image.red[i] / 255 && planes[1][i] == image.green[i] / 255 &&
               planes[2][i] == image.blue[i] / 255;
  }
  REQUIRE(is_equal);
}

TEST_CASE("an EXR is the same for any number of threads and says no date") {
  const Image image = pattern(64, 100);
  const std::vector<std::uint8_t> bytes = encode_exr(image);
  for (const int threads : {1, 2, 7}) {
    std::vector<std::uint8_t> again;
    raytracer::run_with_threads(threads, [&] { again = encode_exr(image); });
    const bool is_equal = again == bytes;
    REQUIRE(is_equal);
  }
  REQUIRE(std::string(bytes.begin(), bytes.end()).find("capDate") == std::string::npos);
}

TEST_CASE("an EXR of nothing is refused") {
  REQUIRE_THROWS_AS(encode_exr(Image{}), Error);
  Image torn = pattern(4, 4);
  torn.green.pop_back();
  REQUIRE_THROWS_AS(encode_exr(torn), Error);
}
