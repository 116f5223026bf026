// The tables of kinds, one file each.
#pragma once

#include <span>

#include "scene_file/schema.hpp"

namespace raytracer::scene_file {

std::span<const KindRow> setting_kinds();   // image camera render background
std::span<const KindRow> light_kinds();     // light and its variants
std::span<const KindRow> material_kinds();  // material
std::span<const KindRow> sky_kinds();       // sky and its variants
std::span<const KindRow> texture_kinds();   // texture and its variants
std::span<const KindRow> group_kinds();     // group
std::span<const KindRow> shape_kinds();     // sphere quad …
std::span<const KindRow> mesh_kinds();      // mesh

}  // namespace raytracer::scene_file
