#include "scene_file/expression_compiler.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>

#include "core/hash.hpp"

namespace raytracer::scene_file {
namespace {

using Step = ExpressionStep;

// More nodes are a mistake, and would make the recursion deep.
constexpr std::size_t kMostNodes = 1000;

struct PointName {
  std::string_view name;
  ValueType type;
  std::uint16_t place;
};
constexpr PointName kPointNames[] = {{"p", ValueType::kVector, ExpressionProgram::kPosition},
                                     {"n", ValueType::kVector, ExpressionProgram::kNormal},
                                     {"u", ValueType::kNumber, ExpressionProgram::kU},
                                     {"v", ValueType::kNumber, ExpressionProgram::kV}};

// Null where the name stands for something else.
const PointName* point_name(const Expression& e, Evaluator& evaluator, const Visibility& visibility) {
  if (e.operation != Operation::kName || evaluator.is_bound(e.name, visibility)) return nullptr;
  const auto* found = std::ranges::find(kPointNames, evaluator.names().text(e.name), &PointName::name);
  return found == std::end(kPointNames) ? nullptr : found;
}

// What a part of the expression has become: the same everywhere, or computed into a place.
struct Operand {
  ValueType type = ValueType::kUnknown;
  bool is_display = false;
  const Expression* constant = nullptr;  // its expression, and …
  Value value;                           // … what that is
  int place = 0;                         // constants below 0, see Compiler::place_of()

  bool is_vector() const { return type == ValueType::kVector || type == ValueType::kColor; }
  int components() const { return is_vector() ? 3 : 1; }
};

class Compiler {
 public:
  Compiler(const Source& source, const Visibility& visibility, Evaluator& evaluator, Diagnostics& diagnostics)
      : source_(source), visibility_(visibility), evaluator_(evaluator), diagnostics_(diagnostics) {}

  std::optional<CompiledExpression> compile_whole(const Expression& e) {
    const std::optional<Operand> result = compile(e);
    if (!result) return std::nullopt;
    if (result->type != ValueType::kNumber && !result->is_vector()) {
      error(e.span, fmt::format("a number or a vector is wanted here, found {}", describe(result->type)));
      return std::nullopt;
    }
    const int place = place_of(*result);
    compiled_.is_display = result->is_display;
    return finished(place, result->is_vector(), e);
  }

 private:
  void error(Span span, std::string message, std::string suggestion = {}) {
    diagnostics_.error({&source_, span}, std::move(message), std::move(suggestion));
  }

  std::optional<Operand> compile(const Expression& e);
  std::optional<Operand> compile_constant(const Expression& e);
  ValueType checked_type(const Expression& e, std::span<const Operand> arguments);
  Operand emit_operation(const Expression& e, std::span<const Operand> arguments, ValueType type);
  std::optional<Operand> emit_multiply_add(Operation operation, const Operand& a, const Operand& b);
  Operand emit_arithmetic(Operation operation, const Operand& a, const Operand& b, ValueType type);
  Operand emit_comparison(Operation operation, const Operand& a, const Operand& b);
  Operand emit_choice(std::span<const Operand> arguments, ValueType type);
  Operand emit_call(const FunctionRow& function, std::span<const Operand> arguments, ValueType type);
  Operand by_component(Step step, std::span<const Operand> arguments, ValueType type);
  Operand joined(std::span<const Operand> numbers);
  std::optional<CompiledExpression> finished(int place, bool is_vector, const Expression& e);

  int new_places(int count) {
    const int first = temporaries_;
    temporaries_ += count;
    return kFirstTemporary + first;
  }
  void emit(Step step, int to, int a, int b = 0, int c = 0) { steps_.push_back({step, to, a, b, c}); }
  Operand number(Step step, int a, int b = 0, int c = 0, ValueType type = ValueType::kNumber) {
    Operand result;
    result.type = type;
    result.place = new_places(1);
    emit(step, result.place, a, b, c);
    return result;
  }
  Operand vector(Step step, int a, int b = 0, ValueType type = ValueType::kVector) {
    Operand result;
    result.type = type;
    result.place = new_places(3);
    emit(step, result.place, a, b);
    return result;
  }

