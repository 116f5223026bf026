// Where the items of a text begin, as its author would say it.
#pragma once

#include <cstdint>
#include <vector>

#include "scene_file/syntax.hpp"

namespace raytracer::scene_file {

/// The offsets, in rising order, at which items begin, those inside of others included. The tree knows them
/// except for one thing: in `center x y z` it takes `y` for the name of a property, as the parser does not
/// know what a property takes. Of a `let` it is the offset of the name behind it.
std::vector<std::uint32_t> item_starts(const SyntaxTree& tree);

}  // namespace raytracer::scene_file
