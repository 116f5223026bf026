#include "scene_file/lexer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

namespace raytracer::scene_file {
namespace {

// <cctype> follows the locale; scene files do not.
bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }
// No word of the language has letters beyond ASCII; they are read as part of one so that the message names
// the whole word.
bool is_foreign(char c) { return static_cast<unsigned char>(c) >= 0x80; }
bool is_word_character(char c) { return is_letter(c) || is_digit(c) || is_foreign(c); }
bool is_blank(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }
constexpr std::string_view kNoBreakSpace = "\xC2\xA0";

}  // namespace

Lexer::Lexer(const Source& source, Diagnostics& diagnostics)
    : source_(&source), text_(source.text()), diagnostics_(&diagnostics) {
  if (text_.starts_with("\xEF\xBB\xBF")) position_ = 3;
}

Lexer Lexer::quiet_copy() const {
  Lexer copy = {*source_, *diagnostics_};
  copy.position_ = position_;
  copy.diagnostics_ = nullptr;
  return copy;
}

void Lexer::error(Span span, std::string message, std::string suggestion) {
  if (diagnostics_ != nullptr) {
    diagnostics_->error({source_, span}, std::move(message), std::move(suggestion));
  }
}

void Lexer::skip_block_comment() {
  const std::uint32_t begin = position_;
  std::uint32_t depth = 0;
  do {
    if (position_ >= text_.size()) {
      error({begin, begin + 2}, "this comment is never closed", "'*/' is missing");
      ended_in_comment_ = true;
      break;
    }
    const bool opens = at(position_) == '/' && at(position_ + 1) == '*';
    const bool closes = at(position_) == '*' && at(position_ + 1) == '/';
    depth += opens ? 1U : 0U;
    depth -= closes ? 1U : 0U;
    position_ += opens || closes ? 2U : 1U;
  } while (depth > 0);
  if (diagnostics_ != nullptr) comments_.push_back({begin, position_});
}

void Lexer::skip_blanks_and_comments() {
  while (true) {
    while (position_ < text_.size() && is_blank(text_[position_])) ++position_;
    if (at(position_) != '/') return;
    if (at(position_ + 1) == '/') {
      const std::uint32_t begin = position_;
      const std::size_t end = std::min(text_.find_first_of("\r\n", position_), text_.size());
      position_ = static_cast<std::uint32_t>(end);
      if (diagnostics_ != nullptr) comments_.push_back({begin, position_});
    } else if (at(position_ + 1) == '*') {
      skip_block_comment();
    } else {
      return;
    }
  }
}

bool Lexer::starts_number(std::uint32_t offset) const {
  return is_digit(at(offset)) || (at(offset) == '.' && is_digit(at(offset + 1)));
}

Token Lexer::next(LexMode mode) {
  skip_blanks_and_comments();
  const std::uint32_t begin = position_;
  if (position_ >= text_.size()) return token(TokenType::kEnd, begin);
  const char c = text_[position_];
  if (is_foreign(c) && starts_with_lookalike()) return lex_lookalike();
  if (is_letter(c) || is_foreign(c)) return lex_word();
  const bool is_sign = c == '+' || c == '-';
  if (starts_number(position_) || (mode == LexMode::kValues && is_sign && starts_number(position_ + 1))) {
    return lex_number();
  }
  switch (c) {
    case '"':
      return lex_string();
    case '#':
      return lex_color();
    case '{':
      ++position_;
      return token(TokenType::kOpenBrace, begin);
    case '}':
      ++position_;
      return token(TokenType::kCloseBrace, begin);
    case '(':
      ++position_;
      return token(TokenType::kOpenParenthesis, begin);
    case ')':
      ++position_;
      return token(TokenType::kCloseParenthesis, begin);
    default:
      return lex_operator(mode);
  }
}

Token Lexer::lex_word() {
  const std::uint32_t begin = position_;
  while (is_word_character(at(position_)) && !(is_foreign(at(position_)) && starts_with_lookalike()))
    ++position_;
  return token(TokenType::kWord, begin);
}

