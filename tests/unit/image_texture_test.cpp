#include "textures/image_texture.hpp"

#include <cmath>
#include <functional>
#include <memory>
#include <vector>

#include "catch.hpp"
#include "core/display_curve.hpp"
#include "image/texel.hpp"
#include "raytracer/error.hpp"

using raytracer::Color3f;
using raytracer::display_from_linear;
using raytracer::linear_from_display;
using raytracer::make_image_texture;
using raytracer::make_pyramid;
using raytracer::Picture;
using raytracer::PictureCurve;
using raytracer::TexelPyramid;
using raytracer::TexelType;
using raytracer::TexelUse;
using raytracer::TextureChannel;
using raytracer::TextureCurve;
using raytracer::TextureMeaning;
using raytracer::TexturePlacement;
using raytracer::TexturePoint;
using raytracer::TexturePointer;
using raytracer::TextureWrap;
using raytracer::Vector2f;

namespace {

using Bytes = std::vector<std::uint8_t>;

std::shared_ptr<Picture> byte_picture(int width, int height, int channels,
                                      const std::function<int(int x, int y, int c)>& value) {
  auto picture = std::make_shared<Picture>(width, height, channels, TexelType::kByte, PictureCurve::kSrgb);
  for (int y = 0; y < height; ++y) {
    for (int i = 0; i < width * channels; ++i) {
      picture->row(y)[i] = static_cast<std::uint8_t>(value(i / channels, y, i % channels));
    }
  }
  return picture;
}

/// Four texels, told apart by their red: 0 and 50 in the upper row, 100 and 200 in the lower.
std::shared_ptr<Picture> four() {
  return byte_picture(
      2, 2, 3, [](int x, int y, int c) { return c == 0 ? (y == 0 ? 50 * x : 100 + 100 * x) : 255 * c / 2; });
}

constexpr TexelUse kLight{};
constexpr TexelUse kDisplay{TextureMeaning::kDisplay};
constexpr TexelUse kNumber{TextureMeaning::kNumber};

TexturePointer texture_of(std::shared_ptr<const Picture> picture, const TexelUse& use = kLight,
                          const TexturePlacement& placement = {}) {
  return make_image_texture(make_pyramid(std::move(picture), use), placement);
}

Color3f look(const TexturePointer& texture, float u, float v) {
  TexturePoint point;
  point.uv = {u, v};
  return texture->at(point);
}

float red_byte(const TexturePointer& texture, float u, float v) { return 255 * look(texture, u, v).x; }

}  // namespace

TEST_CASE(
    "uv 0 0 is the lower left corner of the picture, v upwards, and values lie at the centres of texels") {
  const TexturePointer texture = texture_of(four(), kDisplay, {.wrap = TextureWrap::kClamp});
  CHECK(red_byte(texture, 0.25f, 0.25f) == Approx(100));
  CHECK(red_byte(texture, 0.75f, 0.25f) == Approx(200));
  CHECK(red_byte(texture, 0.25f, 0.75f) == Approx(0));
  CHECK(red_byte(texture, 0.75f, 0.75f) == Approx(50));
  CHECK(red_byte(texture, 0.5f, 0.5f) == Approx(87.5));
  CHECK(red_byte(texture, 0, 0) == Approx(100));
  CHECK(red_byte(texture, 1, 1) == Approx(50));
}

TEST_CASE("a picture repeats, is mirrored or goes on as its edge") {
  const auto reds = [](TextureWrap wrap, float u) {
    return red_byte(texture_of(four(), kDisplay, {.wrap = wrap}), u, 0.25f);
  };
  for (const float u : {1.25f, -0.75f, 7.25f, -3.75f}) CHECK(reds(TextureWrap::kRepeat, u) == Approx(100));
  CHECK(reds(TextureWrap::kRepeat, 0) == Approx(150));  // between the last and the first texel
  CHECK(reds(TextureWrap::kRepeat, 1) == Approx(150));
  CHECK(reds(TextureWrap::kMirror, 1.25f) == Approx(200));
  CHECK(reds(TextureWrap::kMirror, -0.25f) == Approx(100));
  CHECK(reds(TextureWrap::kMirror, 1) == Approx(200));
  CHECK(reds(TextureWrap::kMirror, 2.25f) == Approx(100));
  CHECK(reds(TextureWrap::kClamp, 1.25f) == Approx(200));
  CHECK(reds(TextureWrap::kClamp, -5) == Approx(100));
}

