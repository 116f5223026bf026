#include "raytracer/render.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <mutex>

#include "core/parallel.hpp"
#include "raytracer/error.hpp"
#include "render/classic_renderer.hpp"
#include "render/path_renderer.hpp"

namespace raytracer {
namespace {

// Sample k belongs to slice floor(k n / samples) of n.
std::vector<Slice> cut_into_slices(double time, const RenderSettings& settings) {
  const int count = settings.slices();
  const auto first_sample = [&](int slice) {
    return static_cast<int>((std::int64_t{slice} * settings.samples + count - 1) / count);
  };
  std::vector<Slice> slices;
  for (int i = 0; i < count; ++i) {
    slices.push_back({settings.slice_time(time, i), first_sample(i), first_sample(i + 1)});
  }
  return slices;
}

// Counts tiles and tells the observer, one call at a time; remembers when it asked to stop.
class Progress {
 public:
  Progress(RenderObserver* observer, std::uint64_t total) : observer_(observer), total_(total) {}

  void tile_done() {
    const std::scoped_lock lock(mutex_);
    ++done_;
    if (observer_ != nullptr && !observer_->on_progress(done_, total_)) stopped_ = true;
  }
  bool is_stopped() const { return stopped_; }

 private:
  RenderObserver* observer_;
  std::uint64_t total_, done_ = 0;
  std::mutex mutex_;
  std::atomic<bool> stopped_ = false;
};

}  // namespace

Image render(const SceneAt& scene_at, double time, const RenderSettings& settings, RenderObserver* observer,
             RenderStatistics* statistics) {
  Image image(settings.width, settings.height);
  std::atomic<std::uint64_t> rays = 0;
  const std::vector<Tile> tiles = cut_into_tiles(settings.width, settings.height);
  const std::vector<Slice> slices = cut_into_slices(time, settings);
  Progress progress(observer, tiles.size() * slices.size());
  double build_seconds = 0;
  const auto render_tiles = [&](const auto& renderer) {
    parallel_for(tiles.size(), [&](std::size_t i) {
      if (progress.is_stopped()) return;
      rays += renderer.render(tiles[i]);
      progress.tile_done();
    });
  };
  run_with_threads(settings.threads, [&] {
    for (const Slice& slice : slices) {
      if (progress.is_stopped()) return;
      const auto start = std::chrono::steady_clock::now();
      const std::shared_ptr<const Scene> scene = scene_at(slice.time);
      build_seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
      if (settings.method == Method::kPath) {
        render_tiles(PathRenderer(*scene, settings, slice, image));
      } else {
        render_tiles(ClassicRenderer(*scene, settings, slice, image));
      }
    }
  });
  if (progress.is_stopped()) throw Error(ErrorKind::kInterrupted, "interrupted");
  if (statistics != nullptr) {
    statistics->rays += rays;
    statistics->build_seconds += build_seconds;
  }
  return image;
}

}  // namespace raytracer
