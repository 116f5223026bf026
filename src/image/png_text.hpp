// What a PNG says about itself besides its pixels.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "raytracer/image.hpp"

namespace raytracer {

/// Latin-1; the keyword has 1 to 79 characters.
struct PngText {
  std::string keyword, text;
};

/// encode_png with remarks in front of the pixels.
std::vector<std::uint8_t> encode_png_with(const std::vector<PngText>& texts, const Image& image);

/// The uncompressed remark of that keyword in front of the pixels of the PNG at `path`. Nothing where there
/// is none, or no PNG that is whole: it ends as it should, and the checksums of all its chunks are right.
std::optional<std::string> read_png_text(const std::string& path, std::string_view keyword);

}  // namespace raytracer
