// Which files a text names.
#pragma once

#include <string>
#include <vector>

#include "scene_file/syntax.hpp"

namespace raytracer::scene_file {

/// Every text in quotes that a property has for a value, each once, as far as it can be seen without
/// evaluating anything: whether it is a picture's name is for whoever looks at the file. Branches and
/// definitions are left out, since they may never be used.
std::vector<std::string> quoted_names(const SyntaxTree& tree, const Names& names);

/// What a text may name at any time, each once: what stands in quotes anywhere in it.
struct NamesInText {
  std::vector<std::string> all;
  std::vector<std::string> included;  ///< those among them that `include` may mean
};
NamesInText all_quoted_names(const SyntaxTree& tree, const Names& names);

}  // namespace raytracer::scene_file
