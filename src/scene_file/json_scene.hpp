// Scenes written as JSON. docs/json-scenes.md describes the form.
#pragma once

#include <memory>
#include <string_view>

#include "scene_file/diagnostics.hpp"
#include "scene_file/syntax.hpp"

namespace raytracer::scene_file {

/// Whether a text is meant as JSON: by its file's name, or because it begins with a brace and a quotation
/// mark, as no other scene does.
bool is_json(std::string_view name, std::string_view text);

/// The same nodes as from a scene's text, with places in the JSON. Mistakes go to `diagnostics`.
std::unique_ptr<SyntaxTree> parse_json_scene(const Source& source, Names& names, Diagnostics& diagnostics);

}  // namespace raytracer::scene_file
