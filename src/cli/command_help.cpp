// `raytracer help`: the scene language from its tables.
#include <fmt/format.h>

#include <algorithm>
#include <span>
#include <utility>
#include <vector>

#include "cli/commands.hpp"
#include "cli/output.hpp"
#include "cli/reference.hpp"
#include "core/suggest.hpp"
#include "raytracer/error.hpp"
#include "scene_file/limits.hpp"
#include "scene_file/material_library.hpp"
#include "scene_file/word_help.hpp"

namespace raytracer::cli {
namespace {

using scene_file::FunctionRow;
using scene_file::KindRow;
using scene_file::LibraryMaterial;
using scene_file::PropertyRow;
using scene_file::WordRow;

std::string list_line(std::string_view title, std::string_view help) {
  return fmt::format("  {:<18}  {}\n", title, help);
}

// A word that stands for a list of others.
struct TopicRow {
  std::string_view name, help;
  std::string (*text)();
};
std::span<const TopicRow> all_topics();

std::string list_of_words() {
  std::string out = "The blocks of a scene. 'raytracer help sphere' explains one.\n\n";
  for (const KindRow& kind : scene_file::all_kinds()) out += list_line(title_of(kind), kind.help);
  out += "\nAround them:\n\n";
  for (const WordRow& row : scene_file::all_statements()) out += list_line(row.name, row.help);
  for (const TopicRow& row : all_topics()) out += list_line(row.name, row.help);
  return out;
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
  return out;
}

// What places these kinds, said once for all of them.
std::string placing_text(const std::vector<const KindRow*>& kinds) {
  std::string out;
  const auto placed = std::ranges::count_if(
      kinds, [](const KindRow* kind) { return kind->placing != scene_file::Placing::kNone; });
  for (const PropertyRow& row : scene_file::transform_properties()) {
    std::vector<std::string> names;
    for (const KindRow* kind : kinds) {
      if (can_be_placed_by(*kind, row)) names.push_back(title_of(*kind));
    }
    if (names.empty()) continue;
    out += property_text(*kinds.front(), row);
    if (std::ssize(names) < placed) out += fmt::format("  {:<13} of {} alone\n", "", fmt::join(names, ", "));
  }
  return out.empty() ? out : "\n  Where it stands, all in the order written:\n" + out;
}

// A kind with all its variants, or the one named; empty where there is none.
std::string kinds_text(std::string_view name, std::string_view variant) {
  std::vector<const KindRow*> kinds;
  std::string out;
  for (const KindRow& kind : scene_file::all_kinds()) {
    if (kind.name != name || (!variant.empty() && kind.variant != variant)) continue;
    out += (kinds.empty() ? "" : "\n") + kind_text(kind);
    kinds.push_back(&kind);
  }
  return kinds.empty() ? out : out + placing_text(kinds);
}

// The kinds whose property it is, those with the same words for it in one place; empty where none has it.
std::string property_of_kinds_text(std::string_view name) {
  std::vector<std::pair<std::string, std::vector<std::string>>> rows;  // a row, and the kinds that have it
  for (const KindRow& kind : scene_file::all_kinds()) {
    const PropertyRow* row = scene_file::find_property(kind, name);
    if (row == nullptr) continue;
    const std::string text = property_text(kind, *row);
    auto known = std::ranges::find(rows, text, &decltype(rows)::value_type::first);
    if (known == rows.end()) known = rows.insert(rows.end(), {text, {}});
    known->second.push_back(title_of(kind));
  }
  const bool places = std::ranges::find(scene_file::transform_properties(), name, &PropertyRow::name) !=
                      scene_file::transform_properties().end();
  if (places) rows.front().second = {"all that has a place"};
  std::string out;
  for (const auto& [text, kinds] : rows) {
    out += fmt::format("{}{}, a property of {}:\n\n{}", out.empty() ? "" : "\n", name, fmt::join(kinds, ", "),
                       text);
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
  std::string out = "functions: They stand in expressions, as in 'radius (0.5 + 0.1 * sin(90 * t))'.\n\n";
  for (const FunctionRow& row : scene_file::all_functions()) out += list_line(call_of(row), row.help);
  for (const WordRow& row : scene_file::all_constants()) out += list_line(row.name, row.help);
  return out + "\nOperators: + - * / % ^   < <= > >= == !=   and or not   a ? b : c   v.x v.y v.z\n";
}

std::string materials_text() {
  std::string out =
      "materials: Every scene may name them, as in 'sphere { material glass }'. One of the same name that "
      "the "
      "scene\n"
      "defines takes its place. 'raytracer help glass' shows what one is made of.\n\n";
  for (const LibraryMaterial& row : scene_file::material_library()) out += list_line(row.name, row.help);
  return out;
}

std::string textures_text() {
  std::string out =
      "textures: They stand in place of a colour or a number of a material, as in 'color checker { }'.\n"
      "'raytracer help checker' explains one.\n\n";
  for (const KindRow& kind : scene_file::all_kinds()) {
    if (kind.name == scene_file::kTextureKind) out += list_line(kind.variant, kind.help);
  }
  return out;
}

std::string limits_text() {
  std::string out =
      "limits: How much a scene may ask for, as in 'raytracer scene.txt --limit nesting=1000'.\n\n";
  for (const scene_file::LimitRow& row : scene_file::all_limits()) {
    out += list_line(row.name, fmt::format("At most {} {}.", Limits{}.*row.field, row.help));
  }
  return out;
}

constexpr TopicRow kTopics[] = {
    {"materials", "Materials that every scene may name: glass, gold, …", materials_text},
    {"textures", "What a colour or a number of a material may be in place of one value.", textures_text},
    {"functions", "What can be computed with: sin, mix, random, …", functions_text},
    {"limits", "How much a scene may ask for, and how it gets more.", limits_text},
};
std::span<const TopicRow> all_topics() { return kTopics; }

std::string material_text(const LibraryMaterial& row) {
  return fmt::format("{0}: {1}\n\n  material {0} {{ {2} }}\n", row.name, row.help, row.text);
}

// Of a word other than a block; empty where it is none of the language.
std::string other_text(std::string_view word) {
  for (const TopicRow& topic : all_topics()) {
    if (topic.name == word) return topic.text();
  }
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
  if (kind != scene_file::all_kinds().end() && !word.empty()) return kinds_text(kind->name, kind->variant);
  return property_of_kinds_text(word);
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
    std::vector<std::string_view> known = help_topics();
    for (const KindRow& kind : scene_file::all_kinds()) {
      if (!kind.variant.empty()) known.push_back(kind.variant);
      for (const PropertyRow& row : kind.properties) known.push_back(row.name);
    }
    for (const PropertyRow& row : scene_file::transform_properties()) known.push_back(row.name);
    unknown_word(fmt::format("the scene language has no word '{}'", topic), topic, known,
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
  for (const TopicRow& row : all_topics()) words.push_back(row.name);
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