TEST_CASE("a clamped picture goes on as its edge at every scale") {
  const auto is_edge = [](int x, int y) { return x == 0 || y == 0 || x == 63 || y == 47; };
  const auto picture = byte_picture(64, 48, 3, [&](int x, int y, int c) {
    return is_edge(x, y) ? 200 + ((x + y) % 2 == 0 ? 20 * c : -20 * c) : 10;
  });
  const TexturePointer texture = texture_of(picture, kNumber, {.wrap = TextureWrap::kClamp});
  for (const bool is_rough : {false, true}) {
    for (const bool is_coarse : {false, true}) {
      for (const float width : {0.01f, 0.05f, 0.2f, 0.7f, 3.0f, 40.0f}) {
        TexturePoint point;
        point.is_rough = is_rough;
        point.is_coarse = is_coarse && !is_rough;
        point.uv_dx = {width, 0};
        point.uv_dy = {0, width};
        for (const Vector2f far :
             {Vector2f(1, 0.5f), Vector2f(-1, 0.5f), Vector2f(0.5f, 1), Vector2f(0.5f, -1)}) {
          point.uv = Vector2f(0.5f) + (3 + 3 * width) * (far - Vector2f(0.5f));
          INFO("width " << width << ", at " << point.uv.x << " " << point.uv.y);
          CHECK(255 * texture->at(point).x == Approx(200).margin(1));
        }
      }
    }
  }
}

TEST_CASE("a texture is scaled, turned and shifted") {
  const TexturePlacement turned{.rotate = 90, .wrap = TextureWrap::kRepeat};
  // (0.25, 0.75) is (-0.75, 0.25) a quarter turn further.
  CHECK(red_byte(texture_of(four(), kDisplay, turned), 0.25f, 0.75f) == Approx(100));
  const TexturePlacement moved{.scale = {2, 1}, .offset = {0.5f, 0}};
  CHECK(red_byte(texture_of(four(), kDisplay, moved), 0.125f, 0.25f) == Approx(200));
}

TEST_CASE("colours become light before they are mixed, display values and numbers stay") {
  const auto picture = byte_picture(2, 1, 1, [](int x, int, int) { return 255 * x; });
  const auto grey = byte_picture(1, 1, 1, [](int, int, int) { return 128; });
  const double middle = linear_from_display(128 / 255.0);
  CHECK(look(texture_of(grey), 0.3f, 0.1f).y == static_cast<float>(linear_from_display(128 / 255.0f)));
  CHECK(look(texture_of(grey, kDisplay), 0, 0).z == 128 / 255.0f);
  CHECK(look(texture_of(grey, kNumber), 0, 0).z == 128 / 255.0f);
  CHECK(look(texture_of(picture), 0.5f, 0.5f).x == Approx(0.5));
  TexelUse use = kNumber;
  use.curve = TextureCurve::kSrgb;
  CHECK(look(texture_of(grey, use), 0, 0).x == Approx(middle));
  use = kLight;
  use.curve = TextureCurve::kLinear;
  CHECK(look(texture_of(grey, use), 0, 0).x == 128 / 255.0f);
  use = kDisplay;
  use.curve = TextureCurve::kLinear;
  CHECK(look(texture_of(grey, use), 0, 0).x == Approx(display_from_linear(128 / 255.0)));
}

TEST_CASE("a number comes from the channel that is asked for") {
  const auto picture = byte_picture(3, 2, 4, [](int, int, int c) { return 10 + 40 * c; });
  const auto striped = byte_picture(2, 1, 4, [](int x, int, int c) { return 10 + 40 * c + x; });
  for (const auto& some : {picture, striped}) {
    const auto byte_of = [&](TextureChannel channel) {
      TexelUse use = kNumber;
      use.channel = channel;
      const Color3f value = look(texture_of(some, use), 0.25f, 0.5f) * 255.0f;
      CHECK(value.x == value.y);
      CHECK(value.x == value.z);
      return value.x;
    };
    CHECK(byte_of(TextureChannel::kRed) == Approx(10));
    CHECK(byte_of(TextureChannel::kGreen) == Approx(50));
    CHECK(byte_of(TextureChannel::kBlue) == Approx(90));
    CHECK(byte_of(TextureChannel::kAlpha) == Approx(130));
    CHECK(byte_of(TextureChannel::kMean) == Approx(50));
  }
  TexelUse alpha = kNumber;
  alpha.channel = TextureChannel::kAlpha;
  CHECK(look(texture_of(four(), alpha), 0.1f, 0.9f) == Color3f(1));  // none in the file: all is there
}

