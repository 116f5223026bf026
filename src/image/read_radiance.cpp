// Pictures from Radiance HDR files (Ward 1991, "Real Pixels", Graphics Gems II; the manual page of
// `rpict`'s format: https://radsite.lbl.gov/radiance/refer/filefmts.pdf, "Picture File Format").
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstring>
#include <string_view>
#include <utility>

#include "core/parallel.hpp"
#include "core/printable.hpp"
#include "image/orientation.hpp"
#include "image/readers.hpp"
#include "raytracer/error.hpp"

namespace raytracer {
namespace {

Error broken(const std::string& why) { return {ErrorKind::kScene, "the Radiance HDR is broken: " + why}; }

/// The lines before the pixels.
class HeadLines {
 public:
  explicit HeadLines(ByteSpan file)
      : text_(reinterpret_cast<const char*>(file.data()), std::min(file.size(), kLongestHead)) {}

  std::string_view next() {
    const std::size_t end = text_.find('\n', position_);
    if (end == std::string_view::npos) throw broken("its head has no end");
    std::string_view line = text_.substr(position_, end - position_);
    position_ = end + 1;
    if (line.ends_with('\r')) line.remove_suffix(1);
    return line;
  }
  std::size_t position() const { return position_; }

 private:
  static constexpr std::size_t kLongestHead = std::size_t{1} << 20U;
  std::string_view text_;
  std::size_t position_ = 0;
};

/// The line "-Y 100 +X 200": the slow axis first; -Y is from the top down.
struct Resolution {
  Orientation orientation;
  int slow = 0, fast = 0;  // how many scanlines, and how many pixels in each
};

Resolution parse_resolution(std::string_view line) {
  const Error problem = broken("the line with its size is not one");
  const auto take_axis = [&](char& axis, bool& is_positive, int& count) {
    while (line.starts_with(' ')) line.remove_prefix(1);
    if (line.size() < 3) throw problem;
    is_positive = line[0] == '+';
    axis = line[1];
    if ((line[0] != '+' && line[0] != '-') || (axis != 'X' && axis != 'Y')) throw problem;
    line.remove_prefix(2);
    while (line.starts_with(' ')) line.remove_prefix(1);
    const auto [end, error] = std::from_chars(line.data(), line.data() + line.size(), count);
    if (error != std::errc() || count <= 0) throw problem;
    line.remove_prefix(static_cast<std::size_t>(end - line.data()));
  };
  Resolution result;
  char slow = 0, fast = 0;
  bool is_slow_positive = false, is_fast_positive = false;
  take_axis(slow, is_slow_positive, result.slow);
  take_axis(fast, is_fast_positive, result.fast);
  if (slow == fast) throw problem;
  const bool is_x_first = slow == 'X';
  result.orientation = {is_x_first, !(is_x_first ? is_slow_positive : is_fast_positive),
                        is_x_first ? is_fast_positive : is_slow_positive};
  return result;
}

// Divides by what the pixels have been multiplied with: one number for all channels, or three. The values of
// several lines come together.
void undo(std::string_view line, int count, Vector3d& scale) {
  std::string_view values = line.substr(line.find('=') + 1);
  Vector3d factors(0);
  for (int c = 0; c < count; ++c) {
    while (values.starts_with(' ') || values.starts_with('\t')) values.remove_prefix(1);
    const auto [end, error] = std::from_chars(values.data(), values.data() + values.size(), factors[c]);
    if (error != std::errc()) break;
    values.remove_prefix(static_cast<std::size_t>(end - values.data()));
  }
  if (count == 1) factors = Vector3d(factors.x);
  for (int c = 0; c < 3; ++c) {
    scale[c] /= factors[c];
    constexpr double kLeast = 1e-30, kMost = 1e30;
    if (scale[c] >= kLeast && scale[c] <= kMost) continue;  // not what is no number
    throw broken(fmt::format("'{}' makes no sense", printable(line.substr(0, 60))));
  }
}

struct Head {
  Resolution resolution;
  Vector3d scale{1};
};

// Of the other lines PIXASPECT, VIEW and the like do not matter: a texture lies on u and v, a sky all around.
Head read_head(HeadLines& lines) {
  Head head;
  for (std::string_view line = lines.next(); !line.empty(); line = lines.next()) {
    if (line.starts_with("EXPOSURE=")) undo(line, 1, head.scale);
    if (line.starts_with("COLORCORR=")) undo(line, 3, head.scale);
    if (!line.starts_with("FORMAT=") || line == "FORMAT=32-bit_rle_rgbe") continue;
    throw Error(ErrorKind::kScene,
                fmt::format("the Radiance HDR's pixels are in {}; only 32-bit_rle_rgbe can be read",
                            printable(line.substr(7, 40))));
  }
  head.resolution = parse_resolution(lines.next());
  return head;
}

/// Scanlines of both kinds: the older, pixels with a sign for repeating the one before, and the newer, each
/// of the four bytes by itself in runs.
class Scanlines {
 public:
  Scanlines(ByteSpan bytes, Picture& picture) : bytes_(bytes), picture_(picture) {}

