// What help says of the words that are neither blocks nor functions.
#pragma once

#include <span>
#include <string_view>

namespace raytracer::scene_file {

struct WordRow {
  std::string_view name;
  std::string_view form;  ///< how it is written
  std::string_view help;
  std::string_view more;     ///< a further sentence or two; may be empty
  std::string_view example;  ///< a scene that has it; may be empty
};

/// `let`, `for`, `if`, `define`, `include` and the version line, in the order in which help lists them.
std::span<const WordRow> all_statements();

/// `pi`, `t` and `frame`.
std::span<const WordRow> all_constants();

}  // namespace raytracer::scene_file
