#include "scene_file/json_scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <vector>

#include "core/suggest.hpp"
#include "scene_file/colors.hpp"
#include "scene_file/functions.hpp"
#include "scene_file/json_text.hpp"
#include "scene_file/lexer.hpp"
#include "scene_file/parser.hpp"
#include "scene_file/schema.hpp"

namespace raytracer::scene_file {
namespace {

// `{"display": [r, g, b]}` as a function of three numbers: it gives what #rrggbb gives, of any three numbers.
FunctionResult display_color(std::span<const Value> rgb) {
  FunctionResult result;
  if (std::ranges::all_of(rgb, &Value::is_number)) {
    result.value = Value::display_color({rgb[0].x(), rgb[1].x(), rgb[2].x()});
  } else {
    result.problem = "takes three numbers";
  }
  return result;
}
constexpr FunctionRow kDisplayColor = {"display",    "r, g, b", 3, 3, "a colour as a display shows it",
                                       display_color};

class SceneReader {
 public:
  SceneReader(const Source& source, Names& names, Diagnostics& diagnostics)
      : tree_(std::make_unique<SyntaxTree>()), source_(source), names_(names), diagnostics_(diagnostics) {
    tree_->source = &source;
  }

  std::unique_ptr<SyntaxTree> read() {
    const JsonValue* scene = parse_json(source_, values_, diagnostics_);
    if (scene != nullptr) read_scene(*scene);
    return std::move(tree_);
  }

 private:
  using Items = std::vector<ItemNode>;

  std::string_view text(Span span) const { return source_.text(span); }
  void error(Span span, std::string message, std::string suggestion = {}) {
    diagnostics_.error({&source_, span}, std::move(message), std::move(suggestion));
  }
  // A long value is underlined by its first character.
  static Span mark(const JsonValue& value) {
    const bool is_long = value.type == JsonType::kArray || value.type == JsonType::kObject;
    return is_long ? Span{value.span.begin, value.span.begin + 1} : value.span;
  }
  bool is_key(const JsonMember& member, std::string_view key) const {
    return text(member.key.inside()) == key;
  }
  const JsonMember* find(const JsonValue& object, std::string_view key) const {
    const auto found =
        std::ranges::find_if(object.members, [&](const JsonMember& m) { return is_key(m, key); });
    return found == object.members.end() ? nullptr : &*found;
  }
  std::span<const ItemNode> keep(const Items& items) {
    return tree_->arena.copy(std::span<const ItemNode>(items));
  }

  bool expect(const JsonValue& value, JsonType type, std::string_view what, std::string suggestion = {}) {
    if (value.type == type) return true;
    if (value.type == JsonType::kBad) return false;
    error(mark(value), fmt::format("{} is missing here", what), std::move(suggestion));
    return false;
  }

  void read_scene(const JsonValue& scene);
  Items read_blocks(const JsonMember& blocks);
  void read_block(const JsonValue& object, Items& items);
  const IncludeNode* read_include(const JsonValue& object, Span keyword);
  const DefineNode* read_define(const JsonValue& object, Span keyword);
  bool read_words(const JsonValue& object, Span kind, std::vector<Span>& words);
  void read_properties(const JsonValue& object, const KindRow* row, Items& items);
  void read_property(const JsonMember& member, const KindRow* row, Items& items);
  void read_transforms(const JsonMember& transforms, Items& items);
  const BlockNode* read_inner_block(const JsonMember& member);
  const BlockNode* read_texture(const JsonMember& member, const JsonMember& texture);
  void read_stops(const JsonMember& stops, const PropertyRow& row, Items& items);
  ValueNode expression_value(const JsonMember& expression);
  const Expression* moved(const Expression& e, std::uint32_t by);
  bool has_only(const JsonValue& object, std::span<const std::string_view> known, std::string_view what);
  bool is_name(Span span) const;
  bool take_name(const JsonMember& member, Span& name);
  ValueNode value_of(const JsonValue& json, const PropertyRow* row);
  ValueNode string_value(const JsonValue& json, const PropertyRow* row);
  ValueNode display_value(const JsonMember& display);

