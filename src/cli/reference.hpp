// The scene language's tables in words.
#pragma once

#include <string>

#include "scene_file/functions.hpp"
#include "scene_file/schema.hpp"

namespace raytracer::cli {

/// The kind's name with its variant: `light spot`.
std::string title_of(const scene_file::KindRow& kind);

/// `sin(x)`.
std::string call_of(const scene_file::FunctionRow& function);

/// What the property takes: "a number (degrees), between 0 and 180".
std::string value_of(const scene_file::PropertyRow& row);

/// Whether the row of transform_properties() means something to the kind.
bool can_be_placed_by(const scene_file::KindRow& kind, const scene_file::PropertyRow& transform);

/// Every block, statement, function and limit as Markdown, beginning at headings of the third level.
std::string markdown_reference();

}  // namespace raytracer::cli
