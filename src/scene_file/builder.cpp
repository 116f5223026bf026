#include "scene_file/builder.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/deep_stack.hpp"
#include "core/suggest.hpp"
#include "scene_file/material_library.hpp"
#include "scene_file/parser.hpp"

namespace raytracer::scene_file {
namespace {

// Counts a level of nesting while it lives.
class Deeper {
 public:
  explicit Deeper(std::size_t& depth) : depth_(depth) { ++depth_; }
  ~Deeper() { --depth_; }
  Deeper(const Deeper&) = delete;
  Deeper& operator=(const Deeper&) = delete;

 private:
  std::size_t& depth_;
};

Place place_of(const ItemNode& item, const Surroundings& around) {
  const Span span = std::visit(
      [](const auto* node) -> Span {
        if constexpr (requires { node->header(); }) return node->header();
        if constexpr (requires { node->keyword; }) return node->keyword;
        if constexpr (requires { node->name_span; }) return node->name_span;
        return {};
      },
      item);
  return {around.source, span};
}

std::vector<std::string_view> variants_of(std::string_view kind) {
  std::vector<std::string_view> variants;
  for (const KindRow& row : all_kinds()) {
    if (row.name == kind && !row.variant.empty()) variants.push_back(row.variant);
  }
  return variants;
}

}  // namespace

Builder::Builder(Files& files, const Limits& limits, const Moment& moment, KeptShapes& kept,
                 Diagnostics& diagnostics)
    : files_(files),
      limits_(limits),
      diagnostics_(diagnostics),
      budget_(limits.steps),
      evaluator_(files.names(), moment, budget_, diagnostics),
      store_(kept),
      meshes_(kept, files, diagnostics) {
  draft_.scene.materials.push_back(Material{});  // of shapes that name none
  material_uses_.push_back({{}, true, false, 0});
}

void Builder::build(const SyntaxTree& tree) {
  const Frame frame;
  NameTable names;
  Surroundings top;
  top.source = tree.source;
  top.frame = &frame;
  top.names = &names;
  top.is_top = true;
  run_on_deep_stack([&] {
    build_items(tree.items, top);
    try_unused_definitions(top);
  });
  evaluator_.bindings().pop_to(0);
  definitions_.pop_to(0);
  materials_.pop_to(0);
  if (!diagnostics_.has_errors()) meshes_.place_all(draft_.scene.materials, store_);
}

// A definition that nothing uses is run once all the same, for the mistakes in it.
void Builder::try_unused_definitions(const Surroundings& top) {
  const std::vector<std::shared_ptr<const Definition>> definitions = top_definitions_;
  for (const auto& definition : definitions) {
    if (halted_ || used_definitions_.contains(definition->node)) continue;
    const std::size_t lights = draft_.scene.lights.size();
    const std::uint64_t shapes_made = shapes_made_, lights_made = lights_made_;
    const bool used_time = evaluator_.uses_time();
    ShapeBatch discarded;
    Surroundings inside = top;
    inside.is_top = false;
    inside.source = definition->source;
    inside.kind = definition->name;
    store_.record(discarded);
    is_trying_ = true;
    build_body(*definition, definition->defaults, inside, {});
    is_trying_ = false;
    store_.stop_recording();
    draft_.scene.lights.resize(lights);
    draft_.light_places.resize(lights);
    shapes_made_ = shapes_made;
    lights_made_ = lights_made;
    if (!used_time) evaluator_.forget_time();
  }
}

void Builder::build_items(std::span<const ItemNode> items, const Surroundings& around) {
  for (const ItemNode& item : items) build_item(item, around);
}

void Builder::build_item(const ItemNode& item, const Surroundings& around) {
  if (halted_) return;
  // Every level costs some kilobytes of stack; load() provides as much as this many take.
  if (depth_ >= kDeepestStatements) {
    return halt(place_of(item, around),
                fmt::format("blocks and statements are nested more than {} deep", kDeepestStatements));
  }
  const Deeper deeper(depth_);
  struct Dispatch {
    Builder& builder;
    const Surroundings& around;
    void operator()(const BlockNode* node) const { builder.build_block(*node, around); }
    void operator()(const PropertyNode* node) const { builder.build_stray_property(*node, around); }
    void operator()(const IncludeNode* node) const { builder.build_include(*node, around); }
    void operator()(const LetNode* node) const {
      builder.build_let(*node, around, around.let_base, around.is_top);
    }
    void operator()(const ForNode* node) const { builder.build_for(*node, around); }
    void operator()(const IfNode* node) const { builder.build_if(*node, around); }
    void operator()(const DefineNode* node) const { builder.build_define(*node, around); }
  };
  std::visit(Dispatch{*this, around}, item);
}

void Builder::build_stray_property(const PropertyNode& property, const Surroundings& around) {
  const std::string_view word = around.source->text(property.name);
  const Place place{around.source, property.name};
  constexpr std::string_view kStatements[] = {"include", "let", "for", "if", "define", "raytracer"};
  const std::string_view nearest = nearest_word(word, kStatements);
  if (word == "raytracer") {
    diagnostics_.error(place, "the version of the language stands at the very beginning of a file");
  } else if (!nearest.empty()) {
    diagnostics_.error(place, fmt::format("'{}' stands outside of any block", word),
                       fmt::format("did you mean '{}'?", nearest));
  } else if (around.kind.empty() && around.is_top) {
    diagnostics_.error(place, fmt::format("'{}' stands outside of any block", word),
                       "properties stand between the braces of a block");
  } else {
    diagnostics_.error(place, fmt::format("'{}' stands where only blocks can stand", word),
                       "properties stand directly between the braces of their block");
  }
}

void Builder::report_unknown_kind(const BlockNode& block, const Surroundings& around) {
  const std::string_view word = around.source->text(block.kind);
  if (!diagnostics_.is_listening()) return diagnostics_.error({around.source, block.kind}, {});
  if (may_have_variant(word)) {
    return diagnostics_.error({around.source, block.kind},
                              fmt::format("'{}' needs a word behind it that says which", word),
                              fmt::format("known are {}", fmt::join(variants_of(word), ", ")));
  }
  std::vector<std::string_view> known;
  for (const KindRow& row : all_kinds()) known.push_back(row.name);
  for (std::size_t i = 0; i < definitions_.height(); ++i) {
    if (around.frame->definitions.shows(i)) known.push_back(definitions_.at(i).value->name);
  }
  std::string_view nearest = nearest_word(word, known);
  std::vector<Note> notes;
  std::string suggestion =
      nearest.empty() ? "'raytracer help' lists all kinds" : fmt::format("did you mean '{}'?", nearest);
  if (word == "elif" || word == "elseif") suggestion = "else if … { … }";
  if (const SyntaxTree* tree = files_.tree_of(*around.source)) {
    for (const ItemNode& item : tree->items) {
      const auto* define = std::get_if<const DefineNode*>(&item);
      if (define == nullptr || around.source->text((*define)->name_span) != word) continue;
      notes.push_back({{around.source, (*define)->name_span}, "it is defined here, below its use"});
      suggestion = "a name is defined before it is used";
    }
  }
  diagnostics_.error({around.source, block.kind}, fmt::format("there is no kind of block '{}'", word),
                     suggestion, notes);
}

void Builder::report_unknown_variant(const BlockNode& block, const Surroundings& around) {
  const std::string_view kind = around.source->text(block.kind);
  const std::string_view word = around.source->text(block.words[0]);
  const std::vector<std::string_view> known = variants_of(kind);
  const std::string_view nearest = nearest_word(word, known);
  diagnostics_.error({around.source, block.words[0]}, fmt::format("there is no {} '{}'", kind, word),
                     nearest.empty() ? fmt::format("known are {}", fmt::join(known, ", "))
                                     : fmt::format("did you mean '{}'?", nearest));
}

// Finds the row of a block from its kind and, where the kind has variants, the word behind it; what is left
// is its name.
const KindRow* Builder::resolve_kind(const BlockNode& block, const Surroundings& around,
                                     std::string_view& name) {
  const std::string_view word = around.source->text(block.kind);
  const auto word_at = [&](std::size_t i) {
    return i < block.words.size() ? around.source->text(block.words[i]) : std::string_view();
  };
  const KindRow* plain = find_kind(word);
  if (plain == nullptr && (!may_have_variant(word) || block.words.empty())) {
    report_unknown_kind(block, around);
    return nullptr;
  }
  name = word_at(0);
  if (!may_have_variant(word) || block.words.empty()) return plain;
  if (const KindRow* variant = find_kind(word, word_at(0))) {
    name = word_at(1);
    return variant;
  }
  // `light lamp { … }` has a name; `light spto { … }` has a slip.
  if (block.words.size() < 2 && nearest_word(word_at(0), variants_of(word)).empty() && plain != nullptr)
    return plain;
  report_unknown_variant(block, around);
  return nullptr;
}

bool Builder::check_standing(const KindRow& row, const BlockNode& block, const Surroundings& around) {
  if (row.block_class != BlockClass::kSetting || around.kind.empty()) return true;
  if (!around.is_unclosed) {
    diagnostics_.error({around.source, block.header()},
                       fmt::format("a {} can't stand inside a {}", row.name, around.kind),
                       fmt::format("'{}' stands at the top of the scene", row.name));
  }
  return false;
}

// Names are unique within their kind; a setting without a name exists once.
bool Builder::register_name(const KindRow& row, std::string_view name, const Place& place,
                            const Surroundings& around) {
  if (name.empty() && row.block_class != BlockClass::kSetting) return true;
  NameTable& table = row.block_class == BlockClass::kSetting ? setting_names_ : *around.names;
  const auto [first, is_new] = table.try_emplace(fmt::format("{} {}", row.name, name), place);
  if (is_new) return true;
  diagnostics_.error(place,
                     name.empty() ? fmt::format("a second '{}'", row.name)
                                  : fmt::format("a second {} of the name '{}'", row.name, name),
                     {}, {{first->second, "the first stands here"}});
  return false;
}

std::shared_ptr<const Definition> Builder::find_definition(NameId name, const Surroundings& around) const {
  const std::size_t position = definitions_.find(name, around.frame->definitions);
  return position == decltype(definitions_)::npos ? nullptr : definitions_.at(position).value;
}

void Builder::build_block(const BlockNode& block, const Surroundings& around) {
  if (!spend(1, {around.source, block.header()})) return;
  if (definitions_.height() > 0) {
    if (const auto definition = find_definition(block.kind_name, around))
      return build_use(definition, block, around);
  }
  std::string_view name;
  const KindRow* row = resolve_kind(block, around, name);
  if (row == nullptr || !check_standing(*row, block, around)) return;
  if (row->block_class == BlockClass::kMaterial) return build_material(*row, block, name, around);
  if (row->block_class == BlockClass::kTexture) return build_named_texture(*row, block, name, around);
  register_name(*row, name, {around.source, block.header()}, around);
  const SceneRecorder::Block recorded(recorder(), *row, name);
  BlockContext context(*this, *row, block, around, name);
  row->build(context);
}

// A material with a name, for later.
void Builder::build_material(const KindRow& row, const BlockNode& block, std::string_view name,
                             const Surroundings& around) {
  const Place place{around.source, block.header()};
  if (name.empty()) {
    diagnostics_.error(place, "a material that stands alone needs a name", "material red { color red }");
    return;
  }
  const NameId id = files_.names().id_of(name);
  const std::size_t known = materials_.find(id, around.frame->materials);
  const bool is_new = known == decltype(materials_)::npos || known < around.material_base;
  if (!is_new) {
    diagnostics_.error(place, fmt::format("a second material of the name '{}'", name), {},
                       {{materials_.at(known).place, "the first stands here"}});
  }
  last_material_.reset();
  const SceneRecorder::Block recorded(recorder(), row, name);
  BlockContext context(*this, row, block, around, name);
  const std::size_t errors_before = diagnostics_.error_count();
  row.build(context);
  if (SceneRecorder* told = recorder()) told->name_material(last_material_.value_or(0));
  if (!is_new) return;
  // A material with a mistake in it is known all the same: its uses are no mistakes.
  const std::uint32_t index = last_material_.value_or(0);
  materials_.push(id, index, place);
  const bool sound = diagnostics_.error_count() == errors_before;
  if (sound) material_uses_[index] = {place, false, context.depends_on_time(), id};
}

// A material in place; where it has a name, that is for the recorder alone.
std::optional<std::uint32_t> Builder::build_inline_material(const BlockNode& block,
                                                            const Surroundings& around,
                                                            std::string_view name) {
  const KindRow* row = find_kind("material");
  const SceneRecorder::Block recorded(recorder(), *row, name);
  BlockContext context(*this, *row, block, around, {});
  last_material_.reset();
  row->build(context);
  if (last_material_) material_uses_[*last_material_] = {{}, true, context.depends_on_time(), 0};
  if (SceneRecorder* told = recorder(); told != nullptr && !name.empty()) {
    told->name_material(last_material_.value_or(0));
  }
  return last_material_;
}

std::optional<std::uint32_t> Builder::find_material(std::string_view name, const Place& place,
                                                    const Surroundings& around) {
  const std::size_t position = materials_.find(files_.names().id_of(name), around.frame->materials);
  if (position != decltype(materials_)::npos) {
    const std::uint32_t index = materials_.at(position).value;
    material_uses_[index].used = true;
    if (SceneRecorder* told = recorder()) told->use_material(index);
    return index;
  }
  // Looked for once: a scene may name a material a million times.
  const bool is_known = library_.contains(std::string(name));
  const BlockNode* later = is_known ? nullptr : find_later_material(name, place);
  if (later == nullptr) {
    if (const auto index = find_library_material(name)) return index;
  }
  if (!diagnostics_.is_listening()) {
    diagnostics_.error(place, {});
    return std::nullopt;
  }
  std::vector<std::string_view> known;
  for (std::size_t i = 0; i < materials_.height(); ++i) {
    const std::string_view other = files_.names().text(materials_.at(i).name);
    const bool is_texture = other.find(' ') != std::string_view::npos;
    if (!is_texture && around.frame->materials.shows(i)) known.push_back(other);
  }
  for (const LibraryMaterial& row : material_library()) known.push_back(row.name);
  const std::string_view nearest = nearest_word(name, known);
  const bool is_color = evaluator_.look_up(files_.names().id_of(name), around.frame->values).is_vector();
  std::string suggestion = !nearest.empty() ? fmt::format("did you mean '{}'?", nearest)
                           : is_color       ? fmt::format("material {{ color {} }}", name)
                                            : fmt::format("material {} {{ color red }}", name);
  std::vector<Note> notes;
  if (later != nullptr) {
    notes.push_back({{place.source, later->header()}, "it is defined here, below its use"});
    suggestion = "a name is defined before it is used";
  }
  diagnostics_.error(place, fmt::format("there is no material '{}'", name), suggestion, notes);
  return std::nullopt;
}

// One that every scene knows, built as if its text stood where it is named first. What writes the scene down
// gets it once, in front of everything: shapes that share a material must go on sharing it, and the name that
// it gets there is none of the scene's own.
std::optional<std::uint32_t> Builder::find_library_material(std::string_view name) {
  const LibraryMaterial* row = scene_file::find_library_material(name);
  if (row == nullptr) return std::nullopt;
  LibraryText& text = library_[std::string(name)];
  SceneRecorder* told = recorder();
  if (!text.material || (told != nullptr && !text.is_told)) {
    if (text.tree == nullptr) {
      text.source = std::make_unique<Source>("<library>", "", fmt::format("material {{ {} }}", row->text));
      text.tree = parse(*text.source, files_.names(), diagnostics_);
    }
    const Frame frame;
    Surroundings around;
    around.source = text.source.get();
    around.frame = &frame;
    const SceneRecorder::InFront in_front(told);
    const auto& block = *std::get<const BlockNode*>(text.tree->items.front());
    const auto built = build_inline_material(block, around, row->name);
    if (built && !text.material) text.material = built;
    text.is_told = told != nullptr;
    text.told_as = built.value_or(0);
  }
  if (told != nullptr) told->use_material(text.told_as);
  return text.material;
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

bool Builder::spend(std::uint64_t steps, const Place& place) {
  if (halted_) return false;
  if (budget_.take(steps)) return true;
  if (diagnostics_.has_errors()) halted_ = true;  // a text with mistakes in it is not run to the end
  halt(place, fmt::format("the scene takes more than {} steps to evaluate", limits_.steps),
       "--limit steps=N allows more");
  return false;
}

void Builder::halt(const Place& place, std::string message, std::string suggestion) {
  if (halted_) return;
  halted_ = true;
  diagnostics_.error(place, std::move(message), std::move(suggestion));
}

void Builder::note_shape(const Place& place) {
  ++built_out_;
  if (has_room_for(1, place)) ++shapes_made_;
}

// Whether so many shapes more are allowed: what is known to come to too many is refused before it takes time
// and memory. Otherwise reports it and stops all evaluation.
bool Builder::has_room_for(double shapes, const Place& place) {
  if (static_cast<double>(shapes_made_) + shapes <= static_cast<double>(limits_.shapes)) return true;
  halt(place, fmt::format("the scene makes more than {} shapes", limits_.shapes),
       "--limit shapes=N allows more");
  return false;
}

void Builder::warn_of_unused_names(const SyntaxTree& main) {
  constexpr std::size_t kMostLookedAt =
      200;  // more are not told anyway, and each costs a look through the text
  std::size_t looked_at = 0;
  const auto warn = [&](const Place& place, const std::string& phrase, const std::string& name) {
    if (++looked_at < kMostLookedAt && files_.is_mentioned_twice(phrase)) return;
    diagnostics_.warning(place, fmt::format("'{}' is never used", name));
  };
  for (const MaterialUse& use : material_uses_) {
    // A library of materials that is included is not meant to be used whole.
    if (use.used || use.place.source != main.source) continue;
    const std::string name = fmt::format("material {}", files_.names().text(use.name));
    warn(use.place, name, name);
  }
  for (const auto& definition : top_definitions_) {
    if (definition->source != main.source || used_definitions_.contains(definition->node)) continue;
    warn({main.source, definition->node->name_span}, definition->name, definition->name);
  }
  for (const ItemNode& item : main.items) {
    const auto* let = std::get_if<const LetNode*>(&item);
    if (let == nullptr || evaluator_.was_used(*let)) continue;
    const std::string name(main.source->text((*let)->name_span));
    warn({main.source, (*let)->name_span}, name, name);
  }
}

}  // namespace raytracer::scene_file
