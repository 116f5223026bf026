// Computes expressions.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <unordered_set>

#include "scene_file/bindings.hpp"
#include "scene_file/diagnostics.hpp"
#include "scene_file/functions.hpp"
#include "scene_file/syntax.hpp"
#include "scene_file/value.hpp"

namespace raytracer::scene_file {

/// What a `let`, a loop or a parameter gave a name.
struct NamedValue {
  Value value;
  const LetNode* let = nullptr;  ///< null for loop variables and parameters
  bool is_used = false;
};

/// The moment for which a scene is evaluated.
struct Moment {
  double time = 0;  ///< seconds
  int frame = 1;
};

/// The work that evaluation may take: nodes of expressions, items, turns. Steps and not seconds: a scene is
/// valid on every machine or on none.
class Budget {
 public:
  explicit Budget(std::uint64_t steps) : steps_left_(steps) {}

  /// False once the work is used up.
  bool take(std::uint64_t steps) {
    if (steps > steps_left_) {
      steps_left_ = 0;
      return false;
    }
    steps_left_ -= steps;
    return true;
  }
  bool is_used_up() const { return steps_left_ == 0; }

 private:
  std::uint64_t steps_left_;
};

/// An operator as it is written; "not " with the blank that follows it.
std::string_view symbol_of(Operation operation);

class Evaluator {
 public:
  Evaluator(Names& names, const Moment& moment, Budget& budget, Diagnostics& diagnostics);

  /// The value of an expression of `source`, with the names that `visibility` shows. What is wrong is
  /// reported and gives an unknown value.
  Value evaluate(const Expression& expression, const Source& source, const Visibility& visibility);
  Value evaluate(const ValueNode& value, const Source& source, const Visibility& visibility);
  /// What a bare word stands for; unknown, without a message, where it stands for nothing.
  Value look_up(NameId name, const Visibility& visibility);
  bool is_bound(NameId name, const Visibility& visibility) const;

  Bindings<NamedValue>& bindings() { return bindings_; }
  Names& names() { return names_; }
  /// Whether `t` or `frame` has been asked for, since the start or since forget_time().
  bool uses_time() const { return uses_time_; }
  void forget_time() { uses_time_ = false; }
  void note_time() { uses_time_ = true; }
  bool was_used(const LetNode* let) const { return used_lets_.contains(let); }
  /// The best guess at what a misspelt name should have been.
  std::string suggestion_for(std::string_view name, const Visibility& visibility) const;

 private:
  struct Scene {
    const Source& source;
    const Visibility& visibility;
  };

  Value compute(const Expression& e, const Scene& scene);
  Value compute_chain(const Expression& e, const Scene& scene);
  Value compute_link(const Expression& e, const Value& left, const Scene& scene);
  Value compute_name(const Expression& e, const Scene& scene);
  void report_unknown(std::string_view name, const Place& place, const Visibility& visibility);
  Value compute_vector(const Expression& e, const Scene& scene);
  Value compute_sign(const Expression& e, const Scene& scene);
  Value compute_arithmetic(const Expression& e, const Value& a, const Value& b, const Scene& scene);
  Value compute_power(const Expression& e, const Value& base, const Value& exponent, const Scene& scene);
  Value compute_comparison(const Expression& e, const Value& a, const Value& b, const Scene& scene);
  Value compute_not(const Expression& e, const Scene& scene);
  Value compute_logic(const Expression& e, const Value& left, const Scene& scene);
  Value compute_choice(const Expression& e, const Scene& scene);
  Value compute_member(const Expression& e, const Value& value, const Scene& scene);
  Value compute_call(const Expression& e, const Scene& scene);
  Value literal_string(const Span& span, const Source& source);
  Value checked(Value value, const Expression& e, const Scene& scene);
  Value fail(const Expression& e, const Scene& scene, std::string message, std::string suggestion = {});
  Value wrong_type(const Expression& argument, const Value& found, std::string_view wanted,
                   const Scene& scene);

  Names& names_;
  Moment moment_;
  Budget& budget_;
  Diagnostics& diagnostics_;
  Bindings<NamedValue> bindings_;
  NameId t_, frame_, pi_, true_, false_;
  bool uses_time_ = false;
  std::unordered_set<const LetNode*> used_lets_;
};

}  // namespace raytracer::scene_file
