// The paper's recursion for sixteen pixels at a time, and nothing else.
#pragma once

#include <cstdint>

#include "limit_tree.hpp"
#include "raytracer/image.hpp"

namespace raytracer::limit {

/// Renders the whole picture on all threads; returns how many rays that took.
std::uint64_t trace(const World& world, const Tree& tree, Image& image);

}  // namespace raytracer::limit