  void read() {
    std::vector<std::size_t> starts;  // of the newer ones, which are unpacked once all are found
    std::vector<int> rows;
    for (int y = 0; y < picture_.height; ++y) {
      row_ = y;
      if (is_newer()) {
        starts.push_back(position_ + 4);
        rows.push_back(y);
        skip_newer();
      } else {
        read_older();
      }
    }
    constexpr std::size_t kBand = 16;
    parallel_for((rows.size() + kBand - 1) / kBand, [&](std::size_t band) {
      std::vector<std::uint8_t> plane(static_cast<std::size_t>(picture_.width));
      for (std::size_t i = band * kBand; i < std::min(rows.size(), (band + 1) * kBand); ++i) {
        unpack_newer(starts[i], plane, picture_.row(rows[i]));
      }
    });
  }

 private:
  bool is_newer() const {
    if (picture_.width < 8 || picture_.width > 0x7FFF || bytes_.size() - position_ < 4) return false;
    const std::uint8_t* head = bytes_.data() + position_;
    return head[0] == 2 && head[1] == 2 && head[2] < 128 && (head[2] << 8 | head[3]) == picture_.width;
  }

  std::uint8_t take() {
    if (position_ >= bytes_.size()) throw too_short();
    return bytes_[position_++];
  }

  // Checks every run, so that unpacking need not.
  void skip_newer() {
    position_ += 4;
    for (int component = 0; component < 4; ++component) {
      for (int x = 0; x < picture_.width;) {
        const int code = take();
        const int count = code > 128 ? code - 128 : code;
        if (count == 0 || count > picture_.width - x) {
          throw broken(fmt::format("in scanline {} of {} a run does not fit", row_ + 1, picture_.height));
        }
        x += count;
        position_ += code > 128 ? std::size_t{1} : static_cast<std::size_t>(count);
      }
    }
    if (position_ > bytes_.size()) throw too_short();
  }

  void unpack_newer(std::size_t at, std::vector<std::uint8_t>& plane, std::uint8_t* out) const {
    for (std::size_t component = 0; component < 4; ++component) {
      for (std::size_t x = 0; x < plane.size();) {
        const std::size_t code = bytes_[at++];
        const std::size_t count = code > 128 ? code - 128 : code;
        if (code > 128) {
          std::memset(plane.data() + x, bytes_[at++], count);
        } else {
          std::memcpy(plane.data() + x, bytes_.data() + at, count);
          at += count;
        }
        x += count;
      }
      for (std::size_t x = 0; x < plane.size(); ++x) out[4 * x + component] = plane[x];
    }
  }

  // A pixel 1 1 1 n says: the one before n times more; several in a row are the digits to the base 256 of
  // one number, the lowest first.
  void read_older() {
    std::uint8_t* out = picture_.row(row_);
    int shift = 0;
    for (int x = 0; x < picture_.width;) {
      std::uint8_t pixel[4];
      for (std::uint8_t& byte : pixel) byte = take();
      if (pixel[0] != 1 || pixel[1] != 1 || pixel[2] != 1) {
        std::memcpy(out + std::size_t{4} * static_cast<std::size_t>(x++), pixel, 4);
        shift = 0;
        continue;
      }
      const std::int64_t count = shift > 24 ? 0 : std::int64_t{pixel[3]} << shift;
      if (x == 0 || shift > 24 || count > picture_.width - x) {
        throw broken(fmt::format("in scanline {} of {} a run does not fit", row_ + 1, picture_.height));
      }
      for (std::int64_t i = 0; i < count; ++i, ++x) {
        std::uint8_t* to = out + std::size_t{4} * static_cast<std::size_t>(x);
        std::memcpy(to, to - 4, 4);
      }
      shift += 8;
    }
  }

  Error too_short() const {
    return broken(fmt::format("it ends in scanline {} of {}", row_ + 1, picture_.height));
  }

  ByteSpan bytes_;
  Picture& picture_;
  std::size_t position_ = 0;
  int row_ = 0;
};

}  // namespace

Picture read_radiance(ByteSpan file) {
  HeadLines lines(file);
  const Head head = read_head(lines);
  const Resolution& resolution = head.resolution;
  const ByteSpan bytes = file.subspan(lines.position());
  check_size(resolution.fast, resolution.slow);
  check_plausible(
      std::size_t{4} * static_cast<std::size_t>(resolution.slow) * static_cast<std::size_t>(resolution.fast),
      file.size());
  Picture scanlines(resolution.fast, resolution.slow, 3, TexelType::kRgbe, PictureCurve::kLinear);
  Scanlines(bytes, scanlines).read();
  scanlines.scale = Color3f(head.scale);
  return turned(std::move(scanlines), resolution.orientation);
}

}  // namespace raytracer