Token Lexer::lex_number() {
  const std::uint32_t begin = position_;
  if (at(position_) == '+' || at(position_) == '-') ++position_;
  while (is_digit(at(position_))) ++position_;
  if (at(position_) == '.') ++position_;
  while (is_digit(at(position_))) ++position_;
  if (at(position_) == 'e' || at(position_) == 'E') {
    const std::uint32_t sign = at(position_ + 1) == '+' || at(position_ + 1) == '-' ? 1 : 0;
    if (is_digit(at(position_ + 1 + sign))) {
      position_ += 1 + sign;
      while (is_digit(at(position_))) ++position_;
    }
  }
  if (is_word_character(at(position_)) || (at(position_) == '.' && !is_letter(at(position_ + 1)))) {
    while (is_word_character(at(position_)) || at(position_) == '.') ++position_;
    const std::string_view written = source_->text({begin, position_});
    const std::size_t cross = written.find('x');
    const bool is_hexadecimal = written.starts_with("0x") || written.starts_with("0X");
    const bool is_size = !is_hexadecimal && cross != std::string_view::npos && cross > 0 &&
                         is_digit(written[cross - 1]) && cross + 1 < written.size();
    error({begin, position_}, fmt::format("'{}' is not a number", written),
          is_size ? fmt::format("two numbers have a space between them: {} {}", written.substr(0, cross),
                                written.substr(cross + 1))
          : is_hexadecimal ? "numbers are decimal: 16, not 0x10"
                           : "numbers look like 1, -0.5 or 1.5e-3");
    return token(TokenType::kBad, begin);
  }
  Token result = token(TokenType::kNumber, begin);
  const char* first = text_.data() + begin + (text_[begin] == '+' ? 1 : 0);
  const auto [end, status] = std::from_chars(first, text_.data() + position_, result.number);
  if (status == std::errc::result_out_of_range && is_tiny_number(source_->text(result.span))) {
    result.number = 0;  // too small to tell from 0
  } else if (status != std::errc()) {
    error(result.span, fmt::format("'{}' is too large a number", source_->text(result.span)));
    result.type = TokenType::kBad;
  }
  return result;
}

Token Lexer::lex_string() {
  const std::uint32_t begin = position_++;
  while (position_ < text_.size() && text_[position_] != '"') {
    if (text_[position_] == '\n' || text_[position_] == '\r') break;
    const bool escapes = text_[position_] == '\\' && (at(position_ + 1) == '"' || at(position_ + 1) == '\\');
    position_ += escapes ? 2U : 1U;
  }
  if (at(position_) != '"') {
    error({begin, begin + 1}, "this string is not closed on its line", "'\"' is missing");
    return token(TokenType::kBad, begin);
  }
  ++position_;
  return token(TokenType::kString, begin);
}

// Prose behind a '#': words after a blank, or in a line that begins with it one that has no colour's digits.
bool Lexer::is_foreign_comment(std::uint32_t begin) const {
  std::uint32_t word = begin + 1;
  while (at(word) == ' ' || at(word) == '\t' || at(word) == '#') ++word;
  if (!is_letter(at(word)) && !is_foreign(at(word))) return false;
  if (word > begin + 1) return true;
  std::uint32_t end = word;
  while (is_word_character(at(end))) ++end;
  const bool is_hexadecimal =
      text_.substr(word, end - word).find_first_not_of("0123456789abcdefABCDEF") == std::string_view::npos;
  std::uint32_t before = begin;
  while (before > 0 && is_blank(text_[before - 1]) && text_[before - 1] != '\n') --before;
  return !is_hexadecimal && (before == 0 || text_[before - 1] == '\n');
}

Token Lexer::lex_color() {
  const std::uint32_t begin = position_++;
  if (is_foreign_comment(begin)) {
    position_ = static_cast<std::uint32_t>(std::min(text_.find_first_of("\r\n", begin), text_.size()));
    error({begin, begin + 1}, "'#' begins a colour, no comment", "comments begin with //");
    return token(TokenType::kBad, begin);
  }
  while (is_word_character(at(position_))) ++position_;
  const std::uint32_t digits = position_ - begin - 1;
  if (!is_color(source_->text({begin, position_}))) {
    error({begin, position_}, fmt::format("'{}' is not a colour", source_->text({begin, position_})),
          digits == 0 ? "comments begin with //" : "colours look like #f80 or #ff8800");
    return token(TokenType::kBad, begin);
  }
  return token(TokenType::kColor, begin);
}

