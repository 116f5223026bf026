#include "core/printable.hpp"

#include <algorithm>

namespace raytracer {
namespace {

unsigned char byte(char c) { return static_cast<unsigned char>(c); }

bool is_continuation(char c) { return (byte(c) & 0xC0U) == 0x80U; }

// How many bytes the character at the text's beginning has; 0 where it is no UTF-8.
std::size_t length_of_first(std::string_view text) {
  const unsigned char lead = byte(text[0]);
  if (lead < 0x80) return 1;
  const std::size_t length = lead < 0xC0 || lead >= 0xF8 ? 0 : lead < 0xE0 ? 2 : lead < 0xF0 ? 3 : 4;
  if (length == 0 || length > text.size()) return 0;
  return std::ranges::all_of(text.substr(1, length - 1), is_continuation) ? length : 0;
}

// C0 but for the tab, DEL, and C1 in its two bytes.
bool steers_a_terminal(std::string_view character) {
  const unsigned char lead = byte(character[0]);
  if (character.size() == 1) return (lead < 0x20 && lead != '\t') || lead == 0x7F;
  return lead == 0xC2 && byte(character[1]) < 0xA0;
}

// The first character as it may be shown; takes it off the text.
std::string_view take_printable(std::string_view& text) {
  constexpr std::string_view kReplacement = "\xEF\xBF\xBD";
  const std::size_t length = length_of_first(text);
  const std::string_view character = text.substr(0, std::max<std::size_t>(1, length));
  text.remove_prefix(character.size());
  return length == 0 || steers_a_terminal(character) ? kReplacement : character;
}

}  // namespace

std::vector<std::string> printable_characters(std::string_view text) {
  std::vector<std::string> characters;
  while (!text.empty()) characters.emplace_back(take_printable(text));
  return characters;
}

std::string printable(std::string_view text) {
  std::string out;
  while (!text.empty()) {
    if (text[0] == '\n') {
      out += '\n';
      text.remove_prefix(1);
    } else {
      out += take_printable(text);
    }
  }
  return out;
}

std::string shortened(std::string_view text, std::size_t most) {
  std::vector<std::size_t> starts;  // of the characters
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (!is_continuation(text[i])) starts.push_back(i);
  }
  if (starts.size() <= most) return std::string(text);
  const std::size_t at_end = most / 4;  // what went wrong is mostly said first
  return std::string(text.substr(0, starts[most - at_end])) + "…" +
         std::string(text.substr(starts[starts.size() - at_end]));
}

}  // namespace raytracer
