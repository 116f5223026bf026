// Expressions by precedence climbing, from loosest to tightest:
//
//   a ? b : c    or    and    not    == != < <= > >=    + -    * / %    - + (signs)    ^ (to the right)    .x
#pragma once

#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

#include "scene_file/syntax.hpp"
#include "scene_file/token_reader.hpp"

namespace raytracer::scene_file {

class ExpressionParser {
 public:
  explicit ExpressionParser(TokenReader& tokens) : tokens_(tokens) {}

  /// The current token is '('; reads up to its ')'. A list of three is a vector. An expression of wrong form,
  /// which has been reported, is a kUnknown.
  const Expression* parse_parenthesised();

  /// From behind a keyword: as far as an expression goes. The current token must have been read with
  /// LexMode::kExpression; the one behind the expression is read as a value would be. After a mistake the
  /// rest is skipped: to a brace, a word of a statement, a block, or a word in the next line.
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
  const Expression* parse_group();
  const Expression* parse_word();
  const Expression* parse_call(Span name);
  const Expression* make_call(Span name, Span whole, const std::vector<const Expression*>& arguments);
  std::vector<const Expression*> parse_parts();
  const Expression* parse_list(Span open);

  const Expression* add(const Expression& node);
  const Expression* unknown(Span span);
  const Expression* make(Operation operation, Span span, std::initializer_list<const Expression*> arguments);
  const Expression* make_binary(Operation operation, const Expression* left, const Expression* right) {
    return make(operation, {left->span.begin, right->span.end}, {left, right});
  }

  const Expression* fail(Span span, std::string message, std::string suggestion = {});
  const Expression* fail_missing();
  bool closes(Span open);
  void check_end();
  void refuse_operator_twins(std::string_view second, std::string_view suggestion);

  bool is_on_new_line() const;
  bool begins_block() const;
  bool is_past(bool in_parentheses, int open) const;
  void skip_rest(bool in_parentheses);

  TokenReader& tokens_;
  int depth_ = 0;
  int open_ = 0;  // parentheses inside the expression that wait for their ')'
  int nodes_ = 0;
  bool failed_ = false;  // the form is broken: nothing more is read
  bool told_ = false;    // some mistake was told: the form says nothing more
};

}  // namespace raytracer::scene_file