Token Lexer::lex_operator(LexMode mode) {
  const std::uint32_t begin = position_;
  constexpr std::string_view kSingle = "+-*/%^<>=!?:,.";
  if (text_.substr(position_, 2) == "*/") {
    position_ += 2;
    error({begin, position_}, "this '*/' closes no comment");
    return token(TokenType::kBad, begin);
  }
  constexpr std::string_view kTwins[] = {"<=", ">=", "==", "!="};
  for (const std::string_view twin : kTwins) {
    if (text_.substr(position_, 2) == twin) {
      position_ += 2;
      return token(TokenType::kOperator, begin);
    }
  }
  if (kSingle.find(text_[position_]) == std::string_view::npos) return unexpected_character(mode);
  ++position_;
  return token(TokenType::kOperator, begin);
}

Token Lexer::unexpected_character(LexMode mode) {
  const std::uint32_t begin = position_++;
  const auto byte = static_cast<unsigned char>(text_[begin]);
  if (byte < 0x20 || byte == 0x7F) {
    error({begin, position_}, fmt::format("unexpected control character (byte {:#04x})", byte),
          "a scene is plain text in UTF-8");
  } else {
    const bool is_twin = (text_[begin] == '&' || text_[begin] == '|') && at(position_) == text_[begin];
    if (is_twin) ++position_;
    error({begin, position_}, fmt::format("unexpected '{}'", text_.substr(begin, position_ - begin)),
          std::string(hint_for(begin, mode)));
  }
  return token(TokenType::kBad, begin);
}

// What another language's sign is called here.
std::string_view Lexer::hint_for(std::uint32_t begin, LexMode mode) const {
  const char sign = text_[begin];
  if (sign == '&') return "'and' joins conditions: a and b";
  if (sign == '|') return "'or' joins conditions: a or b";
  if (sign != '[' && sign != ']') return {};
  if (mode == LexMode::kValues) return "a vector is three numbers: 0 1 0";
  const bool is_index = begin > 0 && (is_word_character(text_[begin - 1]) || text_[begin - 1] == ')');
  return is_index ? "the components of a vector are .x .y .z" : "a vector is written (1, 2, 3)";
}

// Signs that word processors put where a keyboard has " and -.
bool Lexer::starts_with_lookalike() const {
  const std::string_view rest = text_.substr(position_, 3);
  if (rest.starts_with(kNoBreakSpace)) return true;
  return rest == "\xE2\x80\x9C" || rest == "\xE2\x80\x9D" || rest == "\xE2\x80\x9E" ||
         rest == "\xE2\x88\x92" || rest == "\xE2\x80\x93";
}

Token Lexer::lex_lookalike() {
  const std::uint32_t begin = position_;
  if (text_.substr(position_).starts_with(kNoBreakSpace)) {
    position_ += 2;
    error({begin, position_}, "unexpected no-break space", "write a plain space");
    return token(TokenType::kBad, begin);
  }
  const std::string_view sign = text_.substr(position_, 3);
  const bool is_minus = sign == "\xE2\x88\x92" || sign == "\xE2\x80\x93";
  position_ += 3;
  if (is_minus) {
    while (is_word_character(at(position_)) || at(position_) == '.') ++position_;
    error({begin, position_}, fmt::format("'{}' is not a minus sign", sign), "write '-'");
  } else {
    while (position_ < text_.size() && text_[position_] != '\n' && text_[position_] != '\r') {
      const std::string_view here = text_.substr(position_, 3);
      ++position_;
      if (here == "\xE2\x80\x9C" || here == "\xE2\x80\x9D") {
        position_ += 2;
        break;
      }
    }
    error({begin, position_}, fmt::format("'{}' is not a quotation mark", sign),
          "strings stand between \"…\"");
  }
  return token(TokenType::kBad, begin);
}

bool is_tiny_number(std::string_view number) {
  const std::size_t exponent = number.find_first_of("eE");
  if (exponent != std::string_view::npos) return number[exponent + 1] == '-';
  return number.find_first_of("123456789") > number.find('.');
}

bool is_color(std::string_view text) {
  const bool all_hexadecimal = text.find_first_not_of("0123456789abcdefABCDEF", 1) == std::string_view::npos;
  return text.starts_with('#') && all_hexadecimal && (text.size() == 4 || text.size() == 7);
}

std::string unquote(std::string_view quoted) {
  std::string text;
  for (std::size_t i = 1; i + 1 < quoted.size(); ++i) {
    const bool escape = quoted[i] == '\\' && (quoted[i + 1] == '"' || quoted[i + 1] == '\\');
    if (escape && i + 2 < quoted.size()) ++i;
    text += quoted[i];
  }
  return text;
}

}  // namespace raytracer::scene_file
