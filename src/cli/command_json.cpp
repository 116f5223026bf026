// `raytracer json`: one moment of a scene for programs to read.
#include "cli/commands.hpp"
#include "cli/output.hpp"
#include "cli/target.hpp"
#include "cli/kept_files.hpp"
#include "raytracer/error.hpp"
#include "raytracer/image.hpp"

namespace raytracer::cli {

int run_json(const Options& options) {
  const LoadedScene scene = load_and_report(options);
  if (!scene.ok()) return static_cast<int>(ErrorKind::kScene);
  const std::string text = scene.json_at(options.time_at.value_or(0));
  if (options.output.empty() || options.output == "-") {
    say(text);
  } else {
    check_output(options.output, KeptFiles::of(scene));
    write_file(options.output, {text.begin(), text.end()});
  }
  return 0;
}

}  // namespace raytracer::cli
