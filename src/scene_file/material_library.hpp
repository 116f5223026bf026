// Materials that a scene may name without defining them.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace raytracer::scene_file {

struct LibraryMaterial {
  std::string_view name;
  std::string_view help;
  std::string text;  ///< what would stand between the braces of `material`
};

/// All of them, in the order in which help lists them.
std::span<const LibraryMaterial> material_library();

/// Null where there is none of that name.
const LibraryMaterial* find_library_material(std::string_view name);

}  // namespace raytracer::scene_file
