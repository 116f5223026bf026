#include "render/path_renderer.hpp"

#include <algorithm>
#include <vector>

#include "render/aim.hpp"

namespace raytracer {
namespace {

constexpr float kWhite = 255;

// Samples of one pixel go the same way for longer than those of neighbours do: where they have to find their
// way through glass that is worth a twentieth of the time.
constexpr int kSamplesAtOnce = 16, kPathsAtOnce = 1024;

}  // namespace

PathRenderer::PathRenderer(const Scene& scene, const RenderSettings& settings, const Slice& slice,
                           Image& image)
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

/// Paths that are followed together, those of a pixel side by side.
struct PathRenderer::Batch {
  std::vector<glm::ivec2> pixels;
  std::vector<PathNumber> numbers;
  std::vector<Vector2f> places, on_lens;
  std::vector<Ray3f> rays;
  std::vector<RayCone> cones;  // none where there are no textures
  std::vector<Color3f> colors;
};

std::uint64_t PathRenderer::render(const Tile& tile) const {
  TileSums sums(tile, image_, slice_, settings_.samples);
  PathTracer tracer(scene_, paths_, points_, world_);
  Batch batch;
  const int at_once = std::clamp(slice_.end_sample - slice_.first_sample, 1, kSamplesAtOnce);
  const auto pixels_at_once = static_cast<std::size_t>(kPathsAtOnce / at_once);
  for (std::size_t first = 0; first < sums.pixels().size(); first += pixels_at_once) {
    const std::size_t end = std::min(first + pixels_at_once, sums.pixels().size());
    batch.pixels.clear();
    for (std::size_t i = first; i < end; ++i) batch.pixels.push_back(sums.pixels().at(i));
    for (int sample = slice_.first_sample; sample < slice_.end_sample; sample += at_once) {
      set_up(batch, sample, std::min(sample + at_once, slice_.end_sample));
      tracer.trace(batch.rays, batch.cones, batch.numbers, batch.colors);
      const std::size_t per_pixel = batch.colors.size() / batch.pixels.size();
      for (std::size_t i = 0; i < batch.colors.size(); ++i) {
        sums.add(first + i / per_pixel, batch.colors[i], kWhite);
      }
    }
  }
  sums.store();
  return tracer.rays();
}

void PathRenderer::set_up(Batch& batch, int first_sample, int end_sample) const {
  batch.numbers.clear();
  for (const glm::ivec2& pixel : batch.pixels) {
    for (int sample = first_sample; sample < end_sample; ++sample) {
      batch.numbers.push_back(points_.number(pixel.x, pixel.y, sample));
    }
  }
  const std::size_t count = batch.numbers.size();
  batch.places.resize(count);
  batch.on_lens.assign(count, Vector2f(0.5F));
  batch.rays.resize(count);
  batch.colors.resize(count);
  points_.fill(0, batch.numbers, batch.places);
  if (scene_.camera().has_lens()) points_.fill(1, batch.numbers, batch.on_lens);
  const auto samples = static_cast<std::size_t>(end_sample - first_sample);
  aim(batch, samples);
  if (has_textures_) set_cones(batch, samples);
}

void PathRenderer::set_cones(Batch& batch, std::size_t samples) const {
  batch.cones.resize(batch.rays.size());
  if (!are_many(settings_.samples)) {
    for (std::size_t i = 0; i < batch.cones.size(); ++i) {
      batch.cones[i] = camera_cone(scene_, image_, batch.pixels[i / samples], batch.places[i],
                                   batch.on_lens[i], batch.rays[i], settings_.samples);
    }
    return;
  }
  for (std::size_t p = 0; p < batch.pixels.size(); ++p) {
    const RayCone cone = pixel_cone(scene_, image_, batch.pixels[p], settings_.samples);
    std::fill_n(batch.cones.begin() + static_cast<std::ptrdiff_t>(p * samples), samples, cone);
  }
}

void PathRenderer::aim(Batch& batch, std::size_t samples) const {
  const std::size_t count = batch.rays.size();
  if (!scene_.camera().is_pinhole()) {
    for (std::size_t i = 0; i < count; ++i) {
      batch.rays[i] =
          camera_ray(scene_, image_, batch.pixels[i / samples], batch.places[i], batch.on_lens[i]);
    }
    return;
  }
  for (std::size_t first = 0; first < count; first += kBlockSize) {
    const std::size_t size = std::min<std::size_t>(kBlockSize, count - first);
    PixelBlock pixels{};
    WithinPixels within{};
    for (std::size_t i = 0; i < size; ++i) {
      pixels.x[i] = batch.pixels[(first + i) / samples].x;
      pixels.y[i] = batch.pixels[(first + i) / samples].y;
      within.x[i] = batch.places[first + i].x;
      within.y[i] = batch.places[first + i].y;
    }
    RayBlock block;
    pinhole_rays(scene_.camera(), places_of(pixels, within, image_), block);
    for (std::size_t i = 0; i < size; ++i) batch.rays[first + i] = block.ray(static_cast<int>(i));
  }
}

}  // namespace raytracer
