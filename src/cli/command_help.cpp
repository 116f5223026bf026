// `raytracer help`: the scene language from its tables.
#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "cli/commands.hpp"
#include "cli/output.hpp"
#include "cli/reference.hpp"
#include "core/suggest.hpp"
#include "raytracer/error.hpp"
#include "scene_file/material_library.hpp"
#include "scene_file/word_help.hpp"

namespace raytracer::cli {
namespace {

using scene_file::FunctionRow;
using scene_file::KindRow;
using scene_file::LibraryMaterial;
using scene_file::PropertyRow;
using scene_file::WordRow;

constexpr std::string_view kFunctionsTopic = "functions";
constexpr std::string_view kMaterialsTopic = "materials";

std::string list_line(std::string_view title, std::string_view help) {
  return fmt::format("  {:<18}  {}\n", title, help);
}

std::string list_of_words() {
  std::string out = "The blocks of a scene. 'raytracer help sphere' explains one.\n\n";
  for (const KindRow& kind : scene_file::all_kinds()) out += list_line(title_of(kind), kind.help);
  out += "\nAround them:\n\n";
  for (const WordRow& row : scene_file::all_statements()) out += list_line(row.name, row.help);
  out += list_line(kMaterialsTopic, "Materials that every scene may name: glass, gold, …");
  return out + list_line(kFunctionsTopic, "What can be computed with: sin, mix, random, …");
}

std::string property_text(const KindRow& kind, const PropertyRow& row) {
  const std::string otherwise = scene_file::describe_default(kind, row);
  return fmt::format("  {:<13} {}\n  {:<13} {}{}\n", row.name, row.help, "", value_of(row),
                     row.required        ? "; must be given"
                     : otherwise.empty() ? ""
                                         : fmt::format("; default {}", otherwise));
}

std::string kind_text(const KindRow& kind) {
  std::string out = fmt::format("{}: {}\n\n", title_of(kind), kind.help);
  for (const PropertyRow& row : kind.properties) out += property_text(kind, row);
  if (kind.takes_material) out += property_text(kind, scene_file::material_property());
  if (kind.placing == scene_file::Placing::kNone) return out;
  out += "\n  Where it stands, all in the order written:\n";
  for (const PropertyRow& row : scene_file::transform_properties()) {
    if (can_be_placed_by(kind, row)) out += property_text(kind, row);
  }
  return out;
}

// A kind with all its variants, or the one named; empty where there is none.
std::string kinds_text(std::string_view name, std::string_view variant) {
  std::string out;
  for (const KindRow& kind : scene_file::all_kinds()) {
    if (kind.name != name || (!variant.empty() && kind.variant != variant)) continue;
    if (!out.empty()) out += '\n';
    out += kind_text(kind);
  }
  return out;
}

std::string word_text(const WordRow& row) {
  std::string out = fmt::format("{}: {}\n", row.name, row.help);
  if (row.form != row.name) out += fmt::format("\n  {}\n", row.form);
  if (!row.more.empty()) out += fmt::format("\n{}\n", row.more);
  if (row.example.empty()) return out;
  out += "\nFor example:\n\n";
  for (std::string_view rest = row.example; !rest.empty();) {
    const std::string_view line = rest.substr(0, rest.find('\n') + 1);
    out += fmt::format("  {}", line);
    rest.remove_prefix(line.size());
  }
  return out;
}

std::string functions_text() {
  std::string out = fmt::format(
      "{}: They stand in expressions, as in 'radius (0.5 + 0.1 * sin(90 * t))'.\n\n", kFunctionsTopic);
  for (const FunctionRow& row : scene_file::all_functions()) out += list_line(call_of(row), row.help);
  for (const WordRow& row : scene_file::all_constants()) out += list_line(row.name, row.help);
  return out + "\nOperators: + - * / % ^   < <= > >= == !=   and or not   a ? b : c   v.x v.y v.z\n";
}

std::string materials_text() {
  std::string out = fmt::format(
      "{}: Every scene may name them, as in 'sphere {{ material glass }}'. One of the same name that the "
      "scene\n"
      "defines takes its place. 'raytracer help glass' shows what one is made of.\n\n",
      kMaterialsTopic);
  for (const LibraryMaterial& row : scene_file::material_library()) out += list_line(row.name, row.help);
  return out;
}

std::string material_text(const LibraryMaterial& row) {
  return fmt::format("{0}: {1}\n\n  material {0} {{ {2} }}\n", row.name, row.help, row.text);
}

// Of a word other than a block; empty where it is none of the language.
std::string other_text(std::string_view word) {
  if (word == kFunctionsTopic) return functions_text();
  if (word == kMaterialsTopic) return materials_text();
  for (const auto& rows : {scene_file::all_statements(), scene_file::all_constants()}) {
    const auto row = std::ranges::find(rows, word, &WordRow::name);
    if (row != rows.end()) return word_text(*row);
  }
  if (const FunctionRow* function = scene_file::find_function(word))
    return fmt::format("{}: {}\n", call_of(*function), function->help);
  const LibraryMaterial* material = scene_file::find_library_material(word);
  if (material != nullptr) return material_text(*material);
  // A variant by its own word: checker, a texture.
  const auto kind = std::ranges::find(scene_file::all_kinds(), word, &KindRow::variant);
  return kind == scene_file::all_kinds().end() || word.empty() ? std::string()
                                                               : kinds_text(kind->name, kind->variant);
}

[[noreturn]] void unknown_word(const std::string& message, std::string_view word,
                               const std::vector<std::string_view>& known, std::string_view otherwise) {
  const std::string_view nearest = nearest_word(word, known);
  throw Error(ErrorKind::kUsage, fmt::format("{}; {}", message,
                                             nearest.empty() ? std::string(otherwise)
                                                             : fmt::format("did you mean '{}'?", nearest)));
}

std::string topic_text(const std::string& topic) {
  std::string text = kinds_text(topic, {});
  if (text.empty()) text = other_text(topic);
  if (text.empty()) {
    unknown_word(fmt::format("the scene language has no word '{}'", topic), topic, help_topics(),
                 "'raytracer help' lists them");
  }
  return text;
}

std::string variant_text(const std::string& name, const std::string& variant) {
  topic_text(name);  // tells of a wrong first word first
  std::string text = kinds_text(name, variant);
  if (!text.empty()) return text;
  std::vector<std::string_view> variants;
  for (const KindRow& kind : scene_file::all_kinds()) {
    if (kind.name == name && !kind.variant.empty()) variants.push_back(kind.variant);
  }
  unknown_word(fmt::format("there is no '{} {}'", name, variant), variant, variants,
               fmt::format("'raytracer help {}' tells what there is", name));
}

}  // namespace

std::vector<std::string_view> help_topics() {
  std::vector<std::string_view> words;
  for (const KindRow& row : scene_file::all_kinds()) {
    if (row.variant.empty()) words.push_back(row.name);
  }
  for (const WordRow& row : scene_file::all_statements()) words.push_back(row.name);
  words.push_back(kMaterialsTopic);
  words.push_back(kFunctionsTopic);
  for (const FunctionRow& row : scene_file::all_functions()) words.push_back(row.name);
  for (const WordRow& row : scene_file::all_constants()) words.push_back(row.name);
  for (const LibraryMaterial& row : scene_file::material_library()) words.push_back(row.name);
  return words;
}

int run_help(const Options& options) {
  const std::vector<std::string>& topics = options.operands;
  say(options.wants_man_page             ? man_page()
      : options.wants_markdown           ? markdown_reference()
      : !options.completions_for.empty() ? completions(options.completions_for)
      : topics.empty()                   ? list_of_words()
      : topics.size() == 1               ? topic_text(topics[0])
                                         : variant_text(topics[0], topics[1]));
  return 0;
}

}  // namespace raytracer::cli
