// Expressions by precedence climbing, from loosest to tightest:
//
//   a ? b : c    or    and    not    == != < <= > >=    + -    * / %    - + (signs)    ^ (to the right)    .x
#pragma once

#include "scene_file/syntax.hpp"
#include "scene_file/token_reader.hpp"

namespace raytracer::scene_file {

class ExpressionParser {
 public:
  explicit ExpressionParser(TokenReader& tokens) : tokens_(tokens) {}

  /// The current token is '('; reads up to its ')'. A list of three is a vector.
  const Expression* parse_parenthesised();

  /// From behind a keyword: as far as an expression goes. The current token must have been read with
  /// LexMode::kExpression; the one behind the expression is read as a value would be.
  const Expression* parse_open();

 private:
  const Expression* parse_choice();
  const Expression* parse_or();
  const Expression* parse_and();
  const Expression* parse_not();
  const Expression* parse_comparison();
  const Expression* parse_sum();
  const Expression* parse_product();
  const Expression* parse_sign();
  const Expression* parse_power();
  const Expression* parse_member();
  const Expression* parse_primary();
  const Expression* parse_word();
  const Expression* parse_call(Span name);
  const Expression* parse_list(Span open);

  const Expression* unknown(Span span);
  const Expression* make(Operation operation, Span span, std::initializer_list<const Expression*> arguments);
  const Expression* make_binary(Operation operation, const Expression* left, const Expression* right) {
    return make(operation, {left->span.begin, right->span.end}, {left, right});
  }
  void skip_to_closing_parenthesis();

  TokenReader& tokens_;
  int depth_ = 0;
  bool failed_ = false;  // the rest of this expression says nothing more
};

}  // namespace raytracer::scene_file
