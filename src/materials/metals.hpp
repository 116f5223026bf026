// Metals as they were measured.
#pragma once

#include <span>
#include <string_view>

#include "raytracer/material.hpp"

namespace raytracer {

/// Relative to vacuum. Red, green and blue are 630, 532 and 465 nm, about where the eye tells them apart
/// best.
struct Metal {
  std::string_view name;
  ConductorIndex index;
};

/// All of them, by name.
std::span<const Metal> metals();

/// Null if there is none of that name.
const ConductorIndex* find_metal(std::string_view name);

}  // namespace raytracer
