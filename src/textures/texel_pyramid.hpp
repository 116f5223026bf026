// A picture made ready to be asked at every scale: its values decoded for a purpose, and their averages.
#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

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

/// Everything that decides on a pyramid besides its picture.
struct TexelUse {
  TextureMeaning meaning = TextureMeaning::kLight;
  TextureCurve curve = TextureCurve::kOfFile;
  TextureChannel channel = TextureChannel::kAll;  ///< kAll: red, green and blue; others: one number for all
  friend auto operator<=>(const TexelUse&, const TexelUse&) = default;
};

class TexelPyramid;

/// Builds the mip levels, on all threads. A picture without alpha has alpha 1.
std::shared_ptr<const TexelPyramid> make_pyramid(std::shared_ptr<const Picture> picture, const TexelUse& use);

}  // namespace raytracer
