// The functions of expressions: one row registers one.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "scene_file/value.hpp"

namespace raytracer::scene_file {

/// The outcome of a function: a value, or what was wrong with its arguments.
struct FunctionResult {
  Value value;
  std::string problem;  ///< empty where all is well
};

struct FunctionRow {
  std::string_view name;
  std::string_view parameters;  ///< as help shows them
  std::size_t least_arguments, most_arguments;
  std::string_view help;
  FunctionResult (*call)(std::span<const Value> arguments);  ///< the arguments are all known
};

std::span<const FunctionRow> all_functions();
const FunctionRow* find_function(std::string_view name);

/// Words with a meaning of their own, which no `let` may take: `pi`, `t`, `for` …
std::span<const std::string_view> reserved_words();
bool is_reserved(std::string_view word);

}  // namespace raytracer::scene_file
