// A picture made ready to be asked at every scale: its values decoded for a purpose, and their averages.
#pragma once

#include <array>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "core/lanes.hpp"
#include "image/picture.hpp"
#include "raytracer/vector3f.hpp"

namespace raytracer {

/// What a picture's values mean where it is used.
enum class TextureMeaning : std::uint8_t {
  kLight,    ///< a colour in `method path`: values become linear before they are averaged
  kDisplay,  ///< a colour in `method classic`: display values stay, light becomes a display value
  kNumber,   ///< roughness and the like, normal maps: values are taken as they are, unless kSrgb says more
};

/// What overrides the file's own word on its curve.
enum class TextureCurve : std::uint8_t { kOfFile, kSrgb, kLinear };

/// Which of the channels a number is read from.
enum class TextureChannel : std::uint8_t { kAll, kMean, kRed, kGreen, kBlue, kAlpha };

/// What a picture continues as beyond its edges.
enum class TextureWrap : std::uint8_t { kRepeat, kMirror, kClamp };

/// Everything that decides on a pyramid besides its picture.
struct TexelUse {
  TextureMeaning meaning = TextureMeaning::kLight;
  TextureCurve curve = TextureCurve::kOfFile;
  TextureChannel channel = TextureChannel::kAll;  ///< kAll: red, green and blue; others: one number for all
  friend auto operator<=>(const TexelUse&, const TexelUse&) = default;
};

/// Level 0 is the picture, each further one half as wide and high, down to a texel. A picture whose texels
/// are all the same is one texel.
class TexelPyramid {
 public:
  /// Builds the levels, on all threads. A picture without alpha has alpha 1.
  TexelPyramid(std::shared_ptr<const Picture> picture, const TexelUse& use);

  int level_count() const { return static_cast<int>(levels_.size()); }
  int width() const { return levels_.front().width; }
  int height() const { return levels_.front().height; }

  /// Whether the mean of the three channels is what was asked for; it is left to whoever looks up.
  bool is_mean() const { return use_.channel == TextureChannel::kMean && !is_number_; }

  /// Bilinear between the centres of the level's texels. Any uv; (0, 0) is the picture's lower left corner.
  Color3f bilinear(int level, const Vector2f& uv, TextureWrap wrap) const;

  /// Of level 0, at as many places as `count`; likewise the rest, but for what is not a number.
  void bilinear(const Vector2Block& uv, int count, TextureWrap wrap, ColorBlock& colors) const;

  /// The level's texel that uv lies in.
  Color3f nearest(int level, const Vector2f& uv, TextureWrap wrap) const;

  /// Of what it has taken besides the picture.
  std::size_t bytes() const;

 private:
  enum class Format : std::uint8_t { kTableByte, kTableShort, kShort, kHalf, kFloat, kRgbe };
  struct Level {
    int width = 0, height = 0;
    int frame = 0;  // of so many texels around it that only clamped pictures show
    Format format = Format::kFloat;
    const std::uint8_t* data = nullptr;  // the first of the channels that are used; others follow it
    std::size_t texel_bytes = 0, row_bytes = 0;

    const std::uint8_t* at(int x, int y) const {
      return data + static_cast<std::ptrdiff_t>(row_bytes) * y + static_cast<std::ptrdiff_t>(texel_bytes) * x;
    }
  };

  Level base_level() const;
  std::size_t first_used() const;  // of the picture's channels
  Color3f first_texel() const;
  void make_table();
  void convert_floats();
  void make_constant(const Color3f& value);
  bool is_constant() const;
  Level half_of(const Level& from) const;
  void add_level();
  void decode_row(const Level& level, int y, float* out) const;
  template <class Function>
  auto with_decoder(const Level& level, const Function& function) const;
  template <class Function>
  auto with_texels(const Level& level, const Function& function) const;
  template <class Decode>
  void decode_with(const Level& level, int y, float* out, const Decode& decode) const;
  float value_of(float stored) const;

  std::shared_ptr<const Picture> picture_;
  TexelUse use_;
  bool is_number_ = false;    // one channel is looked up, not three
  std::vector<float> table_;  // the values of all bytes, or of all shorts
  std::vector<Level> levels_;
  std::vector<std::unique_ptr<std::uint8_t[]>> owned_;  // the pixels of the levels above the picture's
  std::size_t owned_bytes_ = 0;
};

inline std::shared_ptr<const TexelPyramid> make_pyramid(std::shared_ptr<const Picture> picture,
                                                        const TexelUse& use) {
  return std::make_shared<const TexelPyramid>(std::move(picture), use);
}

}  // namespace raytracer
