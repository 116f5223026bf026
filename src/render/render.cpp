#include "raytracer/render.hpp"

#include <algorithm>
#include <atomic>
#include <bit>
#include <chrono>
#include <cmath>
#include <limits>
#include <mutex>
#include <span>

#include "core/parallel.hpp"
#include "integrators/path_tracer.hpp"
#include "raytracer/error.hpp"
#include "sampling/sobol.hpp"
#include "scene/any_material.hpp"
#include "scene/pixel_color.hpp"
#include "scene/shining_parts.hpp"

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

// The sums of a tile's pixels while its samples are rendered. Between slices of time the image holds sums.
class TileSums {
 public:
  TileSums(const Tile& tile, Image& image, int samples)
      : image_(image),
        brightest_(std::numeric_limits<float>::max() / static_cast<float>(samples)),
        pixels_(pixels_in_blocks(tile)),
        sums_(pixels_.size()) {
    for (std::size_t i = 0; i < pixels_.size(); ++i) sums_[i] = image.at(pixels_[i].x, pixels_[i].y);
  }

  const std::vector<glm::ivec2>& pixels() const { return pixels_; }

  void add(const std::vector<Color3f>& colors, float scale) {
    for (std::size_t i = 0; i < sums_.size(); ++i) add(i, scale * colors[i]);
  }
  /// To pixel i. What is brighter than a picture can hold counts as bright as that.
  void add(std::size_t i, const Color3f& color) {
    sums_[i] += glm::min(glm::max(Color3f(0), color), brightest_);
  }

  /// After the last of all samples the sums become means.
  void store(const Slice& slice, int samples) {
    const float divisor = slice.end_sample == samples ? static_cast<float>(samples) : 1.0F;
    for (std::size_t i = 0; i < pixels_.size(); ++i)
      image_.set(pixels_[i].x, pixels_[i].y, sums_[i] / divisor);
  }

 private:
  Image& image_;
  float brightest_;
  std::vector<glm::ivec2> pixels_;
  std::vector<Color3f> sums_;
};

// The ray through the point `within` (0 … 1) of a pixel and a point of the lens.
Ray3f camera_ray(const Scene& scene, const Image& image, const glm::ivec2& pixel, const Vector2f& within,
                 const Vector2f& lens) {
  const double across = (pixel.x + static_cast<double>(within.x)) / image.width;
  const double down = (pixel.y + static_cast<double>(within.y)) / image.height;
  return scene.camera().ray_through(across, down, lens);
}

// 4^k samples lie in as many squares of the pixel, and each stands for its own; else each stands for as much
// around itself.
struct PixelShare {
  Vector2f middle;  // within the pixel
  float edge;
};

PixelShare share_of(const Vector2f& within, int samples) {
  const auto count = static_cast<unsigned>(samples);
  if (!std::has_single_bit(count) || std::countr_zero(count) % 2 != 0) {
    return {within, 1 / std::sqrt(static_cast<float>(samples))};
  }
  const auto squares = static_cast<float>(1U << static_cast<unsigned>(std::countr_zero(count) / 2));
  return {(glm::floor(within * squares) + 0.5F) / squares, 1 / squares};
}

// How wide what that ray stands for is.
RayCone camera_cone(const Scene& scene, const Image& image, const glm::ivec2& pixel, const Vector2f& within,
                    const Vector2f& lens, const Ray3f& ray, int samples) {
  const PixelShare share = share_of(within, samples);
  const double across = (pixel.x + static_cast<double>(share.middle.x)) / image.width;
  const double down = (pixel.y + static_cast<double>(share.middle.y)) / image.height;
  const Ray3f middle = scene.camera().ray_through(across, down, lens);
  RayCone cone;
  cone.aside_origin = middle.origin - ray.origin;
  cone.aside_direction = middle.direction - ray.direction;
  cone.edges = scene.camera().differential(across, down, lens, static_cast<double>(share.edge) / image.width,
                                           static_cast<double>(share.edge) / image.height);
  constexpr int kFew = 16;
  cone.is_coarse = samples < kFew;
  cone.width = glm::length(cone.edges.origin_dx);
  cone.spread = glm::length(cone.edges.direction_dx);
  return cone;
}

