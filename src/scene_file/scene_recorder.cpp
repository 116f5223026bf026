#include "scene_file/scene_recorder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "scene_file/arguments.hpp"
#include "scene_file/colors.hpp"
#include "scene_file/json_text.hpp"
#include "scene_file/shape_store.hpp"

namespace raytracer::scene_file {
namespace {

std::string array_text(std::span<const double> numbers) {
  return fmt::format("[{}]", fmt::join(numbers, ", "));
}

// Display colours are marked as such: as digits where these say exactly the same.
std::string color_text(const Argument& argument) {
  const std::span<const double> rgb = std::span(argument.numbers).first(3);
  if (!argument.is_display) return array_text(rgb);
  const bool in_range = std::ranges::all_of(rgb, [](double x) { return x >= 0 && x <= 1; });
  if (in_range) {
    const auto byte = [&](std::size_t i) { return static_cast<int>(std::round(255 * rgb[i])); };
    const std::string digits = fmt::format("#{:02x}{:02x}{:02x}", byte(0), byte(1), byte(2));
    if (hexadecimal_color(digits) == Vector3d(rgb[0], rgb[1], rgb[2])) return json_quoted(digits);
  }
  return fmt::format("{{\"display\": {}}}", array_text(rgb));
}

std::string value_text(const PropertyRow& row, const Argument& argument) {
  const auto& n = argument.numbers;
  switch (row.type) {
    case PropertyType::kNumber:
    case PropertyType::kInteger:
      return fmt::format("{}", n[0]);
    case PropertyType::kBoolean:
      return n[0] != 0 ? "true" : "false";
    case PropertyType::kString:
    case PropertyType::kName:
    case PropertyType::kFile:
      return json_quoted(argument.text);
    case PropertyType::kStop:
      return fmt::format("[{}, {}]", n[3], color_text(argument));
    case PropertyType::kWord:
      return json_quoted(row.words[argument.index]);
    case PropertyType::kColor:
      return color_text(argument);
    case PropertyType::kSize:
      if (n[0] == n[1] && n[1] == n[2]) return fmt::format("{}", n[0]);
      break;
    case PropertyType::kNumbers:
    case PropertyType::kIndices:
      return array_text(argument.list);
    default:
      break;
  }
  return array_text(std::span(n).first(most_numbers(row.type)));
}

}  // namespace

void SceneRecorder::begin_block(const KindRow& kind, std::string_view name) {
  Node node;
  node.kind = kind.name;
  node.is_value = kind.block_class == BlockClass::kMaterial && name.empty();
  node.is_texture = kind.block_class == BlockClass::kTexture;
  if (node.is_texture) {
    node.properties = fmt::format("\"texture\": {}", json_quoted(kind.variant));
    open_.push_back(std::move(node));
    return;
  }
  if (!name.empty()) node.name = unique(kind.name, name);
  if (!kind.variant.empty()) node.properties = fmt::format(", \"variant\": {}", json_quoted(kind.variant));
  open_.push_back(std::move(node));
}

void SceneRecorder::end_block() {
  Node node = std::move(open_.back());
  open_.pop_back();
  Node& parent = open_.back();
  if (node.is_texture) {
    texture_ = fmt::format("{{{}{}}}", node.properties, transforms_text(node));
  } else if (node.is_value) {
    const std::string_view properties = node.properties;
    parent.properties +=
        fmt::format(", \"material\": {{{}}}", properties.substr(std::min<std::size_t>(2, properties.size())));
  } else if (node.kind != "animation") {  // a moment has no duration
    parent.children.push_back(std::move(node));
  }
}

void SceneRecorder::end_in_front() {
  for (Node& node : open_.back().children) front_.push_back(std::move(node));
  open_.pop_back();
}

void SceneRecorder::add(const PropertyRow& property, const Argument& argument) {
  const std::string text = fmt::format("{}: {}", json_quoted(property.name), value_text(property, argument));
  Node& node = open_.back();
  if (property.is_repeatable) {  // a list of all
    const std::string begin = fmt::format(", {}: [", json_quoted(property.name));
    const bool goes_on = node.properties.ends_with("]]") && node.properties.rfind(begin) != std::string::npos;
    if (goes_on) node.properties.pop_back();
    node.properties += fmt::format("{}{}]", goes_on ? ", " : begin, value_text(property, argument));
  } else if (property.is_placing) {
    node.transforms += fmt::format(", {{{}}}", text);
  } else {
    node.properties += ", " + text;
  }
}

void SceneRecorder::add(const PropertyRow& property, std::string_view texture) {
  open_.back().properties += fmt::format(", {}: {}", json_quoted(property.name), texture);
}

void SceneRecorder::use_material(std::uint32_t index) {
  open_.back().properties += fmt::format(", \"material\": {}", json_quoted(materials_[index]));
}

void SceneRecorder::name_material(std::uint32_t index) { materials_[index] = open_.back().name; }

void SceneRecorder::define(const void* definition, std::string_view name) {
  Node node;
  node.definitions = std::make_shared<std::vector<Node>>();
  definitions_[definition] = {std::string(name), node.definitions, {}, {}};
  open_.back().children.push_back(std::move(node));
}

const std::string& SceneRecorder::name_of(const void* definition, const std::vector<Value>& arguments) {
  Definition& known = definitions_[definition];
  const auto [entry, is_new] = known.names.try_emplace(use_key(definition, arguments, 0));
  if (is_new) entry->second = unique("define", known.name);
  return entry->second;
}

void SceneRecorder::use(const void* definition, const std::vector<Value>& arguments) {
  open_.back().kind = name_of(definition, arguments);
}

void SceneRecorder::begin_body(const void* definition, const std::vector<Value>& arguments) {
  const std::string& name = name_of(definition, arguments);
  Definition& known = definitions_[definition];
  if (!known.begun.insert(name).second) {
    muted_ = true;
    return;
  }
  Node node;
  node.kind = "define";
  node.name = name;
  open_.push_back(std::move(node));
  bodies_.push_back(known.place);
}

void SceneRecorder::end_body() {
  if (muted_) {
    muted_ = false;
    return;
  }
  bodies_.back()->push_back(std::move(open_.back()));
  bodies_.pop_back();
  open_.pop_back();
}

// The name itself for the first one that wants it.
std::string SceneRecorder::unique(std::string_view kind, std::string_view name) {
  const auto key = [&](std::string_view wanted) { return fmt::format("{} {}", kind, wanted); };
  std::string result(name);
  std::size_t& number = numbers_.try_emplace(key(name), 1).first->second;
  while (!taken_.insert(key(result)).second) result = fmt::format("{}_{}", name, ++number);
  return result;
}

std::string SceneRecorder::transforms_text(const Node& node) {
  if (node.transforms.empty()) return {};
  return fmt::format(", \"transforms\": [{}]", node.transforms.substr(2));
}

std::string SceneRecorder::line_of(const Node& node) {
  std::string line = fmt::format("{{\"kind\": {}", json_quoted(node.kind));
  if (!node.name.empty()) line += fmt::format(", \"name\": {}", json_quoted(node.name));
  line += node.properties;
  return line + transforms_text(node);
}

void SceneRecorder::append(std::span<const Node> nodes, std::size_t level, bool& is_first, std::string& out) {
  const std::string indent(2 * level, ' ');
  for (const Node& node : nodes) {
    if (node.definitions != nullptr) {
      append(*node.definitions, level, is_first, out);
      continue;
    }
    out += (is_first ? "\n" : ",\n") + indent + line_of(node);
    is_first = false;
    bool has_none = true;
    std::string inside;
    append(node.children, level + 1, has_none, inside);
    if (!has_none) out += fmt::format(", \"children\": [{}\n{}]", inside, indent);
    out += '}';
  }
}

std::string SceneRecorder::text() const {
  std::string out = "{\"raytracer\": 1, \"blocks\": [";
  bool is_first = true;
  append(front_, 1, is_first, out);
  append(open_.front().children, 1, is_first, out);
  return out + "\n]}\n";
}

}  // namespace raytracer::scene_file
