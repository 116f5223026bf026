#include "scene_file/quoted_names.hpp"

#include <algorithm>

#include "scene_file/lexer.hpp"

namespace raytracer::scene_file {
namespace {

void sort_and_unite(std::vector<std::string>& names) {
  std::ranges::sort(names);
  names.erase(std::unique(names.begin(), names.end()), names.end());  // ranges::unique is beyond Clang 14
}

class Collector {
 public:
  /// `takes_all`: also what may never be evaluated, and what is no property's own value.
  Collector(const Source& source, const Names& names, bool takes_all)
      : source_(source), names_(names), takes_all_(takes_all) {}

  void add(std::span<const ItemNode> items) {
    for (const ItemNode& item : items) {
      if (const auto* property = std::get_if<const PropertyNode*>(&item)) {
        add(**property);
      } else if (const auto* block = std::get_if<const BlockNode*>(&item)) {
        add((*block)->items);
      } else if (const auto* loop = std::get_if<const ForNode*>(&item)) {
        add((*loop)->items);
      } else if (takes_all_) {
        add_statement(item);
      }
    }
  }

  NamesInText take() {
    sort_and_unite(found_);
    sort_and_unite(included_);
    return {std::move(found_), std::move(included_)};
  }

 private:
  void add(const PropertyNode& property) {
    for (const ValueNode& value : property.values) add(value);
    if (property.body != nullptr) add(property.body->items);
  }

  void add_statement(const ItemNode& item) {
    if (const auto* include = std::get_if<const IncludeNode*>(&item)) {
      add((*include)->file);
      if (!found_.empty()) included_.push_back(found_.back());
    } else if (const auto* let = std::get_if<const LetNode*>(&item)) {
      add((*let)->value);
    } else if (const auto* choice = std::get_if<const IfNode*>(&item)) {
      add((*choice)->items);
      add((*choice)->else_items);
    } else if (const auto* define = std::get_if<const DefineNode*>(&item)) {
      for (const ParameterNode& parameter : (*define)->parameters) {
        for (const ValueNode& value : parameter.values) add(value);
      }
      add((*define)->items);
    }
  }

  void add(const ValueNode& value) {
    if (value.kind == ValueKind::kString) {
      found_.push_back(value.is_decoded ? std::string(names_.text(value.name))
                                        : unquote(source_.text(value.span)));
    } else if (takes_all_ && value.kind == ValueKind::kExpression) {
      add(value.expression);
    }
  }

  void add(const Expression* e) {
    if (e == nullptr) return;
    if (e->operation == Operation::kString) found_.push_back(unquote(source_.text(e->token)));
    for (const Expression* argument : e->arguments) add(argument);
  }

  const Source& source_;
  const Names& names_;
  const bool takes_all_;
  std::vector<std::string> found_, included_;
};

}  // namespace

std::vector<std::string> quoted_names(const SyntaxTree& tree, const Names& names) {
  if (tree.source->text().find('"') == std::string_view::npos) return {};
  Collector collector(*tree.source, names, false);
  collector.add(tree.items);
  return collector.take().all;
}

NamesInText all_quoted_names(const SyntaxTree& tree, const Names& names) {
  Collector collector(*tree.source, names, true);
  collector.add(tree.items);
  return collector.take();
}

}  // namespace raytracer::scene_file
