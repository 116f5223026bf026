#include "textures/texel_pyramid.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "core/display_curve.hpp"
#include "core/parallel.hpp"
#include "core/with_constant.hpp"
#include "image/texel.hpp"

namespace raytracer {
namespace {

PictureCurve curve_of(const Picture& picture, const TexelUse& use) {
  if (use.channel == TextureChannel::kAlpha) return PictureCurve::kLinear;
  if (use.curve == TextureCurve::kSrgb) return PictureCurve::kSrgb;
  if (use.curve == TextureCurve::kLinear || use.meaning == TextureMeaning::kNumber) {
    return PictureCurve::kLinear;
  }
  return picture.curve;
}

bool is_one_number(const Picture& picture, TextureChannel channel) {
  if (channel == TextureChannel::kAll || channel == TextureChannel::kMean) return picture.channels < 3;
  return true;
}

/// Index of the first of the texel's channels that is used.
int first_channel(const Picture& picture, TextureChannel channel) {
  const bool is_grey = picture.channels < 3;
  switch (channel) {
    case TextureChannel::kGreen:
      return is_grey ? 0 : 1;
    case TextureChannel::kBlue:
      return is_grey ? 0 : 2;
    case TextureChannel::kAlpha:
      return picture.channels - 1;
    default:
      return 0;
  }
}

std::size_t channel_size(const Picture& picture) {
  return picture.type == TexelType::kRgbe
             ? 1
             : picture.texel_bytes() / static_cast<std::size_t>(picture.channels);
}

constexpr float kShortStep = 1.0f / 65535;

}  // namespace

float TexelPyramid::value_of(float stored) const {
  const PictureCurve curve = curve_of(*picture_, use_);
  if (use_.channel == TextureChannel::kAlpha) return stored;
  if (use_.meaning != TextureMeaning::kDisplay) return light_of(stored, curve, picture_->exponent);
  if (curve == PictureCurve::kSrgb) return stored;
  return static_cast<float>(display_from_linear(light_of(stored, curve, picture_->exponent)));
}

TexelPyramid::TexelPyramid(std::shared_ptr<const Picture> picture, const TexelUse& use)
    : picture_(std::move(picture)), use_(use), is_number_(is_one_number(*picture_, use.channel)) {
  if (use.channel == TextureChannel::kAlpha && !picture_->has_alpha()) {
    make_constant(Color3f(1));
    return;
  }
  make_table();
  levels_.push_back(base_level());
  if (is_constant()) {
    make_constant(first_texel());
    return;
  }
  // A single channel of Radiance's pixels does not stand by itself.
  const bool is_lone = is_number_ && picture_->type == TexelType::kRgbe;
  if (table_.empty() && (is_lone || value_of(0.5f) != 0.5f)) convert_floats();
  while (levels_.back().width > 1 || levels_.back().height > 1) add_level();
}

void TexelPyramid::make_table() {
  const bool is_byte = picture_->type == TexelType::kByte;
  if (!is_byte && picture_->type != TexelType::kShort) return;
  table_.resize(is_byte ? 256 : 65536);
  const auto most = static_cast<float>(table_.size() - 1);
  for (std::size_t i = 0; i < table_.size(); ++i) table_[i] = value_of(static_cast<float>(i) / most);
}

std::size_t TexelPyramid::first_used() const {
  return static_cast<std::size_t>(is_number_ ? first_channel(*picture_, use_.channel) : 0);
}

TexelPyramid::Level TexelPyramid::base_level() const {
  static constexpr std::array kFormats = {Format::kTableByte, Format::kTableShort, Format::kHalf,
                                          Format::kFloat, Format::kRgbe};
  return {picture_->width, picture_->height, kFormats[static_cast<std::size_t>(picture_->type)],
          picture_->data.get() + channel_size(*picture_) * first_used(), picture_->texel_bytes()};
}

bool TexelPyramid::is_constant() const {
  const std::uint8_t* bytes = picture_->data.get();
  const std::size_t step = picture_->texel_bytes();
  return std::memcmp(bytes, bytes + step, picture_->bytes() - step) == 0;
}

Color3f TexelPyramid::first_texel() const {
  Color3f color;
  for (int c = 0; c < 3; ++c) {
    const int channel = static_cast<int>(first_used()) + (is_number_ ? 0 : c);
    color[c] = value_of(stored_value(*picture_, picture_->data.get(), channel));
  }
  return color;
}

void TexelPyramid::make_constant(const Color3f& value) {
  levels_.clear();
  owned_bytes_ = sizeof value;
  owned_.push_back(std::make_unique<std::uint8_t[]>(owned_bytes_));
  std::memcpy(owned_.back().get(), &value, sizeof value);
  levels_.push_back({1, 1, Format::kFloat, owned_.back().get(), sizeof value});
}

// Floats that are not the values themselves are made so once, not at every look.
void TexelPyramid::convert_floats() {
  const Level from = levels_.back();
  const std::size_t channels = is_number_ ? 1 : 3;
  const std::size_t row = channels * static_cast<std::size_t>(from.width);
  owned_.push_back(
      std::make_unique_for_overwrite<std::uint8_t[]>(row * 4 * static_cast<std::size_t>(from.height)));
  owned_bytes_ += row * 4 * static_cast<std::size_t>(from.height);
  std::uint8_t* out = owned_.back().get();
  parallel_for(static_cast<std::size_t>(from.height), [&](std::size_t y) {
    std::vector<float> values;
    const std::uint8_t* texel = picture_->row(static_cast<int>(y));
    for (int x = 0; x < from.width; ++x, texel += picture_->texel_bytes()) {
      for (std::size_t c = 0; c < channels; ++c) {
        values.push_back(value_of(stored_value(*picture_, texel, static_cast<int>(first_used() + c))));
      }
    }
    std::memcpy(out + 4 * row * y, values.data(), 4 * row);
  });
  levels_.back() = {from.width, from.height, Format::kFloat, out, 4 * channels};
}

// --- looking up --------------------------------------------------------------------------------------

/// Calls function(decode), decode(texel, c) being the c-th of the used channels of a texel of that level.
template <class Function>
auto TexelPyramid::with_decoder(const Level& level, const Function& function) const {
  using Texel = const std::uint8_t*;
  const float* table = table_.data();
  switch (level.format) {
    case Format::kTableByte:
      return function([=](Texel texel, std::size_t c) { return table[texel[c]]; });
    case Format::kTableShort:
      return function([=](Texel texel, std::size_t c) { return table[load<std::uint16_t>(texel + 2 * c)]; });
    case Format::kShort:
      return function([](Texel texel, std::size_t c) {
        return static_cast<float>(load<std::uint16_t>(texel + 2 * c)) * kShortStep;
      });
    case Format::kHalf:
      return function(
          [](Texel texel, std::size_t c) { return float_from_half(load<std::uint16_t>(texel + 2 * c)); });
    case Format::kRgbe:
      return function([scale = picture_->scale](Texel texel, std::size_t c) {
        const auto channel = static_cast<int>(c);
        return rgb_from_rgbe(texel)[channel] * scale[channel];
      });
    case Format::kFloat:
      break;
  }
  return function([](Texel texel, std::size_t c) { return load<float>(texel + 4 * c); });
}

/// Likewise function(texel_at), texel_at(x, y) being the colour of a texel.
template <class Function>
auto TexelPyramid::with_texels(const Level& level, const Function& function) const {
  return with_decoder(level, [&](const auto& decode) {
    return function([&](int x, int y) {
      const std::size_t index =
          static_cast<std::size_t>(y) * static_cast<std::size_t>(level.width) + static_cast<std::size_t>(x);
      const std::uint8_t* texel = level.data + index * level.texel_bytes;
      const float first = decode(texel, 0);
      return is_number_ ? Color3f(first) : Color3f(first, decode(texel, 1), decode(texel, 2));
    });
  });
}

namespace {

// std::floor is a call where the processor's own rounding may not be counted on. |x| < 2^31.
float floor_of(float x) {
  const auto towards_zero = static_cast<float>(static_cast<int>(x));
  return towards_zero > x ? towards_zero - 1 : towards_zero;
}

// What follows is done to blocks of places: without branches but for those on `wrap`.

/// To 0..1, where it is the same picture. Whatever is not a number goes to 0.
float wrapped(float x, TextureWrap wrap) {
  if (wrap == TextureWrap::kClamp) {
    const float below = x < 1 ? x : 1.0f;
    return x > 0 ? below : 0.0f;
  }
  constexpr float kWhole = 0x1p23f;  // from here on there are no fractions
  const float near = std::abs(x) < kWhole ? x : 0.0f;
  if (wrap == TextureWrap::kRepeat) {
    const float rest = near - floor_of(near);
    return rest < 1 ? rest : 1.0f;
  }
  const float there_and_back = near - 2 * floor_of(0.5f * near);
  return there_and_back > 1 ? 2 - there_and_back : there_and_back;
}

/// The two texels of an axis between whose centres x, 0..1, lies.
struct Pair {
  int first = 0, second = 0;
  float weight = 0;  // of the second
};

Pair pair_at(float x, int count, bool repeats) {
  const float position = x * static_cast<float>(count) - 0.5f;
  const float below = floor_of(position);
  const int first = static_cast<int>(below), second = first + 1;
  const int before = repeats ? count - 1 : 0, beyond = repeats ? 0 : count - 1;
  return {first < 0 ? before : first, second >= count ? beyond : second, position - below};
}

int index_at(float x, int count) {
  const int index = static_cast<int>(x * static_cast<float>(count));
  return index < count ? index : count - 1;
}

struct alignas(64) PairBlock {
  int first[kBlockSize], second[kBlockSize];
  float weight[kBlockSize];

