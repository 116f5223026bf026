#include "raytracer/render.hpp"

#include <algorithm>
#include <atomic>
#include <mutex>

#include "core/parallel.hpp"
#include "raytracer/error.hpp"
#include "sampling/sobol.hpp"
#include "scene/pixel_color.hpp"

namespace raytracer {
namespace {

constexpr int kTileSize = 32;  // pixels along an edge

struct Tile {
  int x_begin, y_begin, x_end, y_end;
};

std::vector<Tile> cut_into_tiles(int width, int height) {
  std::vector<Tile> tiles;
  for (int y = 0; y < height; y += kTileSize) {
    for (int x = 0; x < width; x += kTileSize) {
      tiles.push_back({x, y, std::min(x + kTileSize, width), std::min(y + kTileSize, height)});
    }
  }
  return tiles;
}

class TileRenderer {
 public:
  TileRenderer(const Scene& scene, const RenderSettings& settings, Image& image)
      : scene_(scene), settings_(settings), image_(image) {}

  /// Writes the tile's pixels; returns how many rays that took.
  std::uint64_t render(const Tile& tile) const {
    std::uint64_t rays = 0;
    for (int y = tile.y_begin; y < tile.y_end; ++y) {
      for (int x = tile.x_begin; x < tile.x_end; ++x) image_.set(x, y, pixel(x, y, rays));
    }
    return rays;
  }

 private:
  Color3f pixel(int x, int y, std::uint64_t& rays) const {
    if (settings_.samples == 1) return sample(x, y, Vector2f(0.5f), rays);
    const auto number = static_cast<std::uint32_t>(image_.index(x, y));
    const std::uint32_t seed = hash_bits(number ^ hash_bits(settings_.seed));
    Color3f sum(0);
    for (int i = 0; i < settings_.samples; ++i) {
      sum += sample(x, y, sobol_point(static_cast<std::uint32_t>(i), seed), rays);
    }
    return sum / static_cast<float>(settings_.samples);
  }

  // `within`: where in the pixel, (0, 0) its upper left corner.
  Color3f sample(int x, int y, const Vector2f& within, std::uint64_t& rays) const {
    const double across = (x + static_cast<double>(within.x)) / image_.width;
    const double down = (y + static_cast<double>(within.y)) / image_.height;
    return get_pixel_color(scene_, scene_.camera().ray_through(across, down), settings_.bounces, rays);
  }

  const Scene& scene_;
  const RenderSettings& settings_;
  Image& image_;
};

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
  Progress progress(observer, tiles.size());
  run_with_threads(settings.threads, [&] {
    const std::shared_ptr<const Scene> scene = scene_at(time);
    const TileRenderer renderer(*scene, settings, image);
    parallel_for(tiles.size(), [&](std::size_t i) {
      if (progress.is_stopped()) return;
      rays += renderer.render(tiles[i]);
      progress.tile_done();
    });
  });
  if (progress.is_stopped()) throw Error(ErrorKind::kInterrupted, "interrupted");
  if (statistics != nullptr) statistics->rays += rays;
  return image;
}

}  // namespace raytracer
