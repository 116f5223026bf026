#include "cli/reference.hpp"

#include <fmt/format.h>

#include "scene_file/limits.hpp"
#include "scene_file/material_library.hpp"
#include "scene_file/word_help.hpp"

namespace raytracer::cli {
namespace {

using scene_file::KindRow;
using scene_file::Placing;
using scene_file::PropertyRow;

// Text for a cell of a table.
std::string cell(std::string_view text) {
  std::string out;
  for (const char c : text) {
    if (c == '|' || c == '*' || c == '_') out += '\\';
    out += c;
  }
  return out;
}

std::string property_line(const PropertyRow& row, const std::string& otherwise) {
  return fmt::format("| `{}` | {} | {} | {} |\n", row.name, cell(value_of(row)), cell(otherwise),
                     cell(row.help));
}

constexpr std::string_view kPropertyHead = "| property | takes | default | |\n| --- | --- | --- | --- |\n";

std::string kind_section(const KindRow& kind) {
  std::string out = fmt::format("### {}\n\n{}", title_of(kind), kind.help);
  if (kind.takes_material) out += " Takes a [material](#properties-of-many-blocks).";
  if (kind.placing != Placing::kNone) {
    out += fmt::format(" [Transforms](#properties-of-many-blocks){} place it.",
                       kind.placing == Placing::kRigid ? " other than `scale`" : "");
  }
  out += '\n';
  if (!kind.properties.empty()) out += fmt::format("\n{}", kPropertyHead);
  for (const PropertyRow& row : kind.properties) {
    out += property_line(row, row.required ? "must be given" : scene_file::describe_default(kind, row));
  }
  return out + '\n';
}

std::string common_section() {
  std::string out = fmt::format("### Properties of many blocks\n\n{}", kPropertyHead);
  const PropertyRow& material = scene_file::material_property();
  out += property_line(material, std::string(material.default_text));
  for (const PropertyRow& row : scene_file::transform_properties()) {
    out += property_line(row, std::string(row.default_text));
  }
  return out + '\n';
}

std::string word_table(std::span<const scene_file::WordRow> words) {
  std::string out;
  for (const scene_file::WordRow& row : words) {
    out += fmt::format("| `{}` | {}{}{} |\n", row.form, cell(row.help), row.more.empty() ? "" : " ",
                       cell(row.more));
  }
  return out;
}

}  // namespace

std::string title_of(const KindRow& kind) {
  return fmt::format("{}{}{}", kind.name, kind.variant.empty() ? "" : " ", kind.variant);
}

std::string call_of(const scene_file::FunctionRow& function) {
  return fmt::format("{}({})", function.name, function.parameters);
}

std::string value_of(const PropertyRow& row) {
  std::string words = scene_file::describe_type(row);
  if (row.store_texture != nullptr && !row.is_texture_only) words += " or a texture";
  if (!row.unit.empty()) words += fmt::format(" ({})", row.unit);
  // What can't be reached by anybody's numbers needs no words.
  const bool is_limited = row.range.least != scene_file::kAnyNumber.least || row.range.most < 1e12;
  if (is_limited) words += fmt::format(", {}", scene_file::describe_range(row.range));
  return words;
}

bool can_be_placed_by(const KindRow& kind, const PropertyRow& transform) {
  return kind.placing == Placing::kAffine || (kind.placing == Placing::kRigid && transform.name != "scale");
}

std::string markdown_reference() {
  std::string out;
  for (const KindRow& kind : scene_file::all_kinds()) out += kind_section(kind);
  out += common_section();
  out += "### Statements\n\n| | |\n| --- | --- |\n" + word_table(scene_file::all_statements());
  out += "\n### Functions\n\n| | |\n| --- | --- |\n";
  for (const scene_file::FunctionRow& row : scene_file::all_functions()) {
    out += fmt::format("| `{}` | {} |\n", call_of(row), cell(row.help));
  }
  out += word_table(scene_file::all_constants());
  out += "\n### Materials to name\n\n| `material` | | what it is made of |\n| --- | --- | --- |\n";
  for (const scene_file::LibraryMaterial& row : scene_file::material_library()) {
    out += fmt::format("| `{}` | {} | `{}` |\n", row.name, cell(row.help), row.text);
  }
  out += "\n### Limits\n\n| `--limit` | default | of |\n| --- | --- | --- |\n";
  for (const scene_file::LimitRow& row : scene_file::all_limits()) {
    out += fmt::format("| `{}` | {} | {} |\n", row.name, Limits{}.*row.field, cell(row.help));
  }
  return out;
}

}  // namespace raytracer::cli
