// From tokens to nodes.
#pragma once

#include <memory>

#include "scene_file/diagnostics.hpp"
#include "scene_file/syntax.hpp"

namespace raytracer::scene_file {

/// Blocks inside blocks, at most.
inline constexpr int kDeepestNesting = 256;

/// Parses a source; mistakes go to `diagnostics`, and what can be understood in spite of them is in the tree.
std::unique_ptr<SyntaxTree> parse(const Source& source, Diagnostics& diagnostics);

}  // namespace raytracer::scene_file
