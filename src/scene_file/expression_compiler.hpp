// From an expression over a point of a surface to a program that textures run at every hit.
#pragma once

#include <optional>

#include "raytracer/scene_file.hpp"
#include "scene_file/evaluator.hpp"
#include "textures/expression_texture.hpp"

namespace raytracer::scene_file {

/// The names that stand for the point: `p` and `n`, vectors, its place and shading normal in the world; `u`
/// and `v`, numbers. A `let` or parameter of such a name hides it.
bool mentions_point(const Expression& expression, Evaluator& evaluator, const Visibility& visibility);

/// Whether it is one of these names.
bool is_point_name(std::string_view name);

struct CompiledExpression {
  ExpressionProgram program;
  bool depends_on_time = false;
  bool is_display = false;  ///< it gives colours as a display shows them, as Value has it
};

/// Types, and whatever does not depend on the point, are checked and computed here, as the evaluator does; a
/// mistake is reported and gives nothing.
std::optional<CompiledExpression> compile_expression(const Expression& expression, const Source& source,
                                                     const Visibility& visibility, Evaluator& evaluator,
                                                     Diagnostics& diagnostics);

/// Makes the program's result a colour, changed by the function.
void append_function(ExpressionProgram& program, ExpressionFunction function);

/// Says all that the program computes.
SceneHash hash_of(const ExpressionProgram& program);

}  // namespace raytracer::scene_file