  void set(int i, const Pair& pair) {
    first[i] = pair.first;
    second[i] = pair.second;
    weight[i] = pair.weight;
  }
};

/// In the form a + t (b - a), which leaves equal values as they are.
Color3f mixed(const Color3f& a, const Color3f& b, float t) { return a + t * (b - a); }

/// Channel c, the texels above and below being decoded; mixed likewise.
template <class Decode>
float mixed(const Decode& decode, const std::uint8_t* upper, const std::uint8_t* lower, const Pair& x,
            float below, std::size_t step, std::size_t c) {
  const std::size_t left = step * static_cast<std::size_t>(x.first);
  const std::size_t right = step * static_cast<std::size_t>(x.second);
  const float upper_left = decode(upper + left, c), lower_left = decode(lower + left, c);
  const float above_mixed = upper_left + x.weight * (decode(upper + right, c) - upper_left);
  const float below_mixed = lower_left + x.weight * (decode(lower + right, c) - lower_left);
  return above_mixed + below * (below_mixed - above_mixed);
}

}  // namespace

Color3f TexelPyramid::bilinear(int level, const Vector2f& uv, TextureWrap wrap) const {
  const Level& pixels = levels_[static_cast<std::size_t>(level)];
  const bool repeats = wrap == TextureWrap::kRepeat;
  const Pair x = pair_at(wrapped(uv.x, wrap), pixels.width, repeats);
  const Pair y = pair_at(1 - wrapped(uv.y, wrap), pixels.height, repeats);
  const std::size_t step = pixels.texel_bytes, row = step * static_cast<std::size_t>(pixels.width);
  const std::uint8_t* upper = pixels.data + row * static_cast<std::size_t>(y.first);
  const std::uint8_t* lower = pixels.data + row * static_cast<std::size_t>(y.second);
  return with_decoder(pixels, [&](const auto& decode) {
    const auto channel = [&](std::size_t c) { return mixed(decode, upper, lower, x, y.weight, step, c); };
    return is_number_ ? Color3f(channel(0)) : Color3f(channel(0), channel(1), channel(2));
  });
}

void TexelPyramid::bilinear(const Vector2Block& uv, int count, TextureWrap wrap, ColorBlock& colors) const {
  const Level pixels = levels_.front();
  PairBlock x, y;
  with_constant<TextureWrap::kRepeat, TextureWrap::kMirror, TextureWrap::kClamp>(wrap, [&](auto kind) {
    constexpr bool kRepeats = kind == TextureWrap::kRepeat;
    for (int i = 0; i < kBlockSize; ++i) {
      x.set(i, pair_at(wrapped(uv.x[i], kind), pixels.width, kRepeats));
      y.set(i, pair_at(1 - wrapped(uv.y[i], kind), pixels.height, kRepeats));
    }
  });
  ColorBlock upper_left, upper_right, lower_left, lower_right;
  with_texels(pixels, [&](const auto& texel_at) {
    for (int i = 0; i < count; ++i) {
      upper_left.set(i, texel_at(x.first[i], y.first[i]));
      upper_right.set(i, texel_at(x.second[i], y.first[i]));
      lower_left.set(i, texel_at(x.first[i], y.second[i]));
      lower_right.set(i, texel_at(x.second[i], y.second[i]));
    }
  });
  ColorBlock result;
  for (int i = 0; i < kBlockSize; ++i) {
    const Color3f upper = mixed(upper_left.at(i), upper_right.at(i), x.weight[i]);
    const Color3f lower = mixed(lower_left.at(i), lower_right.at(i), x.weight[i]);
    result.set(i, mixed(upper, lower, y.weight[i]));
  }
  colors = result;
}

Color3f TexelPyramid::nearest(int level, const Vector2f& uv, TextureWrap wrap) const {
  const Level& pixels = levels_[static_cast<std::size_t>(level)];
  const int x = index_at(wrapped(uv.x, wrap), pixels.width);
  const int y = index_at(1 - wrapped(uv.y, wrap), pixels.height);
  return with_texels(pixels, [&](const auto& texel_at) { return texel_at(x, y); });
}

// --- levels ------------------------------------------------------------------------------------------

template <class Decode>
void TexelPyramid::decode_with(const Level& level, int y, float* out, const Decode& decode) const {
  const std::size_t channels = is_number_ ? 1 : 3;
  const std::uint8_t* texel =
      level.data + static_cast<std::size_t>(y) * static_cast<std::size_t>(level.width) * level.texel_bytes;
  for (int x = 0; x < level.width; ++x, texel += level.texel_bytes, out += channels) {
    for (std::size_t c = 0; c < channels; ++c) out[c] = decode(texel, c);
  }
}

void TexelPyramid::decode_row(const Level& level, int y, float* out) const {
  with_decoder(level, [&](const auto& decode) { decode_with(level, y, out, decode); });
}

namespace {

/// Texels first … and how much of each, which together are one texel of an axis with fewer.
struct Share {
  int first = 0;
  std::vector<float> weights;
};

Share share_of(int index, int count, int of_count) {
  const double from = static_cast<double>(index) * of_count / count;
  const double to = static_cast<double>(index + 1) * of_count / count;
  Share share{static_cast<int>(from), {}};
  for (int i = share.first; i < of_count && i < to; ++i) {
    share.weights.push_back(
        static_cast<float>((std::min(to, i + 1.0) - std::max(from, double(i))) / (to - from)));
  }
  return share;
}

std::vector<Share> shares_of(int count, int of_count) {
  std::vector<Share> shares;
  for (int i = 0; i < count; ++i) shares.push_back(share_of(i, count, of_count));
  return shares;
}

}  // namespace

void TexelPyramid::add_level() {
  const Level from = levels_.back();
  const std::size_t channels = is_number_ ? 1 : 3;
  const bool is_short = !table_.empty();  // of values in 0..1
  const std::size_t number_bytes = is_short ? 2 : 4;
  Level to{std::max(from.width / 2, 1), std::max(from.height / 2, 1),
           is_short ? Format::kShort : Format::kFloat, nullptr, channels * number_bytes};
  const std::size_t row_bytes = to.texel_bytes * static_cast<std::size_t>(to.width);
  owned_.push_back(
      std::make_unique_for_overwrite<std::uint8_t[]>(row_bytes * static_cast<std::size_t>(to.height)));
  owned_bytes_ += row_bytes * static_cast<std::size_t>(to.height);
  std::uint8_t* out = owned_.back().get();
  to.data = out;

  const std::vector<Share> columns = shares_of(to.width, from.width);
  constexpr int kBand = 16;
  parallel_for(static_cast<std::size_t>((to.height - 1) / kBand + 1), [&](std::size_t band) {
    const std::size_t row_values = channels * static_cast<std::size_t>(from.width);
    std::vector<float> row(row_values), sum(row_values), averages(channels * columns.size());
    const int first = static_cast<int>(band) * kBand;
    for (int y = first; y < std::min(first + kBand, to.height); ++y) {
      const Share rows = share_of(y, to.height, from.height);
      std::fill(sum.begin(), sum.end(), 0.0f);
      for (std::size_t i = 0; i < rows.weights.size(); ++i) {
        decode_row(from, rows.first + static_cast<int>(i), row.data());
        for (std::size_t k = 0; k < row_values; ++k) sum[k] += rows.weights[i] * row[k];
      }
      for (std::size_t x = 0; x < columns.size(); ++x) {
        const float* texel = sum.data() + channels * static_cast<std::size_t>(columns[x].first);
        for (std::size_t c = 0; c < channels; ++c) {
          float average = 0;
          for (std::size_t i = 0; i < columns[x].weights.size(); ++i) {
            average += columns[x].weights[i] * texel[i * channels + c];
          }
          averages[channels * x + c] = average;
        }
      }
      std::uint8_t* out_row = out + row_bytes * static_cast<std::size_t>(y);
      if (!is_short) {
        std::memcpy(out_row, averages.data(), row_bytes);
        continue;
      }
      for (std::size_t k = 0; k < averages.size(); ++k) {
        const auto rounded = static_cast<std::uint16_t>(std::clamp(averages[k], 0.0f, 1.0f) * 65535 + 0.5f);
        std::memcpy(out_row + 2 * k, &rounded, 2);
      }
    }
  });
  levels_.push_back(to);
}

std::size_t TexelPyramid::bytes() const { return owned_bytes_ + table_.size() * sizeof(float); }

}  // namespace raytracer