  // Constants are numbered -1, -2 … until it is known how many there are.
  int place_of(const Operand& operand) {
    if (operand.constant == nullptr) return operand.place;
    auto& all = compiled_.program.constants;
    const int count = operand.components();
    for (std::size_t i = 0; i + static_cast<std::size_t>(count) <= all.size(); ++i) {
      bool same = true;
      for (int c = 0; c < count; ++c)
        same = same && all[i + static_cast<std::size_t>(c)] == operand.value.vector[c];
      if (same) return -1 - static_cast<int>(i);
    }
    for (int c = 0; c < count; ++c) all.push_back(operand.value.vector[c]);
    return -1 - static_cast<int>(all.size() - static_cast<std::size_t>(count));
  }
  // The place of one component; a number counts for each.
  int place_of(const Operand& operand, int component) {
    const int first = place_of(operand);
    if (!operand.is_vector()) return first;
    return first < 0 ? first - component : first + component;
  }

  struct WideStep {
    Step step;
    int to, a, b, c;
  };
  static constexpr int kFirstTemporary = 1'000'000;

  const Source& source_;
  const Visibility& visibility_;
  Evaluator& evaluator_;
  Diagnostics& diagnostics_;
  CompiledExpression compiled_;
  std::vector<WideStep> steps_;
  int temporaries_ = 0;
};

std::optional<Operand> Compiler::compile_constant(const Expression& e) {
  Operand operand;
  operand.value = evaluator_.evaluate(e, source_, visibility_);
  if (!operand.value.is_known()) return std::nullopt;
  compiled_.depends_on_time = compiled_.depends_on_time || operand.value.depends_on_time;
  operand.type = operand.value.type;
  operand.is_display = operand.value.is_display;
  operand.constant = &e;
  return operand;
}

std::optional<Operand> Compiler::compile(const Expression& e) {
  if (!mentions_point(e, evaluator_, visibility_)) return compile_constant(e);
  if (const PointName* name = point_name(e, evaluator_, visibility_)) {
    Operand operand;
    operand.type = name->type;
    operand.place = name->place;
    return operand;
  }
  std::vector<Operand> arguments;
  bool known = true;
  for (const Expression* argument : e.arguments) {
    const std::optional<Operand> operand = compile(*argument);
    known = known && operand.has_value();
    if (operand) arguments.push_back(*operand);
  }
  if (!known) return std::nullopt;
  const ValueType type = checked_type(e, arguments);
  if (type == ValueType::kUnknown) return std::nullopt;
  return emit_operation(e, arguments, type);
}

// Lets the evaluator look at the node with some value of the right type for each argument that is not known
// before a hit, so that its word on types is the only one.
ValueType Compiler::checked_type(const Expression& e, std::span<const Operand> arguments) {
  constexpr double kSample = 0.5;  // in the domain of every function but kelvin
  if (e.operation == Operation::kChoose) {
    const Operand &yes = arguments[1], &no = arguments[2];
    if (yes.type != no.type && !(yes.is_vector() && no.is_vector())) {
      error(e.span, fmt::format("both outcomes must be of one kind, found {} and {}", describe(yes.type),
                                describe(no.type)));
      return ValueType::kUnknown;
    }
  }
  const bool is_number =
      std::ranges::all_of(arguments, [](const Operand& a) { return a.type == ValueType::kNumber; });
  if (e.operation == Operation::kCall && e.function->form == FunctionForm::kColor && is_number) {
    return ValueType::kColor;
  }
  std::array<Expression, 3> numbers;
  const std::array<const Expression*, 3> components = {&numbers[0], &numbers[1], &numbers[2]};
  for (Expression& number : numbers) {
    number.operation = Operation::kNumber;
    number.number = kSample;
  }
  std::vector<Expression> samples(arguments.size());
  std::vector<const Expression*> pointers;
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    const Operand& argument = arguments[i];
    // What divides may well be 0 at other points, and then is at this one; its type alone counts.
    if (argument.constant != nullptr && argument.type != ValueType::kNumber) {
      pointers.push_back(argument.constant);
      continue;
    }
    Expression& sample = samples[i];
    sample.span = sample.token = e.arguments[i]->span;
    sample.operation = argument.is_vector() ? Operation::kVector : Operation::kNumber;
    sample.number = kSample + 0.1 * static_cast<double>(i);  // smoothstep needs two edges
    sample.arguments = components;
    if (argument.type == ValueType::kBoolean) {
      // Such that `and`, `or` go on to their right side.
      sample.operation = Operation::kName;
      sample.name = evaluator_.names().id_of(e.operation == Operation::kOr ? "false" : "true");
    }
    pointers.push_back(&sample);
  }
  Expression node = e;
  node.arguments = pointers;
  return evaluator_.evaluate(node, source_, visibility_).type;
}

Operand Compiler::emit_operation(const Expression& e, std::span<const Operand> arguments, ValueType type) {
  switch (e.operation) {
    case Operation::kVector:
      return joined(arguments);
    case Operation::kPlus:
      return arguments[0];
    case Operation::kNegate:
      return by_component(Step::kNegate, arguments, type);
    case Operation::kNot:
      return number(Step::kNot, place_of(arguments[0]), 0, 0, type);
    case Operation::kAnd:
    case Operation::kOr:
      return number(e.operation == Operation::kAnd ? Step::kAnd : Step::kOr, place_of(arguments[0]),
                    place_of(arguments[1]), 0, type);
    case Operation::kMember: {
      Operand component;
      component.type = ValueType::kNumber;
      component.place = place_of(arguments[0], static_cast<int>(e.number));
      return component;
    }
    case Operation::kChoose:
      return emit_choice(arguments, type);
    case Operation::kCall:
      return emit_call(*e.function, arguments, type);
    case Operation::kLess:
    case Operation::kLessEqual:
    case Operation::kGreater:
    case Operation::kGreaterEqual:
    case Operation::kEqual:
    case Operation::kNotEqual:
      return emit_comparison(e.operation, arguments[0], arguments[1]);
    default:
      return emit_arithmetic(e.operation, arguments[0], arguments[1], type);
  }
}

// A product that has just been computed, and is needed for nothing else, is added, or subtracted, in the same
// step.
std::optional<Operand> Compiler::emit_multiply_add(Operation operation, const Operand& a, const Operand& b) {
  if (steps_.empty() || steps_.back().step != Step::kMultiply) return std::nullopt;
  const WideStep product = steps_.back();
  const bool is_first = a.constant == nullptr && product.to == a.place;
  const bool is_second = b.constant == nullptr && product.to == b.place;
  const bool is_sum = operation == Operation::kAdd;
  if (is_first == is_second || (is_first && !is_sum)) return std::nullopt;
  steps_.pop_back();
  return number(is_sum ? Step::kMultiplyAdd : Step::kMultiplySubtract, product.a, product.b,
                place_of(is_first ? b : a));
}

Operand Compiler::emit_arithmetic(Operation operation, const Operand& a, const Operand& b, ValueType type) {
  const bool is_sum = operation == Operation::kAdd || operation == Operation::kSubtract;
  if (is_sum && type == ValueType::kNumber) {
    if (const std::optional<Operand> sum = emit_multiply_add(operation, a, b)) return *sum;
  }
  const Operand both[] = {a, b};
  const bool are_vectors = a.is_vector() && b.is_vector();
  switch (operation) {
    case Operation::kAdd:
      return are_vectors ? vector(Step::kAddVector, place_of(a), place_of(b))
                         : by_component(Step::kAdd, both, type);
    case Operation::kSubtract:
      return are_vectors ? vector(Step::kSubtractVector, place_of(a), place_of(b))
                         : by_component(Step::kSubtract, both, type);
    case Operation::kMultiply:
      if (are_vectors) return vector(Step::kMultiplyVector, place_of(a), place_of(b));
      if (a.is_vector()) return vector(Step::kScaleVector, place_of(a), place_of(b));
      if (b.is_vector()) return vector(Step::kScaleVector, place_of(b), place_of(a));
      return by_component(Step::kMultiply, both, type);
    case Operation::kDivide:
      return by_component(Step::kDivide, both, type);
    case Operation::kRemainder:
      return by_component(Step::kRemainder, both, type);
    default:
      return by_component(Step::kPower, both, type);
  }
}

Operand Compiler::emit_comparison(Operation operation, const Operand& a, const Operand& b) {
  const auto boolean = [&](Step step, int x, int y) { return number(step, x, y, 0, ValueType::kBoolean); };
  switch (operation) {
    case Operation::kLess:
      return boolean(Step::kLess, place_of(a), place_of(b));
    case Operation::kLessEqual:
      return boolean(Step::kLessEqual, place_of(a), place_of(b));
    case Operation::kGreater:
      return boolean(Step::kLess, place_of(b), place_of(a));
    case Operation::kGreaterEqual:
      return boolean(Step::kLessEqual, place_of(b), place_of(a));
    default:
      break;
  }
  Operand equal = boolean(Step::kEqual, place_of(a, 0), place_of(b, 0));
  for (int c = 1; c < a.components(); ++c) {
    const Operand next = boolean(Step::kEqual, place_of(a, c), place_of(b, c));
    equal = boolean(Step::kAnd, equal.place, next.place);
  }
  return operation == Operation::kEqual ? equal : boolean(Step::kNot, equal.place, 0);
}

Operand Compiler::emit_choice(std::span<const Operand> arguments, ValueType type) {
  const Operand &yes = arguments[1], &no = arguments[2];
  Operand result;
  result.type = yes.is_vector() ? ValueType::kVector : type;
  result.is_display = yes.is_display && no.is_display;
  result.place = new_places(yes.components());
  for (int c = 0; c < yes.components(); ++c) {
    emit(Step::kChoose, result.place + c, place_of(arguments[0]), place_of(yes, c), place_of(no, c));
  }
  return result;
}

Operand Compiler::emit_call(const FunctionRow& function, std::span<const Operand> arguments, ValueType type) {
  switch (function.form) {
    case FunctionForm::kNumbers:
    case FunctionForm::kComponents:
      return by_component(function.step, arguments, type);
    case FunctionForm::kFold: {
      Operand result = arguments[0];
      for (std::size_t i = 1; i < arguments.size(); ++i) {
        const Operand pair[] = {result, arguments[i]};
        const bool is_vector = pair[0].is_vector() || pair[1].is_vector();
        result = by_component(function.step, pair, is_vector ? ValueType::kVector : ValueType::kNumber);
      }
      return result;
    }
    case FunctionForm::kVectorsToNumber:
      return number(function.step, place_of(arguments[0]), arguments.size() > 1 ? place_of(arguments[1]) : 0);
    case FunctionForm::kVectorsToVector:
      return vector(function.step, place_of(arguments[0]), arguments.size() > 1 ? place_of(arguments[1]) : 0);
    case FunctionForm::kPlace: {
      if (arguments[0].is_vector()) return number(function.step, place_of(arguments[0]));
      Operand zero;
      static const Expression nothing;
      zero.type = ValueType::kNumber;
      zero.constant = &nothing;
      const Operand place[] = {arguments[0], zero, zero};
      return number(function.step, joined(place).place);
    }
    case FunctionForm::kSeeds: {
      int count = 0;
      for (const Operand& argument : arguments) count += argument.components();
      const int first = new_places(count);
      int to = first;
      for (const Operand& argument : arguments) {
        for (int c = 0; c < argument.components(); ++c) emit(Step::kCopy, to++, place_of(argument, c));
      }
      Operand result = number(function.step, first);
      steps_.back().b = count;
      return result;
    }
    case FunctionForm::kColor: {
      const int first = new_places(3);
      for (int c = 0; c < 3; ++c) {
        emit(Step::kCopy, first + c,
             place_of(arguments[std::min<std::size_t>(static_cast<std::size_t>(c), arguments.size() - 1)]));
      }
      Operand result = vector(function.step, first, 0, type);
      steps_.back().b = static_cast<int>(compiled_.program.functions.size());
      compiled_.program.functions.push_back(function.at_hit);
      result.is_display =
          function.call(std::array{Value::number(1000), Value::number(0.5), Value::number(0.5)})
              .value.is_display;
      return result;
    }
  }
  return {};
}

// The step for each component; a number counts for all of them.
Operand Compiler::by_component(Step step, std::span<const Operand> arguments, ValueType type) {
  Operand result;
  result.type = type == ValueType::kColor ? ValueType::kVector : type;
  const int count = result.components();
  result.place = new_places(count);
  for (int c = 0; c < count; ++c) {
    int places[3] = {};
    for (std::size_t i = 0; i < arguments.size(); ++i) places[i] = place_of(arguments[i], c);
    emit(step, result.place + c, places[0], places[1], places[2]);
  }
  return result;
}

Operand Compiler::joined(std::span<const Operand> numbers) {
  Operand result;
  result.type = ValueType::kVector;
  result.place = new_places(3);
  for (int c = 0; c < 3; ++c)
    emit(Step::kCopy, result.place + c, place_of(numbers[static_cast<std::size_t>(c)]));
  return result;
}

std::optional<CompiledExpression> Compiler::finished(int place, bool is_vector, const Expression& e) {
  ExpressionProgram& program = compiled_.program;
  const std::size_t places =
      ExpressionProgram::kFirstConstant + program.constants.size() + static_cast<std::size_t>(temporaries_);
  constexpr std::size_t kSpare = 8;  // for append_function()
  if (places + kSpare > ExpressionProgram::kMostPlaces) {
    error(e.span, "the expression is too long to be computed at every point",
          "split it into nested textures");
    return std::nullopt;
  }
  const auto final_place = [&](int p) {
    if (p < 0) return static_cast<std::uint16_t>(ExpressionProgram::kFirstConstant - 1 - p);
    if (p < kFirstTemporary) return static_cast<std::uint16_t>(p);
    return static_cast<std::uint16_t>(ExpressionProgram::kFirstConstant +
                                      static_cast<int>(program.constants.size()) + p - kFirstTemporary);
  };
  for (const WideStep& s : steps_) {
    const bool has_plain_b = s.step == Step::kRandom || s.step == Step::kCall;
    program.instructions.push_back({s.step, final_place(s.to), final_place(s.a),
                                    has_plain_b ? static_cast<std::uint16_t>(s.b) : final_place(s.b),
                                    final_place(s.c)});
  }
  program.places = static_cast<std::uint16_t>(places);
  program.result = final_place(place);
  program.is_vector = is_vector;
  return std::move(compiled_);
}

std::size_t count_nodes(const Expression& expression, std::size_t most) {
  std::vector<const Expression*> open = {&expression};
  std::size_t count = 0;
  while (!open.empty() && count <= most) {
    const Expression* e = open.back();
    open.pop_back();
    ++count;
    open.insert(open.end(), e->arguments.begin(), e->arguments.end());
  }
  return count;
}

}  // namespace

