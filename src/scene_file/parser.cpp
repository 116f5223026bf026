// A recursive-descent parser; the grammar stands in docs/scene-language.md. It needs no more of the
// vocabulary than that a `light` may carry two words, and it uses the properties' names only to tell what was
// forgotten. A bare word directly behind a property's name is its value, any other begins the next property
// or block; where that is not what was meant
// (`center x y z` with three names), the builder, which knows what a property takes, puts the pieces
// together.
#include "scene_file/parser.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "scene_file/expression_parser.hpp"
#include "scene_file/functions.hpp"
#include "scene_file/schema.hpp"
#include "scene_file/token_reader.hpp"

namespace raytracer::scene_file {
namespace {

bool is_statement(std::string_view word) {
  constexpr std::string_view kStatements[] = {"include", "let", "for", "if", "else", "define"};
  return std::ranges::find(kStatements, word) != std::end(kStatements);
}

// `color image "wood.png"`, `sky image "studio.exr"`
bool names_file(const PropertyNode& property) {
  const auto& values = property.values;
  return values.size() == 2 && values[0].kind == ValueKind::kWord && values[1].kind == ValueKind::kString;
}

class Parser {
 public:
  Parser(const Source& source, Names& names, Diagnostics& diagnostics, std::vector<ReadToken>* record)
      : tree_(std::make_unique<SyntaxTree>()), tokens_(source, names, tree_->arena, diagnostics, record) {
    tree_->source = &source;
  }

  std::unique_ptr<SyntaxTree> parse() {
    parse_version();
    tree_->items = parse_items({});
    tree_->comments = tokens_.comments();
    return std::move(tree_);
  }

 private:
  // The kind of the block around an item; empty at the top of a file.
  using Context = std::string_view;

  bool current_is_value() const {
    return tokens_.is(TokenType::kNumber) || tokens_.is(TokenType::kString) ||
           tokens_.is(TokenType::kColor) || tokens_.is(TokenType::kBad) ||
           tokens_.is(TokenType::kOpenParenthesis);
  }
  template <class Node>
  void add(std::vector<ItemNode>& items, const Node* node) {
    if (node != nullptr) items.emplace_back(node);
  }

  void parse_version();
  std::span<const ItemNode> parse_items(Context context);
  void parse_item(Context context, std::vector<ItemNode>& items);
  std::span<const ItemNode> parse_body(Span keyword, Context context);
  void parse_bad_block(std::vector<ItemNode>& items);
  int words_before_brace() const;
  const BlockNode* parse_block(int words);
  const BlockNode* block_with_file(const PropertyNode& property);
  void take_body(BlockNode& block, Context context);
  const PropertyNode* parse_property(Context context);
  bool begins_next_property(Context context) const;
  const IncludeNode* parse_include();
  const LetNode* parse_let();
  const ForNode* parse_for(Context context);
  const IfNode* parse_if(Context context);
  const DefineNode* parse_define();
  bool parse_parameter(std::vector<ParameterNode>& parameters);
  bool take_new_name(Span keyword, std::string_view what, Span& span, NameId& name);
  const Expression* parse_clause(std::string_view keyword, Span statement);
  ValueNode take_value();
  void report_stray(const std::string& hint = {});
  void skip_to_statement();
  void skip_nested_braces();
  void skip_parentheses();
  std::string plain_form(Span name) const;

