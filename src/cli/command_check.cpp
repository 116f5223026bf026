#include "cli/commands.hpp"
#include "cli/output.hpp"
#include "raytracer/error.hpp"

namespace raytracer::cli {

LoadedScene load_and_report(const Options& options) {
  if (options.operands.empty()) {
    throw Error(ErrorKind::kUsage, "which scene? Try: raytracer scene.txt -o out.png");
  }
  LoadedScene scene = load_scene_file(options.operands[0], options.load);
  for (const Diagnostic& diagnostic : scene.diagnostics) {
    if (options.json) {
      say(to_json(diagnostic) + '\n');
    } else {
      warn(to_text(diagnostic) + '\n');
    }
  }
  return scene;
}

int run_check(const Options& options) {
  return load_and_report(options).ok() ? 0 : static_cast<int>(ErrorKind::kScene);
}

}  // namespace raytracer::cli
