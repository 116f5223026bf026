// A picture as its file holds it: compact, and not yet decoded.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "raytracer/vector3f.hpp"

namespace raytracer {

/// How a channel of a texel is kept.
enum class TexelType : std::uint8_t {
  kByte,   ///< 8 bits, 255 is 1
  kShort,  ///< 16 bits, 65535 is 1
  kHalf,   ///< IEEE 754 binary16
  kFloat,
  kRgbe,  ///< Radiance's: three mantissas and an exponent for all, 4 bytes in all
};

/// How the stored values, as 0..1 or as floats, become light.
enum class PictureCurve : std::uint8_t {
  kSrgb,    ///< by the sRGB curve (IEC 61966-2-1)
  kLinear,  ///< they are light
  kPower,   ///< light is value ^ exponent
};

inline constexpr std::size_t kLargestTexels = std::size_t{1} << 28U;

/// Rows from the top left, channels interleaved: grey, grey and alpha, RGB, or RGB and alpha. Colours are as
/// the file has them (PNG: not multiplied with alpha; EXR: multiplied). Rec.709 primaries are assumed.
struct Picture {
  int width = 0, height = 0;
  int channels = 0;  ///< 1..4; of kRgbe 3
  TexelType type = TexelType::kByte;
  PictureCurve curve = PictureCurve::kSrgb;
  float exponent = 1;                    ///< of kPower
  Color3f scale{1};                      ///< of kRgbe: times the stored values
  std::unique_ptr<std::uint8_t[]> data;  ///< in the machine's byte order

  Picture() = default;
  /// With data of the right size, not set. Throws Error (kScene) for a size out of range or too little
  /// memory.
  Picture(int width, int height, int channels, TexelType type, PictureCurve curve);

  bool has_alpha() const { return channels == 2 || channels == 4; }
  std::size_t texel_bytes() const;  ///< of all its channels
  std::size_t row_bytes() const { return texel_bytes() * static_cast<std::size_t>(width); }
  std::size_t bytes() const { return row_bytes() * static_cast<std::size_t>(height); }
  std::uint8_t* row(int y) { return data.get() + row_bytes() * static_cast<std::size_t>(y); }
  const std::uint8_t* row(int y) const { return data.get() + row_bytes() * static_cast<std::size_t>(y); }
};

/// The value of a texel's channel as it is stored: 0..1, or the float.
float stored_value(const Picture& picture, const std::uint8_t* texel, int channel);

/// A stored value as light.
float light_of(float value, PictureCurve curve, float exponent);

/// Row y as light: 3 floats a texel, linear Rec.709, into `rgb`; alpha is left out.
void row_to_floats(const Picture& picture, int y, float* rgb);

/// All rows from the top, likewise. Uses all threads.
std::vector<float> to_floats(const Picture& picture);

}  // namespace raytracer
