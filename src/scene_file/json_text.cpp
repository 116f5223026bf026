#include "scene_file/json_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <optional>
#include <unordered_map>
#include <vector>

#include "scene_file/lexer.hpp"
#include "scene_file/parser.hpp"

namespace raytracer::scene_file {
namespace {

constexpr int kDeepestValue =
    2 * kDeepestNesting + 4;  // a block inside a block is an object in an array in an object

bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }
bool is_word_character(char c) {
  return is_digit(c) || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}

// The four hexadecimal digits at the beginning; nothing where they aren't.
std::optional<std::uint32_t> code_unit(std::string_view text) {
  std::uint32_t unit = 0;
  const char* end = text.data() + std::min<std::size_t>(4, text.size());
  const auto [stop, status] = std::from_chars(text.data(), end, unit, 16);
  return status == std::errc() && stop == text.data() + 4 ? std::optional(unit) : std::nullopt;
}

bool is_high_surrogate(std::uint32_t unit) { return unit >= 0xD800 && unit < 0xDC00; }
bool is_low_surrogate(std::uint32_t unit) { return unit >= 0xDC00 && unit < 0xE000; }

void append_utf8(std::string& out, std::uint32_t code_point) {
  const auto put = [&](std::uint32_t byte) { out += static_cast<char>(byte); };
  const auto put_rest = [&](unsigned bits) {
    for (unsigned shift = bits; shift > 0; shift -= 6) put(0x80U | ((code_point >> (shift - 6)) & 0x3FU));
  };
  if (code_point < 0x80) return put(code_point);
  if (code_point < 0x800) {
    put(0xC0U | code_point >> 6U);
    return put_rest(6);
  }
  put(code_point < 0x10000 ? 0xE0U | code_point >> 12U : 0xF0U | code_point >> 18U);
  put_rest(code_point < 0x10000 ? 12 : 18);
}

class JsonParser {
 public:
  JsonParser(const Source& source, Arena& arena, Diagnostics& diagnostics)
      : source_(source), text_(source.text()), arena_(arena), diagnostics_(diagnostics) {
    if (text_.starts_with("\xEF\xBB\xBF")) position_ = 3;
  }

  const JsonValue* parse() {
    const std::optional<JsonValue> value = parse_value(0);
    if (!value) return nullptr;
    skip_blanks();
    if (position_ < text_.size()) {
      fail(word_here(), "unexpected text behind the scene", "a file holds one value");
      return nullptr;
    }
    return arena_.make(*value);
  }

 private:
  char at(std::uint32_t offset) const { return offset < text_.size() ? text_[offset] : '\0'; }
  char here() const { return at(position_); }

  void skip_blanks() {
    while (position_ < text_.size() && is_blank(text_[position_])) ++position_;
  }

  // The word or the character at the position, for a message; empty at the end of the text.
  Span word_here() const {
    std::uint32_t end = position_;
    while (is_word_character(at(end))) ++end;
    if (end == position_ && end < text_.size()) ++end;
    while (end < text_.size() && (static_cast<unsigned char>(text_[end]) & 0xC0U) == 0x80) ++end;
    return {position_, end};
  }

  std::nullopt_t fail(Span span, std::string message, std::string suggestion = {}) {
    diagnostics_.error({&source_, span}, std::move(message), std::move(suggestion));
    return std::nullopt;
  }

  std::nullopt_t unexpected(std::string_view wanted) {
    const Span span = word_here();
    if (span.begin == span.end) return fail(span, fmt::format("the text ends where {} is missing", wanted));
    return fail(span, fmt::format("'{}' stands where {} is missing", source_.text(span), wanted), hint());
  }

  // What people write who think of JavaScript.
  std::string hint() const {
    const char c = here();
    if (c == '\'') return "strings stand between \"…\"";
    if (c == '/') return "JSON has no comments";
    if (c == '+' || c == '.') return "numbers look like 1, -0.5 or 1.5e-3";
    if (c == ']' || c == '}') return "no comma stands behind the last one";
    return {};
  }

