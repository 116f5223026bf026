// From linear light to display values.
#include <cmath>
#include <limits>
#include <vector>

#include "catch.hpp"
#include "raytracer/image.hpp"

namespace {

using raytracer::Color3f;
using raytracer::Development;
using raytracer::Image;
using raytracer::Tone;

Image filled(int width, int height, float value) {
  Image image(width, height);
  for (auto* channel : {&image.red, &image.green, &image.blue}) {
    for (float& v : *channel) v = 255 * value;
  }
  return image;
}

Development linear() {
  Development development;
  development.is_linear = true;
  return development;
}

double mean(const std::vector<float>& values) {
  double sum = 0;
  for (const float v : values) sum += static_cast<double>(v);
  return sum / static_cast<double>(values.size());
}

double developed_mean(float value, const Development& development) {
  return mean(raytracer::develop(filled(64, 64, value), development).green);
}

}  // namespace

TEST_CASE("display values stay as they are") {
  const Image before = filled(4, 3, 0.3F);
  CHECK(raytracer::develop(before, {}).red == before.red);
}

TEST_CASE("linear values get the sRGB code, give or take the dithering") {  // row G1 of the closed forms
  const float linear_values[] = {0, 0.001F, 0.0031308F, 0.01F, 0.18F, 0.22F, 0.5F, 1, 2};
  const int codes[] = {0, 3, 10, 25, 118, 129, 188, 255, 255};
  for (int i = 0; i < 9; ++i) {
    const Image image = raytracer::develop(filled(64, 64, linear_values[i]), linear());
    for (const float v : image.red) {
      const int code = static_cast<int>(std::floor(v + 0.5F));
      REQUIRE(std::abs(code - codes[i]) <= 1);
    }
  }
}

TEST_CASE("dithering keeps the mean, and leaves black and white alone") {
  const double code = 255 * (1.055 * std::pow(0.18, 1 / 2.4) - 0.055);
  std::vector<float> rounded = raytracer::develop(filled(256, 256, 0.18F), linear()).red;
  for (float& v : rounded) v = std::floor(v + 0.5F);
  CHECK(std::abs(mean(rounded) - code) < 0.02);
  for (const float exact : {0.0F, 1.0F}) {
    for (const float v : raytracer::develop(filled(64, 64, exact), linear()).blue) {
      REQUIRE(std::floor(v + 0.5F) == 255 * exact);
    }
  }
  CHECK(raytracer::develop(filled(9, 9, 0.2F), linear()).red ==
        raytracer::develop(filled(9, 9, 0.2F), linear()).red);
}

TEST_CASE("a stop more is twice the light") {
  Development brighter = linear();
  brighter.exposure = 1;
  CHECK(raytracer::develop(filled(8, 8, 0.1F), brighter).red ==
        raytracer::develop(filled(8, 8, 0.2F), linear()).red);
}

TEST_CASE("the light that shall look white does, and others keep their luminance") {
  Development warm = linear();
  warm.white = {1, 0.7F, 0.4F};
  Image image(32, 32);
  for (int y = 0; y < 32; ++y) {
    for (int x = 0; x < 32; ++x) image.set(x, y, 255.0F * 0.5F * warm.white);
  }
  const Image developed = raytracer::develop(image, warm);
  CHECK(std::abs(mean(developed.red) - mean(developed.green)) < 0.5);
  CHECK(std::abs(mean(developed.blue) - mean(developed.green)) < 0.5);
}

TEST_CASE("tone curves rise, begin at black and bring bright light into range") {
  for (const Tone tone : {Tone::kFilmic, Tone::kAgx, Tone::kAces}) {
    Development development = linear();
    development.tone = tone;
    CHECK(developed_mean(0, development) < 1);
    double last = -1;
    for (const float value : {0.01F, 0.05F, 0.18F, 0.5F, 1.0F, 2.0F, 4.0F}) {
      const double code = developed_mean(value, development);
      CHECK(code > last);
      last = code;
    }
    CHECK(developed_mean(1, development) < 254);
    CHECK(developed_mean(0.18F, development) > 60);
    CHECK(developed_mean(0.18F, development) < 160);
    CHECK(developed_mean(1e30F, development) > 240);
  }
}

TEST_CASE("what is no finite number does no harm") {
  const float infinity = std::numeric_limits<float>::infinity();
  for (const Tone tone : {Tone::kNone, Tone::kFilmic, Tone::kAgx, Tone::kAces}) {
    Development development = linear();
    development.tone = tone;
    CHECK(developed_mean(infinity, development) > 240);
    CHECK(developed_mean(-1, development) < 1);
  }
}
