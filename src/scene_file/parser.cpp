// A recursive-descent parser. The grammar needs no more of the vocabulary than this: `include` is a statement, and a
// `light` may carry two words. A bare word directly behind a property's name is its value; any other bare word
// begins the next property or block:
//
//   item     = "include" string | block | property
//   block    = word [word [word]] "{" { item } "}"
//   property = word (word { number | string | colour } | { number | string | colour })
#include "scene_file/parser.hpp"

#include <fmt/format.h>

#include <utility>

#include "scene_file/lexer.hpp"
#include "scene_file/schema.hpp"

namespace raytracer::scene_file {
namespace {

constexpr int kLanguageVersion = 1;

class Parser {
 public:
  Parser(const Source& source, Diagnostics& diagnostics)
      : source_(source),
        diagnostics_(diagnostics),
        lexer_(source, diagnostics),
        tree_(std::make_unique<SyntaxTree>()) {
    tree_->source = &source;
    current_ = lexer_.next(LexMode::kValues);
  }

  std::unique_ptr<SyntaxTree> parse() {
    parse_version();
    tree_->items = parse_items({});
    tree_->comments = lexer_.comments();
    return std::move(tree_);
  }

 private:
  // The kind of the block around an item; empty at the top of a file.
  using Context = std::string_view;

  void advance() {
    previous_end_ = current_.span.end;
    current_ = lexer_.next(LexMode::kValues);
  }
  std::string_view text(const Token& token) const { return source_.text(token.span); }
  bool current_is_value() const {
    return current_.type == TokenType::kNumber || current_.type == TokenType::kString ||
           current_.type == TokenType::kColor || current_.type == TokenType::kBad;
  }
  void error(Span span, std::string message, std::string suggestion = {}) {
    diagnostics_.error({&source_, span}, std::move(message), std::move(suggestion));
  }

  void parse_version();
  std::span<const ItemNode> parse_items(Context context);
  void parse_item(Context context, std::vector<ItemNode>& items);
  int words_before_brace() const;
  const BlockNode* parse_block(int words);
  const PropertyNode* parse_property(Context context);
  bool begins_next_property(Context context) const;
  const IncludeNode* parse_include();
  ValueNode take_value();
  void report_stray();
  void skip_operators();
  void skip_nested_braces();

