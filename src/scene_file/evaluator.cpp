#include "scene_file/evaluator.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <vector>

#include "core/numeric.hpp"
#include "core/suggest.hpp"
#include "scene_file/colors.hpp"
#include "scene_file/expression_compiler.hpp"
#include "scene_file/lexer.hpp"

namespace raytracer::scene_file {

std::string_view symbol_of(Operation operation) {
  switch (operation) {
    case Operation::kNegate:
    case Operation::kSubtract:
      return "-";
    case Operation::kNot:
      return "not ";
    case Operation::kMultiply:
      return "*";
    case Operation::kDivide:
      return "/";
    case Operation::kRemainder:
      return "%";
    case Operation::kPower:
      return "^";
    case Operation::kLess:
      return "<";
    case Operation::kLessEqual:
      return "<=";
    case Operation::kGreater:
      return ">";
    case Operation::kGreaterEqual:
      return ">=";
    case Operation::kEqual:
      return "==";
    case Operation::kNotEqual:
      return "!=";
    case Operation::kAnd:
      return "and";
    case Operation::kOr:
      return "or";
    default:
      return "+";
  }
}

namespace {

bool is_comparison(Operation operation) {
  return operation >= Operation::kLess && operation <= Operation::kNotEqual;
}

// Whether an operator has its left side in arguments[0].
bool is_link(Operation operation) {
  return (operation >= Operation::kAdd && operation <= Operation::kOr) || operation == Operation::kMember;
}

// How other programs print what is no finite number.
bool is_endless_or_undefined(std::string_view word) {
  std::string lower(word);
  for (char& c : lower) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  return lower == "nan" || lower == "inf" || lower == "infinity";
}

bool has_zero(const Value& v) {
  return v.x() == 0 || (v.is_vector() && (v.vector.y == 0 || v.vector.z == 0));
}

}  // namespace

Evaluator::Evaluator(Names& names, const Moment& moment, Budget& budget, Diagnostics& diagnostics)
    : names_(names),
      moment_(moment),
      budget_(budget),
      diagnostics_(diagnostics),
      t_(names.id_of("t")),
      frame_(names.id_of("frame")),
      pi_(names.id_of("pi")),
      true_(names.id_of("true")),
      false_(names.id_of("false")) {}

Value Evaluator::fail(const Expression& e, const Scene& scene, std::string message, std::string suggestion) {
  diagnostics_.error({&scene.source, e.span}, std::move(message), std::move(suggestion));
  return {};
}

Value Evaluator::wrong_type(const Expression& argument, const Value& found, std::string_view wanted,
                            const Scene& scene) {
  return fail(argument, scene, fmt::format("{} is wanted here, found {}", wanted, describe(found.type)));
}

Value Evaluator::evaluate(const Expression& expression, const Source& source, const Visibility& visibility) {
  return compute(expression, {source, visibility});
}

Value Evaluator::evaluate(const ValueNode& value, const Source& source, const Visibility& visibility) {
  switch (value.kind) {
    case ValueKind::kNumber:
      return Value::number(value.number);
    case ValueKind::kString:
      return value.is_decoded ? Value::string(names_.text(value.name)) : literal_string(value.span, source);
    case ValueKind::kColor:
      return Value::display_color(hexadecimal_color(source.text(value.span)));
    case ValueKind::kExpression:
      return compute(*value.expression, {source, visibility});
    case ValueKind::kWord: {
      Expression name;
      name.operation = Operation::kName;
      name.span = name.token = value.span;
      name.name = value.name;
      return compute_name(name, {source, visibility});
    }
    case ValueKind::kBad:
      break;
  }
  return {};
}

Value Evaluator::literal_string(const Span& span, const Source& source) {
  const std::string_view quoted = source.text(span);
  if (quoted.find('\\') == std::string_view::npos) return Value::string(quoted.substr(1, quoted.size() - 2));
  return Value::string(names_.text(names_.id_of(unquote(quoted))));  // names live long enough
}

bool Evaluator::is_bound(NameId name, const Visibility& visibility) const {
  return bindings_.find(name, visibility) != Bindings<NamedValue>::npos || name == t_ || name == frame_ ||
         name == pi_;
}

Value Evaluator::look_up(NameId name, const Visibility& visibility) {
  const std::size_t position = bindings_.find(name, visibility);
  if (position != Bindings<NamedValue>::npos) {
    NamedValue& named = bindings_.at(position).value;
    if (!named.is_used) {
      named.is_used = true;
      if (named.let != nullptr) used_lets_.insert(named.let);
    }
    return named.value;
  }
  if (name == t_ || name == frame_) {
    uses_time_ = true;
    Value value = Value::number(name == t_ ? moment_.time : moment_.frame);
    value.depends_on_time = true;
    return value;
  }
  if (name == pi_) return Value::number(kPi);
  if (name == true_ || name == false_) return Value::boolean(name == true_);
  if (const auto rgb = named_color(names_.text(name))) return Value::display_color(*rgb);
  return {};
}

std::string Evaluator::suggestion_for(std::string_view name, const Visibility& visibility) const {
  if (!diagnostics_.is_listening()) return {};
  std::vector<std::string_view> known = {"pi", "t", "frame", "true", "false"};
  for (std::size_t i = 0; i < bindings_.height(); ++i) {
    if (visibility.shows(i)) known.push_back(names_.text(bindings_.at(i).name));
  }
  std::string_view nearest = nearest_word(name, known);
  if (nearest.empty() && is_point_name(name)) {
    return fmt::format("{} exists only in materials, where a texture may stand", name);
  }
  if (nearest.empty()) nearest = nearest_word(name, color_names());
  return nearest.empty() ? std::string() : fmt::format("did you mean '{}'?", nearest);
}

Value Evaluator::compute(const Expression& e, const Scene& scene) {
  if (!budget_.take(1)) return {};
  switch (e.operation) {
    case Operation::kUnknown:
      return {};
    case Operation::kNumber:
      return Value::number(e.number);
    case Operation::kString:
      return literal_string(e.token, scene.source);
    case Operation::kColor:
      return Value::display_color(hexadecimal_color(scene.source.text(e.token)));
    case Operation::kName:
      return compute_name(e, scene);
    case Operation::kVector:
      return compute_vector(e, scene);
    case Operation::kNegate:
    case Operation::kPlus:
      return compute_sign(e, scene);
    case Operation::kNot:
      return compute_not(e, scene);
    case Operation::kChoose:
      return compute_choice(e, scene);
    case Operation::kCall:
      return compute_call(e, scene);
    default:
      return compute_chain(e, scene);
  }
}

// Operators that are read from left to right make trees as deep as the chain is long: `1 + 1 + …`. Pieces of
// it are computed in a loop, so that the recursion stays shallow.
Value Evaluator::compute_chain(const Expression& e, const Scene& scene) {
  std::array<const Expression*, 16> links;
  std::size_t count = 0;
  const Expression* first = &e;
  while (count < links.size() && is_link(first->operation)) {
    links[count++] = first;
    first = first->arguments[0];
  }
  Value value = compute(*first, scene);
  while (count > 0) {
    const Expression* link = links[--count];
    if (count > 0 && !budget_.take(1)) return {};  // the last one's step was taken by compute()
    value = compute_link(*link, value, scene);
  }
  return value;
}

// An operator whose left side is known already.
Value Evaluator::compute_link(const Expression& e, const Value& left, const Scene& scene) {
  if (e.operation == Operation::kMember) return compute_member(e, left, scene);
  if (e.operation == Operation::kAnd || e.operation == Operation::kOr) return compute_logic(e, left, scene);
  const Value right = compute(*e.arguments[1], scene);
  if (!left.is_known() || !right.is_known()) return {};
  return is_comparison(e.operation) ? compute_comparison(e, left, right, scene)
                                    : compute_arithmetic(e, left, right, scene);
}

Value Evaluator::compute_name(const Expression& e, const Scene& scene) {
  const std::size_t position = bindings_.find(e.name, scene.visibility);
  if (position != Bindings<NamedValue>::npos) return look_up(e.name, scene.visibility);
  const Value value = look_up(e.name, scene.visibility);
  if (value.is_known()) return value;
  const std::string_view name = names_.text(e.name);
  const Place place{&scene.source, e.token};
  if (const FunctionRow* function = find_function(name)) {
    diagnostics_.error(place, fmt::format("'{}' is a function", name),
                       fmt::format("{}({})", name, function->parameters));
  } else if (is_endless_or_undefined(name)) {
    diagnostics_.error(place, fmt::format("'{}' is not a number", name),
                       "numbers look like 1, -0.5 or 1.5e-3");
  } else {
    report_unknown(name, place, scene.visibility);
  }
  return {};
}

// A name that stands for nothing, or for nothing yet.
void Evaluator::report_unknown(std::string_view name, const Place& place, const Visibility& visibility) {
  const std::string_view text = place.source->text();
  const std::string later = fmt::format("let {} ", name);
  const std::size_t below =
      diagnostics_.is_listening() ? text.find(later, place.span.end) : std::string_view::npos;
  if (below == std::string_view::npos) {
    return diagnostics_.error(place, fmt::format("there is no '{}'", name), suggestion_for(name, visibility));
  }
  const auto begin = static_cast<std::uint32_t>(below + 4);
  const Span there = {begin, begin + static_cast<std::uint32_t>(name.size())};
  diagnostics_.error(place, fmt::format("there is no '{}' yet", name), "a name is defined before it is used",
                     {{{place.source, there}, "it is defined here, below its use"}});
}

Value Evaluator::compute_vector(const Expression& e, const Scene& scene) {
  Value result = Value::of_vector(Vector3d(0));
  for (int i = 0; i < 3; ++i) {
    const Expression& part = *e.arguments[static_cast<std::size_t>(i)];
    const Value value = compute(part, scene);
    if (value.is_known() && !value.is_number()) wrong_type(part, value, "a number", scene);
    if (!value.is_number()) result.type = ValueType::kUnknown;
    result.vector[i] = value.x();
    result.depends_on_time = result.depends_on_time || value.depends_on_time;
  }
  return result;
}

// Results that are no numbers are mistakes at their place, not surprises in the picture.
Value Evaluator::checked(Value value, const Expression& e, const Scene& scene) {
  if (is_finite(value.vector)) return value;
  return fail(e, scene, "the result is too large or not a number");
}

Value Evaluator::compute_sign(const Expression& e, const Scene& scene) {
  Value value = compute(*e.arguments[0], scene);
  if (!value.is_known()) return {};
  if (!value.is_number() && !value.is_vector())
    return wrong_type(*e.arguments[0], value, "a number or a vector", scene);
  if (e.operation == Operation::kNegate) {
    value.vector = -value.vector;
    if (value.is_vector()) value.type = ValueType::kVector;
    value.is_display = false;
  }
  return value;
}

Value Evaluator::compute_arithmetic(const Expression& e, const Value& a, const Value& b, const Scene& scene) {
  for (std::size_t i = 0; i < 2; ++i) {
    const Value& value = i == 0 ? a : b;
    if (!value.is_number() && !value.is_vector()) {
      return wrong_type(*e.arguments[i], value, "a number or a vector", scene);
    }
  }
  if (e.operation == Operation::kPower) return compute_power(e, a, b, scene);
  const bool divides = e.operation == Operation::kDivide || e.operation == Operation::kRemainder;
  if (divides && has_zero(b)) {
    const bool is_literal = e.arguments[1]->operation == Operation::kNumber;
    return fail(
        e, scene, "division by zero",
        is_literal ? std::string() : fmt::format("'{}' is 0", scene.source.text(e.arguments[1]->span)));
  }
  const bool adds = e.operation == Operation::kAdd || e.operation == Operation::kSubtract;
  if (adds && a.is_number() != b.is_number()) {
    return fail(
        e, scene,
        fmt::format("'{}' between {} and {}", symbol_of(e.operation), describe(a.type), describe(b.type)),
        "a number for each component: (v + (1, 1, 1))");
  }
  const bool is_vector = a.is_vector() || b.is_vector();
  const Vector3d x = a.is_vector() || !is_vector ? a.vector : Vector3d(a.x());
  const Vector3d y = b.is_vector() || !is_vector ? b.vector : Vector3d(b.x());
  Value result = is_vector ? Value::of_vector(Vector3d(0)) : Value::number(0);
  result.depends_on_time = a.depends_on_time || b.depends_on_time;
  for (int i = 0; i < (is_vector ? 3 : 1); ++i) {
    switch (e.operation) {
      case Operation::kAdd:
        result.vector[i] = x[i] + y[i];
        break;
      case Operation::kSubtract:
        result.vector[i] = x[i] - y[i];
        break;
      case Operation::kMultiply:
        result.vector[i] = x[i] * y[i];
        break;
      case Operation::kDivide:
        result.vector[i] = x[i] / y[i];
        break;
      default:
        result.vector[i] = std::fmod(x[i], y[i]);
        break;
    }
  }
  return checked(result, e, scene);
}

Value Evaluator::compute_power(const Expression& e, const Value& base, const Value& exponent,
                               const Scene& scene) {
  if (!base.is_number()) return wrong_type(*e.arguments[0], base, "a number", scene);
  if (!exponent.is_number()) return wrong_type(*e.arguments[1], exponent, "a number", scene);
  if (base.x() == 0 && exponent.x() < 0) return fail(e, scene, "division by zero", "0 to a negative power");
  if (base.x() < 0 && exponent.x() != std::floor(exponent.x())) {
    return fail(e, scene, fmt::format("{} to the power {} is not a number", base.x(), exponent.x()),
                "a negative number takes whole powers only");
  }
  Value result = Value::number(std::pow(base.x(), exponent.x()));
  result.depends_on_time = base.depends_on_time || exponent.depends_on_time;
  return checked(result, e, scene);
}

Value Evaluator::compute_comparison(const Expression& e, const Value& a, const Value& b, const Scene& scene) {
  bool outcome = false;
  if (e.operation == Operation::kEqual || e.operation == Operation::kNotEqual) {
    if (a.type != b.type && !(a.is_vector() && b.is_vector())) {
      return fail(e, scene, fmt::format("{} is never equal to {}", describe(a.type), describe(b.type)),
                  "only things of one kind can be compared");
    }
    const bool equal = a.vector == b.vector && a.text == b.text;
    outcome = equal == (e.operation == Operation::kEqual);
  } else {
    if (!a.is_number()) return wrong_type(*e.arguments[0], a, "a number", scene);
    if (!b.is_number()) return wrong_type(*e.arguments[1], b, "a number", scene);
    outcome = e.operation == Operation::kLess        ? a.x() < b.x()
              : e.operation == Operation::kLessEqual ? a.x() <= b.x()
              : e.operation == Operation::kGreater   ? a.x() > b.x()
                                                     : a.x() >= b.x();
  }
  Value result = Value::boolean(outcome);
  result.depends_on_time = a.depends_on_time || b.depends_on_time;
  return result;
}

Value Evaluator::compute_not(const Expression& e, const Scene& scene) {
  const Value value = compute(*e.arguments[0], scene);
  if (!value.is_known()) return {};
  if (!value.is_boolean()) return wrong_type(*e.arguments[0], value, "true or false", scene);
  Value result = Value::boolean(!value.is_true());
  result.depends_on_time = value.depends_on_time;
  return result;
}

// `and` and `or` look at their right side only where the left one leaves it open.
Value Evaluator::compute_logic(const Expression& e, const Value& left, const Scene& scene) {
  if (!left.is_known()) return {};
  if (!left.is_boolean()) return wrong_type(*e.arguments[0], left, "true or false", scene);
  if (left.is_true() == (e.operation == Operation::kOr)) return left;
  Value right = compute(*e.arguments[1], scene);
  if (!right.is_known()) return {};
  if (!right.is_boolean()) return wrong_type(*e.arguments[1], right, "true or false", scene);
  right.depends_on_time = right.depends_on_time || left.depends_on_time;
  return right;
}

Value Evaluator::compute_choice(const Expression& e, const Scene& scene) {
  const Value condition = compute(*e.arguments[0], scene);
  if (!condition.is_known()) return {};
  if (!condition.is_boolean()) return wrong_type(*e.arguments[0], condition, "true or false", scene);
  Value result = compute(*e.arguments[condition.is_true() ? 1 : 2], scene);
  result.depends_on_time = result.depends_on_time || condition.depends_on_time;
  return result;
}

Value Evaluator::compute_member(const Expression& e, const Value& value, const Scene& scene) {
  if (!value.is_known()) return {};
  if (!value.is_vector()) return wrong_type(*e.arguments[0], value, "a vector", scene);
  Value result = Value::number(value.vector[static_cast<int>(e.number)]);
  result.depends_on_time = value.depends_on_time;
  return result;
}

Value Evaluator::compute_call(const Expression& e, const Scene& scene) {
  std::array<Value, 8> few;
  std::vector<Value> many(e.arguments.size() > few.size() ? e.arguments.size() : 0);
  Value* arguments = many.empty() ? few.data() : many.data();
  bool known = true, depends = false;
  for (std::size_t i = 0; i < e.arguments.size(); ++i) {
    arguments[i] = compute(*e.arguments[i], scene);
    known = known && arguments[i].is_known();
    depends = depends || arguments[i].depends_on_time;
  }
  if (!known) return {};
  FunctionResult result = e.function->call({arguments, e.arguments.size()});
  if (!result.problem.empty()) {
    return fail(e, scene, fmt::format("'{}' {}", e.function->name, result.problem),
                fmt::format("{}({}): {}", e.function->name, e.function->parameters, e.function->help));
  }
  result.value.depends_on_time = depends;
  return checked(result.value, e, scene);
}

}  // namespace raytracer::scene_file
