#include "image/picture.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <new>

#include "core/display_curve.hpp"
#include "core/parallel.hpp"
#include "image/texel.hpp"
#include "raytracer/error.hpp"

namespace raytracer {
namespace {

constexpr std::size_t kLargestBytes = std::size_t{2} << 30U;

std::size_t channel_bytes(TexelType type) {
  switch (type) {
    case TexelType::kByte:
      return 1;
    case TexelType::kShort:
    case TexelType::kHalf:
      return 2;
    case TexelType::kFloat:
      return 4;
    case TexelType::kRgbe:
      break;
  }
  return 0;
}

}  // namespace

Picture::Picture(int width_in, int height_in, int channels_in, TexelType type_in, PictureCurve curve_in)
    : width(width_in), height(height_in), channels(channels_in), type(type_in), curve(curve_in) {
  if (bytes() > kLargestBytes) {
    throw Error(ErrorKind::kScene, fmt::format("its pixels take {} MiB; at most {} can be read",
                                               bytes() >> 20U, kLargestBytes >> 20U));
  }
  data.reset(new (std::nothrow) std::uint8_t[bytes()]);
  if (!data) throw Error(ErrorKind::kScene, "there is not enough memory for its pixels");
}

std::size_t Picture::texel_bytes() const {
  if (type == TexelType::kRgbe) return 4;
  return static_cast<std::size_t>(channels) * channel_bytes(type);
}

float stored_value(const Picture& picture, const std::uint8_t* texel, int channel) {
  const auto c = static_cast<std::size_t>(channel);
  switch (picture.type) {
    case TexelType::kByte:
      return static_cast<float>(texel[c]) / 255;
    case TexelType::kShort:
      return static_cast<float>(load<std::uint16_t>(texel + 2 * c)) / 65535;
    case TexelType::kHalf:
      return float_from_half(load<std::uint16_t>(texel + 2 * c));
    case TexelType::kFloat:
      return load<float>(texel + 4 * c);
    case TexelType::kRgbe:
      return rgb_from_rgbe(texel)[channel] * picture.scale[channel];
  }
  return 0;
}

float light_of(float value, PictureCurve curve, float exponent) {
  switch (curve) {
    case PictureCurve::kSrgb:
      return static_cast<float>(linear_from_display(value));
    case PictureCurve::kLinear:
      break;
    case PictureCurve::kPower:
      return std::pow(std::max(value, 0.0f), exponent);
  }
  return value;
}

namespace {

/// What row_to_floats does to one value of a whole picture, worked out for all values where they are few.
class LightOf {
 public:
  explicit LightOf(const Picture& picture) : picture_(picture) {
    if (picture.type != TexelType::kByte) return;
    for (std::size_t i = 0; i < 256; ++i) {
      bytes_[i] = light_of(static_cast<float>(i) / 255, picture.curve, picture.exponent);
    }
  }

  float operator()(const std::uint8_t* texel, int channel) const {
    if (picture_.type == TexelType::kByte) return bytes_[texel[channel]];
    return light_of(stored_value(picture_, texel, channel), picture_.curve, picture_.exponent);
  }

 private:
  const Picture& picture_;
  std::array<float, 256> bytes_ = {};
};

void decode_row(const Picture& picture, const LightOf& light, int y, float* rgb) {
  const std::uint8_t* texel = picture.row(y);
  const std::size_t step = picture.texel_bytes();
  if (picture.type == TexelType::kRgbe && picture.curve == PictureCurve::kLinear) {
    for (int x = 0; x < picture.width; ++x, texel += step, rgb += 3) {
      const Vector3f value = rgb_from_rgbe(texel) * picture.scale;
      for (int c = 0; c < 3; ++c) rgb[c] = value[c];
    }
    return;
  }
  const bool is_grey = picture.channels < 3;
  for (int x = 0; x < picture.width; ++x, texel += step, rgb += 3) {
    rgb[0] = light(texel, 0);
    rgb[1] = is_grey ? rgb[0] : light(texel, 1);
    rgb[2] = is_grey ? rgb[0] : light(texel, 2);
  }
}

}  // namespace

void row_to_floats(const Picture& picture, int y, float* rgb) {
  decode_row(picture, LightOf(picture), y, rgb);
}

std::vector<float> to_floats(const Picture& picture) {
  const auto width = static_cast<std::size_t>(picture.width);
  std::vector<float> floats(3 * width * static_cast<std::size_t>(picture.height));
  const LightOf light(picture);
  parallel_for(static_cast<std::size_t>(picture.height), [&](std::size_t y) {
    decode_row(picture, light, static_cast<int>(y), floats.data() + 3 * width * y);
  });
  return floats;
}

}  // namespace raytracer
