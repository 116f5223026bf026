#include "scene_file/builder.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/suggest.hpp"
#include "scene_file/lexer.hpp"

namespace raytracer::scene_file {
namespace {

constexpr std::size_t kDeepestInclude = 32;
constexpr std::uint64_t kMostIncludes = 100'000;

}  // namespace

Builder::Builder(Files& files, Diagnostics& diagnostics) : files_(files), diagnostics_(diagnostics) {
  draft_.scene.materials.push_back(Material{});  // of shapes that name none
  material_uses_.push_back({{}, true});
}

void Builder::build(const SyntaxTree& tree) {
  Scope scope;
  const Surroundings top{tree.source, {}, {}, 0, &scope};
  open_includes_.push_back(tree.source);
  for (const ItemNode& item : tree.items) build_item(item, top);
  open_includes_.pop_back();
}

void Builder::build_item(const ItemNode& item, const Surroundings& around) {
  if (const auto* block = std::get_if<const BlockNode*>(&item)) return build_block(**block, around);
  if (const auto* include = std::get_if<const IncludeNode*>(&item)) return build_include(**include, around);
  const PropertyNode& property = *std::get<const PropertyNode*>(item);
  const std::string_view word = around.source->text(property.name);
  const bool is_kind = find_kind(word) != nullptr;
  diagnostics_.error({around.source, property.name},
                     is_kind ? fmt::format("'{}' needs braces", word)
                             : fmt::format("'{}' stands outside of any block", word),
                     is_kind ? fmt::format("{} {{ … }}", word) : "properties stand between the braces of a block");
}

void Builder::report_unknown_kind(const BlockNode& block, const Surroundings& around) {
  const std::string_view word = around.source->text(block.kind);
  std::vector<std::string_view> known;
  for (const KindRow& row : all_kinds()) known.push_back(row.name);
  const std::string_view nearest = nearest_word(word, known);
  diagnostics_.error({around.source, block.kind}, fmt::format("there is no kind of block '{}'", word),
                     nearest.empty() ? "'raytracer help' lists all kinds"
                                     : fmt::format("did you mean '{}'?", nearest));
}

// Finds the row of a block from its kind and, where the kind has variants, the word behind it; what is left is its name.
const KindRow* Builder::resolve_kind(const BlockNode& block, const Surroundings& around, std::string_view& name) {
  const std::string_view word = around.source->text(block.kind);
  const auto word_at = [&](std::size_t i) {
    return i < block.words.size() ? around.source->text(block.words[i]) : std::string_view();
  };
  if (find_kind(word) == nullptr) {
    report_unknown_kind(block, around);
    return nullptr;
  }
  if (!may_have_variant(word)) {
    name = word_at(0);
    return find_kind(word);
  }
  const KindRow* variant = word_at(0).empty() ? nullptr : find_kind(word, word_at(0));
  if (block.words.size() < 2 && variant == nullptr) {  // `light lamp { … }`
    name = word_at(0);
    return find_kind(word);
  }
  name = word_at(1);
  if (variant != nullptr) return variant;
  std::vector<std::string_view> known;
  for (const KindRow& row : all_kinds()) {
    if (row.name == word && !row.variant.empty()) known.push_back(row.variant);
  }
  const std::string_view nearest = nearest_word(word_at(0), known);
  diagnostics_.error({around.source, block.words[0]}, fmt::format("there is no {} '{}'", word, word_at(0)),
                     nearest.empty() ? fmt::format("known are {}", fmt::join(known, ", "))
                                     : fmt::format("did you mean '{}'?", nearest));
  return nullptr;
}

bool Builder::check_standing(const KindRow& row, const BlockNode& block, const Surroundings& around) {
  const Place place{around.source, block.header()};
  if (row.block_class == BlockClass::kSetting && !around.kind.empty()) {
    diagnostics_.error(place, fmt::format("a {} can't stand inside a {}", row.name, around.kind),
                       fmt::format("'{}' stands at the top of the scene", row.name));
    return false;
  }
  return true;
}

// Names are unique within their kind; a setting without a name exists once.
bool Builder::register_name(const KindRow& row, std::string_view name, const Place& place) {
  if (name.empty() && row.block_class != BlockClass::kSetting) return true;
  const auto [first, is_new] = names_.try_emplace(fmt::format("{} {}", row.name, name), place);
  if (is_new) return true;
  diagnostics_.error(place,
                     name.empty() ? fmt::format("a second '{}'", row.name)
                                  : fmt::format("a second {} of the name '{}'", row.name, name),
                     {}, {{first->second, "the first stands here"}});
  return false;
}

void Builder::build_block(const BlockNode& block, const Surroundings& around) {
  std::string_view name;
  const KindRow* row = resolve_kind(block, around, name);
  if (row == nullptr || !check_standing(*row, block, around)) return;
  const Place name_place{around.source, block.header()};
  const bool is_material = row->block_class == BlockClass::kMaterial;
  if (is_material && name.empty()) {
    diagnostics_.error(name_place, "a material that stands alone needs a name", "material red { color red }");
    return;
  }
  bool is_new = true;
  if (is_material) {
    const auto local = around.scope->materials.find(name);
    if (local != around.scope->materials.end()) {
      diagnostics_.error(name_place, fmt::format("a second material of the name '{}'", name), {},
                         {{material_uses_[local->second].place, "the first stands here"}});
      is_new = false;
    }
  } else {
    is_new = register_name(*row, name, name_place);
  }
  last_material_.reset();
  BlockContext context(*this, *row, block, around, name);
  const std::size_t errors_before = diagnostics_.error_count();
  row->build(context);
  if (!is_material || !is_new) return;
  // A material with a mistake in it is known all the same: its uses are no mistakes.
  const std::uint32_t index = last_material_.value_or(0);
  const bool failed = diagnostics_.error_count() > errors_before;
  around.scope->materials.emplace(name, index);
  material_uses_.resize(draft_.scene.materials.size());
  if (!failed) material_uses_[index] = {name_place, false};
}

std::optional<std::uint32_t> Builder::build_inline_material(const BlockNode& block, const Surroundings& around) {
  const KindRow* row = find_kind("material");
  BlockContext context(*this, *row, block, around, {});
  last_material_.reset();
  row->build(context);
  material_uses_.resize(draft_.scene.materials.size(), {{}, true});
  if (last_material_) material_uses_[*last_material_] = {{}, true};
  return last_material_;
}

std::optional<std::uint32_t> Builder::find_material(std::string_view name, const Place& place,
                                                    const Surroundings& around) {
  std::vector<std::string_view> known;
  for (const Scope* scope = around.scope; scope != nullptr; scope = scope->parent) {
    const auto found = scope->materials.find(name);
    if (found != scope->materials.end()) {
      material_uses_[found->second].used = true;
      return found->second;
    }
    for (const auto& [other, index] : scope->materials) known.push_back(other);
  }
  std::ranges::sort(known);
  const std::string_view nearest = nearest_word(name, known);
  std::string suggestion = nearest.empty() ? std::string() : fmt::format("did you mean '{}'?", nearest);
  std::vector<Note> notes;
  if (const BlockNode* later = find_later_material(name, place)) {
    notes.push_back({{place.source, later->header()}, "it is defined here, below its use"});
    suggestion = "a name is defined before it is used";
  } else if (nearest.empty()) {
    suggestion = fmt::format("material {} {{ color red }}", name);
  }
  diagnostics_.error(place, fmt::format("there is no material '{}'", name), suggestion, notes);
  return std::nullopt;
}

// A material of that name further down at the top of the same file.
const BlockNode* Builder::find_later_material(std::string_view name, const Place& place) const {
  const SyntaxTree* tree = files_.tree_of(*place.source);
  if (tree == nullptr) return nullptr;
  for (const ItemNode& item : tree->items) {
    const auto* block = std::get_if<const BlockNode*>(&item);
    if (block == nullptr || (*block)->kind.begin < place.span.begin || (*block)->words.size() != 1) continue;
    if (place.source->text((*block)->kind) == "material" && place.source->text((*block)->words[0]) == name) {
      return *block;
    }
  }
  return nullptr;
}

void Builder::build_include(const IncludeNode& include, const Surroundings& around) {
  const Place place{around.source, include.file.span};
  if (open_includes_.size() > kDeepestInclude) {
    const bool itself = std::ranges::count(open_includes_, around.source) > 1;
    diagnostics_.error(place, fmt::format("files include each other more than {} deep", kDeepestInclude),
                       itself ? "the file includes itself" : "");
    return;
  }
  if (++includes_done_ > kMostIncludes) {
    if (includes_done_ == kMostIncludes + 1) {
      diagnostics_.error(place, fmt::format("the scene includes more than {} files", kMostIncludes));
    }
    return;
  }
  const SyntaxTree* tree = files_.include(unquote(place.text()), place, diagnostics_);
  if (tree == nullptr) return;
  Surroundings inside = around;
  inside.source = tree->source;
  open_includes_.push_back(tree->source);
  for (const ItemNode& item : tree->items) build_item(item, inside);
  open_includes_.pop_back();
}

void Builder::warn_of_unused_materials() {
  for (const MaterialUse& use : material_uses_) {
    if (!use.used && use.place.source != nullptr) {
      const std::string_view header = use.place.text();
      diagnostics_.warning(use.place, fmt::format("'{}' is never used", header));
    }
  }
}

}  // namespace raytracer::scene_file
