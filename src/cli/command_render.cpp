// `raytracer render`: reads the scene, then makes one picture after the other.
#include <fmt/format.h>
#include <unistd.h>

#include "cli/commands.hpp"
#include "cli/output.hpp"
#include "cli/progress_bar.hpp"
#include "cli/statistics.hpp"
#include "cli/target.hpp"
#include "core/hash.hpp"
#include "raytracer/error.hpp"
#include "raytracer/image.hpp"

namespace raytracer::cli {
namespace {

// What a frame's file says about what it shows: two files with the same key have the same pixels.
std::string key_of(const SceneHash& hash) {
  Hasher hasher;
  for (const std::uint64_t word : hash) hasher.add(word);
  hasher.add(std::string_view(RAYTRACER_VERSION));
  const auto [first, second] = hasher.value();
  return fmt::format("{:016x}{:016x}", first, second);
}

// Makes pictures of a scene, each only where it isn't there yet.
class Renderer {
 public:
  Renderer(const LoadedScene& scene, const Options& options, FrameSink& sink, ProgressBar& bar,
           RunStatistics& run, Stopwatch& watch)
      : scene_(scene), options_(options), sink_(sink), bar_(bar), run_(run), watch_(watch) {}

  void make(const Shot& shot) {
    if (shot.frame == 0) return make_still(shot);
    try {
      make_frame(shot);
    } catch (const Error& error) {
      const bool is_of_scene = error.kind() == ErrorKind::kScene || error.kind() == ErrorKind::kUsage;
      if (!is_of_scene) throw;
      throw Error(error.kind(), fmt::format("frame {} (t = {}): {}", shot.frame, shot.time, error.what()));
    }
  }

 private:
  void make_still(const Shot& shot) {
    // What has been evaluated for the time 0 will do.
    const RenderSettings settings = shot.time == 0 ? scene_.settings : scene_.moment_at(shot.time).settings;
    sink_.add(0, {}, picture(shot, settings));
  }

  void make_frame(const Shot& shot) {
    const SceneMoment moment = scene_.moment_at(shot.time);
    const std::string key = key_of(moment.hash);
    run_.build += watch_.lap();
    if (options_.resume && sink_.has(shot.frame, key)) {
      ++run_.kept;
    } else if (key == latest_key_) {
      sink_.repeat(shot.frame);
    } else {
      sink_.add(shot.frame, key, picture(shot, moment.settings));
      latest_key_ = key;
    }
  }

  Image picture(const Shot& shot, RenderSettings settings) {
    settings.threads = options_.threads;
    RenderStatistics statistics;
    Image image = render(scene_.scene_at, shot.time, settings, &bar_, &statistics);
    run_.rays += statistics.rays;
    run_.build += statistics.build_seconds;
    run_.render += watch_.lap() - statistics.build_seconds;
    run_.width = image.width;
    run_.height = image.height;
    if (sink_.wants_light()) return image;
    return develop(std::move(image), settings.development);
  }

  const LoadedScene& scene_;
  const Options& options_;
  FrameSink& sink_;
  ProgressBar& bar_;
  RunStatistics& run_;
  Stopwatch& watch_;
  std::string latest_key_;  // of the picture that the sink was given last
};

void write_statistics(const Options& options, const RunStatistics& run) {
  if (options.statistics.empty()) return;
  const std::string text = to_json(run);
  if (options.statistics == "-") return say(text);
  write_file(options.statistics, {text.begin(), text.end()});
}

}  // namespace

int run_render(const Options& options) {
  if (options.operands.empty() && options.output.empty()) {
    warn(help_page());
    return static_cast<int>(ErrorKind::kUsage);
  }
  const bool on_terminal = !options.quiet && ::isatty(STDERR_FILENO) != 0;
  const Target target = target_of(options);
  Stopwatch watch;
  RunStatistics run;
  const LoadedScene scene = load_and_report(options);
  if (!scene.ok()) return static_cast<int>(ErrorKind::kScene);
  const std::vector<Shot> shots = shots_of(target, options, scene);
  const KeptFiles kept = KeptFiles::of(scene);
  check_target(target, shots, kept);
  check_statistics(options.statistics, target, shots, kept);
  const std::unique_ptr<FrameSink> sink = open_target(target, shots.size(), scene.animation.fps, run, watch);
  run.shapes = scene.shapes;
  run.picture_bytes = scene.picture_bytes;
  run.load = watch.lap();
  {
    ProgressBar bar(on_terminal, shots.size());
    Renderer renderer(scene, options, *sink, bar, run, watch);
    for (const Shot& shot : shots) {
      bar.begin_picture(shot.frame);
      renderer.make(shot);
      ++run.pictures;
    }
  }
  sink->finish();
  if (on_terminal) warn(summary(target.path, run));
  write_statistics(options, run);
  return 0;
}

}  // namespace raytracer::cli
