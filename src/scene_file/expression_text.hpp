// Expressions over a point of a surface, written down.
#pragma once

#include <string>

#include "scene_file/evaluator.hpp"

namespace raytracer::scene_file {

/// An expression of the point as a JSON scene has it: `{"expression": "…"}`. What does not depend on the
/// point is computed.
std::string expression_json(const Expression& expression, const Source& source, const Visibility& visibility,
                            Evaluator& evaluator);

}  // namespace raytracer::scene_file