TEST_CASE("a texture of one colour is that colour exactly, however it is asked") {
  const float light = static_cast<float>(linear_from_display(77 / 255.0f));
  for (const int size : {1, 5, 64}) {
    const TexturePointer texture = texture_of(byte_picture(size, size, 3, [](int, int, int) { return 77; }));
    for (const float step : {0.0f, 1e-3f, 0.3f, 100.0f, raytracer::kInfinity}) {
      TexturePoint point;
      point.uv = {0.3f + step, -12.7f};
      point.uv_dx = {step, 0.3f * step};
      point.uv_dy = {0, 0.1f * step};
      const Color3f value = texture->at(point);
      CHECK(value == Color3f(light));
    }
  }
}

TEST_CASE("every kind of stored value is read as what it is") {
  Picture shorts(1, 1, 1, TexelType::kShort, PictureCurve::kLinear);
  const std::uint16_t third = 21845;
  std::memcpy(shorts.row(0), &third, 2);
  CHECK(look(texture_of(std::make_shared<Picture>(std::move(shorts))), 0, 0).x == Approx(1 / 3.0));

  Picture halves(1, 1, 3, TexelType::kHalf, PictureCurve::kLinear);
  const std::uint16_t values[] = {0x3C00, 0xC000, 0x0001};
  std::memcpy(halves.row(0), values, 6);
  CHECK(look(texture_of(std::make_shared<Picture>(std::move(halves))), 0, 0) == Color3f(1, -2, 0x1p-24f));
  CHECK(std::isinf(raytracer::float_from_half(0x7C00)));
  CHECK(std::isnan(raytracer::float_from_half(0x7E00)));
  CHECK(raytracer::float_from_half(0x7BFF) == 65504);

  Picture rgbe(2, 1, 3, TexelType::kRgbe, PictureCurve::kLinear);
  const Bytes bytes = {128, 64, 32, 129, 1, 2, 3, 0};
  std::copy(bytes.begin(), bytes.end(), rgbe.row(0));
  const auto shared = std::make_shared<Picture>(std::move(rgbe));
  CHECK(look(texture_of(shared), 0.25f, 0.5f) == Color3f(1, 0.5f, 0.25f));
  CHECK(look(texture_of(shared), 0.75f, 0.5f) == Color3f(0));
  CHECK(look(texture_of(shared, kDisplay), 0.25f, 0.5f).y == Approx(display_from_linear(0.5)));
}

TEST_CASE("what is not a number, and what is endless, asks for something finite") {
  const TexturePointer texture = texture_of(four());
  const float nan = std::nanf("");
  for (const float odd : {nan, raytracer::kInfinity, -raytracer::kInfinity, 1e30f, -1e30f}) {
    TexturePoint point;
    point.uv = {odd, 0.5f};
    CHECK(std::isfinite(texture->at(point).x));
    point.uv_dx = {odd, odd};
    CHECK(std::isfinite(texture->at(point).x));
    point.uv = {0.5f, 0.5f};
    CHECK(std::isfinite(texture->at(point).x));
  }
}

TEST_CASE("a huge footprint sees the mean of the light, of every size and shape of picture") {
  for (const auto& [width, height] : {std::pair{16, 16}, {37, 21}, {1, 9}, {100, 3}}) {
    const auto picture =
        byte_picture(width, height, 1, [](int x, int y, int) { return (x * 7919 + y * 104729) % 256; });
    double mean = 0;
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x)
        mean += linear_from_display(picture->row(y)[x] / 255.0) / (width * height);
    }
    TexturePoint point;
    point.uv = {0.3f, 0.4f};
    point.uv_dx = {50, 0};
    point.uv_dy = {3, 60};
    CHECK(texture_of(picture)->at(point).x == Approx(mean).margin(3e-4));
    point.uv_dx = Vector2f(raytracer::kInfinity);
    CHECK(texture_of(picture)->at(point).x == Approx(mean).margin(3e-4));
  }
}

namespace {

/// A plane below a camera that looks at it at a grazing angle.
struct GrazingView {
  int size = 48;
  double pitch = 0.1;  // radians downwards
  double scale = 0.5;  // of uv

