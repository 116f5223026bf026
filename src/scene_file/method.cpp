#include "scene_file/method.hpp"

#include <algorithm>

namespace raytracer::scene_file {
namespace {

std::optional<Method> method_in(const BlockNode& block, const Source& source) {
  for (const ItemNode& item : block.items) {
    const auto* property = std::get_if<const PropertyNode*>(&item);
    if (property == nullptr || source.text((*property)->name) != "method" || (*property)->values.empty())
      continue;
    return find_method(source.text((*property)->values.front().span));
  }
  return std::nullopt;
}

}  // namespace

std::optional<Method> find_method(std::string_view word) {
  const auto* found = std::ranges::find(kMethodWords, word);
  if (found == kMethodWords.end()) return std::nullopt;
  return static_cast<Method>(found - kMethodWords.begin());
}

Method method_in(const SyntaxTree& tree) {
  for (const ItemNode& item : tree.items) {
    const auto* block = std::get_if<const BlockNode*>(&item);
    if (block == nullptr || tree.source->text((*block)->kind) != "render") continue;
    return method_in(**block, *tree.source).value_or(Method::kClassic);
  }
  return Method::kClassic;
}

}  // namespace raytracer::scene_file
