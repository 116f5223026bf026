#include "scene_file/picture_names.hpp"

#include <algorithm>

#include "scene_file/lexer.hpp"

namespace raytracer::scene_file {
namespace {

class Collector {
 public:
  Collector(const Source& source, const Names& names) : source_(source), names_(names) {}

  void add(std::span<const ItemNode> items) {
    for (const ItemNode& item : items) {
      if (const auto* property = std::get_if<const PropertyNode*>(&item)) {
        add(**property);
      } else if (const auto* block = std::get_if<const BlockNode*>(&item)) {
        add((*block)->items);
      } else if (const auto* loop = std::get_if<const ForNode*>(&item)) {
        add((*loop)->items);
      }
    }
  }

  std::vector<std::string> take() {
    std::ranges::sort(found_);
    const auto again = std::ranges::unique(found_);
    found_.erase(again.begin(), again.end());
    return std::move(found_);
  }

 private:
  void add(const PropertyNode& property) {
    for (const ValueNode& value : property.values) {
      if (value.kind != ValueKind::kString) continue;
      found_.push_back(value.is_decoded ? std::string(names_.text(value.name))
                                        : unquote(source_.text(value.span)));
    }
    if (property.body != nullptr) add(property.body->items);
  }

  const Source& source_;
  const Names& names_;
  std::vector<std::string> found_;
};

}  // namespace

std::vector<std::string> quoted_names(const SyntaxTree& tree, const Names& names) {
  Collector collector(*tree.source, names);
  collector.add(tree.items);
  return collector.take();
}

}  // namespace raytracer::scene_file
