// What a PNG says about itself.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace raytracer {

/// The uncompressed remark of that keyword in front of the pixels of the PNG at `path`. Nothing where there is none, or no
/// PNG that is whole.
std::optional<std::string> read_png_text(const std::string& path, std::string_view keyword);

}  // namespace raytracer
