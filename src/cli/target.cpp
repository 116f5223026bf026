#include "cli/target.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <filesystem>

#include "cli/frames.hpp"
#include "cli/movie.hpp"
#include "raytracer/error.hpp"

namespace raytracer::cli {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void usage_error(const std::string& message) { throw Error(ErrorKind::kUsage, message); }

std::string output_path(const Options& options) {
  if (!options.output.empty()) return options.output;
  const std::string& scene = options.operands.empty() ? std::string("-") : options.operands[0];
  if (scene == "-") usage_error("a scene from standard input has no name: say -o out.png");
  return fs::path(scene).stem().string() + (options.frames ? ".####.png" : ".png");
}

void check_time_and_resume(const Target& target, const Options& options) {
  if (options.time_at && options.frames)
    usage_error("--time-at names one moment, --frames names frames: say either");
  if (options.time_at && target.wants_frames) {
    usage_error(fmt::format("'{}' asks for frames, --time-at for one moment: say either", target.path));
  }
  if (!options.resume) return;
  if (!target.wants_frames) usage_error("--resume goes on with frames: -o shot.####.png");
  if (target.is_film || target.path == "-" || !is_png(target.path)) {
    usage_error(
        fmt::format("--resume can't go on with '{}': only frames as PNG files tell what they show, "
                    "as -o shot.####.png makes them",
                    target.path));
  }
}

}  // namespace

Target target_of(const Options& options) {
  Target target;
  target.path = output_path(options);
  target.is_film = is_film(target.path);
  if (!target.is_film) format_of(target.path);
  target.is_numbered = !target.is_film && has_frame_number(target.path);
  target.wants_frames = options.frames || target.is_film || target.is_numbered;
  check_time_and_resume(target, options);
  return target;
}

std::vector<Shot> shots_of(const Target& target, const Options& options, const LoadedScene& scene) {
  if (!target.wants_frames) return {{options.time_at.value_or(0), 0}};
  if (scene.animation.duration == 0) {
    usage_error(fmt::format(
        "{} asks for frames, and the scene does not say how long it lasts: animation {{ duration 4 }}",
        options.frames ? "--frames" : fmt::format("'{}'", target.path)));
  }
  std::vector<Shot> shots;
  const FrameList list = options.frames.value_or(parse_frame_list("all"));
  for (const int frame : frames_of(list, scene.animation.frames())) {
    shots.push_back({(frame - 1) / scene.animation.fps, frame});
  }
  const bool has_place = shots.size() == 1 || target.is_numbered || target.is_film;
  if (!has_place && !is_png(target.path)) {
    usage_error(
        fmt::format("'{}' can't hold {} frames: -o shot.####.pfm makes a file of each, -o film.mp4 a film",
                    target.path, shots.size()));
  }
  if (!has_place && options.resume) {
    usage_error(fmt::format(
        "--resume can't go on with '{}', one file of {} frames: -o shot.####.png makes a file of each",
        target.path, shots.size()));
  }
  return shots;
}

std::vector<std::string> files_of(const Target& target, const std::vector<Shot>& shots) {
  if (!target.is_numbered) return {target.path};
  std::vector<std::string> files;
  for (const Shot& shot : shots) files.push_back(with_frame_number(target.path, shot.frame));
  return files;
}

void check_target(const Target& target, const std::vector<Shot>& shots, const KeptFiles& kept) {
  if (target.path == "-" && ::isatty(STDOUT_FILENO) != 0) {
    usage_error("standard output is a terminal, and a picture is no text: say -o out.png");
  }
  for (const std::string& file : files_of(target, shots)) check_output(file, kept);
}

void check_statistics(const std::string& path, const Target& target, const std::vector<Shot>& shots,
                      KeptFiles kept) {
  if (path.empty()) return;
  if (path == "-" && target.path == "-") {
    usage_error("-o and --stats can't both go to standard output: say --stats times.json");
  }
  for (const std::string& file : files_of(target, shots)) kept.add(file, "where the picture goes");
  check_output(path, kept);
}

std::unique_ptr<FrameSink> open_target(const Target& target, std::size_t shots, double fps,
                                       RunStatistics& run, Stopwatch& watch) {
  if (target.is_film) return std::make_unique<Movie>(target.path, fps, run, watch);
  if (!target.is_numbered && shots > 1) return std::make_unique<MovingPng>(target.path, fps, run, watch);
  return std::make_unique<PictureFiles>(target.path, run, watch);
}

}  // namespace raytracer::cli
