// The transform words.
#pragma once

#include <string>
#include <string_view>

#include "scene_file/builder.hpp"

namespace raytracer::scene_file {

/// Adds one transform word to those of a block. Returns what is wrong with it, or nothing.
std::string add_placing(std::string_view word, const Argument& argument, PlacingWords& placing);

}  // namespace raytracer::scene_file
