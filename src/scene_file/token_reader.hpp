// What the parsers of blocks and of expressions share: the current token, and a voice.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "scene_file/lexer.hpp"
#include "scene_file/syntax.hpp"

namespace raytracer::scene_file {

class TokenReader {
 public:
  /// `record`, where it is given, gets every token that is read.
  TokenReader(const Source& source, Names& names, Arena& arena, Diagnostics& diagnostics,
              std::vector<ReadToken>* record = nullptr)
      : source_(source),
        names_(names),
        arena_(arena),
        diagnostics_(diagnostics),
        lexer_(source, diagnostics),
        record_(record) {
    read();
  }

  const Token& current() const { return current_; }
  bool is(TokenType type) const { return current_.type == type; }
  bool is_word(std::string_view word) const { return is(TokenType::kWord) && text() == word; }
  bool is_operator(std::string_view symbol) const { return is(TokenType::kOperator) && text() == symbol; }
  std::string_view text() const { return source_.text(current_.span); }
  std::string_view text(Span span) const { return source_.text(span); }
  NameId name_of(Span span) { return names_.id_of(source_.text(span)); }

  void advance() {
    previous_end_ = current_.span.end;
    read();
  }
  /// How the tokens behind the current one are read.
  void set_mode(LexMode mode) { mode_ = mode; }
  LexMode mode() const { return mode_; }
  std::uint32_t previous_end() const { return previous_end_; }
  /// A lexer that stands behind the current token.
  Lexer ahead() const { return lexer_.quiet_copy(); }
  const std::vector<Span>& comments() const { return lexer_.comments(); }
  bool ended_in_comment() const { return lexer_.ended_in_comment(); }
  /// While muted, the tokens read and the errors made say nothing.
  void mute(bool muted) { diagnostics_.mute(muted); }

  const Source& source() const { return source_; }
  Arena& arena() { return arena_; }
  void error(Span span, std::string message, std::string suggestion = {}) {
    diagnostics_.error({&source_, span}, std::move(message), std::move(suggestion));
  }

 private:
  void read() {
    current_ = lexer_.next(mode_);
    if (record_ != nullptr) record_->push_back({current_, mode_});
  }

  const Source& source_;
  Names& names_;
  Arena& arena_;
  Diagnostics& diagnostics_;
  Lexer lexer_;
  Token current_;
  LexMode mode_ = LexMode::kValues;
  std::uint32_t previous_end_ = 0;
  std::vector<ReadToken>* record_;
};

}  // namespace raytracer::scene_file
