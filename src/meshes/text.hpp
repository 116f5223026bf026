// Words and numbers of a text: no locale, no copies, no allocation.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string_view>

namespace raytracer::meshes {

/// A place in a text, on its way to the end.
struct Cursor {
  const char* at;
  const char* end;

  explicit Cursor(std::string_view text) : at(text.data()), end(text.data() + text.size()) {}
};

inline bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\v' || c == '\f'; }
inline bool is_digit(char c) { return c >= '0' && c <= '9'; }

inline bool at_line_end(const Cursor& c) { return c.at == c.end || *c.at == '\n'; }

inline void skip_blanks(Cursor& c) {
  while (c.at != c.end && is_blank(*c.at)) ++c.at;
}

/// Behind the line feed that ends this line.
inline void skip_line(Cursor& c) {
  const void* const found = std::memchr(c.at, '\n', static_cast<std::size_t>(c.end - c.at));
  c.at = found == nullptr ? c.end : static_cast<const char*>(found) + 1;
}

/// The word that begins here, up to a blank or the end of the line; empty where there is none.
inline std::string_view peek_word(const Cursor& c) {
  const char* end = c.at;
  while (end != c.end && *end != '\n' && !is_blank(*end)) ++end;
  return {c.at, static_cast<std::size_t>(end - c.at)};
}

inline std::string_view read_word(Cursor& c) {
  const std::string_view word = peek_word(c);
  c.at += word.size();
  return word;
}

/// `text` without blanks at its two ends.
std::string_view trimmed(std::string_view text);

/// Whether a word may end here; OBJ hides line ends behind a backslash.
inline bool ends_word(const Cursor& c) { return at_line_end(c) || is_blank(*c.at) || *c.at == '\\'; }

/// As read_number, for what is rare: many digits, large exponents, "nan", "-inf", "1.#IND".
bool read_rare_number(Cursor& c, double& value);

/// Reads a decimal number that begins and ends here as a word does. Within 2^-52 of what is written, hence
/// the right float but for numbers that lie that close to the middle of two. False, and unmoved, where there
/// is no number. What is too large becomes infinite.
inline bool read_number(Cursor& c, double& value) {
  static constexpr std::array<double, 23> kPowers = {1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,
                                                     1e8,  1e9,  1e10, 1e11, 1e12, 1e13, 1e14, 1e15,
                                                     1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};
  constexpr int kMostDigits = 19;  // as many fit in 64 bits
  Cursor now = c;
  const bool negative = now.at != now.end && *now.at == '-';
  if (now.at != now.end && (*now.at == '-' || *now.at == '+')) ++now.at;
  std::uint64_t digits = 0;
  const auto read_digits = [&] {
    const char* const begin = now.at;
    while (now.at != now.end && is_digit(*now.at)) {
      digits = 10 * digits + static_cast<std::uint64_t>(*now.at++ - '0');
    }
    return now.at - begin;
  };
  std::ptrdiff_t count = read_digits();
  std::ptrdiff_t exponent = 0;
  if (now.at != now.end && *now.at == '.') {
    ++now.at;
    exponent = -read_digits();
    count -= exponent;
  }
  if (count == 0 || count > kMostDigits) return read_rare_number(c, value);
  if (now.at != now.end && (*now.at == 'e' || *now.at == 'E')) {
    ++now.at;
    const bool smaller = now.at != now.end && *now.at == '-';
    if (now.at != now.end && (*now.at == '-' || *now.at == '+')) ++now.at;
    int power = 0;
    const char* const begin = now.at;
    while (now.at != now.end && is_digit(*now.at) && now.at - begin < 4)
      power = 10 * power + (*now.at++ - '0');
    if (now.at == begin) return false;
    exponent += smaller ? -power : power;
  }
  if (!ends_word(now) || exponent < -22 || exponent > 22) return read_rare_number(c, value);
  const auto whole = static_cast<double>(digits);
  const double size = exponent < 0 ? whole / kPowers[static_cast<std::size_t>(-exponent)]
                                   : whole * kPowers[static_cast<std::size_t>(exponent)];
  value = negative ? -size : size;
  c = now;
  return true;
}

/// Reads a whole number; what ends it is for the caller to look at. False, and unmoved, where there is none
/// or it has more than 18 digits.
inline bool read_integer(Cursor& c, std::int64_t& value) {
  Cursor now = c;
  const bool negative = now.at != now.end && *now.at == '-';
  if (now.at != now.end && (*now.at == '-' || *now.at == '+')) ++now.at;
  const char* const begin = now.at;
  std::int64_t size = 0;
  while (now.at != now.end && is_digit(*now.at)) {
    if (now.at - begin == 18) return false;
    size = 10 * size + (*now.at++ - '0');
  }
  if (now.at == begin) return false;
  value = negative ? -size : size;
  c = now;
  return true;
}

}  // namespace raytracer::meshes
