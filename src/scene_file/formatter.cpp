#include "scene_file/formatter.hpp"

#include <algorithm>
#include <array>
#include <string_view>

#include "scene_file/item_starts.hpp"
#include "scene_file/parser.hpp"

namespace raytracer::scene_file {
namespace {

constexpr std::size_t kWidest = 100;  // columns of a line that holds a whole block
constexpr std::size_t kIndent = 2;

// A token or a comment.
struct Piece {
  Span span;
  TokenType type = TokenType::kEnd;  ///< kEnd for comments
  LexMode mode = LexMode::kValues;
  bool is_comment = false;
  bool is_line_comment = false;  ///< `//`: nothing can follow on its line
  bool is_sign = false;          ///< a '+' or '-' with nothing in front of it to add to
  bool is_start = false;         ///< of an item
  int line_ends = 0;             ///< between the piece in front and this one
  std::size_t partner = 0;       ///< of a '{': the index of its '}'
};

bool is_keyword_before_value(std::string_view word) {
  constexpr std::array<std::string_view, 7> kWords = {"if", "from", "to", "step", "and", "or", "not"};
  return std::ranges::find(kWords, word) != kWords.end();
}

// The source as a sequence of pieces, each knowing what layout needs to know of it.
class Pieces {
 public:
  Pieces(const SyntaxTree& tree, const std::vector<ReadToken>& tokens) : source_(*tree.source) {
    auto comment = tree.comments.begin();
    for (const ReadToken& read : tokens) {
      for (; comment != tree.comments.end() && comment->begin < read.token.span.begin; ++comment)
        add_comment(*comment);
      if (read.token.type != TokenType::kEnd) add_token(read);
    }
    mark_starts(item_starts(tree));
    pair_braces();
  }

  std::size_t size() const { return pieces_.size(); }
  const Piece& operator[](std::size_t i) const { return pieces_[i]; }
  std::string_view text(std::size_t i) const { return source_.text(pieces_[i].span); }
  std::string_view text_between(std::size_t first, std::size_t last) const {
    return source_.text({pieces_[first].span.begin, pieces_[last].span.end});
  }
  bool is(std::size_t i, std::string_view symbol) const {
    return !pieces_[i].is_comment && text(i) == symbol;
  }

 private:
  void add(Piece piece) {
    const std::uint32_t begin = pieces_.empty() ? 0 : pieces_.back().span.end;
    const std::string_view gap = source_.text({begin, piece.span.begin});
    piece.line_ends = static_cast<int>(std::ranges::count(gap, '\n'));
    pieces_.push_back(piece);
  }

  void add_comment(Span span) {
    Piece piece;
    piece.span = span;
    piece.is_comment = true;
    piece.is_line_comment = source_.text(span).starts_with("//");
    while (piece.is_line_comment &&
           source_.text(piece.span).find_last_of(" \t\v\f") == piece.span.end - piece.span.begin - 1) {
      --piece.span.end;
    }
    add(piece);
  }

  void add_token(const ReadToken& read) {
    Piece piece;
    piece.span = read.token.span;
    piece.type = read.token.type;
    piece.mode = read.mode;
    const std::string_view symbol = source_.text(piece.span);
    piece.is_sign =
        piece.type == TokenType::kOperator && (symbol == "+" || symbol == "-") && !last_ends_operand_;
    add(piece);
    last_ends_operand_ = piece.type == TokenType::kWord ? !is_keyword_before_value(symbol)
                                                        : piece.type != TokenType::kOperator &&
                                                              piece.type != TokenType::kOpenParenthesis;
  }

  void mark_starts(const std::vector<std::uint32_t>& offsets) {
    std::size_t token = pieces_.size();  // the latest token in front
    auto start = offsets.begin();
    for (std::size_t i = 0; i < pieces_.size(); ++i) {
      if (pieces_[i].is_comment) continue;
      Piece& piece = pieces_[i];
      if (token == pieces_.size() && text(i) == "raytracer") piece.is_start = true;  // the version
      if (start != offsets.end() && *start == piece.span.begin) {
        ++start;
        // Offsets of a 'let' are those of its name; the 'if' of an 'else if' is part of the item that the
        // 'else' belongs to.
        const bool has_let = token != pieces_.size() && text(token) == "let" && !pieces_[token].is_start;
        const bool goes_on = token != pieces_.size() && text(token) == "else";
        if (!goes_on) pieces_[has_let ? token : i].is_start = true;
      }
      token = i;
    }
  }

