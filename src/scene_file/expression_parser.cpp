#include "scene_file/expression_parser.hpp"

#include <fmt/format.h>

#include <utility>
#include <vector>

#include "core/suggest.hpp"
#include "scene_file/functions.hpp"
#include "scene_file/parser.hpp"

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

const Expression* ExpressionParser::make(Operation operation, Span span,
                                         std::initializer_list<const Expression*> arguments) {
  Expression node;
  node.operation = operation;
  node.span = span;
  node.arguments = tokens_.arena().copy(std::span<const Expression* const>(arguments.begin(), arguments.size()));
  return tokens_.arena().make(node);
}

const Expression* ExpressionParser::unknown(Span span) {
  failed_ = true;
  return make(Operation::kUnknown, span, {});
}

const Expression* ExpressionParser::parse_parenthesised() {
  const LexMode outside = tokens_.mode();
  const Span open = tokens_.current().span;
  failed_ = false;
  tokens_.set_mode(LexMode::kExpression);
  tokens_.advance();
  const Expression* result = parse_list(open);
  if (failed_) skip_to_closing_parenthesis();
  tokens_.set_mode(outside);
  if (tokens_.is(TokenType::kCloseParenthesis)) {
    tokens_.advance();
  } else if (!failed_) {
    tokens_.error(open, "this '(' is never closed", "')' is missing");
    return make(Operation::kUnknown, open, {});
  }
  // The span with its parentheses is what a message about the value underlines.
  Expression whole = *result;
  whole.span = {open.begin, tokens_.previous_end()};
  return tokens_.arena().make(whole);
}

const Expression* ExpressionParser::parse_open() {
  failed_ = false;
  const Expression* result = parse_choice();
  tokens_.set_mode(LexMode::kValues);
  return result;
}

// After a mistake: on to the ')' that closes the expression, but not past a brace.
void ExpressionParser::skip_to_closing_parenthesis() {
  int open = 0;
  while (!tokens_.is(TokenType::kEnd) && !tokens_.is(TokenType::kOpenBrace) &&
         !tokens_.is(TokenType::kCloseBrace)) {
    if (tokens_.is(TokenType::kOpenParenthesis)) ++open;
    if (tokens_.is(TokenType::kCloseParenthesis) && open-- == 0) return;
    tokens_.advance();
  }
}

// What stands between parentheses: one expression, or the three components of a vector.
const Expression* ExpressionParser::parse_list(Span open) {
  std::vector<const Expression*> parts = {parse_choice()};
  while (!failed_ && tokens_.is_operator(",")) {
    tokens_.advance();
    parts.push_back(parse_choice());
  }
  if (failed_) return parts.front();
  const Span whole = {open.begin, tokens_.current().span.end};
  if (!tokens_.is(TokenType::kCloseParenthesis)) {
    if (tokens_.is(TokenType::kEnd) || tokens_.is(TokenType::kOpenBrace) || tokens_.is(TokenType::kCloseBrace)) {
      tokens_.error(open, "this '(' is never closed", "')' is missing");
    } else if (!tokens_.is(TokenType::kBad)) {
      tokens_.error(tokens_.current().span, fmt::format("unexpected '{}' in an expression", tokens_.text()),
                    "an operator or ')' would fit; a vector has commas: (1, 2, 3)");
    }
    return unknown(open);
  }
  if (parts.size() == 1) return parts.front();
  if (parts.size() == 3) return make(Operation::kVector, whole, {parts[0], parts[1], parts[2]});
  tokens_.error(whole, fmt::format("a vector has three components, found {}", parts.size()), "(0, 1, 0)");
  return unknown(open);
}

