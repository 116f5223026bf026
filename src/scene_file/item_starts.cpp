#include "scene_file/item_starts.hpp"

#include <algorithm>
#include <functional>
#include <string_view>
#include <unordered_map>

#include "scene_file/arguments.hpp"
#include "scene_file/schema.hpp"

namespace raytracer::scene_file {
namespace {

constexpr std::size_t kMostWords = 3;  // that a property of unknown type may take

class Collector {
 public:
  explicit Collector(const SyntaxTree& tree) : source_(*tree.source) {
    find_definitions(tree.items);
    collect(tree.items, nullptr);
  }

  std::vector<std::uint32_t> starts;

 private:
  std::string_view text(Span span) const { return source_.text(span); }

  void find_definitions(std::span<const ItemNode> items) {
    for_each_body(items, [this](const ItemNode& item, std::span<const ItemNode> body) {
      if (const auto* define = std::get_if<const DefineNode*>(&item)) {
        definitions_.try_emplace(text((*define)->name_span), *define);
      }
      find_definitions(body);
    });
  }

  static void for_each_body(std::span<const ItemNode> items,
                            const std::function<void(const ItemNode&, std::span<const ItemNode>)>& visit) {
    for (const ItemNode& item : items) {
      std::visit(
          [&](const auto* node) {
            if constexpr (requires { node->items; }) visit(item, node->items);
            if constexpr (requires { node->else_items; }) visit(item, node->else_items);
          },
          item);
    }
  }

  const KindRow* row_of(const BlockNode& block) const {
    if (block.words.size() == 1) {  // `color checker { … }`
      if (const KindRow* texture = find_texture_kind(text(block.words[0]))) return texture;
    }
    const KindRow* variant =
        block.words.empty() ? nullptr : find_kind(text(block.kind), text(block.words[0]));
    return variant != nullptr ? variant : find_kind(text(block.kind));
  }

  const DefineNode* definition_of(const BlockNode& block) const {
    const auto found = definitions_.find(text(block.kind));
    return found == definitions_.end() ? nullptr : found->second;
  }

  // How many values a property can take at most.
  std::size_t most_values(const BlockNode* block, std::string_view property) const {
    if (block == nullptr) return 0;
    if (const KindRow* row = row_of(*block)) {
      const PropertyRow* known = find_property(*row, property);
      return known == nullptr ? 0 : most_numbers(known->type);
    }
    for (const PropertyRow& transform : transform_properties()) {
      if (transform.name == property) return most_numbers(transform.type);
    }
    return property == material_property().name ? 0 : kMostWords;
  }

  // Whether a word in a block, read as a property's name or a block's kind, is rather a value of the property
  // in front of it.
  bool is_value(const BlockNode& block, std::uint32_t previous_end, Span word) const {
    const std::string_view name = text(word);
    if (find_kind(name) != nullptr || definitions_.contains(name)) return false;
    if (const KindRow* row = row_of(block)) return find_property(*row, name) == nullptr;
    if (name == material_property().name) return false;
    for (const PropertyRow& transform : transform_properties()) {
      if (transform.name == name) return false;
    }
    if (const DefineNode* definition = definition_of(block)) {
      return std::ranges::none_of(definition->parameters,
                                  [&](const ParameterNode& p) { return text(p.name_span) == name; });
    }
    // Of a definition in another file nothing is known: what its author wrote with a single space is kept so.
    return word.begin == previous_end + 1 && text({previous_end, word.begin}) == " ";
  }

  void collect(std::span<const ItemNode> items, const BlockNode* block) {
    std::size_t room = 0;  // for more values of the property in front
    std::uint32_t end = 0;
    for (const ItemNode& item : items) {
      if (const auto* property = std::get_if<const PropertyNode*>(&item)) {
        if ((*property)->is_nameless()) continue;
        const std::size_t count = (*property)->values.size();
        if (room > 0 && is_value(*block, end, (*property)->name)) {
          room -= std::min(room, count + 1);
        } else {
          starts.push_back((*property)->name.begin);
          const std::size_t most = count == 0 ? 0 : most_values(block, text((*property)->name));
          room = most - std::min(most, count);
        }
        end = (*property)->whole().end;
        if (const BlockNode* body = (*property)->body) {
          room = 0;
          collect(body->items, body);
        }
        continue;
      }
      const auto* inner = std::get_if<const BlockNode*>(&item);
      const bool is_shifted =
          inner != nullptr && room > 0 && !(*inner)->words.empty() && is_value(*block, end, (*inner)->kind);
      room = 0;
      starts.push_back(is_shifted ? (*inner)->words.front().begin : begin_of(item));
      for_each_body({&item, 1}, [&](const ItemNode&, std::span<const ItemNode> body) {
        collect(body, inner == nullptr ? nullptr : *inner);
      });
    }
  }

  static std::uint32_t begin_of(const ItemNode& item) {
    return std::visit(
        [](const auto* node) {
          if constexpr (requires { node->keyword; }) return node->keyword.begin;
          if constexpr (requires { node->kind; }) return node->kind.begin;
          if constexpr (requires { node->value; }) return node->name_span.begin;
          return std::uint32_t{0};
        },
        item);
  }

  const Source& source_;
  std::unordered_map<std::string_view, const DefineNode*> definitions_;
};

}  // namespace

std::vector<std::uint32_t> item_starts(const SyntaxTree& tree) { return Collector(tree).starts; }

}  // namespace raytracer::scene_file
