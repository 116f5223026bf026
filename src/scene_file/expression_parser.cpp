#include "scene_file/expression_parser.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "core/suggest.hpp"
#include "scene_file/functions.hpp"
#include "scene_file/parser.hpp"
#include "scene_file/schema.hpp"

namespace raytracer::scene_file {
namespace {

struct BinaryOperator {
  std::string_view symbol;
  Operation operation;
};
constexpr BinaryOperator kComparisons[] = {
    {"==", Operation::kEqual},     {"!=", Operation::kNotEqual}, {"<", Operation::kLess},
    {"<=", Operation::kLessEqual}, {">", Operation::kGreater},   {">=", Operation::kGreaterEqual},
};
constexpr BinaryOperator kSums[] = {{"+", Operation::kAdd}, {"-", Operation::kSubtract}};
constexpr BinaryOperator kProducts[] = {
    {"*", Operation::kMultiply}, {"/", Operation::kDivide}, {"%", Operation::kRemainder}};

const BinaryOperator* current_operator(const TokenReader& tokens, std::span<const BinaryOperator> operators) {
  if (!tokens.is(TokenType::kOperator)) return nullptr;
  for (const BinaryOperator& row : operators) {
    if (row.symbol == tokens.text()) return &row;
  }
  return nullptr;
}

// What begins a statement can't be a value.
constexpr std::string_view kStatements[] = {"let", "for", "if", "else", "define", "include"};
constexpr std::string_view kClauses[] = {"from", "to", "step"};

bool is_one_of(std::string_view word, std::span<const std::string_view> words) {
  return std::ranges::find(words, word) != words.end();
}

// What somebody may have meant who writes this sign where the language has none.
std::string hint_for(std::string_view sign) {
  if (sign == "=") return "'==' compares";
  if (sign == "!") return "'not' negates: not a";
  return {};
}

constexpr int kMostNodes = 10'000;

// Counts how deep a recursion is while it lives.
class Deeper {
 public:
  explicit Deeper(int& depth) : depth_(depth) { ++depth_; }
  ~Deeper() { --depth_; }
  Deeper(const Deeper&) = delete;
  Deeper& operator=(const Deeper&) = delete;