  void pair_braces() {
    std::vector<std::size_t> open;
    for (std::size_t i = 0; i < pieces_.size(); ++i) {
      if (pieces_[i].type == TokenType::kOpenBrace) open.push_back(i);
      if (pieces_[i].type != TokenType::kCloseBrace) continue;
      pieces_[open.back()].partner = i;
      open.pop_back();
    }
  }

  const Source& source_;
  std::vector<Piece> pieces_;
  bool last_ends_operand_ = false;
};

class Writer {
 public:
  explicit Writer(const Pieces& pieces) : pieces_(pieces) {}

  std::string write() {
    write_body(0, pieces_.size(), 0);
    if (!out_.empty()) out_ += '\n';
    return std::move(out_);
  }

 private:
  void break_line(std::size_t level) {
    out_ += '\n';
    out_.append(kIndent * level, ' ');
  }

  std::size_t column() const {
    const std::size_t line = out_.rfind('\n') + 1;  // npos + 1 is 0
    return width(std::string_view(out_).substr(line));
  }

  // In characters: the bytes that continue one are not counted.
  static std::size_t width(std::string_view text) {
    return static_cast<std::size_t>(
        std::ranges::count_if(text, [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80; }));
  }

  // One past the last token of the item that begins at `first`.
  std::size_t end_of_item(std::size_t first, std::size_t limit) const {
    std::size_t end = first;
    for (std::size_t i = first; i < limit && (i == first || !pieces_[i].is_start); ++i) {
      if (pieces_[i].type == TokenType::kOpenBrace) i = pieces_[i].partner;
      if (!pieces_[i].is_comment) end = i + 1;
    }
    return end;
  }

  // The items and comments [begin, end), each on a line of its own but for comments behind and in front of
  // something.
  void write_body(std::size_t begin, std::size_t end, std::size_t level) {
    bool line_has_item = level > 0;  // the '{' in front
    for (std::size_t i = begin; i < end;) {
      const bool follows = pieces_[i].line_ends == 0 && i > 0;
      if (pieces_[i].is_comment && follows) {
        out_ += line_has_item && !pieces_[i - 1].is_comment ? "  " : " ";
      } else if (!pieces_[i].is_comment && follows && !line_has_item) {
        out_ += ' ';  // behind a comment that begins the line
      } else if (i > begin || level > 0) {
        if (i > begin && pieces_[i].line_ends > 1) out_ += '\n';
        break_line(level);
        line_has_item = false;
      }
      if (pieces_[i].is_comment) {
        out_ += pieces_.text(i++);
      } else {
        const std::size_t item_end = end_of_item(i, end);
        write_item(i, item_end, level);
        i = item_end;
        line_has_item = true;
      }
    }
  }

  void write_item(std::size_t begin, std::size_t end, std::size_t level) {
    const bool was_on_one_line = pieces_.text_between(begin, end - 1).find('\n') == std::string_view::npos;
    if (was_on_one_line && pieces_[end - 1].type == TokenType::kCloseBrace) {
      const std::string line = on_one_line(begin, end);
      if (column() + width(line) <= kWidest) {
        out_ += line;
        return;
      }
    }
    const bool is_block = is_header_of_block(begin, end);
    for (std::size_t i = begin; i < end; ++i) {
      if (i > begin) separate(begin, i, level, is_block);
      out_ += pieces_.text(i);
      if (pieces_[i].type != TokenType::kOpenBrace) continue;
      const std::size_t close = pieces_[i].partner;
      if (close == i + 1) {
        out_ += ' ';
      } else {
        write_body(i + 1, close, level + 1);
        break_line(level);
      }
      out_ += '}';
      i = close;
    }
  }

