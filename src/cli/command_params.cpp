// `raytracer params`: what --set can change in a scene.
#include <fmt/format.h>

#include "cli/commands.hpp"
#include "cli/output.hpp"
#include "core/printable.hpp"
#include "raytracer/error.hpp"

namespace raytracer::cli {

int run_params(const Options& options) {
  const LoadedScene scene = load_and_report(options);
  if (!scene.ok()) return static_cast<int>(ErrorKind::kScene);
  std::string lines;
  for (const Parameter& parameter : scene.parameters) {
    lines += printable(fmt::format("{} = {}\n", parameter.name, parameter.value));
  }
  say(lines);
  return 0;
}

}  // namespace raytracer::cli
