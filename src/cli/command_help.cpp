// `raytracer help`: the scene language from its tables.
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <vector>

#include "cli/commands.hpp"
#include "core/suggest.hpp"
#include "raytracer/error.hpp"
#include "scene_file/schema.hpp"

namespace raytracer::cli {
namespace {

using scene_file::KindRow;
using scene_file::PropertyRow;

void print_kinds() {
  fmt::print("The blocks of a scene. 'raytracer help sphere' explains one.\n\n");
  for (const KindRow& kind : scene_file::all_kinds()) {
    fmt::print("  {:<18}  {}\n", fmt::format("{}{}{}", kind.name, kind.variant.empty() ? "" : " ", kind.variant),
               kind.help);
  }
  fmt::print("  {:<18}  {}\n", "include \"file\"", "Stands for the blocks of another file.");
}

void print_property(const KindRow& kind, const PropertyRow& row) {
  std::string facts = scene_file::describe_type(row);
  if (!row.unit.empty()) facts += fmt::format(" ({})", row.unit);
  const bool limited = row.range.least != scene_file::kAnyNumber.least || row.range.most < 1e12;
  if (limited) facts += fmt::format(", {}", scene_file::describe_range(row.range));
  const std::string otherwise = scene_file::describe_default(kind, row);
  facts += row.required ? "; must be given" : otherwise.empty() ? "" : fmt::format("; default {}", otherwise);
  fmt::print("  {:<13} {}\n  {:<13} {}\n", row.name, row.help, "", facts);
}

void print_kind(const KindRow& kind) {
  fmt::print("{}{}{}: {}\n\n", kind.name, kind.variant.empty() ? "" : " ", kind.variant, kind.help);
  for (const PropertyRow& row : kind.properties) print_property(kind, row);
  if (kind.takes_material) print_property(kind, scene_file::material_property());
  if (kind.placing == scene_file::Placing::kNone) return;
  fmt::print("\n  Where it stands, all in the order written:\n");
  for (const PropertyRow& row : scene_file::transform_properties()) {
    const bool means_nothing = kind.placing == scene_file::Placing::kRigid && row.name == "scale";
    if (!means_nothing) print_property(kind, row);
  }
}

int print_topic(const std::string& topic) {
  std::vector<std::string_view> names;
  bool found = false;
  for (const KindRow& kind : scene_file::all_kinds()) {
    names.push_back(kind.name);
    if (kind.name != topic) continue;
    if (found) fmt::print("\n");
    print_kind(kind);
    found = true;
  }
  if (found) return 0;
  const std::string_view nearest = nearest_word(topic, names);
  throw Error(ErrorKind::kUsage, fmt::format("there is no kind of block '{}'{}", topic,
                                             nearest.empty() ? "; 'raytracer help' lists all"
                                                             : fmt::format("; did you mean '{}'?", nearest)));
}

}  // namespace

int run_help(const Options& options) {
  if (options.wants_man_page) {
    fmt::print("{}", man_page());
  } else if (!options.completions_for.empty()) {
    fmt::print("{}", completions(options.completions_for));
  } else if (options.operands.empty()) {
    print_kinds();
  } else {
    return print_topic(options.operands[0]);
  }
  return 0;
}

}  // namespace raytracer::cli