  std::optional<JsonValue> parse_value(int depth) {
    skip_blanks();
    switch (here()) {
      case '{':
      case '[':
        if (depth >= kDeepestValue) {
          return fail(word_here(), fmt::format("values are nested more than {} deep", kDeepestValue));
        }
        return here() == '{' ? parse_object(depth) : parse_array(depth);
      case '"':
        return parse_string();
      default:
        break;
    }
    if (here() == '-' || is_digit(here())) return parse_number();
    const Span word = word_here();
    JsonValue value;
    value.span = word;
    const std::string_view written = source_.text(word);
    if (written != "true" && written != "false" && written != "null") return unexpected("a value");
    value.type = written == "true"    ? JsonType::kTrue
                 : written == "false" ? JsonType::kFalse
                                      : JsonType::kNull;
    position_ = word.end;
    return value;
  }

  // Goes over the ',' behind an element or the bracket that ends them all; false after a mistake, which has
  // been reported.
  bool next(char close, std::uint32_t open, bool& more) {
    skip_blanks();
    more = here() == ',';
    if (more || here() == close) {
      ++position_;
      return true;
    }
    if (!is_at_end(open, close)) unexpected(fmt::format("',' or '{}'", close));
    return false;
  }

  // Whether the text ends inside of what the bracket at `open` began, which is then reported there.
  bool is_at_end(std::uint32_t open, char close) {
    skip_blanks();
    if (position_ < text_.size()) return false;
    fail({open, open + 1}, fmt::format("this '{}' is never closed", text_[open]),
         fmt::format("'{}' is missing", close));
    return true;
  }

  std::optional<JsonValue> parse_array(int depth) {
    const std::uint32_t begin = position_++;
    std::vector<JsonValue> elements;
    skip_blanks();
    bool more = here() != ']';
    if (!more) ++position_;
    while (more) {
      if (is_at_end(begin, ']')) return std::nullopt;
      const std::optional<JsonValue> element = parse_value(depth + 1);
      if (!element) return std::nullopt;
      elements.push_back(*element);
      if (!next(']', begin, more)) return std::nullopt;
    }
    JsonValue value;
    value.type = JsonType::kArray;
    value.span = {begin, position_};
    value.elements = arena_.copy(std::span<const JsonValue>(elements));
    return value;
  }

  std::optional<JsonValue> parse_object(int depth) {
    const std::uint32_t begin = position_++;
    std::vector<JsonMember> members;
    std::unordered_map<std::string, Span> keys;
    skip_blanks();
    bool more = here() != '}';
    if (!more) ++position_;
    while (more) {
      if (is_at_end(begin, '}')) return std::nullopt;
      if (here() != '"') return unexpected("a name in quotes");
      const std::optional<JsonValue> key = parse_string();
      if (!key) return std::nullopt;
      const auto [first, is_new] = keys.try_emplace(json_unescape(source_.text(key->inside())), key->span);
      if (!is_new) {
        diagnostics_.error({&source_, key->span}, fmt::format("{} is given twice", source_.text(key->span)),
                           {}, {{{&source_, first->second}, "first given here"}});
      }
      skip_blanks();
      if (here() != ':') return unexpected("':'");
      ++position_;
      const std::optional<JsonValue> value = parse_value(depth + 1);
      if (!value) return std::nullopt;
      if (is_new) members.push_back({*key, *value});
      if (!next('}', begin, more)) return std::nullopt;
    }
    JsonValue value;
    value.type = JsonType::kObject;
    value.span = {begin, position_};
    value.members = arena_.copy(std::span<const JsonMember>(members));
    return value;
  }

  // Goes over the escape at the position; false where it is none.
  bool skip_escape() {
    const std::uint32_t begin = position_++;
    constexpr std::string_view kSimple = "\"\\/bfnrt";
    if (position_ < text_.size() && kSimple.find(here()) != std::string_view::npos) {
      ++position_;
      return true;
    }
    if (here() == 'u') {
      const std::optional<std::uint32_t> unit = code_unit(text_.substr(position_ + 1));
      position_ += unit ? 5 : 1;
      if (unit && !is_high_surrogate(*unit) && !is_low_surrogate(*unit)) return true;
      const bool has_second = text_.substr(position_, 2) == "\\u";
      const std::optional<std::uint32_t> second =
          has_second ? code_unit(text_.substr(position_ + 2)) : std::nullopt;
      if (unit && is_high_surrogate(*unit) && second && is_low_surrogate(*second)) {
        position_ += 6;
        return true;
      }
      if (unit) {
        fail({begin, position_}, fmt::format("'{}' is half a character", source_.text({begin, position_})),
             "a character beyond \\uFFFF takes two: \\ud83d\\ude00");
        return false;
      }
    }
    const std::uint32_t end = std::min(begin + 2, static_cast<std::uint32_t>(text_.size()));
    fail({begin, end}, "this is no escape", "known are \\\" \\\\ \\/ \\b \\f \\n \\r \\t \\u00e4");
    return false;
  }

