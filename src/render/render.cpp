#include "raytracer/render.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
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

// The pixels of a tile in blocks of as many as a packet takes: rays that go the same way.
std::vector<glm::ivec2> pixels_in_blocks(const Tile& tile) {
  constexpr int kBlock = 4;
  std::vector<glm::ivec2> pixels;
  for (int y = tile.y_begin; y < tile.y_end; y += kBlock) {
    for (int x = tile.x_begin; x < tile.x_end; x += kBlock) {
      for (int v = y; v < std::min(y + kBlock, tile.y_end); ++v) {
        for (int u = x; u < std::min(x + kBlock, tile.x_end); ++u) pixels.push_back({u, v});
      }
    }
  }
  return pixels;
}

// A part of the time that the shutter is open, of which its middle stands for the whole, and the samples that
// fall in it.
struct Slice {
  double time;
  int first_sample, end_sample;
};

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

// Renders the samples of one slice of time. Between slices the image holds sums.
class TileRenderer {
 public:
  TileRenderer(const Scene& scene, const RenderSettings& settings, const Slice& slice, Image& image)
      : scene_(scene), settings_(settings), slice_(slice), image_(image) {}

  /// Adds to the tile's pixels, and after the last sample divides them; returns how many rays that took.
  std::uint64_t render(const Tile& tile) const {
    const std::vector<glm::ivec2> pixels = pixels_in_blocks(tile);
    std::vector<Color3f> sums(pixels.size()), colors(pixels.size());
    for (std::size_t i = 0; i < pixels.size(); ++i) sums[i] = image_.at(pixels[i].x, pixels[i].y);
    std::vector<Ray3f> rays(pixels.size());
    PixelColors tracer(scene_);
    for (int sample = slice_.first_sample; sample < slice_.end_sample; ++sample) {
      for (std::size_t i = 0; i < pixels.size(); ++i) rays[i] = camera_ray(pixels[i].x, pixels[i].y, sample);
      tracer.trace(rays, settings_.bounces, colors);
      for (std::size_t i = 0; i < pixels.size(); ++i) sums[i] += colors[i];
    }
    const bool is_last = slice_.end_sample == settings_.samples;
    const float divisor = is_last ? static_cast<float>(settings_.samples) : 1.0F;
    for (std::size_t i = 0; i < pixels.size(); ++i) image_.set(pixels[i].x, pixels[i].y, sums[i] / divisor);
    return tracer.rays();
  }

 private:
  Ray3f camera_ray(int x, int y, int sample) const {
    const Vector2f within = place_in_pixel(x, y, sample);
    const double across = (x + static_cast<double>(within.x)) / image_.width;
    const double down = (y + static_cast<double>(within.y)) / image_.height;
    const Camera& camera = scene_.camera();
    return camera.has_lens() ? camera.ray_through(across, down, place_on_lens(x, y, sample))
                             : camera.ray_through(across, down);
  }

  // (0, 0) is the pixel's upper left corner.
  Vector2f place_in_pixel(int x, int y, int sample) const {
    if (settings_.samples == 1) return Vector2f(0.5f);
    const auto number = static_cast<std::uint32_t>(image_.index(x, y));
    return sobol_point(static_cast<std::uint32_t>(sample), hash_bits(number ^ hash_bits(settings_.seed)));
  }

  // The same points in an order of their own, so that no place in the pixel belongs to a place on the lens.
  Vector2f place_on_lens(int x, int y, int sample) const {
    if (settings_.samples == 1) return Vector2f(0.5f);
    const auto number = static_cast<std::uint32_t>(image_.index(x, y));
    const std::uint32_t seed = hash_bits(number ^ hash_bits(settings_.seed ^ 0x6C656E73U));
    return sobol_point(owen_scramble(static_cast<std::uint32_t>(sample), seed), hash_bits(seed));
  }

  const Scene& scene_;
  const RenderSettings& settings_;
  const Slice& slice_;
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
  const std::vector<Slice> slices = cut_into_slices(time, settings);
  Progress progress(observer, tiles.size() * slices.size());
  double build_seconds = 0;
  run_with_threads(settings.threads, [&] {
    for (const Slice& slice : slices) {
      if (progress.is_stopped()) return;
      const auto start = std::chrono::steady_clock::now();
      const std::shared_ptr<const Scene> scene = scene_at(slice.time);
      build_seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
      const TileRenderer renderer(*scene, settings, slice, image);
      parallel_for(tiles.size(), [&](std::size_t i) {
        if (progress.is_stopped()) return;
        rays += renderer.render(tiles[i]);
        progress.tile_done();
      });
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
