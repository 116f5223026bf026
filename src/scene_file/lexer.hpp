// From characters to tokens.
#pragma once

#include <string_view>
#include <vector>

#include "scene_file/diagnostics.hpp"
#include "scene_file/source.hpp"

namespace raytracer::scene_file {

enum class TokenType : std::uint8_t {
  kEnd,
  kWord,
  kNumber,
  kString,
  kColor,  ///< #rgb or #rrggbb
  kOpenBrace,
  kCloseBrace,
  kOpenParenthesis,
  kCloseParenthesis,
  kOperator,  ///< any other punctuation of expressions, one or two characters
  kBad,       ///< already reported; stands for a value that nobody knows
};

struct Token {
  TokenType type = TokenType::kEnd;
  Span span;
  double number = 0;  ///< of a kNumber
};

/// Whether a sign belongs to the number behind it (a list of values) or is an operator (inside parentheses).
enum class LexMode : std::uint8_t { kValues, kExpression };

/// A token and how it was read, for tools that rewrite files.
struct ReadToken {
  Token token;
  LexMode mode = LexMode::kValues;
};

/// Reads tokens one after the other. Comments are kept aside, with their places, for tools that rewrite
/// files.
class Lexer {
 public:
  Lexer(const Source& source, Diagnostics& diagnostics);

  Token next(LexMode mode);

  /// The tokens to come, without a word to anybody, for looking ahead.
  Lexer quiet_copy() const;

  const std::vector<Span>& comments() const { return comments_; }
  /// Whether a comment that is never closed has swallowed the rest of the text.
  bool ended_in_comment() const { return ended_in_comment_; }

 private:
  void skip_blanks_and_comments();
  void skip_block_comment();
  Token lex_word();
  Token lex_number();
  Token lex_string();
  bool is_foreign_comment(std::uint32_t begin) const;
  Token lex_color();
  Token lex_operator(LexMode mode);
  Token unexpected_character(LexMode mode);
  std::string_view hint_for(std::uint32_t begin, LexMode mode) const;
  bool starts_with_lookalike() const;
  Token lex_lookalike();
  Token token(TokenType type, std::uint32_t begin) const { return {type, {begin, position_}, 0}; }
  char at(std::uint32_t offset) const { return offset < text_.size() ? text_[offset] : '\0'; }
  bool starts_number(std::uint32_t offset) const;
  void error(Span span, std::string message, std::string suggestion = {});

  const Source* source_;
  std::string_view text_;
  Diagnostics* diagnostics_;  // null in a quiet copy
  std::uint32_t position_ = 0;
  std::vector<Span> comments_;
  bool ended_in_comment_ = false;
};

/// Of a number that no double holds: whether it is too small rather than too large.
bool is_tiny_number(std::string_view number);

/// Whether a text is `#rgb` or `#rrggbb`.
bool is_color(std::string_view text);

/// The text between the quotes of a kString token, its escapes resolved.
std::string unquote(std::string_view quoted);

}  // namespace raytracer::scene_file
