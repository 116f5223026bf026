// Textures in place of a colour or a number: `color checker { … }`, `color image "wood.png" { … }`,
// `color oak`, `color (0.5 + 0.5 * u)`.
#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "core/suggest.hpp"
#include "scene_file/arguments.hpp"
#include "scene_file/builder.hpp"
#include "scene_file/colors.hpp"
#include "scene_file/expression_compiler.hpp"
#include "scene_file/expression_text.hpp"

namespace raytracer::scene_file {
namespace {

// Among the names of materials, where no material can have it.
std::string key_of(std::string_view texture) { return fmt::format("{} {}", kTextureKind, texture); }

std::vector<std::string_view> texture_names() {
  std::vector<std::string_view> names;
  for (const KindRow& row : all_kinds()) {
    if (row.block_class == BlockClass::kTexture) names.push_back(row.variant);
  }
  return names;
}

bool is_color(const PropertyRow& row) { return row.type == PropertyType::kColor && !row.is_texture_only; }

// What a textured property keeps for a value, so that what is made of it knows that there is some.
constexpr double kSomething = 0.5;

}  // namespace

void BlockContext::set_texture(TexturePointer texture) { builder_.last_texture_ = std::move(texture); }
TextureMeaning BlockContext::texture_meaning() const { return builder_.texture_meaning_; }

template <class Read>
auto BlockContext::read_picture_file(std::string_view property, const std::string& file, const Read& read)
    -> decltype(read(file)) {
  Files& files = builder_.files_;
  const Place named = place_of(property);
  const std::string path = files.find(file, named, "a picture", builder_.diagnostics_);
  if (path.empty()) return nullptr;
  files.note_read(path);
  try {
    auto result = read(path);
    if (SceneHasher* hasher = builder_.hasher()) hasher->add_content(files.content_hash(path));
    return result;
  } catch (const Error& problem) {
    builder_.diagnostics_.error(named, fmt::format("'{}' can't be shown: {}", file, problem.what()));
    return nullptr;
  }
}

std::shared_ptr<const TexelPyramid> BlockContext::pyramid(std::string_view property, const std::string& file,
                                                          const TexelUse& use) {
  return read_picture_file(property, file, [&](const std::string& path) {
    PictureCache& pictures = builder_.files_.pictures();
    TexelUse wanted = use;
    const bool is_opacity = builder_.texture_is_opacity_ && use.channel == TextureChannel::kAll;
    if (is_opacity && pictures.picture(path)->has_alpha()) wanted.channel = TextureChannel::kAlpha;
    return pictures.pyramid(path, wanted);
  });
}

std::shared_ptr<const Picture> BlockContext::picture(std::string_view property, const std::string& file) {
  return read_picture_file(property, file,
                           [&](const std::string& path) { return builder_.files_.pictures().picture(path); });
}

// The row of a kind of texture; null where there is none, which has then been reported.
const KindRow* BlockContext::find_texture_row(Span word) {
  const std::string_view name = around_.source->text(word);
  if (const KindRow* row = find_texture_kind(name)) return row;
  const std::vector<std::string_view> known = texture_names();
  const std::string_view nearest = nearest_word(name, known);
  builder_.diagnostics_.error(place(word), fmt::format("there is no texture '{}'", name),
                              nearest.empty() ? fmt::format("known are {}", fmt::join(known, ", "))
                                              : fmt::format("did you mean '{}'?", nearest));
  return nullptr;
}

// The kind of texture that a property's value begins with; null where it is something else.
const KindRow* BlockContext::texture_named(const PropertyNode& property) {
  const auto& values = property.values;
  if (values.empty() || values[0].kind != ValueKind::kWord) return nullptr;
  if (builder_.evaluator_.is_bound(values[0].name, around_.frame->values)) return nullptr;
  const std::string_view word = around_.source->text(values[0].span);
  return named_color(word) ? nullptr : find_texture_kind(word);
}

// Whether a property that takes no texture is given one, which is then reported.
bool BlockContext::misses_texture(const PropertyRow& row, const PropertyNode& property) {
  const bool takes_words = row.type == PropertyType::kWord || row.type == PropertyType::kName ||
                           row.type == PropertyType::kMaterial || row.type == PropertyType::kStop;
  if (row.store_texture != nullptr || takes_words || property.values.empty()) return false;
  const bool is_of_surface =
      row_.block_class == BlockClass::kMaterial || row_.block_class == BlockClass::kTexture;
  const bool has_texture =
      texture_named(property) != nullptr || (is_of_surface && expression_at_point(property) != nullptr);
  if (has_texture) report_no_texture(row, {property.values.front().span.begin, property.whole().end});
  return has_texture;
}

void BlockContext::report_no_texture(const PropertyRow& row, Span span) {
  builder_.diagnostics_.error(place(span),
                              fmt::format("'{}' takes no texture, but {}", row.name, describe_type(row)),
                              fmt::format("{} {}", row.name, example_value(row)));
}

// `color image 5`, `color checker`, `color u`: what can't be a value, and not quite a texture either. False
// where there is nothing of that kind.
bool BlockContext::report_bad_texture(const PropertyRow& row, const PropertyNode& property) {
  const auto& values = property.values;
  const auto report = [&](Span span, const std::string& message, const std::string& suggestion) {
    builder_.diagnostics_.error(place(span), message, suggestion);
    return true;
  };
  if (const KindRow* kind = texture_named(property)) {
    const bool needs_file = find_file_property(*kind) != nullptr;
    if (!needs_file || values.size() == 1) {
      return report(values[0].span, fmt::format("'{}' needs braces", kind->variant),
                    fmt::format("{} {} {{ … }}", row.name, kind->variant));
    }
    const bool has_file = values[1].kind == ValueKind::kString;
    const Span rest = {values[has_file ? 2 : 1].span.begin, values.back().span.end};
    return report(
        rest,
        fmt::format("'{}' takes the name of one file, found {}", kind->variant, around_.source->text(rest)),
        values[1].kind == ValueKind::kWord ? fmt::format("{} {} {{ file {} }}", row.name, kind->variant,
                                                         around_.source->text(values[1].span))
                                           : fmt::format("{} {} \"file\"", row.name, kind->variant));
  }
  const bool is_point = values.size() == 1 && values[0].kind == ValueKind::kWord &&
                        is_point_name(around_.source->text(values[0].span)) &&
                        !builder_.evaluator_.is_bound(values[0].name, around_.frame->values);
  if (!is_point) return false;
  const std::string_view word = around_.source->text(values[0].span);
  return report(values[0].span, fmt::format("'{}' is computed at each point: it needs parentheses", word),
                fmt::format("{} ({})", row.name, word));
}

std::optional<bool> BlockContext::fill_texture_item(const PropertyRow& row, const PropertyNode& property,
                                                    void* input) {
  const auto& values = property.values;
  const bool is_word = !values.empty() && values[0].kind == ValueKind::kWord;
  if (is_word && values.size() == 2 && values[1].kind == ValueKind::kString) {
    return fill_texture_file(row, property, input);
  }
  if (is_word && values.size() == 1 && !builder_.evaluator_.is_bound(values[0].name, around_.frame->values)) {
    const std::string_view word = around_.source->text(values[0].span);
    if (const BuiltTexture* texture = builder_.find_texture(word, around_)) {
      return store_texture(row, *texture, input);
    }
  }
  if (report_bad_texture(row, property)) return false;
  if (expression_at_point(property) != nullptr) return fill_expression(row, property, input);
  if (!row.is_texture_only || values.empty()) return std::nullopt;
  if (std::ranges::none_of(values, [](const ValueNode& v) { return v.kind == ValueKind::kBad; })) {
    builder_.diagnostics_.error(place({values.front().span.begin, values.back().span.end}),
                                fmt::format("'{}' takes {}", row.name, describe_type(row)),
                                fmt::format("{} {}", row.name, example_value(row)));
  }
  return false;
}

bool BlockContext::fill_texture_block(const PropertyRow& row, const BlockNode& block, void* input) {
  const KindRow* kind = find_texture_row(block.words[0]);
  if (kind == nullptr) return false;
  // What the outermost property wants decides on what colours and pictures mean in all within.
  const bool is_outermost = row_.block_class != BlockClass::kTexture;
  const TextureMeaning wanted = is_color(row) ? builder_.color_meaning() : TextureMeaning::kNumber;
  const TextureMeaning meaning_before = builder_.texture_meaning_;
  const bool is_opacity_before = builder_.texture_is_opacity_;
  if (is_outermost) {
    builder_.texture_meaning_ = wanted;
    builder_.texture_is_opacity_ = row.is_opacity;
  }
  const std::optional<BuiltTexture> texture = builder_.build_texture(*kind, block, {}, around_);
  builder_.texture_meaning_ = meaning_before;
  builder_.texture_is_opacity_ = is_opacity_before;
  return texture && store_texture(row, *texture, input);
}

// `color image "wood.png"`: the file stands in front of the braces, if there are any.
bool BlockContext::fill_texture_file(const PropertyRow& row, const PropertyNode& property, void* input) {
  const ValueNode &word = property.values[0], &file = property.values[1];
  const KindRow* kind = find_texture_row(word.span);
  if (kind == nullptr) return false;
  const PropertyRow* known = find_file_property(*kind);
  if (known == nullptr) {
    builder_.diagnostics_.error(place(file.span), fmt::format("a {} has no file", kind->variant),
                                fmt::format("{} {} {{ … }}", row.name, kind->variant));
    return false;
  }
  Arena& arena = builder_.draft_.nodes;
  PropertyNode named;
  named.name = file.span;
  named.name_id = builder_.evaluator_.names().id_of(known->name);
  named.values = property.values.subspan(1);
  BlockNode block;
  block.kind = property.name;
  block.words = arena.copy(std::span<const Span>(&word.span, 1));
  block.end = property.whole().end;
  if (property.body != nullptr) block = *property.body;
  std::vector<ItemNode> items(block.items.begin(), block.items.end());
  items.insert(items.begin(), arena.make(named));
  block.items = arena.copy(std::span<const ItemNode>(items));
  return fill_texture_block(row, *arena.make(block), input);
}

// The property's value as one expression, where it mentions the point; null where it is the same everywhere.
const Expression* BlockContext::expression_at_point(const PropertyNode& property) {
  const auto& values = property.values;
  if (values.size() != 1 && values.size() != 3) return nullptr;
  const auto as_expression = [&](const ValueNode& value) -> const Expression* {
    Expression e;
    e.span = e.token = value.span;
    switch (value.kind) {
      case ValueKind::kExpression:
        return value.expression;
      case ValueKind::kNumber:
        e.operation = Operation::kNumber;
        e.number = value.number;
        return builder_.draft_.nodes.make(e);
      case ValueKind::kWord:
        e.operation = Operation::kName;
        e.name = value.name;
        return builder_.draft_.nodes.make(e);
      default:
        return nullptr;
    }
  };
  const auto mentions = [&](const ValueNode& value) {
    return value.kind == ValueKind::kExpression &&
           mentions_point(*value.expression, builder_.evaluator_, around_.frame->values);
  };
  if (std::ranges::none_of(values, mentions)) return nullptr;
  if (values.size() == 1) return values[0].expression;
  std::vector<const Expression*> parts;
  for (const ValueNode& value : values) {
    parts.push_back(as_expression(value));
    if (parts.back() == nullptr) return nullptr;
  }
  Expression whole;
  whole.operation = Operation::kVector;
  whole.span = {values.front().span.begin, values.back().span.end};
  whole.arguments = builder_.draft_.nodes.copy(std::span<const Expression* const>(parts));
  return builder_.draft_.nodes.make(whole);
}

bool BlockContext::fill_expression(const PropertyRow& row, const PropertyNode& property, void* input) {
  const Expression& e = *expression_at_point(property);
  auto compiled = compile_expression(e, *around_.source, around_.frame->values, builder_.evaluator_,
                                     builder_.diagnostics_);
  if (!compiled) return false;
  const bool wants_number = row.type == PropertyType::kNumber;
  if (wants_number && compiled->program.is_vector) {
    builder_.diagnostics_.error(place(e.span),
                                fmt::format("'{}' takes {}, found a vector", row.name, describe_type(row)),
                                "one of its components: (v.x)");
    return false;
  }
  const TextureMeaning meaning = row_.block_class == BlockClass::kTexture ? builder_.texture_meaning_
                                 : is_color(row)                          ? builder_.color_meaning()
                                                                          : TextureMeaning::kNumber;
  if (compiled->is_display && meaning == TextureMeaning::kLight) {
    append_function(compiled->program, [](const Vector3d& c) {
      return Vector3d(linear_from_display(c.x), linear_from_display(c.y), linear_from_display(c.z));
    });
  }
  BuiltTexture built;
  built.depends_on_time = compiled->depends_on_time;
  if (builder_.recorder() != nullptr) {
    built.json = expression_json(e, *around_.source, around_.frame->values, builder_.evaluator_);
  }
  if (SceneHasher* hasher = builder_.hasher()) hasher->add_content(hash_of(compiled->program));
  built.texture = make_expression_texture(std::move(compiled->program));
  return store_texture(row, built, input);
}

bool BlockContext::store_texture(const PropertyRow& row, const BuiltTexture& texture, void* input) {
  depends_on_time_ = depends_on_time_ || texture.depends_on_time;
  if (SceneHasher* hasher = builder_.hasher()) hasher->add_texture(row.name, texture.texture.get());
  if (SceneRecorder* recorder = builder_.recorder()) recorder->add(row, texture.json);
  if (row.store != nullptr) {
    Argument something;
    something.numbers.fill(std::clamp(kSomething, row.range.least, row.range.most));
    row.store(input, something);
  }
  row.store_texture(input, texture.texture);
  return true;
}

TextureMeaning Builder::color_meaning() const {
  return method_ == Method::kPath ? TextureMeaning::kLight : TextureMeaning::kDisplay;
}

// Nothing where a mistake was in it.
std::optional<BuiltTexture> Builder::build_texture(const KindRow& row, const BlockNode& block,
                                                   std::string_view name, const Surroundings& around) {
  last_texture_.reset();
  BuiltTexture built;
  {
    const SceneRecorder::Block recorded(recorder(), row, name);
    BlockContext context(*this, row, block, around, name);
    row.build(context);
    built.depends_on_time = context.depends_on_time();
  }
  if (SceneRecorder* told = recorder()) built.json = told->take_texture();
  built.texture = std::exchange(last_texture_, nullptr);
  if (built.texture == nullptr) return std::nullopt;
  return built;
}

// `texture checker oak { … }`, for later.
void Builder::build_named_texture(const KindRow& row, const BlockNode& block, std::string_view name,
                                  const Surroundings& around) {
  const Place place{around.source, block.header()};
  if (name.empty()) {
    diagnostics_.error(place, "a texture that stands alone needs a name",
                       fmt::format("texture {} pattern {{ … }}", row.variant));
    return;
  }
  const NameId id = files_.names().id_of(key_of(name));
  const std::size_t known = materials_.find(id, around.frame->materials);
  const bool is_new = known == decltype(materials_)::npos || known < around.material_base;
  if (!is_new) {
    diagnostics_.error(place, fmt::format("a second texture of the name '{}'", name), {},
                       {{materials_.at(known).place, "the first stands here"}});
  }
  texture_meaning_ = color_meaning();
  std::optional<BuiltTexture> built = build_texture(row, block, name, around);
  if (!is_new) return;
  // A texture with a mistake in it is known all the same: its uses are no mistakes.
  if (!built) built = BuiltTexture{};
  if (hasher() != nullptr) hasher()->number_texture(built->texture.get());
  materials_.push(id, static_cast<std::uint32_t>(named_textures_.size()), place);
  named_textures_.push_back(std::move(*built));
}

const BuiltTexture* Builder::find_texture(std::string_view name, const Surroundings& around) {
  const std::size_t position = materials_.find(files_.names().id_of(key_of(name)), around.frame->materials);
  return position == decltype(materials_)::npos ? nullptr : &named_textures_[materials_.at(position).value];
}

}  // namespace raytracer::scene_file
