// Which method a scene's light is computed by, known before anything of it is evaluated.
#pragma once

#include <array>
#include <optional>
#include <string_view>

#include "raytracer/render.hpp"
#include "scene_file/syntax.hpp"

namespace raytracer::scene_file {

/// As `method` and --method have them, in the order of Method.
inline constexpr std::array<std::string_view, 2> kMethodWords = {"classic", "path"};

/// The method of that name; nothing where there is none.
std::optional<Method> find_method(std::string_view word);

/// What the first `render` block at the top of the text says, as far as can be seen without evaluating it:
/// one that an `if` chooses, or that another file holds, is not seen.
Method method_in(const SyntaxTree& tree);

}  // namespace raytracer::scene_file