  std::unique_ptr<SyntaxTree> tree_;
  Arena values_;
  const Source& source_;
  Names& names_;
  Diagnostics& diagnostics_;
};

bool SceneReader::has_only(const JsonValue& object, std::span<const std::string_view> known,
                           std::string_view what) {
  bool sound = true;
  for (const JsonMember& member : object.members) {
    const std::string_view key = text(member.key.inside());
    if (std::ranges::find(known, key) != known.end()) continue;
    const std::string_view nearest = nearest_word(key, known);
    error(member.key.inside(), fmt::format("{} has no '{}'", what, key),
          nearest.empty() ? fmt::format("it has {}", fmt::join(known, ", "))
                          : fmt::format("did you mean '{}'?", nearest));
    sound = false;
  }
  return sound;
}

void SceneReader::read_scene(const JsonValue& scene) {
  constexpr std::string_view kExample = R"({"raytracer": 1, "blocks": [{"kind": "sphere"}]})";
  if (!expect(scene, JsonType::kObject, "an object", std::string(kExample))) return;
  constexpr std::array<std::string_view, 2> kKeys = {"raytracer", "blocks"};
  const bool sound = has_only(scene, kKeys, "a scene");
  const JsonMember* version = find(scene, "raytracer");
  if (version != nullptr &&
      (version->value.type != JsonType::kNumber || version->value.number != kLanguageVersion)) {
    error(mark(version->value), "this is no version of the language that is known",
          fmt::format("this program reads \"raytracer\": {}", kLanguageVersion));
  }
  const JsonMember* blocks = find(scene, "blocks");
  if (blocks == nullptr && sound) error(mark(scene), "a scene needs \"blocks\"", std::string(kExample));
  if (blocks == nullptr) return;
  tree_->items = keep(read_blocks(*blocks));
}

SceneReader::Items SceneReader::read_blocks(const JsonMember& blocks) {
  Items items;
  if (!expect(blocks.value, JsonType::kArray, "a list of blocks", R"([{"kind": "sphere"}])")) return items;
  for (const JsonValue& block : blocks.value.elements) {
    if (expect(block, JsonType::kObject, "a block", R"({"kind": "sphere"})")) read_block(block, items);
  }
  return items;
}

bool SceneReader::is_name(Span span) const {
  const std::string_view word = text(span);
  return !word.empty() && !(word[0] >= '0' && word[0] <= '9') && std::ranges::all_of(word, [](char c) {
    return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
  });
}

bool SceneReader::take_name(const JsonMember& member, Span& name) {
  if (!expect(member.value, JsonType::kString, "a name in quotes")) return false;
  name = member.value.inside();
  if (is_name(name)) return true;
  error(member.value.span, fmt::format("{} is no name", text(member.value.span)),
        "a name has letters, digits and '_' only");
  return false;
}

void SceneReader::read_block(const JsonValue& object, Items& items) {
  const JsonMember* kind = find(object, "kind");
  BlockNode block;
  block.is_exact = true;
  if (kind == nullptr) return error(mark(object), "a block needs a \"kind\"", R"("kind": "sphere")");
  if (!take_name(*kind, block.kind)) return;
  const std::string_view word = text(block.kind);
  if (word == "include") {
    if (const IncludeNode* include = read_include(object, block.kind)) items.emplace_back(include);
    return;
  }
  if (word == "define") {
    if (const DefineNode* define = read_define(object, block.kind)) items.emplace_back(define);
    return;
  }
  if (word == "let" || word == "for" || word == "if") {
    return error(kind->value.span, fmt::format("JSON has no '{}'", word),
                 "whoever writes the JSON computes it");
  }
  std::vector<Span> words;
  if (!read_words(object, block.kind, words)) return;
  const KindRow* variant = words.empty() ? nullptr : find_kind(word, text(words[0]));
  Items inside;
  read_properties(object, variant != nullptr ? variant : find_kind(word), inside);
  block.kind_name = names_.id_of(word);
  block.words = tree_->arena.copy(std::span<const Span>(words));
  block.items = keep(inside);
  block.end = object.span.end;
  items.emplace_back(tree_->arena.make(block));
}

// The variant and the name of a block.
bool SceneReader::read_words(const JsonValue& object, Span kind, std::vector<Span>& words) {
  Span word;
  if (const JsonMember* variant = find(object, "variant")) {
    if (!take_name(*variant, word)) return false;
    if (find_kind(text(kind), text(word)) == nullptr) {
      std::vector<std::string_view> known;
      for (const KindRow& row : all_kinds()) {
        if (row.name == text(kind) && !row.variant.empty()) known.push_back(row.variant);
      }
      error(word, fmt::format("there is no {} '{}'", text(kind), text(word)),
            known.empty() ? "it has no variants" : fmt::format("known are {}", fmt::join(known, ", ")));
      return false;
    }
    words.push_back(word);
  }
  if (const JsonMember* name = find(object, "name")) {
    if (!take_name(*name, word)) return false;
    if (words.empty() && find_kind(text(kind), text(word)) != nullptr) {
      error(word, fmt::format("'{}' is a variant of '{}', no name", text(word), text(kind)),
            "\"variant\": …");
      return false;
    }
    words.push_back(word);
  }
  return true;
}

const IncludeNode* SceneReader::read_include(const JsonValue& object, Span keyword) {
  constexpr std::array<std::string_view, 2> kKeys = {"kind", "file"};
  if (!has_only(object, kKeys, "an include")) return nullptr;
  const JsonMember* file = find(object, "file");
  if (file == nullptr || file->value.type != JsonType::kString) {
    error(file == nullptr ? keyword : mark(file->value), "'include' needs the name of a file",
          R"("file": "parts.txt")");
    return nullptr;
  }
  IncludeNode include;
  include.keyword = {std::min(keyword.begin, file->value.span.begin), keyword.end};
  include.file = string_value(file->value, nullptr);
  return tree_->arena.make(include);
}

const DefineNode* SceneReader::read_define(const JsonValue& object, Span keyword) {
  constexpr std::array<std::string_view, 3> kKeys = {"kind", "name", "children"};
  if (!has_only(object, kKeys, "a definition")) return nullptr;
  const JsonMember* name = find(object, "name");
  DefineNode define;
  define.keyword = keyword;
  if (name == nullptr) {
    error(keyword, "'define' needs a \"name\"", R"("name": "tree")");
    return nullptr;
  }
  if (!take_name(*name, define.name_span)) return nullptr;
  const std::string_view word = text(define.name_span);
  if (is_reserved(word) || find_kind(word) != nullptr) {
    error(define.name_span, fmt::format("'{}' is built in and can't be given another meaning", word),
          "choose another name");
    return nullptr;
  }
  define.name = names_.id_of(word);
  if (const JsonMember* children = find(object, "children")) define.items = keep(read_blocks(*children));
  return tree_->arena.make(define);
}

void SceneReader::read_properties(const JsonValue& object, const KindRow* row, Items& items) {
  const JsonMember* children = nullptr;
  for (const JsonMember& member : object.members) {
    if (is_key(member, "kind") || is_key(member, "name") || is_key(member, "variant")) continue;
    if (is_key(member, "texture") && row != nullptr && row->block_class == BlockClass::kTexture) continue;
    if (is_key(member, "children")) {
      children = &member;
    } else if (is_key(member, "transforms")) {
      read_transforms(member, items);
    } else {
      read_property(member, row, items);
    }
  }
  if (children == nullptr) return;
  const Items blocks = read_blocks(*children);
  items.insert(items.end(), blocks.begin(), blocks.end());
}

// `[{"rotate": [0, 30, 0]}, {"translate": [1, 0, 0]}]`: an object cannot say one word twice, and their order
// counts.
void SceneReader::read_transforms(const JsonMember& transforms, Items& items) {
  constexpr const char* kExample = R"([{"rotate": [0, 30, 0]}, {"translate": [1, 0, 0]}])";
  if (!expect(transforms.value, JsonType::kArray, "a list of transforms", kExample)) return;
  for (const JsonValue& transform : transforms.value.elements) {
    if (!expect(transform, JsonType::kObject, "a transform", kExample)) continue;
    if (transform.members.size() != 1) {
      error(mark(transform), fmt::format("a transform has one word, found {}", transform.members.size()),
            kExample);
      continue;
    }
    const JsonMember& member = transform.members[0];
    const auto rows = transform_properties();
    const auto row = std::ranges::find(rows, text(member.key.inside()), &PropertyRow::name);
    if (row != rows.end()) {
      read_property(member, nullptr, items);
      continue;
    }
    std::vector<std::string_view> known;
    for (const PropertyRow& each : rows) known.push_back(each.name);
    const std::string_view nearest = nearest_word(text(member.key.inside()), known);
    error(member.key.inside(), fmt::format("there is no transform '{}'", text(member.key.inside())),
          nearest.empty() ? fmt::format("known are {}", fmt::join(known, ", "))
                          : fmt::format("did you mean '{}'?", nearest));
  }
}

void SceneReader::read_property(const JsonMember& member, const KindRow* row, Items& items) {
  PropertyNode property;
  property.name = member.key.inside();
  if (!is_name(property.name)) {
    return error(member.key.span, fmt::format("{} is no name of a property", text(member.key.span)));
  }
  const std::string_view name = text(property.name);
  const PropertyRow* known = row != nullptr ? find_property(*row, name) : nullptr;
  if (known == nullptr && name == material_property().name) known = &material_property();
  std::vector<ValueNode> values;
  const bool is_list_of_stops = known != nullptr && known->type == PropertyType::kStop;
  if (is_list_of_stops && member.value.type == JsonType::kArray) {
    return read_stops(member, *known, items);
  }
  if (member.value.type == JsonType::kArray) {
    for (const JsonValue& element : member.value.elements) values.push_back(value_of(element, known));
  } else if (member.value.type == JsonType::kObject) {
    if (const JsonMember* texture = find(member.value, "texture")) {
      if (const BlockNode* block = read_texture(member, *texture)) items.emplace_back(block);
      return;
    }
    if (const JsonMember* expression = find(member.value, "expression")) {
      values.push_back(expression_value(*expression));
    } else if (const JsonMember* display = find(member.value, "display"); display == nullptr) {
      items.emplace_back(read_inner_block(member));
      return;
    } else if (member.value.members.size() == 1) {
      values.push_back(display_value(*display));
    } else {
      return error(mark(member.value), "\"display\" stands alone", R"({"display": [1, 0.5, 0]})");
    }
  } else {
    values.push_back(value_of(member.value, known));
  }
  property.name_id = names_.id_of(name);
  property.values = tree_->arena.copy(std::span<const ValueNode>(values));
  items.emplace_back(tree_->arena.make(property));
}

// `"material": {"color": "red"}`
const BlockNode* SceneReader::read_inner_block(const JsonMember& member) {
  BlockNode block;
  block.is_exact = true;
  block.kind = member.key.inside();
  block.kind_name = names_.id_of(text(block.kind));
  Items items;
  for (const JsonMember& inner : member.value.members)
    read_property(inner, find_kind(text(block.kind)), items);
  block.items = keep(items);
  block.end = member.value.span.end;
  return tree_->arena.make(block);
}

// `"color": {"texture": "checker", "a": "red"}`
const BlockNode* SceneReader::read_texture(const JsonMember& member, const JsonMember& texture) {
  Span word;
  if (!take_name(texture, word)) return nullptr;
  BlockNode block;
  block.is_exact = true;
  block.kind = member.key.inside();
  block.kind_name = names_.id_of(text(block.kind));
  block.words = tree_->arena.copy(std::span<const Span>(&word, 1));
  Items items;
  read_properties(member.value, find_texture_kind(text(word)), items);
  block.items = keep(items);
  block.end = member.value.span.end;
  return tree_->arena.make(block);
}

// `"stop": [[0, "black"], [1, [1, 0.5, 0]]]`
void SceneReader::read_stops(const JsonMember& stops, const PropertyRow& row, Items& items) {
  PropertyRow color = row;
  color.type = PropertyType::kColor;
  for (const JsonValue& stop : stops.value.elements) {
    if (stop.type != JsonType::kArray || stop.elements.size() != 2) {
      error(mark(stop), "a stop is a number and a colour", R"([0.5, "red"])");
      continue;
    }
    std::vector<ValueNode> values = {value_of(stop.elements[0], nullptr)};
    const JsonValue& value = stop.elements[1];
    const JsonMember* display = value.type == JsonType::kObject ? find(value, "display") : nullptr;
    if (display != nullptr) {
      values.push_back(display_value(*display));
    } else if (value.type == JsonType::kArray) {
      for (const JsonValue& component : value.elements) values.push_back(value_of(component, &color));
    } else {
      values.push_back(value_of(value, &color));
    }
    PropertyNode property;
    property.name = stops.key.inside();
    property.name_id = names_.id_of(text(property.name));
    property.values = tree_->arena.copy(std::span<const ValueNode>(values));
    items.emplace_back(tree_->arena.make(property));
  }
}

// `"color": {"expression": "0.5 + 0.5 * u"}`
ValueNode SceneReader::expression_value(const JsonMember& expression) {
  ValueNode value;
  value.span = expression.value.span;
  if (!expect(expression.value, JsonType::kString, "an expression in quotes")) return value;
  const Span inside = expression.value.inside();
  constexpr std::size_t kLongest = 20'000;
  const bool is_plain = text(inside).find('\\') == std::string_view::npos && text(inside).size() <= kLongest;
  Diagnostics mistakes;
  const Source source("expression", "", std::string(text(inside)));
  const Expression* parsed =
      is_plain ? parse_lone_expression(source, names_, tree_->arena, mistakes) : nullptr;
  if (parsed == nullptr) {
    const std::vector<Diagnostic> messages = mistakes.take();
    error(value.span, messages.empty() ? "this is no expression" : messages.front().message,
          "\"0.5 + 0.5 * u\"");
    return value;
  }
  value.kind = ValueKind::kExpression;
  value.expression = moved(*parsed, inside.begin);
  return value;
}

// An expression of another text, as if it stood here.
const Expression* SceneReader::moved(const Expression& e, std::uint32_t by) {
  Expression copy = e;
  for (Span* span : {&copy.span, &copy.token}) *span = {span->begin + by, span->end + by};
  std::vector<const Expression*> arguments;
  for (const Expression* argument : e.arguments) arguments.push_back(moved(*argument, by));
  copy.arguments = tree_->arena.copy(std::span<const Expression* const>(arguments));
  return tree_->arena.make(copy);
}

ValueNode SceneReader::value_of(const JsonValue& json, const PropertyRow* row) {
  ValueNode value;
  value.span = json.span;
  switch (json.type) {
    case JsonType::kNumber:
      value.kind = ValueKind::kNumber;
      value.number = json.number;
      return value;
    case JsonType::kString:
      return string_value(json, row);
    case JsonType::kTrue:
    case JsonType::kFalse:
      value.kind = ValueKind::kWord;
      value.name = names_.id_of(text(json.span));
      return value;
    case JsonType::kBad:
      return value;
    default:
      error(mark(json), fmt::format("{} is no value here", json.type == JsonType::kNull    ? "null"
                                                           : json.type == JsonType::kArray ? "a list"
                                                                                           : "an object"));
      return value;
  }
}

// What a string is depends on what its property takes: a word, the name of a material, a colour, or text.
ValueNode SceneReader::string_value(const JsonValue& json, const PropertyRow* row) {
  ValueNode value;
  value.span = json.span;
  const std::string_view inside = text(json.inside());
  const bool takes_color = row != nullptr && row->type == PropertyType::kColor;
  const bool takes_word =
      row != nullptr && (row->type == PropertyType::kWord || row->type == PropertyType::kMaterial ||
                         row->type == PropertyType::kName || takes_color);
  if (takes_color && inside.starts_with('#')) {
    if (is_color(inside)) {
      value.kind = ValueKind::kColor;
      value.span = json.inside();
    } else {
      error(json.span, fmt::format("{} is not a colour", text(json.span)),
            "colours look like \"#f80\" or \"#ff8800\"");
    }
  } else if (takes_color && !named_color(inside)) {
    const std::string_view nearest = nearest_word(inside, color_names());
    error(
        json.span, fmt::format("there is no colour {}", text(json.span)),
        nearest.empty() ? "\"#ff8800\", a name or [1, 0.5, 0]" : fmt::format("did you mean '{}'?", nearest));
  } else if (takes_word) {
    value.kind = is_name(json.inside()) ? ValueKind::kWord : ValueKind::kBad;
    value.span = json.inside();
    value.name = names_.id_of(inside);
    if (value.kind == ValueKind::kBad) {
      error(json.span, fmt::format("{} is no word", text(json.span)),
            "a word has letters, digits and '_' only");
    }
  } else {
    value.kind = ValueKind::kString;
    value.is_decoded = true;
    value.name = names_.id_of(json_unescape(inside));
  }
  return value;
}

ValueNode SceneReader::display_value(const JsonMember& display) {
  ValueNode value;
  value.span = display.value.span;
  if (display.value.type != JsonType::kArray || display.value.elements.size() != 3) {
    error(mark(display.value), "\"display\" takes three numbers", R"({"display": [1, 0.5, 0]})");
    return value;
  }
  std::vector<const Expression*> arguments;
  for (const JsonValue& element : display.value.elements) {
    Expression number;
    number.operation = Operation::kNumber;
    number.span = element.span;
    number.number = element.number;
    if (!expect(element, JsonType::kNumber, "a number")) return value;
    arguments.push_back(tree_->arena.make(number));
  }
  Expression call;
  call.operation = Operation::kCall;
  call.span = value.span;
  call.function = &kDisplayColor;
  call.arguments = tree_->arena.copy(std::span<const Expression* const>(arguments));
  value.kind = ValueKind::kExpression;
  value.expression = tree_->arena.make(call);
  return value;
}

}  // namespace

bool is_json(std::string_view name, std::string_view text) {
  if (name.ends_with(".json")) return true;
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  const auto skip_blanks = [&] {
    text.remove_prefix(std::min(text.find_first_not_of(" \t\r\n"), text.size()));
  };
  skip_blanks();
  if (!text.starts_with('{')) return false;
  text.remove_prefix(1);
  skip_blanks();
  return text.empty() || text[0] == '"' || text[0] == '}';
}

std::unique_ptr<SyntaxTree> parse_json_scene(const Source& source, Names& names, Diagnostics& diagnostics) {
  return SceneReader(source, names, diagnostics).read();
}

}  // namespace raytracer::scene_file