bool has_textures(const SceneDescription& scene) {
  return any_material(scene, [](const Material& material) { return material.textures != nullptr; });
}

// Renders the samples of one slice of time by the paper's recursion.
class ClassicRenderer {
 public:
  ClassicRenderer(const Scene& scene, const RenderSettings& settings, const Slice& slice, Image& image)
      : scene_(scene),
        settings_(settings),
        slice_(slice),
        image_(image),
        has_textures_(has_textures(scene.description())) {}

  /// Adds to the tile's pixels; returns how many rays that took.
  std::uint64_t render(const Tile& tile) const {
    TileSums sums(tile, image_, settings_.samples);
    const std::vector<glm::ivec2>& pixels = sums.pixels();
    std::vector<Color3f> colors(pixels.size());
    std::vector<Ray3f> rays(pixels.size());
    const bool has_light_points = settings_.samples > 1 && !scene_.shining().is_empty();
    std::vector<Vector2f> light_points(has_light_points ? pixels.size() : 0);
    std::vector<RayCone> cones(has_textures_ ? pixels.size() : 0);
    PixelColors tracer(scene_);
    const bool has_lens = scene_.camera().has_lens();
    for (int sample = slice_.first_sample; sample < slice_.end_sample; ++sample) {
      for (std::size_t i = 0; i < pixels.size(); ++i) {
        const Vector2f lens = has_lens ? place_on_lens(pixels[i], sample) : Vector2f(0.5F);
        const Vector2f within = place_in_pixel(pixels[i], sample);
        rays[i] = camera_ray(scene_, image_, pixels[i], within, lens);
        if (has_textures_) {
          cones[i] = camera_cone(scene_, image_, pixels[i], within, lens, rays[i], settings_.samples);
        }
      }
      for (std::size_t i = 0; i < light_points.size(); ++i) {
        light_points[i] = point_of_lights(pixels[i], sample);
      }
      tracer.trace(rays, settings_.bounces, colors, light_points, cones);
      sums.add(colors, 1);
    }
    sums.store(slice_, settings_.samples);
    return tracer.rays();
  }

 private:
  // (0, 0) is the pixel's upper left corner.
  Vector2f place_in_pixel(const glm::ivec2& pixel, int sample) const {
    if (settings_.samples == 1) return Vector2f(0.5f);
    const auto number = static_cast<std::uint32_t>(image_.index(pixel.x, pixel.y));
    return sobol_point(static_cast<std::uint32_t>(sample), hash_bits(number ^ hash_bits(settings_.seed)));
  }

  // The same points in an order of their own, so that no place in the pixel belongs to a place on the lens.
  Vector2f place_on_lens(const glm::ivec2& pixel, int sample) const {
    if (settings_.samples == 1) return Vector2f(0.5f);
    const auto number = static_cast<std::uint32_t>(image_.index(pixel.x, pixel.y));
    const std::uint32_t seed = hash_bits(number ^ hash_bits(settings_.seed ^ 0x6C656E73U));
    return sobol_point(owen_scramble(static_cast<std::uint32_t>(sample), seed), hash_bits(seed));
  }

  // Another point of the same kind, for the places on what shines.
  Vector2f point_of_lights(const glm::ivec2& pixel, int sample) const {
    const auto number = static_cast<std::uint32_t>(image_.index(pixel.x, pixel.y));
    constexpr std::uint32_t kOther = 0x68BC21EBU;
    return sobol_point(static_cast<std::uint32_t>(sample),
                       hash_bits(number ^ hash_bits(settings_.seed ^ kOther)));
  }

  const Scene& scene_;
  const RenderSettings& settings_;
  const Slice& slice_;
  Image& image_;
  bool has_textures_;
};

