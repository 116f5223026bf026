// Text from outside on its way to a terminal or into JSON.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace raytracer {

/// The characters of a UTF-8 text, one string each. Bytes that are no UTF-8, and control characters other
/// than the tab, become replacement characters: nothing that stands in a scene or a file name steers the
/// terminal.
std::vector<std::string> printable_characters(std::string_view text);

/// The same in one piece; line feeds stay.
std::string printable(std::string_view text);

/// The text, or, where it has more than `most` characters, its beginning and its end with "…" between them.
std::string shortened(std::string_view text, std::size_t most);

}  // namespace raytracer
