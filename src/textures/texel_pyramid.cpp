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
  Level level;
  level.width = picture_->width;
  level.height = picture_->height;
  level.format = kFormats[static_cast<std::size_t>(picture_->type)];
  level.data = picture_->data.get() + channel_size(*picture_) * first_used();
  level.texel_bytes = picture_->texel_bytes();
  level.row_bytes = picture_->row_bytes();
  return level;
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
  Level level;
  level.width = level.height = 1;
  level.data = owned_.back().get();
  level.texel_bytes = level.row_bytes = sizeof value;
  levels_.push_back(level);
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
  Level& level = levels_.back();
  level.format = Format::kFloat;
  level.data = out;
  level.texel_bytes = 4 * channels;
  level.row_bytes = 4 * row;
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
      const std::uint8_t* texel = level.at(x, y);
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

/// To 0..1, where it is the same picture; clamped ones to as far beyond as the largest texel may reach.
/// Whatever is not a number goes to the lower end.
float wrapped(float x, TextureWrap wrap) {
  if (wrap == TextureWrap::kClamp) {
    const float below = x < 2 ? x : 2.0f;
    return x > -1 ? below : -1.0f;
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

/// The texels that an axis has; clamped ones may go on by a frame on both sides.
struct Axis {
  int count, frame;
  bool repeats;

  Axis(int texels, int framed_by, TextureWrap wrap)
      : count(texels),
        frame(wrap == TextureWrap::kClamp ? framed_by : 0),
        repeats(wrap == TextureWrap::kRepeat) {}
};

/// The two texels of an axis between whose centres x lies.
struct Pair {
  int first = 0, second = 0;
  float weight = 0;  // of the second
};

Pair pair_at(float x, const Axis& axis) {
  const auto size = static_cast<float>(axis.count);
  const float place = x * size - 0.5f, above = place > -1 ? place : -1.0f;
  const float position = above < size ? above : size;
  const float below = floor_of(position);
  const int first = static_cast<int>(below), second = first + 1;
  const int least = -axis.frame, most = axis.count - 1 + axis.frame;
  const int before = axis.repeats ? most : least, beyond = axis.repeats ? least : most;
  const int within = first > most ? most : first;
  return {within < least ? before : within, second > most ? beyond : second, position - below};
}

int index_at(float x, const Axis& axis) {
  const int index = static_cast<int>(floor_of(x * static_cast<float>(axis.count)));
  return std::clamp(index, -axis.frame, axis.count - 1 + axis.frame);
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

}  // namespace

Color3f TexelPyramid::bilinear(int level, const Vector2f& uv, TextureWrap wrap) const {
  const Level& pixels = levels_[static_cast<std::size_t>(level)];
  const Pair x = pair_at(wrapped(uv.x, wrap), {pixels.width, pixels.frame, wrap});
  const Pair y = pair_at(1 - wrapped(uv.y, wrap), {pixels.height, pixels.frame, wrap});
  return with_texels(pixels, [&](const auto& texel_at) {
    const Color3f upper = mixed(texel_at(x.first, y.first), texel_at(x.second, y.first), x.weight);
    const Color3f lower = mixed(texel_at(x.first, y.second), texel_at(x.second, y.second), x.weight);
    return mixed(upper, lower, y.weight);
  });
}

void TexelPyramid::bilinear(const Vector2Block& uv, int count, TextureWrap wrap, ColorBlock& colors) const {
  const Level pixels = levels_.front();
  PairBlock x, y;
  with_constant<TextureWrap::kRepeat, TextureWrap::kMirror, TextureWrap::kClamp>(wrap, [&](auto kind) {
    const Axis across(pixels.width, pixels.frame, kind), down(pixels.height, pixels.frame, kind);
    for (int i = 0; i < kBlockSize; ++i) {
      x.set(i, pair_at(wrapped(uv.x[i], kind), across));
      y.set(i, pair_at(1 - wrapped(uv.y[i], kind), down));
    }
  });
  ColorBlock upper_left{}, upper_right{}, lower_left{}, lower_right{};
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
  const int x = index_at(wrapped(uv.x, wrap), {pixels.width, pixels.frame, wrap});
  const int y = index_at(1 - wrapped(uv.y, wrap), {pixels.height, pixels.frame, wrap});
  return with_texels(pixels, [&](const auto& texel_at) { return texel_at(x, y); });
}

// --- levels ------------------------------------------------------------------------------------------

template <class Decode>
void TexelPyramid::decode_with(const Level& level, int y, float* out, const Decode& decode) const {
  const std::size_t channels = is_number_ ? 1 : 3;
  const auto within = [&](int i, int count) { return std::clamp(i, -level.frame, count - 1 + level.frame); };
  for (int x = -1; x <= level.width; ++x, out += channels) {
    const std::uint8_t* texel = level.at(within(x, level.width), within(y, level.height));
    for (std::size_t c = 0; c < channels; ++c) out[c] = decode(texel, c);
  }
}

// With the frame, or what stands for it, on both sides: y from -1 to the height.
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

/// Of all texels of an axis, its frame's before and after them: these are the frame's alone.
std::vector<Share> shares_of(int count, int of_count) {
  std::vector<Share> shares = {{-1, {1}}};
  for (int i = 0; i < count; ++i) shares.push_back(share_of(i, count, of_count));
  shares.push_back({of_count, {1}});
  return shares;
}

/// The average of a row's texels by shares, whose first number is that of texel -1.
void average_columns(const std::vector<float>& row, const std::vector<Share>& columns, std::size_t channels,
                     std::vector<float>& averages) {
  averages.clear();
  for (const Share& column : columns) {
    const float* texel = row.data() + channels * static_cast<std::size_t>(column.first + 1);
    for (std::size_t c = 0; c < channels; ++c) {
      float average = 0;
      for (std::size_t i = 0; i < column.weights.size(); ++i) {
        average += column.weights[i] * texel[i * channels + c];
      }
      averages.push_back(average);
    }
  }
}

void store_as_shorts(const std::vector<float>& values, std::uint8_t* out) {
  for (std::size_t k = 0; k < values.size(); ++k) {
    const auto rounded = static_cast<std::uint16_t>(std::clamp(values[k], 0.0f, 1.0f) * 65535 + 0.5f);
    std::memcpy(out + 2 * k, &rounded, 2);
  }
}

}  // namespace

// Half as wide and high, in a frame of one texel that averages what a clamped picture goes on as: its edges
// along themselves, its corners.
TexelPyramid::Level TexelPyramid::half_of(const Level& from) const {
  const std::size_t channels = is_number_ ? 1 : 3;
  const bool is_short = !table_.empty();  // of values in 0..1
  Level to;
  to.width = std::max(from.width / 2, 1);
  to.height = std::max(from.height / 2, 1);
  to.frame = 1;
  to.format = is_short ? Format::kShort : Format::kFloat;
  to.texel_bytes = channels * (is_short ? 2 : 4);
  to.row_bytes = to.texel_bytes * static_cast<std::size_t>(to.width + 2);
  return to;
}

void TexelPyramid::add_level() {
  const Level from = levels_.back();
  Level to = half_of(from);
  const std::size_t bytes = to.row_bytes * static_cast<std::size_t>(to.height + 2);
  owned_.push_back(std::make_unique_for_overwrite<std::uint8_t[]>(bytes));
  owned_bytes_ += bytes;
  std::uint8_t* const out = owned_.back().get();
  to.data = out + to.row_bytes + to.texel_bytes;

  const std::size_t channels = is_number_ ? 1 : 3;
  const std::vector<Share> columns = shares_of(to.width, from.width),
                           rows = shares_of(to.height, from.height);
  constexpr std::size_t kBand = 16;
  parallel_for((rows.size() - 1) / kBand + 1, [&](std::size_t band) {
    std::vector<float> row(channels * static_cast<std::size_t>(from.width + 2)), sum(row.size()), averages;
    for (std::size_t y = band * kBand; y < std::min((band + 1) * kBand, rows.size()); ++y) {
      std::ranges::fill(sum, 0.0f);
      for (std::size_t i = 0; i < rows[y].weights.size(); ++i) {
        decode_row(from, rows[y].first + static_cast<int>(i), row.data());
        for (std::size_t k = 0; k < row.size(); ++k) sum[k] += rows[y].weights[i] * row[k];
      }
      average_columns(sum, columns, channels, averages);
      std::uint8_t* const out_row = out + to.row_bytes * y;
      if (to.format == Format::kShort) {
        store_as_shorts(averages, out_row);
      } else {
        std::memcpy(out_row, averages.data(), to.row_bytes);
      }
    }
  });
  levels_.push_back(to);
}

std::size_t TexelPyramid::bytes() const { return owned_bytes_ + table_.size() * sizeof(float); }

}  // namespace raytracer