  std::optional<JsonValue> parse_string() {
    const std::uint32_t begin = position_++;
    while (position_ < text_.size() && here() != '"') {
      const auto byte = static_cast<unsigned char>(here());
      if (here() == '\n' || here() == '\r') break;
      if (byte < 0x20) {
        return fail({position_, position_ + 1},
                    fmt::format("a control character (byte {:#04x}) in a string", byte),
                    fmt::format("\\u{:04x}", byte));
      }
      if (byte != '\\') {
        ++position_;
      } else if (!skip_escape()) {
        return std::nullopt;
      }
    }
    if (here() != '"')
      return fail({begin, begin + 1}, "this string is not closed on its line", "'\"' is missing");
    ++position_;
    JsonValue value;
    value.type = JsonType::kString;
    value.span = {begin, position_};
    return value;
  }

  // The end of a number that begins at the position, by the standard's grammar; the position itself where it
  // is none.
  std::uint32_t end_of_number() const {
    std::uint32_t end = position_ + (here() == '-' ? 1 : 0);
    const auto digits = [&](std::uint32_t from) {
      while (is_digit(at(from))) ++from;
      return from;
    };
    const std::uint32_t whole = at(end) == '0' ? end + 1 : digits(end);
    if (whole == end) return position_;
    end = whole;
    if (at(end) == '.') {
      if (!is_digit(at(end + 1))) return position_;
      end = digits(end + 1);
    }
    if (at(end) == 'e' || at(end) == 'E') {
      const std::uint32_t first = end + (at(end + 1) == '+' || at(end + 1) == '-' ? 2 : 1);
      if (!is_digit(at(first))) return position_;
      end = digits(first);
    }
    return end;
  }

  std::optional<JsonValue> parse_number() {
    JsonValue value;
    value.type = JsonType::kNumber;
    const std::uint32_t end = end_of_number();
    std::uint32_t written_end = std::max(end, position_ + 1);
    while (is_word_character(at(written_end)) || at(written_end) == '.') ++written_end;
    value.span = {position_, written_end};
    if (end != written_end) {
      return fail(value.span, fmt::format("'{}' is not a number", source_.text(value.span)),
                  "numbers look like 1, -0.5 or 1.5e-3");
    }
    const auto [stop, status] = std::from_chars(text_.data() + position_, text_.data() + end, value.number);
    if (status == std::errc::result_out_of_range) {
      if (!is_tiny_number(source_.text(value.span))) {
        fail(value.span, fmt::format("'{}' is too large a number", source_.text(value.span)));
        value.type = JsonType::kBad;
      }
      value.number = 0;
    }
    position_ = end;
    return value;
  }

  const Source& source_;
  std::string_view text_;
  Arena& arena_;
  Diagnostics& diagnostics_;
  std::uint32_t position_ = 0;
};

}  // namespace

const JsonValue* parse_json(const Source& source, Arena& arena, Diagnostics& diagnostics) {
  return JsonParser(source, arena, diagnostics).parse();
}

std::string json_unescape(std::string_view inside) {
  std::string text;
  for (std::size_t i = 0; i < inside.size(); ++i) {
    if (inside[i] != '\\') {
      text += inside[i];
      continue;
    }
    const char c = inside[++i];
    constexpr std::string_view kLetters = "bfnrt", kMeanings = "\b\f\n\r\t";
    const std::size_t letter = kLetters.find(c);
    if (c != 'u') {
      text += letter == std::string_view::npos ? c : kMeanings[letter];
      continue;
    }
    std::uint32_t code_point = code_unit(inside.substr(i + 1)).value_or(0);
    i += 4;
    if (is_high_surrogate(code_point)) {
      code_point = 0x10000 + ((code_point - 0xD800) << 10U) +
                   (code_unit(inside.substr(i + 3)).value_or(0xDC00) - 0xDC00);
      i += 6;
    }
    append_utf8(text, code_point);
  }
  return text;
}

std::string json_quoted(std::string_view text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    if (static_cast<unsigned char>(c) < 0x20) {
      out += fmt::format("\\u{:04x}", static_cast<unsigned char>(c));
    } else {
      out += c;
    }
  }
  return out + '"';
}

}  // namespace raytracer::scene_file