  const Source& source_;
  Diagnostics& diagnostics_;
  Lexer lexer_;
  std::unique_ptr<SyntaxTree> tree_;
  Token current_;
  std::uint32_t previous_end_ = 0;
  int depth_ = 0;
};

void Parser::parse_version() {
  if (current_.type != TokenType::kWord || text(current_) != "raytracer") return;
  advance();
  if (current_.type == TokenType::kNumber && current_.number == kLanguageVersion) return advance();
  const bool is_number = current_.type == TokenType::kNumber;
  error(is_number ? current_.span : Span{previous_end_ - 9, previous_end_},
        is_number ? fmt::format("the scene is written in version {} of the language", text(current_))
                  : "the version of the language is missing",
        fmt::format("this program reads 'raytracer {}'", kLanguageVersion));
  if (is_number) advance();
}

std::span<const ItemNode> Parser::parse_items(Context context) {
  std::vector<ItemNode> items;
  while (current_.type != TokenType::kEnd) {
    if (current_.type == TokenType::kCloseBrace) {
      if (depth_ > 0) break;
      error(current_.span, "this '}' closes nothing");
      advance();
      continue;
    }
    parse_item(context, items);
  }
  return tree_->arena.copy(std::span<const ItemNode>(items));
}

void Parser::parse_item(Context context, std::vector<ItemNode>& items) {
  if (current_.type != TokenType::kWord) return report_stray();
  if (text(current_) == "include") {
    if (const IncludeNode* include = parse_include()) items.emplace_back(include);
    return;
  }
  const int words = words_before_brace();
  if (words > 0) {
    if (const BlockNode* block = parse_block(words)) items.emplace_back(block);
  } else if (const PropertyNode* property = parse_property(context)) {
    items.emplace_back(property);
  }
}

// How many words, the current one included, stand before a '{' if a block begins here; 0 if none does.
int Parser::words_before_brace() const {
  const int most = may_have_variant(text(current_)) ? 3 : 2;
  Lexer ahead = lexer_.quiet_copy();
  for (int words = 1; words <= most; ++words) {
    const Token token = ahead.next(LexMode::kValues);
    if (token.type == TokenType::kOpenBrace) return words;
    if (token.type != TokenType::kWord) return 0;
  }
  return 0;
}

const BlockNode* Parser::parse_block(int words) {
  BlockNode block;
  block.kind = current_.span;
  std::vector<Span> more;
  for (int i = 1; i < words; ++i) {
    advance();
    more.push_back(current_.span);
  }
  block.words = tree_->arena.copy(std::span<const Span>(more));
  advance();
  const Span open = current_.span;
  if (depth_ >= kDeepestNesting) {
    error(open, fmt::format("blocks are nested more than {} deep", kDeepestNesting));
    skip_nested_braces();
    return nullptr;
  }
  advance();
  ++depth_;
  block.items = parse_items(source_.text(block.kind));
  --depth_;
  if (current_.type == TokenType::kCloseBrace) {
    advance();
  } else {
    error(open, fmt::format("this '{{' of '{}' is never closed", source_.text(block.kind)), "'}' is missing");
  }
  block.end = previous_end_;
  return tree_->arena.make(block);
}

// Whether the word that follows a property's name is not its value but the next property: `radius center 0 1 0`.
bool Parser::begins_next_property(Context context) const {
  if (!is_property_of(context, text(current_))) return false;
  const TokenType next = lexer_.quiet_copy().next(LexMode::kValues).type;
  return next == TokenType::kNumber || next == TokenType::kString || next == TokenType::kColor ||
         next == TokenType::kOpenBrace;
}

ValueNode Parser::take_value() {
  ValueNode value;
  value.span = current_.span;
  value.number = current_.number;
  switch (current_.type) {
    case TokenType::kNumber: value.kind = ValueKind::kNumber; break;
    case TokenType::kString: value.kind = ValueKind::kString; break;
    case TokenType::kColor: value.kind = ValueKind::kColor; break;
    case TokenType::kWord: value.kind = ValueKind::kWord; break;
    default: value.kind = ValueKind::kBad; break;
  }
  advance();
  return value;
}

const PropertyNode* Parser::parse_property(Context context) {
  PropertyNode property;
  property.name = current_.span;
  advance();
  std::vector<ValueNode> values;
  if (current_.type == TokenType::kWord && !begins_next_property(context)) values.push_back(take_value());
  while (true) {
    if (current_is_value()) {
      values.push_back(take_value());
    } else if (current_.type == TokenType::kOperator || current_.type == TokenType::kOpenParenthesis) {
      ValueNode bad;
      bad.span = current_.span;
      report_stray();
      values.push_back(bad);
    } else {
      break;
    }
  }
  property.values = tree_->arena.copy(std::span<const ValueNode>(values));
  return tree_->arena.make(property);
}

const IncludeNode* Parser::parse_include() {
  IncludeNode include;
  include.keyword = current_.span;
  advance();
  if (current_.type != TokenType::kString) {
    if (current_.type != TokenType::kBad) {
      error(include.keyword, "'include' needs the name of a file", "include \"parts.txt\"");
    }
    if (current_.type != TokenType::kCloseBrace && current_.type != TokenType::kEnd) advance();
    return nullptr;
  }
  include.file = take_value();
  return tree_->arena.make(include);
}

// Something that can't stand where an item begins, or among values.
void Parser::report_stray() {
  const Token stray = current_;
  switch (stray.type) {
    case TokenType::kBad: break;  // the lexer has said it
    case TokenType::kOpenBrace:
      error(stray.span, "this '{' belongs to no block", "a block begins with its kind: sphere { … }");
      return skip_nested_braces();
    case TokenType::kOperator:
    case TokenType::kOpenParenthesis:
    case TokenType::kCloseParenthesis:
      skip_operators();
      error({stray.span.begin, previous_end_}, fmt::format("unexpected '{}'", text(stray)),
            text(stray) == "," || text(stray) == "=" ? "values are separated by spaces alone"
                                                       : "values are plain numbers, words and strings");
      return;
    default:
      while (current_is_value()) advance();
      error({stray.span.begin, previous_end_}, fmt::format("{} belongs to no property", text(stray)),
            "a property begins with its name: radius 1");
      return;
  }
  advance();
}

void Parser::skip_operators() {
  while (current_.type == TokenType::kOperator || current_.type == TokenType::kOpenParenthesis ||
         current_.type == TokenType::kCloseParenthesis) {
    advance();
  }
}

void Parser::skip_nested_braces() {
  int open = 0;
  do {
    if (current_.type == TokenType::kOpenBrace) ++open;
    if (current_.type == TokenType::kCloseBrace) --open;
    advance();
  } while (open > 0 && current_.type != TokenType::kEnd);
}

}  // namespace

std::unique_ptr<SyntaxTree> parse(const Source& source, Diagnostics& diagnostics) {
  return Parser(source, diagnostics).parse();
}

}  // namespace raytracer::scene_file