  bool uv_at(double px, double py, double& u, double& v) const {
    const double x = px / (0.5 * size) - 1, y = 1 - py / (0.5 * size), z = -1.2;
    const double down = y * std::cos(pitch) + z * std::sin(pitch);
    const double forward = z * std::cos(pitch) - y * std::sin(pitch);
    if (down > -1e-2) return false;
    u = -scale * x / down;
    v = scale * forward / down;
    return true;
  }

  /// With the footprint of a sample `width` pixels wide.
  bool point_at(double px, double py, double width, TexturePoint& point) const {
    constexpr double kStep = 1e-4;
    double u = 0, v = 0, u_x = 0, v_x = 0, u_y = 0, v_y = 0;
    if (!uv_at(px, py, u, v) || !uv_at(px + kStep, py, u_x, v_x) || !uv_at(px, py + kStep, u_y, v_y)) {
      return false;
    }
    point.uv = {u, v};
    point.uv_dx = Vector2f(u_x - u, v_x - v) * static_cast<float>(width / kStep);
    point.uv_dy = Vector2f(u_y - u, v_y - v) * static_cast<float>(width / kStep);
    return true;
  }

  /// n x n samples, each in the middle of its square of the pixel; false beyond the horizon.
  bool pixel(const TexturePointer& texture, int x, int y, int n, bool is_filtered, Color3f& color) const {
    color = Color3f(0);
    for (int i = 0; i < n * n; ++i) {
      TexturePoint point;
      if (!point_at(x + (i % n + 0.5) / n, y + (i / n + 0.5) / n, 1.0 / n, point)) return false;
      if (!is_filtered) point.uv_dx = point.uv_dy = Vector2f(0);
      color += texture->at(point) / static_cast<float>(n * n);
    }
    return true;
  }

  /// The mean difference between 4 samples a pixel and 256 without footprints, in display values of 0..255.
  double mean_difference(const TexturePointer& texture, bool is_filtered = true) const {
    double sum = 0;
    int count = 0;
    for (int y = 0; y < size; ++y) {
      for (int x = 0; x < size; ++x) {
        Color3f few, many;
        if (!pixel(texture, x, y, 2, is_filtered, few) || !pixel(texture, x, y, 16, false, many)) continue;
        for (int c = 0; c < 3; ++c) {
          sum += 255 * std::abs(display_from_linear(few[c]) - display_from_linear(many[c]));
        }
        count += 3;
      }
    }
    return sum / count;
  }
};

}  // namespace

TEST_CASE("at a grazing angle four samples a pixel show what many without footprints do") {
  // Slow waves with fine ones upon them, and grain: what photographs are made of.
  const auto photograph = byte_picture(256, 256, 3, [](int x, int y, int c) {
    const double wave = std::sin(0.05 * x + c) * std::cos(0.04 * y) + 0.3 * std::sin(0.4 * x + 0.3 * y);
    return static_cast<int>(120 + 60 * wave + ((x * 7919 + y * 104729 + x * y * 31) % 23));
  });
  const TexturePointer texture = texture_of(photograph);
  for (const double pitch : {0.05, 0.15, 0.5}) {
    for (const double scale : {0.1, 0.5, 2.0}) {
      GrazingView view;
      view.pitch = pitch;
      view.scale = scale;
      CAPTURE(pitch, scale);
      CHECK(view.mean_difference(texture) < 1.0);
    }
  }
}

TEST_CASE("close by a footprint blurs nothing") {
  const TexturePointer texture = texture_of(four());
  TexturePoint small, large;
  small.uv = large.uv = {0.37f, 0.61f};
  large.uv_dx = {0.01f, 0};  // a fiftieth of a texel
  large.uv_dy = {0, 0.01f};
  CHECK(texture->at(large).x == Approx(texture->at(small).x).margin(1e-3));
}

TEST_CASE("a pyramid tells its memory and takes a third more texels than the picture") {
  const TexelPyramid pyramid(byte_picture(64, 32, 3, [](int x, int, int) { return x; }), kLight);
  CHECK(pyramid.level_count() == 7);
  // Each level in a frame of one texel.
  const std::size_t texels = 34 * 18 + 18 * 10 + 10 * 6 + 6 * 4 + 4 * 3 + 3 * 3;
  CHECK(pyramid.bytes() == texels * 3 * 2 + 256 * 4);
}