  // `light spot lamp {`: words alone.
  bool is_header_of_block(std::size_t begin, std::size_t end) const {
    for (std::size_t i = begin; i < end; ++i) {
      if (pieces_[i].type == TokenType::kOpenBrace) return !is_statement(begin);
      if (!pieces_[i].is_comment && pieces_[i].type != TokenType::kWord) return false;
    }
    return false;
  }
  bool is_statement(std::size_t i) const {
    return pieces_.is(i, "if") || pieces_.is(i, "for") || pieces_.is(i, "define") || pieces_.is(i, "let");
  }

  // What stands between the piece `i` of an item and the one in front of it, where the item may take several
  // lines.
  void separate(std::size_t begin, std::size_t i, std::size_t level, bool is_block) {
    const Piece& piece = pieces_[i];
    const Piece& previous = pieces_[i - 1];
    const bool broken = piece.line_ends > 0;
    const bool continues_item = piece.type == TokenType::kOpenBrace || pieces_.is(i, "else");
    const bool closes = piece.type == TokenType::kCloseParenthesis;
    const bool is_behind_body = previous.type == TokenType::kCloseBrace;
    if (previous.is_comment || piece.is_comment) {
      if (broken) return break_line(continues_item || closes || is_behind_body ? level : level + 2);
      out_ += piece.is_line_comment ? "  " : " ";
      return;
    }
    const std::string_view space = between(i);
    const bool may_break = !space.empty() || previous.type == TokenType::kOpenParenthesis || closes;
    const bool is_early = i == begin + 1 || is_block || continues_item || is_behind_body;
    if (broken && may_break && !is_early) return break_line(closes ? level : level + 2);
    out_ += space;
  }

  // The space in front of the token `i` within its item; the piece in front is a token, too.
  std::string_view between(std::size_t i) const {
    const Piece& piece = pieces_[i];
    const Piece& previous = pieces_[i - 1];
    if (pieces_.is(i, ",") || piece.type == TokenType::kCloseParenthesis) return "";
    if (previous.type == TokenType::kOpenParenthesis || previous.is_sign) return "";
    if (pieces_.is(i, ".")) return previous.type == TokenType::kNumber ? " " : "";  // `1.x` is no number
    if (pieces_.is(i - 1, ".")) return "";
    const bool is_call = piece.type == TokenType::kOpenParenthesis && piece.mode == LexMode::kExpression &&
                         previous.type == TokenType::kWord && !is_keyword_before_value(pieces_.text(i - 1));
    return is_call ? "" : " ";
  }

  // The pieces [begin, end), or enough of them to see that they have no room.
  std::string on_one_line(std::size_t begin, std::size_t end) const {
    constexpr std::size_t kMostBytes = 4 * kWidest;
    std::string line;
    for (std::size_t i = begin; i < end && line.size() <= kMostBytes; ++i) {
      const bool by_comment = i > begin && (pieces_[i].is_comment || pieces_[i - 1].is_comment);
      const bool by_brace = i > begin && (pieces_[i - 1].type == TokenType::kOpenBrace ||
                                          pieces_[i].type == TokenType::kCloseBrace);
      if (i > begin) line += by_comment || by_brace ? " " : pieces_[i].is_start ? "  " : between(i);
      line += pieces_.text(i);
    }
    return line;
  }

  const Pieces& pieces_;
  std::string out_;
};

// Line ends as LF, whatever they were; no byte-order mark.
std::string with_plain_line_ends(std::string_view text) {
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  std::string plain;
  plain.reserve(text.size());
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '\r' && i + 1 < text.size() && text[i + 1] == '\n') continue;
    plain += text[i] == '\r' ? '\n' : text[i];
  }
  return plain;
}

}  // namespace

FormattedText format_text(const std::string& text, const std::string& name) {
  const Source source(name, {}, with_plain_line_ends(text));
  Names names;
  Diagnostics diagnostics;
  std::vector<ReadToken> tokens;
  const std::unique_ptr<SyntaxTree> tree = parse(source, names, diagnostics, &tokens);
  if (diagnostics.has_errors()) return {{}, diagnostics.take()};
  return {Writer(Pieces(*tree, tokens)).write(), {}};
}

}  // namespace raytracer::scene_file
