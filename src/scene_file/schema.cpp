#include "scene_file/schema.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <unordered_map>
#include <vector>

#include "scene_file/kinds.hpp"

namespace raytracer::scene_file {
namespace {

// What the builder reads itself, whatever the kind: these rows have no struct to store into.
constexpr PropertyRow common(std::string_view name, PropertyType type, std::string_view unit,
                             std::string_view help, std::string_view default_text) {
  PropertyRow row;
  row.name = name;
  row.type = type;
  row.unit = unit;
  row.help = help;
  row.default_text = default_text;
  row.is_placing = type != PropertyType::kMaterial;
  return row;
}

constexpr PropertyRow kTransformRows[] = {
    common("translate", PropertyType::kVector, "scene units", "Moves it.", "0 0 0"),
    common("rotate", PropertyType::kVector, "degrees",
           "Turns it on the spot about x, then y, then z, counter-clockwise seen from the tip of the axis.",
           "0 0 0"),
    common("rotate_axis", PropertyType::kAxisAngle, "degrees",
           "Turns it on the spot about the axis x y z by an angle.", "0 1 0 0"),
    common("scale", PropertyType::kSize, "", "Grows it on the spot; negative mirrors.", "1"),
    common("pivot", PropertyType::kVector, "scene units",
           "The spot to turn and grow about, in place of its own middle.", "its middle"),
    common("matrix", PropertyType::kMatrix, "",
           "In place of all these: three rows of four numbers, applied to columns.",
           "1 0 0 0  0 1 0 0  0 0 1 0"),
};

constexpr PropertyRow kMaterialRow =
    common("material", PropertyType::kMaterial, "", "What the surface is made of: a name or { … }.",
           "that of the group, else white 0.8");

}  // namespace

std::span<const KindRow> all_kinds() {
  static const std::vector<KindRow> rows = [] {
    std::vector<KindRow> all;
    for (const std::span<const KindRow> table :
         {setting_kinds(), sky_kinds(), light_kinds(), material_kinds(), texture_kinds(), group_kinds(),
          shape_kinds(), mesh_kinds()}) {
      all.insert(all.end(), table.begin(), table.end());
    }
    return all;
  }();
  return rows;
}

std::span<const PropertyRow> transform_properties() { return kTransformRows; }
const PropertyRow& material_property() { return kMaterialRow; }

namespace {

// The kinds by their names. It is asked for every word of a scene, most of which are none: that is mostly
// known by first letter and length.
class KindIndex {
 public:
  KindIndex() {
    for (const KindRow& row : all_kinds()) {
      by_name_[row.name].push_back(&row);
      lengths_[letter(row.name)] |= bit(row.name);
    }
  }

  // One, or its variants.
  std::span<const KindRow* const> named(std::string_view name) const {
    if (name.empty() || (lengths_[letter(name)] & bit(name)) == 0) return {};
    const auto found = by_name_.find(name);
    if (found == by_name_.end()) return {};
    return found->second;
  }

 private:
  static std::size_t letter(std::string_view name) { return static_cast<unsigned char>(name.front()); }
  static std::uint64_t bit(std::string_view name) { return std::uint64_t{1} << (name.size() % 64); }

