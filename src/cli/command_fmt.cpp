// `raytracer fmt`: scene text in canonical form.
#include <algorithm>

#include "cli/commands.hpp"
#include "cli/output.hpp"
#include "core/printable.hpp"
#include "raytracer/error.hpp"
#include "raytracer/image.hpp"
#include "scene_file/files.hpp"
#include "scene_file/formatter.hpp"
#include "scene_file/json_scene.hpp"

namespace raytracer::cli {
namespace {

// Returns the exit code for one file.
int format_file(const std::string& path, const Options& options) {
  const std::string text = scene_file::read_text(path);
  if (scene_file::is_json(path, text)) {
    throw Error(ErrorKind::kUsage, printable(path) + " is JSON; fmt is for the text form of scenes");
  }
  const scene_file::FormattedText formatted =
      scene_file::format_text(text, path == "-" ? "<standard input>" : path);
  for (const Diagnostic& diagnostic : formatted.diagnostics) warn(to_text(diagnostic) + '\n');
  if (!formatted.diagnostics.empty()) return static_cast<int>(ErrorKind::kScene);
  if (options.checks_form) {
    if (formatted.text == text) return 0;
    say(printable(path) + '\n');
    return static_cast<int>(ErrorKind::kScene);
  }
  if (!options.in_place) {
    say(formatted.text);
  } else if (formatted.text != text) {
    write_file(path, {formatted.text.begin(), formatted.text.end()});
  }
  return 0;
}

}  // namespace

int run_fmt(const Options& options) {
  if (options.operands.empty()) throw Error(ErrorKind::kUsage, "which scene? Try: raytracer fmt scene.txt");
  if (options.checks_form && options.in_place) {
    throw Error(ErrorKind::kUsage, "--check changes nothing, and --in-place does: say one of them");
  }
  int worst = 0;
  for (const std::string& path : options.operands) {
    if (options.in_place && path == "-")
      throw Error(ErrorKind::kUsage, "standard input is no file to change in place");
    worst = std::max(worst, format_file(path, options));
  }
  return worst;
}

}  // namespace raytracer::cli
