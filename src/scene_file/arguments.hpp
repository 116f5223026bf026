// From the values behind a property's name to an argument that fits its row.
#pragma once

#include <optional>

#include "scene_file/diagnostics.hpp"
#include "scene_file/evaluator.hpp"
#include "scene_file/schema.hpp"
#include "scene_file/syntax.hpp"

namespace raytracer::scene_file {

/// How many numbers a property takes at most; 0 where it takes something else.
std::size_t most_numbers(PropertyType type);

/// Computes the values and checks their number, type and range; nothing where they don't fit, which has then
/// been reported. The name of a material becomes the argument's text; whoever knows the materials looks it
/// up.
std::optional<Argument> read_argument(const PropertyRow& row, const PropertyNode& property,
                                      const Source& source, const Visibility& visibility,
                                      Evaluator& evaluator, Diagnostics& diagnostics);

}  // namespace raytracer::scene_file
