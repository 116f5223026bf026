#include "meshes/text.hpp"

#include <charconv>
#include <limits>
#include <system_error>

namespace raytracer::meshes {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();
constexpr double kNotANumber = std::numeric_limits<double>::quiet_NaN();

// What a number that no double holds comes nearest to, 0 or infinity.
double nearest_end(std::string_view digits) {
  const std::size_t power = digits.find_first_of("eE");
  const bool tiny = power == std::string_view::npos ? digits[0] == '0' || digits[0] == '.'
                                                    : digits.substr(power + 1, 1) == "-";
  return tiny ? 0 : kInfinite;
}

}  // namespace

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
  return text;
}

bool read_rare_number(Cursor& c, double& value) {
  std::string_view word = peek_word(c);
  const std::size_t backslash = word.find('\\');
  if (backslash != std::string_view::npos) word = word.substr(0, backslash);
  std::string_view digits = word;
  const bool negative = !digits.empty() && digits[0] == '-';
  if (!digits.empty() && (digits[0] == '-' || digits[0] == '+')) digits.remove_prefix(1);
  if (digits.empty() || digits[0] == '-') return false;

  double size = 0;
  if (digits.substr(0, 3) == "1.#") {  // as Microsoft's C library wrote them
    size = digits.substr(3, 3) == "INF" ? kInfinite : kNotANumber;
  } else {
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), size);
    if (error == std::errc::invalid_argument || end != digits.data() + digits.size()) return false;
    if (error == std::errc::result_out_of_range) size = nearest_end(digits);
  }
  value = negative ? -size : size;
  c.at += word.size();
  return true;
}

}  // namespace raytracer::meshes