bool is_point_name(std::string_view name) {
  return std::ranges::find(kPointNames, name, &PointName::name) != std::end(kPointNames);
}

bool mentions_point(const Expression& expression, Evaluator& evaluator, const Visibility& visibility) {
  std::vector<const Expression*> open = {&expression};
  while (!open.empty()) {
    const Expression* e = open.back();
    open.pop_back();
    if (point_name(*e, evaluator, visibility) != nullptr) return true;
    open.insert(open.end(), e->arguments.begin(), e->arguments.end());
  }
  return false;
}

std::optional<CompiledExpression> compile_expression(const Expression& expression, const Source& source,
                                                     const Visibility& visibility, Evaluator& evaluator,
                                                     Diagnostics& diagnostics) {
  if (count_nodes(expression, kMostNodes) > kMostNodes) {
    diagnostics.error({&source, expression.span}, "the expression is too long to be computed at every point",
                      "split it into nested textures");
    return std::nullopt;
  }
  return Compiler(source, visibility, evaluator, diagnostics).compile_whole(expression);
}

void append_function(ExpressionProgram& program, ExpressionFunction function) {
  const auto arguments = program.places;
  for (std::uint16_t c = 0; c < 3; ++c) {
    const auto from = static_cast<std::uint16_t>(program.is_vector ? program.result + c : program.result);
    program.instructions.push_back({Step::kCopy, static_cast<std::uint16_t>(arguments + c), from, 0, 0});
  }
  const auto result = static_cast<std::uint16_t>(arguments + 3);
  program.instructions.push_back(
      {Step::kCall, result, arguments, static_cast<std::uint16_t>(program.functions.size()), 0});
  program.functions.push_back(function);
  program.places = static_cast<std::uint16_t>(result + 3);
  program.result = result;
  program.is_vector = true;
}

SceneHash hash_of(const ExpressionProgram& program) {
  Hasher hasher;
  for (const double constant : program.constants) hasher.add(constant);
  for (const ExpressionInstruction& i : program.instructions) {
    for (const auto number : {static_cast<std::uint16_t>(i.step), i.to, i.a, i.b, i.c}) {
      hasher.add(std::uint64_t{number});
    }
  }
  for (const ExpressionFunction function : program.functions) {
    // Told from others by what it does.
    const Vector3d value = function({0.1, 0.2, 0.3});
    for (int c = 0; c < 3; ++c) hasher.add(value[c]);
  }
  hasher.add(std::uint64_t{program.result} << 1U | (program.is_vector ? 1U : 0U));
  return hasher.value();
}

}  // namespace raytracer::scene_file
