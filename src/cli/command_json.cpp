// `raytracer json`: one moment of a scene for programs to read.
#include <filesystem>

#include "cli/commands.hpp"
#include "cli/kept_files.hpp"
#include "cli/output.hpp"
#include "raytracer/error.hpp"
#include "raytracer/image.hpp"

namespace raytracer::cli {

int run_json(const Options& options) {
  const LoadedScene scene = load_and_report(options);
  if (!scene.ok()) return static_cast<int>(ErrorKind::kScene);
  const bool is_stream = options.output.empty() || options.output == "-";
  std::string folder;  // of the file that is written: its texts are read from there
  if (!is_stream) folder = std::filesystem::path(options.output).parent_path().string();
  if (!is_stream && folder.empty()) folder = ".";
  const std::string text = scene.json_at(options.time_at.value_or(0), folder);
  if (is_stream) {
    say(text);
  } else {
    check_output(options.output, KeptFiles::of(scene));
    write_file(options.output, {text.begin(), text.end()});
  }
  return 0;
}

}  // namespace raytracer::cli