  std::unordered_map<std::string_view, std::vector<const KindRow*>> by_name_;
  std::array<std::uint64_t, 256> lengths_{};  // bit i: there is a name of that letter of i (mod 64) letters
};

std::span<const KindRow* const> kinds_named(std::string_view name) {
  static const KindIndex index;
  return index.named(name);
}

}  // namespace

const KindRow* find_kind(std::string_view name, std::string_view variant) {
  for (const KindRow* row : kinds_named(name)) {
    if (row->variant == variant) return row;
  }
  return nullptr;
}

bool may_have_variant(std::string_view kind) {
  return std::ranges::any_of(kinds_named(kind), [](const KindRow* row) { return !row->variant.empty(); });
}

std::string called(const KindRow& kind) {
  if (kind.variant.empty()) return std::string(kind.name);
  return kind.block_class == BlockClass::kTexture ? std::string(kind.variant)
                                                  : fmt::format("{} {}", kind.name, kind.variant);
}

const PropertyRow* find_property(const KindRow& kind, std::string_view name) {
  const auto find_in = [&](std::span<const PropertyRow> rows) -> const PropertyRow* {
    const auto row = std::ranges::find(rows, name, &PropertyRow::name);
    return row == rows.end() ? nullptr : &*row;
  };
  if (const PropertyRow* row = find_in(kind.properties)) return row;
  if (kind.takes_material && name == kMaterialRow.name) return &kMaterialRow;
  return kind.placing == Placing::kNone ? nullptr : find_in(kTransformRows);
}

const PropertyRow* find_file_property(const KindRow& kind) {
  const auto row = std::ranges::find(kind.properties, PropertyType::kFile, &PropertyRow::type);
  return row == kind.properties.end() ? nullptr : &*row;
}

const KindRow* find_texture_kind(std::string_view name) { return find_kind(kTextureKind, name); }

bool is_property_of(std::string_view kind, std::string_view property) {
  // Of a definition nobody knows the parameters here, but it is placed and made of a material as a group is.
  if (!kind.empty() && kinds_named(kind).empty()) kind = "group";
  return std::ranges::any_of(kinds_named(kind),
                             [&](const KindRow* row) { return find_property(*row, property) != nullptr; });
}

std::string describe_type(const PropertyRow& row) {
  if (row.is_texture_only) return "a texture";
  switch (row.type) {
    case PropertyType::kNumber:
      return "a number";
    case PropertyType::kInteger:
      return "a whole number";
    case PropertyType::kBoolean:
      return "true or false";
    case PropertyType::kString:
      return "a string";
    case PropertyType::kFile:
      return "the name of a file";
    case PropertyType::kVector:
      return "three numbers";
    case PropertyType::kSize:
      return "one number or three";
    case PropertyType::kPixels:
      return "two whole numbers";
    case PropertyType::kPair:
      return "two numbers";
    case PropertyType::kColor:
      return "a colour";
    case PropertyType::kName:
      return "a name";
    case PropertyType::kStop:
      return "a number and a colour";
    case PropertyType::kWord:
      return row.words.size() == 1 ? std::string(row.words[0])
                                   : fmt::format("one of {}", fmt::join(row.words, ", "));
    case PropertyType::kMaterial:
      return "a material";
    case PropertyType::kAxisAngle:
      return "an axis x y z and an angle";
    case PropertyType::kMatrix:
      return "twelve numbers";
    case PropertyType::kNumbers:
      return "numbers";
    case PropertyType::kIndices:
      return "whole numbers";
  }
  return {};
}

std::string example_value(const PropertyRow& row) {
  if (row.is_texture_only) return "noise { }";
  switch (row.type) {
    case PropertyType::kNumber:
    case PropertyType::kInteger:
      return detail::number_text(std::clamp(1.0, row.range.least, row.range.most));
    case PropertyType::kBoolean:
      return "true";
    case PropertyType::kString:
      return "\"text\"";
    case PropertyType::kFile:
      return "\"file\"";
    case PropertyType::kNumbers:
      return "0 0 0  1 0 0  0 1 0";
    case PropertyType::kIndices:
      return "0 1 2  0 2 3";
    case PropertyType::kVector:
      return "0 1 0";
    case PropertyType::kSize:
      return "1";
    case PropertyType::kPixels:
      return "960 540";
    case PropertyType::kPair:
      return "2 2";
    case PropertyType::kName:
      return "ball";
    case PropertyType::kStop:
      return "0.5 red";
    case PropertyType::kColor:
      return "0.9 0.4 0.1";
    case PropertyType::kWord:
      return std::string(row.words.front());
    case PropertyType::kMaterial:
      return "{ color red }";
    case PropertyType::kAxisAngle:
      return "0 1 0 45";
    case PropertyType::kMatrix:
      return "1 0 0 0  0 1 0 0  0 0 1 0";
  }
  return {};
}

std::string describe_range(const Range& range, double value) {
  const bool has_least = range.least > kAnyNumber.least;
  const bool has_most = range.most < kAnyNumber.most;
  const std::string least = detail::number_text(range.least);
  const std::string most = detail::number_text(range.most);
  if (has_least && has_most) {
    return range.above_least ? fmt::format("above {} and at most {}", least, most)
                             : fmt::format("between {} and {}", least, most);
  }
  if (has_least && value > range.most) return fmt::format("at most {}", most);
  if (has_least) return range.above_least ? "greater than " + least : "at least " + least;
  if (has_most) return "at most " + most;
  return fmt::format("within {}", most);
}

std::string describe_default(const KindRow& kind, const PropertyRow& row) {
  if (row.required) return {};
  if (!row.default_text.empty() || row.default_value == nullptr) return std::string(row.default_text);
  return kind.default_of(row);
}

std::string detail::number_text(double value) { return fmt::format("{}", value); }

}  // namespace raytracer::scene_file
