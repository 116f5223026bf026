// The word that was probably meant.
#pragma once

#include <span>
#include <string_view>

namespace raytracer {

/// The candidate nearest to `word` by edit distance (insertions, deletions, substitutions and swaps of
/// neighbours count one each), or an empty view when none is near enough to be meant.
std::string_view nearest_word(std::string_view word, std::span<const std::string_view> candidates);

}  // namespace raytracer
