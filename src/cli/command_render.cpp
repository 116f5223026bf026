#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>

#include "cli/commands.hpp"
#include "cli/interrupt.hpp"
#include "cli/progress_bar.hpp"
#include "image/write_file.hpp"
#include "raytracer/error.hpp"
#include "raytracer/image.hpp"

namespace raytracer::cli {
namespace {

namespace fs = std::filesystem;

struct PictureFormat {
  std::string_view ending;
  std::vector<std::uint8_t> (*encode)(const Image& image);
};
constexpr PictureFormat kFormats[] = {{".png", encode_png}, {".pfm", encode_pfm}};

// The format that a file's name asks for; PNG where it has no ending.
const PictureFormat& format_of(const std::string& path) {
  std::string ending = fs::path(path).extension().string();
  std::ranges::transform(ending, ending.begin(), [](char c) { return c >= 'A' && c <= 'Z' ? char(c + 32) : c; });
  if (ending.empty()) return kFormats[0];
  std::string known;
  for (const PictureFormat& format : kFormats) {
    if (format.ending == ending) return format;
    known += fmt::format("{}{}", known.empty() ? "" : " and ", format.ending);
  }
  throw Error(ErrorKind::kUsage, fmt::format("'{}': pictures are written as {}", path, known));
}

std::string output_path(const Options& options) {
  if (!options.output.empty()) return options.output;
  const std::string& scene = options.operands.empty() ? std::string("-") : options.operands[0];
  if (scene == "-") throw Error(ErrorKind::kUsage, "a scene from standard input has no name: say -o out.png");
  return fs::path(scene).stem().string() + ".png";
}

// Everything that can be known to go wrong with the picture's place is told before a ray is shot.
void check_output(const std::string& path, const std::vector<std::string>& files_read) {
  if (path == "-") {
    if (::isatty(STDOUT_FILENO) != 0) {
      throw Error(ErrorKind::kUsage, "standard output is a terminal, and a picture is no text: say -o out.png");
    }
    return;
  }
  check_writable(path);
  for (const std::string& read : files_read) {
    std::error_code none;
    if (fs::equivalent(path, read, none)) {
      throw Error(ErrorKind::kFile, fmt::format("'{}' is a file that the scene reads: it is not overwritten", path));
    }
  }
}

double peak_memory_in_megabytes() {
  struct rusage usage {};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024;  // Linux counts in KiB
}

void print_summary(const std::string& path, const Image& image, double seconds, double render_seconds,
                   const RenderStatistics& statistics) {
  const double rays = static_cast<double>(statistics.rays);
  fmt::print(stderr, "{}: {} x {} in {:.2f} s, {:.1f} million rays at {:.1f} million/s, {:.0f} MB\n", path,
             image.width, image.height, seconds, rays / 1e6, rays / 1e6 / std::max(render_seconds, 1e-9),
             peak_memory_in_megabytes());
}

}  // namespace

int run_render(const Options& options) {
  using Clock = std::chrono::steady_clock;
  const auto seconds_since = [](Clock::time_point then) {
    return std::chrono::duration<double>(Clock::now() - then).count();
  };
  const Clock::time_point start = Clock::now();
  const bool on_terminal = !options.quiet && ::isatty(STDERR_FILENO) != 0;
  if (options.operands.empty() && options.output.empty()) {
    fmt::print(stderr, "{}", help_page());
    return static_cast<int>(ErrorKind::kUsage);
  }
  const std::string path = output_path(options);
  const PictureFormat& format = format_of(path);
  LoadedScene scene = load_and_report(options);
  if (!scene.ok()) return static_cast<int>(ErrorKind::kScene);
  check_output(path, scene.files_read);
  scene.settings.threads = options.threads;

  RenderStatistics statistics;
  Image image;
  const Clock::time_point render_start = Clock::now();
  {
    const StopBetweenTiles orderly_stop;
    ProgressBar bar(on_terminal);
    image = render(scene.scene_at, 0, scene.settings, &bar, &statistics);
  }
  const double render_seconds = seconds_since(render_start);
  const std::vector<std::uint8_t> bytes = format.encode(image);
  if (path == "-") {
    write_all(STDOUT_FILENO, bytes, "standard output");
  } else {
    write_file(path, bytes);
  }
  if (on_terminal) print_summary(path, image, seconds_since(start), render_seconds, statistics);
  return 0;
}

}  // namespace raytracer::cli
