// The functions of expressions: one row registers one.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "scene_file/value.hpp"
#include "textures/expression_texture.hpp"

namespace raytracer::scene_file {

/// The outcome of a function: a value, or what was wrong with its arguments.
struct FunctionResult {
  Value value;
  std::string problem;  ///< empty where all is well
};

/// What a function takes and gives where it is run at every hit.
enum class FunctionForm : std::uint8_t {
  kNumbers,          ///< numbers to a number
  kComponents,       ///< numbers or vectors, component by component
  kFold,             ///< likewise of two at a time, any number of them
  kVectorsToNumber,  ///< vectors to a number
  kVectorsToVector,
  kPlace,  ///< a vector or a number to a number
  kSeeds,  ///< numbers or vectors, all their components, to a number
  kColor,  ///< up to three numbers to a colour, by `at_hit`
};

struct FunctionRow {
  std::string_view name;
  std::string_view parameters;  ///< as help shows them
  std::size_t least_arguments, most_arguments;
  std::string_view help;
  FunctionResult (*call)(std::span<const Value> arguments);  ///< the arguments are all known
  FunctionForm form = FunctionForm::kNumbers;
  ExpressionStep step = ExpressionStep::kCopy;  ///< what it is at a hit
  ExpressionFunction at_hit = nullptr;          ///< of a kColor
};

std::span<const FunctionRow> all_functions();
const FunctionRow* find_function(std::string_view name);

/// Words with a meaning of their own, which no `let` may take: `pi`, `t`, `for` …
std::span<const std::string_view> reserved_words();
bool is_reserved(std::string_view word);

}  // namespace raytracer::scene_file