const Expression* ExpressionParser::parse_choice() {
  const Deeper deeper(depth_);
  if (depth_ > kDeepestNesting) {
    if (!failed_) {
      tokens_.error(tokens_.current().span,
                    fmt::format("expressions are nested more than {} deep", kDeepestNesting));
    }
    return unknown(tokens_.current().span);
  }
  const Expression* condition = parse_or();
  if (failed_ || !tokens_.is_operator("?")) return condition;
  tokens_.advance();
  const Expression* if_true = parse_choice();
  if (failed_) return condition;
  if (!tokens_.is_operator(":")) {
    tokens_.error(tokens_.current().span, "'?' needs a ':' and a second value", "(a > 0 ? 1 : 2)");
    return unknown(condition->span);
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
  left = make_binary(row->operation, left, parse_sum());
  if (!failed_ && current_operator(tokens_, kComparisons) != nullptr) {
    tokens_.error(tokens_.current().span, "comparisons can't be chained", "(a < b and b < c)");
    return unknown(left->span);
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
    left = make_binary(row->operation, left, parse_sign());
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
    const std::size_t component =
        tokens_.is(TokenType::kWord) && tokens_.text().size() == 1 ? kComponents.find(tokens_.text()) : std::string::npos;
    if (component == std::string_view::npos) {
      tokens_.error(tokens_.current().span, fmt::format("a vector has no component '{}'", tokens_.text()),
                    "known are .x .y .z and .r .g .b");
      return unknown(left->span);
    }
    Expression member;
    member.operation = Operation::kMember;
    member.span = {left->span.begin, tokens_.current().span.end};
    member.number = static_cast<double>(component % 3);
    member.arguments = tokens_.arena().copy(std::span<const Expression* const>(&left, 1));
    tokens_.advance();
    left = tokens_.arena().make(member);
  }
  return left;
}

const Expression* ExpressionParser::parse_primary() {
  const Token token = tokens_.current();
  Expression node;
  node.span = token.span;
  switch (token.type) {
    case TokenType::kNumber:
      node.operation = Operation::kNumber;
      node.number = token.number;
      break;
    case TokenType::kString: node.operation = Operation::kString; break;
    case TokenType::kColor: node.operation = Operation::kColor; break;
    case TokenType::kWord: return parse_word();
    case TokenType::kOpenParenthesis: {
      tokens_.advance();
      const Expression* inside = parse_list(token.span);
      if (!failed_) tokens_.advance();
      return inside;
    }
    case TokenType::kBad: failed_ = true; break;
    case TokenType::kEnd:
      tokens_.error(token.span, "the text ends where a value is missing");
      return unknown(token.span);
    default:
      tokens_.error(token.span, fmt::format("'{}' stands where a value is missing", tokens_.text()));
      return unknown(token.span);
  }
  tokens_.advance();
  return tokens_.arena().make(node);
}

const Expression* ExpressionParser::parse_word() {
  const Span span = tokens_.current().span;
  const std::string_view word = tokens_.text();
  // A keyword here means that the value in front of it was forgotten.
  constexpr std::string_view kEnders[] = {"let", "for", "from", "to", "step", "if", "else", "define", "include", "and", "or"};
  for (const std::string_view ender : kEnders) {
    if (word == ender) {
      tokens_.error(span, fmt::format("'{}' stands where a value is missing", word));
      return unknown(span);
    }
  }
  tokens_.advance();
  if (tokens_.is(TokenType::kOpenParenthesis)) return parse_call(span);
  Expression node;
  node.operation = Operation::kName;
  node.span = span;
  node.name = tokens_.name_of(span);
  return tokens_.arena().make(node);
}

const Expression* ExpressionParser::parse_call(Span name) {
  tokens_.advance();
  std::vector<const Expression*> arguments;
  if (!tokens_.is(TokenType::kCloseParenthesis)) {
    arguments.push_back(parse_choice());
    while (!failed_ && tokens_.is_operator(",")) {
      tokens_.advance();
      arguments.push_back(parse_choice());
    }
  }
  if (failed_) return unknown(name);
  const Span whole = {name.begin, tokens_.current().span.end};
  if (!tokens_.is(TokenType::kCloseParenthesis)) {
    tokens_.error(tokens_.current().span, fmt::format("the '(' of '{}' is never closed", tokens_.text(name)),
                  "')' is missing");
    return unknown(name);
  }
  tokens_.advance();
  const std::string_view word = tokens_.text(name);
  const FunctionRow* function = find_function(word);
  if (function == nullptr) {
    std::vector<std::string_view> known;
    for (const FunctionRow& row : all_functions()) known.push_back(row.name);
    const std::string_view nearest = nearest_word(word, known);
    tokens_.error(name, fmt::format("there is no function '{}'", word),
                  nearest.empty() ? std::string() : fmt::format("did you mean '{}'?", nearest));
    return make(Operation::kUnknown, whole, {});
  }
  if (arguments.size() < function->least_arguments || arguments.size() > function->most_arguments) {
    tokens_.error(whole,
                  fmt::format("'{}' takes {}{} argument{}, found {}", word,
                              function->most_arguments > function->least_arguments ? "at least " : "",
                              function->least_arguments, function->least_arguments == 1 ? "" : "s", arguments.size()),
                  fmt::format("{}({})", word, function->parameters));
    return make(Operation::kUnknown, whole, {});
  }
  Expression call;
  call.operation = Operation::kCall;
  call.span = whole;
  call.function = function;
  call.arguments = tokens_.arena().copy(std::span<const Expression* const>(arguments));
  return tokens_.arena().make(call);
}

}  // namespace raytracer::scene_file