 private:
  int& depth_;
};

}  // namespace

const Expression* ExpressionParser::add(const Expression& node) {
  if (++nodes_ > kMostNodes)
    fail(tokens_.current().span, "the expression is too long", "a 'let' can hold a part of it");
  return tokens_.arena().make(node);
}

const Expression* ExpressionParser::make(Operation operation, Span span,
                                         std::initializer_list<const Expression*> arguments) {
  Expression node;
  node.operation = operation;
  node.span = span;
  node.arguments =
      tokens_.arena().copy(std::span<const Expression* const>(arguments.begin(), arguments.size()));
  return add(node);
}

const Expression* ExpressionParser::unknown(Span span) {
  Expression node;
  node.span = span;
  return tokens_.arena().make(node);
}

// The form is broken here.
const Expression* ExpressionParser::fail(Span span, std::string message, std::string suggestion) {
  if (!told_) tokens_.error(span, std::move(message), std::move(suggestion));
  told_ = failed_ = true;
  return unknown(span);
}

// The current token is no value, though one is needed.
const Expression* ExpressionParser::fail_missing() {
  const Span here = tokens_.current().span;
  if (tokens_.is(TokenType::kBad)) {  // the lexer has said it
    told_ = failed_ = true;
    return unknown(here);
  }
  if (tokens_.is(TokenType::kEnd)) return fail(here, "the text ends where a value is missing");
  if (tokens_.previous_end() > 0 && is_on_new_line())
    return fail({tokens_.previous_end() - 1, tokens_.previous_end()}, "a value is missing behind this");
  return fail(here, fmt::format("'{}' stands where a value is missing", tokens_.text()),
              hint_for(tokens_.text()));
}

const Expression* ExpressionParser::parse_parenthesised() {
  const LexMode outside = tokens_.mode();
  const Span open = tokens_.current().span;
  tokens_.set_mode(LexMode::kExpression);
  tokens_.advance();
  const Expression* result = parse_list(open);
  if (failed_) skip_rest(true);
  tokens_.set_mode(outside);
  if (tokens_.is(TokenType::kCloseParenthesis)) tokens_.advance();
  // The span with its parentheses is what a message about the value underlines.
  Expression whole = failed_ ? Expression{} : *result;
  whole.span = {open.begin, tokens_.previous_end()};
  return tokens_.arena().make(whole);
}

const Expression* ExpressionParser::parse_open() {
  const Expression* result = parse_choice();
  tokens_.set_mode(LexMode::kValues);
  if (!failed_) check_end();
  if (!failed_) return result;
  skip_rest(false);
  return unknown({result->span.begin, std::max(result->span.begin, tokens_.previous_end())});
}

// Behind a whole expression that no parenthesis closes.
void ExpressionParser::check_end() {
  const Span here = tokens_.current().span;
  switch (tokens_.current().type) {
    case TokenType::kBad:
      told_ = failed_ = true;
      return;
    case TokenType::kCloseParenthesis:
      fail(here, "this ')' closes nothing");
      return;
    case TokenType::kOpenParenthesis:
      fail(here, "an operator is missing in front of this '('", "2 * (1 + 3)");
      return;
    case TokenType::kOperator:
      fail(here, fmt::format("unexpected '{}' behind a value", tokens_.text()),
           tokens_.text() == "," ? "a number has a decimal point: 1.5; a vector has parentheses: (1, 2, 3)"
                                 : hint_for(tokens_.text()));
      return;
    case TokenType::kNumber:
    case TokenType::kString:
    case TokenType::kColor: {
      tokens_.mute(true);
      while (tokens_.is(TokenType::kNumber) || tokens_.is(TokenType::kString) ||
             tokens_.is(TokenType::kColor)) {
        tokens_.advance();
      }
      tokens_.mute(false);
      fail({here.begin, tokens_.previous_end()}, "one value is wanted here", "a vector is written (1, 2, 3)");
      return;
    }
    default:
      return;
  }
}

// --- after a mistake
// -------------------------------------------------------------------------------------------------

bool ExpressionParser::is_on_new_line() const {
  return tokens_.text({tokens_.previous_end(), tokens_.current().span.begin}).find_first_of("\r\n") !=
         std::string_view::npos;
}

// Whether the current word is that of a block, `sphere {` or `light spot lamp {`, rather than a value.
bool ExpressionParser::begins_block() const {
  if (!tokens_.is(TokenType::kWord) || (!is_on_new_line() && find_kind(tokens_.text()) == nullptr))
    return false;
  Lexer ahead = tokens_.ahead();
  for (int words = 1; words <= 3; ++words) {
    const Token token = ahead.next(LexMode::kValues);
    if (token.type == TokenType::kOpenBrace) return true;
    if (token.type != TokenType::kWord) return false;
  }
  return false;
}

// Whether the current token can't belong to a broken expression any more, `open` of whose parentheses are not
// closed.
bool ExpressionParser::is_past(bool in_parentheses, int open) const {
  if (tokens_.is(TokenType::kEnd) || tokens_.is(TokenType::kOpenBrace) || tokens_.is(TokenType::kCloseBrace))
    return true;
  if (tokens_.is(TokenType::kCloseParenthesis)) return in_parentheses && open == 0;
  if (!tokens_.is(TokenType::kWord)) return false;
  if (is_one_of(tokens_.text(), kStatements)) return true;
  if (!in_parentheses && (is_one_of(tokens_.text(), kClauses) || (open == 0 && is_on_new_line())))
    return true;
  return begins_block();
}

void ExpressionParser::skip_rest(bool in_parentheses) {
  int open = open_;
  tokens_.mute(true);
  while (!is_past(in_parentheses, open)) {
    if (tokens_.is(TokenType::kOpenParenthesis)) ++open;
    if (tokens_.is(TokenType::kCloseParenthesis) && open > 0) --open;
    tokens_.advance();
  }
  tokens_.mute(false);
}

// --- the grammar
// -----------------------------------------------------------------------------------------------------

// Expressions with commas between them.
std::vector<const Expression*> ExpressionParser::parse_parts() {
  std::vector<const Expression*> parts = {parse_choice()};
  while (!failed_ && tokens_.is_operator(",")) {
    tokens_.advance();
    parts.push_back(parse_choice());
  }
  return parts;
}

// Whether the ')' of an '(' is there, as it must be.
bool ExpressionParser::closes(Span open) {
  if (failed_) return false;
  if (tokens_.is(TokenType::kCloseParenthesis)) return true;
  const bool ends = tokens_.is(TokenType::kEnd) || tokens_.is(TokenType::kOpenBrace) ||
                    tokens_.is(TokenType::kCloseBrace) || (tokens_.is(TokenType::kWord) && is_on_new_line());
  if (ends) {
    fail(open, "this '(' is never closed", "')' is missing");
  } else if (tokens_.is(TokenType::kBad)) {
    fail_missing();
  } else {
    const std::string hint = hint_for(tokens_.text());
    fail(tokens_.current().span, fmt::format("unexpected '{}' in an expression", tokens_.text()),
         hint.empty() ? "an operator or ')' would fit; a vector has commas: (1, 2, 3)" : hint);
  }
  return false;
}

// What stands between parentheses, up to the ')': one expression, or the three components of a vector.
const Expression* ExpressionParser::parse_list(Span open) {
  const std::vector<const Expression*> parts = parse_parts();
  if (!closes(open)) return unknown(open);
  const Span whole = {open.begin, tokens_.current().span.end};
  if (parts.size() == 1) return parts.front();
  if (parts.size() == 3) return make(Operation::kVector, whole, {parts[0], parts[1], parts[2]});
  if (!told_)
    tokens_.error(whole, fmt::format("a vector has three components, found {}", parts.size()), "(0, 1, 0)");
  told_ = true;
  return unknown(whole);
}

const Expression* ExpressionParser::parse_choice() {
  const Deeper deeper(depth_);
  if (depth_ > kDeepestNesting) {
    return fail(tokens_.current().span,
                fmt::format("expressions are nested more than {} deep", kDeepestNesting));
  }
  const Expression* condition = parse_or();
  if (failed_ || !tokens_.is_operator("?")) return condition;
  const Span sign = tokens_.current().span;
  tokens_.advance();
  const Expression* if_true = parse_choice();
  if (failed_) return condition;
  if (!tokens_.is_operator(":")) {
    if (tokens_.is(TokenType::kBad)) return fail_missing();
    return fail(is_on_new_line() ? sign : tokens_.current().span, "'?' needs a ':' and a second value",
                "(a > 0 ? 1 : 2)");
  }
  tokens_.advance();
  const Expression* if_not = parse_choice();
  return make(Operation::kChoose, {condition->span.begin, if_not->span.end}, {condition, if_true, if_not});
}

const Expression* ExpressionParser::parse_or() {
  const Expression* left = parse_and();
  while (!failed_ && tokens_.is_word("or")) {
    tokens_.advance();
    left = make_binary(Operation::kOr, left, parse_and());
  }
  return left;
}

const Expression* ExpressionParser::parse_and() {
  const Expression* left = parse_not();
  while (!failed_ && tokens_.is_word("and")) {
    tokens_.advance();
    left = make_binary(Operation::kAnd, left, parse_not());
  }
  return left;
}

const Expression* ExpressionParser::parse_not() {
  if (!tokens_.is_word("not")) return parse_comparison();
  const Deeper deeper(depth_);
  const Span keyword = tokens_.current().span;
  tokens_.advance();
  if (depth_ > kDeepestNesting) return parse_choice();  // reports the depth
  const Expression* argument = parse_not();
  return make(Operation::kNot, {keyword.begin, argument->span.end}, {argument});
}

const Expression* ExpressionParser::parse_comparison() {
  const Expression* left = parse_sum();
  const BinaryOperator* row = current_operator(tokens_, kComparisons);
  if (failed_ || row == nullptr) return left;
  tokens_.advance();
  if (row->symbol == "<") refuse_operator_twins(">", "'!=' is not equal: a != b");
  if (failed_) return left;
  left = make_binary(row->operation, left, parse_sum());
  if (!failed_ && current_operator(tokens_, kComparisons) != nullptr) {
    return fail(tokens_.current().span, "comparisons can't be chained", "(a < b and b < c)");
  }
  return left;
}

const Expression* ExpressionParser::parse_sum() {
  const Expression* left = parse_product();
  while (!failed_) {
    const BinaryOperator* row = current_operator(tokens_, kSums);
    if (row == nullptr) break;
    tokens_.advance();
    left = make_binary(row->operation, left, parse_product());
  }
  return left;
}

const Expression* ExpressionParser::parse_product() {
  const Expression* left = parse_sign();
  while (!failed_) {
    const BinaryOperator* row = current_operator(tokens_, kProducts);
    if (row == nullptr) break;
    tokens_.advance();
    if (row->symbol == "*") refuse_operator_twins("*", "a power is written a ^ b");
    if (!failed_) left = make_binary(row->operation, left, parse_sign());
  }
  return left;
}

const Expression* ExpressionParser::parse_sign() {
  const bool negates = tokens_.is_operator("-");
  if (!negates && !tokens_.is_operator("+")) return parse_power();
  const Deeper deeper(depth_);
  const Span sign = tokens_.current().span;
  tokens_.advance();
  if (depth_ > kDeepestNesting) return parse_choice();  // reports the depth
  const Expression* argument = parse_sign();
  return make(negates ? Operation::kNegate : Operation::kPlus, {sign.begin, argument->span.end}, {argument});
}

const Expression* ExpressionParser::parse_power() {
  const Expression* base = parse_member();
  if (failed_ || !tokens_.is_operator("^")) return base;
  const Deeper deeper(depth_);
  tokens_.advance();
  if (depth_ > kDeepestNesting) return parse_choice();  // reports the depth
  return make_binary(Operation::kPower, base, parse_sign());
}

const Expression* ExpressionParser::parse_member() {
  const Expression* left = parse_primary();
  while (!failed_ && tokens_.is_operator(".")) {
    tokens_.advance();
    constexpr std::string_view kComponents = "xyzrgb";
    const std::size_t component = tokens_.is(TokenType::kWord) && tokens_.text().size() == 1
                                      ? kComponents.find(tokens_.text())
                                      : std::string::npos;
    if (component == std::string_view::npos) {
      if (!tokens_.is(TokenType::kWord)) return fail_missing();
      return fail(tokens_.current().span, fmt::format("a vector has no component '{}'", tokens_.text()),
                  "known are .x .y .z and .r .g .b");
    }
    Expression member;
    member.operation = Operation::kMember;
    member.span = {left->span.begin, tokens_.current().span.end};
    member.number = static_cast<double>(component % 3);
    member.arguments = tokens_.arena().copy(std::span<const Expression* const>(&left, 1));
    tokens_.advance();
    left = add(member);
  }
  return left;
}

// `**` where the language has another sign: the first of the two has just been read.
void ExpressionParser::refuse_operator_twins(std::string_view second, std::string_view suggestion) {
  const Span here = tokens_.current().span;
  if (!tokens_.is_operator(second) || here.begin != tokens_.previous_end()) return;
  const Span both = {here.begin - 1, here.end};
  fail(both, fmt::format("there is no operator '{}'", tokens_.text(both)), std::string(suggestion));
}

const Expression* ExpressionParser::parse_primary() {
  const Token token = tokens_.current();
  Expression node;
  node.span = node.token = token.span;
  switch (token.type) {
    case TokenType::kNumber:
      node.operation = Operation::kNumber;
      node.number = token.number;
      break;
    case TokenType::kString:
      node.operation = Operation::kString;
      break;
    case TokenType::kColor:
      node.operation = Operation::kColor;
      break;
    case TokenType::kWord:
      return parse_word();
    case TokenType::kOpenParenthesis:
      return parse_group();
    default:
      return fail_missing();
  }
  tokens_.advance();
  return add(node);
}

const Expression* ExpressionParser::parse_group() {
  const Span open = tokens_.current().span;
  ++open_;
  tokens_.advance();
  const Expression* inside = parse_list(open);
  if (failed_) return inside;
  --open_;
  tokens_.advance();
  // The value itself, but with its parentheses where a message underlines it.
  Expression whole = *inside;
  whole.span = {open.begin, tokens_.previous_end()};
  return tokens_.arena().make(whole);
}

const Expression* ExpressionParser::parse_word() {
  const Span span = tokens_.current().span;
  const std::string_view word = tokens_.text();
  // A keyword here means that the value in front of it was forgotten; so does a block, where no `if` has its
  // braces.
  const bool is_keyword =
      is_one_of(word, kStatements) || is_one_of(word, kClauses) || word == "and" || word == "or";
  const bool is_whole_value = tokens_.text({0, tokens_.previous_end()}).ends_with('=') &&
                              !tokens_.text({0, tokens_.previous_end()}).ends_with("==");
  if (is_keyword || ((is_whole_value || is_on_new_line()) && find_kind(word) != nullptr && begins_block())) {
    return fail_missing();
  }
  tokens_.advance();
  if (tokens_.is(TokenType::kOpenParenthesis)) return parse_call(span);
  if (tokens_.is(TokenType::kNumber) && find_function(word) != nullptr) {
    return fail({span.begin, tokens_.current().span.end}, fmt::format("'{}' is a function", word),
                fmt::format("{}({})", word, tokens_.text()));
  }
  Expression node;
  node.operation = Operation::kName;
  node.span = node.token = span;
  node.name = tokens_.name_of(span);
  return add(node);
}

const Expression* ExpressionParser::parse_call(Span name) {
  const Span open = tokens_.current().span;
  ++open_;
  tokens_.advance();
  std::vector<const Expression*> arguments;
  if (!tokens_.is(TokenType::kCloseParenthesis)) arguments = parse_parts();
  if (!closes(open)) return unknown(name);
  --open_;
  tokens_.advance();
  return make_call(name, {name.begin, tokens_.previous_end()}, arguments);
}

// A function that does not exist, or takes another number of arguments, leaves the form of the rest alone.
const Expression* ExpressionParser::make_call(Span name, Span whole,
                                              const std::vector<const Expression*>& arguments) {
  const std::string_view word = tokens_.text(name);
  const FunctionRow* function = find_function(word);
  if (function == nullptr) {
    std::vector<std::string_view> known;
    for (const FunctionRow& row : all_functions()) known.push_back(row.name);
    const std::string_view nearest = nearest_word(word, known);
    tokens_.error(name, fmt::format("there is no function '{}'", word),
                  nearest.empty() ? std::string() : fmt::format("did you mean '{}'?", nearest));
    told_ = true;
    return unknown(whole);
  }
  if (arguments.size() < function->least_arguments || arguments.size() > function->most_arguments) {
    tokens_.error(
        whole,
        fmt::format("'{}' takes {}{} argument{}, found {}", word,
                    function->most_arguments > function->least_arguments ? "at least " : "",
                    function->least_arguments, function->least_arguments == 1 ? "" : "s", arguments.size()),
        fmt::format("{}({})", word, function->parameters));
    told_ = true;
    return unknown(whole);
  }
  Expression call;
  call.operation = Operation::kCall;
  call.span = whole;
  call.function = function;
  call.arguments = tokens_.arena().copy(std::span<const Expression* const>(arguments));
  return add(call);
}

}  // namespace raytracer::scene_file
