// Scene text in canonical form: `raytracer fmt`.
#pragma once

#include <string>
#include <vector>

#include "raytracer/scene_file.hpp"

namespace raytracer::scene_file {

/// A scene's text as its author could have written it with more care, or what is wrong with it.
struct FormattedText {
  std::string text;                     ///< empty where the text has mistakes
  std::vector<Diagnostic> diagnostics;  ///< mistakes of syntax
};

/// The text with the same tokens and comments in canonical form; formatting that once more changes nothing.
/// Indented by two spaces, one item per line; what stood on one line between its braces stays there where it
/// has room; line breaks within long values and single blank lines are kept, columns aligned by hand are not.
/// Line ends become LF, a byte-order mark goes. `name` stands in the messages.
FormattedText format_text(const std::string& text, const std::string& name);

}  // namespace raytracer::scene_file
