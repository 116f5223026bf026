// How much a scene may ask for before it is taken for a mistake. Counted in things, never in seconds: a scene
// is valid on every machine or on none.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "raytracer/scene_file.hpp"

namespace raytracer::scene_file {

struct LimitRow {
  std::string_view name;  ///< behind --limit
  std::uint64_t Limits::*field;
  std::string_view help;
};

/// One row registers a limit.
std::span<const LimitRow> all_limits();

}  // namespace raytracer::scene_file