// Likewise by path tracing.
class PathRenderer {
 public:
  PathRenderer(const Scene& scene, const RenderSettings& settings, const Slice& slice, Image& image)
      : scene_(scene),
        settings_(settings),
        slice_(slice),
        image_(image),
        paths_{settings.bounces, settings.sampling, settings.clamp_indirect, settings.seed},
        points_(settings.samples, settings.seed),
        has_textures_(has_textures(scene.description())),
        world_(scene) {
    scene.lights();  // gathered before the threads begin
  }

  std::uint64_t render(const Tile& tile) const {
    TileSums sums(tile, image_, settings_.samples);
    const std::vector<glm::ivec2>& pixels = sums.pixels();
    PathTracer tracer(scene_, paths_, points_, world_);
    Batch batch;
    const int count = slice_.end_sample - slice_.first_sample;
    const int samples_at_once = std::min(count, kSamplesAtOnce);
    const auto pixels_at_once = static_cast<std::size_t>(kPathsAtOnce / std::max(samples_at_once, 1));
    for (std::size_t first = 0; first < pixels.size(); first += pixels_at_once) {
      const std::size_t size = std::min(pixels_at_once, pixels.size() - first);
      for (int sample = slice_.first_sample; sample < slice_.end_sample; sample += samples_at_once) {
        const int end = std::min(sample + samples_at_once, slice_.end_sample);
        set_up(batch, std::span(pixels).subspan(first, size), sample, end);
        tracer.trace(batch.rays, batch.cones, batch.numbers, batch.colors);
        const auto per_pixel = static_cast<std::size_t>(end - sample);
        for (std::size_t i = 0; i < batch.colors.size(); ++i)
          sums.add(first + i / per_pixel, kWhite * batch.colors[i]);
      }
    }
    sums.store(slice_, settings_.samples);
    return tracer.rays();
  }

 private:
  static constexpr float kWhite = 255;
  // Samples of one pixel go the same way for longer than those of neighbours do: where they have to find
  // their way through glass that is worth a twentieth of the time.
  static constexpr int kSamplesAtOnce = 16, kPathsAtOnce = kTileSize * kTileSize;

  // Paths that are followed together, those of a pixel side by side.
  struct Batch {
    std::vector<PathNumber> numbers;
    std::vector<Vector2f> places, on_lens;
    std::vector<Ray3f> rays;
    std::vector<RayCone> cones;  // none where there are no textures
    std::vector<Color3f> colors;
  };

  void set_up(Batch& batch, std::span<const glm::ivec2> pixels, int first_sample, int end_sample) const {
    const std::size_t count = pixels.size() * static_cast<std::size_t>(end_sample - first_sample);
    batch.numbers.clear();
    for (const glm::ivec2& pixel : pixels) {
      for (int sample = first_sample; sample < end_sample; ++sample)
        batch.numbers.push_back(points_.number(pixel.x, pixel.y, sample));
    }
    batch.places.resize(count);
    points_.fill(0, batch.numbers, batch.places);
    batch.on_lens.assign(count, Vector2f(0.5F));
    if (scene_.camera().has_lens()) points_.fill(1, batch.numbers, batch.on_lens);
    batch.rays.clear();
    batch.cones.clear();
    for (std::size_t i = 0; i < count; ++i) {
      const glm::ivec2& pixel = pixels[i / static_cast<std::size_t>(end_sample - first_sample)];
      const Vector2f &place = batch.places[i], &lens = batch.on_lens[i];
      batch.rays.push_back(camera_ray(scene_, image_, pixel, place, lens));
      if (!has_textures_) continue;
      batch.cones.push_back(
          camera_cone(scene_, image_, pixel, place, lens, batch.rays.back(), settings_.samples));
    }
    batch.colors.resize(count);
  }

  const Scene& scene_;
  const RenderSettings& settings_;
  const Slice& slice_;
  Image& image_;
  PathSettings paths_;
  PathPoints points_;
  bool has_textures_;
  PathWorld world_;
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
