// Colours by name and by hexadecimal digits, as CSS has them. All are display (sRGB) values.
#pragma once

#include <optional>
#include <span>
#include <string_view>

#include "raytracer/vector3f.hpp"

namespace raytracer::scene_file {

/// The 148 names of CSS Color Module Level 4, section 6.1; nothing for another word.
std::optional<Vector3d> named_color(std::string_view name);
std::span<const std::string_view> color_names();

/// Of `#rgb` or `#rrggbb`, which must be well-formed.
Vector3d hexadecimal_color(std::string_view text);

}  // namespace raytracer::scene_file
