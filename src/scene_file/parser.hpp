// From tokens to nodes.
#pragma once

#include <memory>
#include <vector>

#include "scene_file/diagnostics.hpp"
#include "scene_file/lexer.hpp"
#include "scene_file/syntax.hpp"

namespace raytracer::scene_file {

/// What `raytracer 1` at the beginning of a scene says.
inline constexpr int kLanguageVersion = 1;

/// Blocks inside blocks, and parentheses inside parentheses, at most; the parser is recursive.
inline constexpr int kDeepestNesting = 256;

/// Parses a source; mistakes go to `diagnostics`, and what can be understood in spite of them is in the tree.
/// `record`, where it is given, gets all tokens in their order.
std::unique_ptr<SyntaxTree> parse(const Source& source, Names& names, Diagnostics& diagnostics,
                                  std::vector<ReadToken>* record = nullptr);

/// Parses a text that is one expression alone; null where it is none, which has then been reported.
const Expression* parse_lone_expression(const Source& source, Names& names, Arena& arena,
                                        Diagnostics& diagnostics);

}  // namespace raytracer::scene_file