  std::unique_ptr<SyntaxTree> tree_;
  TokenReader tokens_;
  int depth_ = 0;
  bool tokens_ended_open_ = false;  // some '{' lacks its '}': every block around it ends with the text too
};

void Parser::parse_version() {
  if (!tokens_.is_word("raytracer")) return;
  const Span keyword = tokens_.current().span;
  tokens_.advance();
  const bool is_number = tokens_.is(TokenType::kNumber);
  if (!is_number || tokens_.current().number != kLanguageVersion) {
    tokens_.error(is_number ? tokens_.current().span : keyword,
                  is_number
                      ? fmt::format("the scene is written in version {} of the language", tokens_.text())
                      : "the version of the language is missing",
                  fmt::format("this program reads 'raytracer {}'", kLanguageVersion));
  }
  if (is_number) tokens_.advance();
}

std::span<const ItemNode> Parser::parse_items(Context context) {
  std::vector<ItemNode> items;
  while (!tokens_.is(TokenType::kEnd)) {
    if (tokens_.is(TokenType::kCloseBrace)) {
      if (depth_ > 0) break;
      tokens_.error(tokens_.current().span, "this '}' closes nothing");
      tokens_.advance();
      continue;
    }
    parse_item(context, items);
  }
  return tree_->arena.copy(std::span<const ItemNode>(items));
}

void Parser::parse_item(Context context, std::vector<ItemNode>& items) {
  if (!tokens_.is(TokenType::kWord)) return report_stray();
  if (tokens_.is_word("include")) return add(items, parse_include());
  if (tokens_.is_word("let")) return add(items, parse_let());
  if (tokens_.is_word("for")) return add(items, parse_for(context));
  if (tokens_.is_word("if")) return add(items, parse_if(context));
  if (tokens_.is_word("define")) return add(items, parse_define());
  if (tokens_.is_word("else")) {
    tokens_.error(tokens_.current().span, "this 'else' belongs to no 'if'", "if t > 2 { … } else { … }");
    tokens_.advance();
    if (tokens_.is(TokenType::kOpenBrace)) skip_nested_braces();
    return;
  }
  const int words = words_before_brace();
  if (words > 0) return add(items, parse_block(words));
  if (find_kind(tokens_.text()) != nullptr && !is_property_of(context, tokens_.text()))
    return parse_bad_block(items);
  const PropertyNode* property = parse_property(context);
  if (property != nullptr && names_file(*property)) {
    const KindRow* kind = find_kind(tokens_.text(property->name), tokens_.text(property->values[0].span));
    if (kind != nullptr && find_file_property(*kind) != nullptr)
      return add(items, block_with_file(*property));
  }
  add(items, property);
}

// `sphere "ball" { … }`, `sphere radius 1 }`, `sphere`: a kind of block that no '{' follows as it should.
void Parser::parse_bad_block(std::vector<ItemNode>& items) {
  const Span kind = tokens_.current().span;
  constexpr int kMostJunk = 4;
  Lexer ahead = tokens_.ahead();
  Token token = ahead.next(LexMode::kValues);
  const Span junk_begin = token.span;
  Span junk_end = token.span;
  int count = 0;
  while (count < kMostJunk && (token.type == TokenType::kWord || token.type == TokenType::kString ||
                               token.type == TokenType::kNumber || token.type == TokenType::kOperator)) {
    junk_end = token.span;
    token = ahead.next(LexMode::kValues);
    ++count;
  }
  if (token.type == TokenType::kOpenBrace && count > 0) {
    const Span junk = {junk_begin.begin, junk_end.end};
    tokens_.error(junk, fmt::format("{} can't be the name of a {}", tokens_.text(junk), tokens_.text(kind)),
                  fmt::format("a name is one word: {} ball {{ … }}", tokens_.text(kind)));
    while (!tokens_.is(TokenType::kOpenBrace)) tokens_.advance();
    BlockNode block;
    block.kind = kind;
    block.kind_name = tokens_.name_of(kind);
    block.items = parse_body(kind, tokens_.text(kind));
    block.end = tokens_.previous_end();
    return add(items, tree_->arena.make(block));
  }
  tokens_.error(kind, fmt::format("'{}' needs braces", tokens_.text(kind)),
                fmt::format("{} {{ … }}", tokens_.text(kind)));
  tokens_.advance();
  if (tokens_.is(TokenType::kOpenParenthesis)) return skip_parentheses();
  // What follows are its properties, up to a '}' or the next block.
  tokens_.mute(true);
  while (tokens_.is(TokenType::kWord) && words_before_brace() == 0 && !is_statement(tokens_.text()) &&
         find_kind(tokens_.text()) == nullptr) {
    parse_property(tokens_.text(kind));
  }
  if (depth_ == 0 && tokens_.is(TokenType::kCloseBrace)) tokens_.advance();
  tokens_.mute(false);
}

// How many words, the current one included, stand before a '{' if a block begins here; 0 if none does.
int Parser::words_before_brace() const {
  Lexer ahead = tokens_.ahead();
  for (int words = 1; words <= 2 || (words == 3 && may_have_variant(tokens_.text())); ++words) {
    const Token token = ahead.next(LexMode::kValues);
    if (token.type == TokenType::kOpenBrace) return words;
    if (token.type != TokenType::kWord || is_statement(tokens_.text(token.span))) return 0;
  }
  return 0;
}

// The items between a '{', which must be the current token, and its '}'.
std::span<const ItemNode> Parser::parse_body(Span keyword, Context context) {
  const Span open = tokens_.current().span;
  if (depth_ >= kDeepestNesting) {
    tokens_.error(open, fmt::format("blocks are nested more than {} deep", kDeepestNesting));
    skip_nested_braces();
    return {};
  }
  tokens_.advance();
  ++depth_;
  const std::span<const ItemNode> items = parse_items(context);
  --depth_;
  if (tokens_.is(TokenType::kCloseBrace)) {
    tokens_.advance();
  } else {
    tokens_ended_open_ = true;
    if (!tokens_.ended_in_comment()) {
      tokens_.error(open, fmt::format("this '{{' of '{}' is never closed", tokens_.text(keyword)),
                    "'}' is missing");
    }
  }
  return items;
}

const BlockNode* Parser::parse_block(int words) {
  BlockNode block;
  block.kind = tokens_.current().span;
  block.kind_name = tokens_.name_of(block.kind);
  std::vector<Span> more;
  for (int i = 1; i < words; ++i) {
    tokens_.advance();
    more.push_back(tokens_.current().span);
  }
  block.words = tree_->arena.copy(std::span<const Span>(more));
  tokens_.advance();
  // In `color checker { … }` stand a texture's properties.
  const bool is_texture = more.size() == 1 && find_texture_kind(tokens_.text(more[0])) != nullptr;
  take_body(block, is_texture ? kTextureKind : tokens_.text(block.kind));
  return tree_->arena.make(block);
}

// `sky image "studio.exr" { … }`: a block whose first property is the file.
const BlockNode* Parser::block_with_file(const PropertyNode& property) {
  PropertyNode file;
  file.name = property.values[1].span;
  file.values = property.values.subspan(1);
  BlockNode block;
  block.kind = property.name;
  block.kind_name = property.name_id;
  block.words = tree_->arena.copy(std::span<const Span>(&property.values[0].span, 1));
  block.end = property.whole().end;
  if (property.body != nullptr) block = *property.body;
  std::vector<ItemNode> items = {tree_->arena.make(file)};
  items.insert(items.end(), block.items.begin(), block.items.end());
  block.items = tree_->arena.copy(std::span<const ItemNode>(items));
  return tree_->arena.make(block);
}

void Parser::take_body(BlockNode& block, Context context) {
  block.items = parse_body(block.kind, context);
  block.end = tokens_.previous_end();
  block.is_closed =
      block.end > block.kind.end && tokens_.text({block.end - 1, block.end}) == "}" && !tokens_ended_open_;
}

// Whether the word that follows a property's name is not its value but the next property: `radius center 0 1
// 0`.
bool Parser::begins_next_property(Context context) const {
  if (is_statement(tokens_.text())) return true;
  if (!is_property_of(context, tokens_.text())) return false;
  const TokenType next = tokens_.ahead().next(LexMode::kValues).type;
  return next == TokenType::kNumber || next == TokenType::kString || next == TokenType::kColor ||
         next == TokenType::kOpenBrace || next == TokenType::kOpenParenthesis;
}

ValueNode Parser::take_value() {
  ValueNode value;
  value.span = tokens_.current().span;
  value.number = tokens_.current().number;
  switch (tokens_.current().type) {
    case TokenType::kNumber:
      value.kind = ValueKind::kNumber;
      break;
    case TokenType::kString:
      value.kind = ValueKind::kString;
      break;
    case TokenType::kColor:
      value.kind = ValueKind::kColor;
      break;
    case TokenType::kWord:
      value.kind = ValueKind::kWord;
      value.name = tokens_.name_of(value.span);
      break;
    case TokenType::kOpenParenthesis:
      value.expression = ExpressionParser(tokens_).parse_parenthesised();
      value.kind =
          value.expression->operation == Operation::kUnknown ? ValueKind::kBad : ValueKind::kExpression;
      value.span = value.expression->span;
      return value;
    default:
      value.kind = ValueKind::kBad;
      break;
  }
  tokens_.advance();
  return value;
}

const PropertyNode* Parser::parse_property(Context context) {
  PropertyNode property;
  property.name = tokens_.current().span;
  property.name_id = tokens_.name_of(property.name);
  tokens_.advance();
  if (tokens_.is_operator("=") && (context.empty() || context == "group")) {
    tokens_.error(property.name,
                  fmt::format("'{}' is given a value without 'let'", tokens_.text(property.name)),
                  fmt::format("let {} = …", tokens_.text(property.name)));
    skip_to_statement();
    return nullptr;
  }
  std::vector<ValueNode> values;
  if (tokens_.is(TokenType::kWord) && !begins_next_property(context)) values.push_back(take_value());
  bool is_bad = false;
  while (true) {
    const bool is_stray = tokens_.is(TokenType::kOperator) || tokens_.is(TokenType::kCloseParenthesis);
    const bool is_glued =
        is_bad && tokens_.is(TokenType::kWord) && tokens_.current().span.begin == tokens_.previous_end();
    if (is_stray && !is_bad) {
      values.push_back({});
      values.back().span = tokens_.current().span;
      report_stray(values.size() == 1 ? plain_form(property.name) : std::string());
    } else if (current_is_value() || is_stray || is_glued) {
      values.push_back(take_value());
    } else {
      break;
    }
    // One slip among the values is enough said about them.
    is_bad = is_bad || values.back().kind == ValueKind::kBad;
    tokens_.mute(is_bad);
  }
  tokens_.mute(false);
  property.values = tree_->arena.copy(std::span<const ValueNode>(values));
  // `color image "wood.png" { … }`
  if (names_file(property) && tokens_.is(TokenType::kOpenBrace)) {
    BlockNode block;
    block.kind = property.name;
    block.kind_name = property.name_id;
    block.words = tree_->arena.copy(std::span<const Span>(&values[0].span, 1));
    take_body(block, kTextureKind);
    property.body = tree_->arena.make(block);
  }
  return tree_->arena.make(property);
}

const IncludeNode* Parser::parse_include() {
  IncludeNode include;
  include.keyword = tokens_.current().span;
  tokens_.advance();
  if (!tokens_.is(TokenType::kString)) {
    if (!tokens_.is(TokenType::kBad)) {
      tokens_.error(include.keyword, "'include' needs the name of a file", "include \"parts.txt\"");
    }
    skip_to_statement();
    return nullptr;
  }
  include.file = take_value();
  return tree_->arena.make(include);
}

// The word that a statement gives a meaning to.
bool Parser::take_new_name(Span keyword, std::string_view what, Span& span, NameId& name) {
  const bool is_clause = tokens_.text(keyword) == "for" &&
                         (tokens_.is_word("from") || tokens_.is_word("to") || tokens_.is_word("step"));
  if (!tokens_.is(TokenType::kWord) || is_clause) {
    if (!tokens_.is(TokenType::kBad)) {
      tokens_.error(keyword, fmt::format("'{}' needs a name", tokens_.text(keyword)), std::string(what));
    }
    skip_to_statement();
    return false;
  }
  span = tokens_.current().span;
  name = tokens_.name_of(span);
  if (is_reserved(tokens_.text())) {
    tokens_.error(span, fmt::format("'{}' is built in and can't be given another meaning", tokens_.text()),
                  "choose another name");
  }
  return true;
}

// After a statement that can't be understood: silently on to the next one, which begins with a keyword or in
// a new line, and over the braces that belong to this one.
void Parser::skip_to_statement() {
  tokens_.mute(true);
  std::uint32_t end = tokens_.previous_end();
  while (!tokens_.is(TokenType::kEnd) && !tokens_.is(TokenType::kCloseBrace)) {
    if (tokens_.is(TokenType::kOpenBrace)) {
      skip_nested_braces();
      break;
    }
    const bool is_new_line =
        tokens_.text({end, tokens_.current().span.begin}).find_first_of("\r\n") != std::string_view::npos;
    if (tokens_.is(TokenType::kWord) && (is_statement(tokens_.text()) || is_new_line)) break;
    end = tokens_.current().span.end;
    tokens_.advance();
  }
  tokens_.mute(false);
}

const LetNode* Parser::parse_let() {
  LetNode let;
  const Span keyword = tokens_.current().span;
  tokens_.advance();
  if (!take_new_name(keyword, "let n = 12", let.name_span, let.name)) return nullptr;
  tokens_.advance();
  if (!tokens_.is_operator("=")) {
    if (!tokens_.is(TokenType::kBad)) {
      tokens_.error(let.name_span,
                    fmt::format("'let {}' needs a '=' and a value", tokens_.text(let.name_span)),
                    "let n = 12");
    }
    skip_to_statement();
    return nullptr;
  }
  tokens_.set_mode(LexMode::kExpression);
  tokens_.advance();
  let.value = ExpressionParser(tokens_).parse_open();
  // `let p = 1 2 3`: a vector has parentheses.
  if (let.value->operation != Operation::kUnknown &&
      (tokens_.is(TokenType::kNumber) || tokens_.is(TokenType::kString))) {
    const Span extra = tokens_.current().span;
    while (current_is_value()) take_value();
    tokens_.error({extra.begin, tokens_.previous_end()}, "'let' takes one value",
                  "a vector is written (1, 2, 3)");
  }
  return tree_->arena.make(let);
}

// `from 0`: a word of a statement and the expression behind it.
const Expression* Parser::parse_clause(std::string_view keyword, Span statement) {
  if (!tokens_.is_word(keyword)) {
    if (!tokens_.is(TokenType::kBad)) {
      tokens_.error(statement, fmt::format("'for' needs a '{}'", keyword), "for i from 0 to 9 { … }");
    }
    return nullptr;
  }
  tokens_.set_mode(LexMode::kExpression);
  tokens_.advance();
  return ExpressionParser(tokens_).parse_open();
}

const ForNode* Parser::parse_for(Context context) {
  ForNode loop;
  loop.keyword = tokens_.current().span;
  tokens_.advance();
  if (!take_new_name(loop.keyword, "for i from 0 to 9 { … }", loop.name_span, loop.name)) return nullptr;
  tokens_.advance();
  const Span head = {loop.keyword.begin, loop.name_span.end};
  loop.from = parse_clause("from", head);
  loop.to = loop.from == nullptr ? nullptr : parse_clause("to", head);
  if (loop.to != nullptr && tokens_.is_word("step")) loop.step = parse_clause("step", head);
  if (!tokens_.is(TokenType::kOpenBrace)) {
    const bool said = loop.to == nullptr || loop.to->operation == Operation::kUnknown ||
                      (loop.step != nullptr && loop.step->operation == Operation::kUnknown);
    if (!said) tokens_.error(head, "'for' needs braces around what it repeats", "for i from 0 to 9 { … }");
    skip_to_statement();
    return nullptr;
  }
  loop.items = parse_body(loop.keyword, context);
  return loop.to == nullptr ? nullptr : tree_->arena.make(loop);
}

const IfNode* Parser::parse_if(Context context) {
  IfNode choice;
  choice.keyword = tokens_.current().span;
  tokens_.set_mode(LexMode::kExpression);
  tokens_.advance();
  choice.condition = ExpressionParser(tokens_).parse_open();
  if (!tokens_.is(TokenType::kOpenBrace)) {
    if (choice.condition->operation != Operation::kUnknown && tokens_.is_operator("=")) {
      tokens_.error(tokens_.current().span, "'=' gives a name its value", "'==' compares");
    } else if (choice.condition->operation != Operation::kUnknown && !tokens_.is(TokenType::kBad)) {
      tokens_.error(choice.keyword, "'if' needs braces around what it guards", "if t > 2 { … } else { … }");
    }
    skip_to_statement();
    return nullptr;
  }
  choice.items = parse_body(choice.keyword, context);
  if (!tokens_.is_word("else")) return tree_->arena.make(choice);
  const Span else_keyword = tokens_.current().span;
  tokens_.advance();
  if (tokens_.is_word("if")) {
    std::vector<ItemNode> nested;
    if (depth_ < kDeepestNesting) {
      ++depth_;  // `else if` chains are a recursion too
      add(nested, parse_if(context));
      --depth_;
    } else {
      tokens_.error(else_keyword, fmt::format("blocks are nested more than {} deep", kDeepestNesting));
      skip_to_statement();
    }
    choice.else_items = tree_->arena.copy(std::span<const ItemNode>(nested));
  } else if (tokens_.is(TokenType::kOpenBrace)) {
    choice.else_items = parse_body(else_keyword, context);
  } else {
    tokens_.error(else_keyword, "'else' needs braces around what it guards", "else { … }");
  }
  return tree_->arena.make(choice);
}

const DefineNode* Parser::parse_define() {
  DefineNode define;
  define.keyword = tokens_.current().span;
  tokens_.advance();
  if (!take_new_name(define.keyword, "define tree (height 2) { … }", define.name_span, define.name))
    return nullptr;
  if (find_kind(tokens_.text()) != nullptr) {
    tokens_.error(define.name_span,
                  fmt::format("'{}' is built in and can't be given another meaning", tokens_.text()),
                  "choose another name");
  }
  tokens_.advance();
  std::vector<ParameterNode> parameters;
  if (tokens_.is(TokenType::kOpenParenthesis)) {
    const Span open = tokens_.current().span;
    tokens_.advance();
    while (tokens_.is(TokenType::kWord) && parse_parameter(parameters)) {
    }
    if (!tokens_.is(TokenType::kCloseParenthesis)) {
      if (!tokens_.is(TokenType::kBad)) {
        tokens_.error(open, "this list of parameters is never closed", "(size 1, hat black)");
      }
      skip_to_statement();
      return nullptr;
    }
    tokens_.advance();
  }
  if (!tokens_.is(TokenType::kOpenBrace)) {
    tokens_.error({define.keyword.begin, define.name_span.end},
                  "'define' needs braces around what it defines", "define tree (height 2) { … }");
    skip_to_statement();
    return nullptr;
  }
  define.parameters = tree_->arena.copy(std::span<const ParameterNode>(parameters));
  define.items = parse_body(define.keyword, "group");
  return tree_->arena.make(define);
}

// `size 1` and the comma behind it; false where no further one follows.
bool Parser::parse_parameter(std::vector<ParameterNode>& parameters) {
  ParameterNode parameter;
  parameter.name_span = tokens_.current().span;
  parameter.name = tokens_.name_of(parameter.name_span);
  const std::string_view word = tokens_.text();
  const bool taken = is_reserved(word) || is_property_of("group", word);
  if (taken) {
    tokens_.error(parameter.name_span,
                  fmt::format("'{}' can't be a parameter: it has a meaning of its own", word),
                  "choose another name");
  }
  for (const ParameterNode& other : parameters) {
    if (other.name == parameter.name) {
      tokens_.error(parameter.name_span, fmt::format("a second parameter of the name '{}'", word));
    }
  }
  tokens_.advance();
  if (tokens_.is_operator("=")) {
    tokens_.error(tokens_.current().span, "a default follows its parameter without '='",
                  fmt::format("({} 1)", word));
    tokens_.mute(true);
    while (!tokens_.is(TokenType::kCloseParenthesis) && !tokens_.is(TokenType::kOpenBrace) &&
           !tokens_.is(TokenType::kCloseBrace) && !tokens_.is(TokenType::kEnd)) {
      tokens_.advance();
    }
    tokens_.mute(false);
    return false;
  }
  std::vector<ValueNode> values;
  while (current_is_value() || tokens_.is(TokenType::kWord)) values.push_back(take_value());
  if (values.empty()) {
    tokens_.error(parameter.name_span, fmt::format("the parameter '{}' has no default", word),
                  fmt::format("({} 1)", word));
    values.push_back({});
  }
  parameter.values = tree_->arena.copy(std::span<const ValueNode>(values));
  parameters.push_back(parameter);
  if (!tokens_.is_operator(",")) return false;
  tokens_.advance();
  return true;
}

// Something that can't stand where an item begins, or among values.
void Parser::report_stray(const std::string& hint) {
  const Token stray = tokens_.current();
  switch (stray.type) {
    case TokenType::kBad:
      break;  // the lexer has said it
    case TokenType::kOpenBrace:
      tokens_.error(stray.span, "this '{' belongs to no block", "a block begins with its kind: sphere { … }");
      return skip_nested_braces();
    case TokenType::kOperator:
    case TokenType::kCloseParenthesis: {
      const bool separates = tokens_.text() == "," || tokens_.text() == "=";
      while (tokens_.is(TokenType::kOperator) || tokens_.is(TokenType::kCloseParenthesis)) tokens_.advance();
      tokens_.error({stray.span.begin, tokens_.previous_end()},
                    fmt::format("unexpected '{}'", tokens_.text(stray.span)),
                    !hint.empty() ? hint
                    : separates   ? "values are separated by spaces alone"
                                  : "a computed value stands in parentheses: (2 * r)");
      return;
    }
    default: {
      while (current_is_value()) take_value();
      const Span all = {stray.span.begin, tokens_.previous_end()};
      const bool several = all.end > stray.span.end;
      tokens_.error(all,
                    several ? "these values belong to no property"
                            : fmt::format("{} belongs to no property", tokens_.text(all)),
                    "a property begins with its name: radius 1");
      return;
    }
  }
  tokens_.advance();
}

void Parser::skip_nested_braces() {
  int open = 0;
  do {
    if (tokens_.is(TokenType::kOpenBrace)) ++open;
    if (tokens_.is(TokenType::kCloseBrace)) --open;
    tokens_.advance();
  } while (open > 0 && !tokens_.is(TokenType::kEnd));
}

// Silently behind the ')' that belongs to the current '('.
void Parser::skip_parentheses() {
  tokens_.mute(true);
  int open = 0;
  do {
    if (tokens_.is(TokenType::kOpenParenthesis)) ++open;
    if (tokens_.is(TokenType::kCloseParenthesis)) --open;
    tokens_.advance();
  } while (open > 0 && !tokens_.is(TokenType::kEnd));
  tokens_.mute(false);
}

// What `radius: 1` and `center <0, 1, 0>` are here, where other languages' signs stand behind a property's
// name; empty where it can't be said.
std::string Parser::plain_form(Span name) const {
  if (!tokens_.is_operator(":") && !tokens_.is_operator("<") && !tokens_.is_operator("=")) return {};
  constexpr int kMostValues = 4;
  std::string values;
  int count = 0;
  Lexer ahead = tokens_.ahead();
  for (Token token = ahead.next(LexMode::kValues); count < kMostValues;
       token = ahead.next(LexMode::kValues)) {
    const bool is_value = token.type == TokenType::kNumber || token.type == TokenType::kString ||
                          token.type == TokenType::kColor || (token.type == TokenType::kWord && count == 0);
    if (!is_value && token.type != TokenType::kOperator) break;
    if (!is_value) continue;
    values += fmt::format(" {}", tokens_.text(token.span));
    ++count;
  }
  return count == 0 ? std::string() : fmt::format("{}{}", tokens_.text(name), values);
}

}  // namespace

std::unique_ptr<SyntaxTree> parse(const Source& source, Names& names, Diagnostics& diagnostics,
                                  std::vector<ReadToken>* record) {
  return Parser(source, names, diagnostics, record).parse();
}

const Expression* parse_lone_expression(const Source& source, Names& names, Arena& arena,
                                        Diagnostics& diagnostics) {
  TokenReader tokens(source, names, arena, diagnostics);
  const std::size_t errors_before = diagnostics.error_count();
  // The first token was read as a value would be: a sign belongs to its number, which does no harm.
  tokens.set_mode(LexMode::kExpression);
  const Expression* expression = ExpressionParser(tokens).parse_open();
  if (!tokens.is(TokenType::kEnd) && diagnostics.error_count() == errors_before) {
    diagnostics.error({&source, tokens.current().span}, "unexpected text behind the value");
  }
  return diagnostics.error_count() == errors_before ? expression : nullptr;
}

}  // namespace raytracer::scene_file
