#include "render/path_renderer.hpp"

#include <vector>

#include "render/aim.hpp"

namespace raytracer {
namespace {

constexpr float kWhite = 255;

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

std::uint64_t PathRenderer::render(const Tile& tile) const {
  TileSums sums(tile, image_, slice_, settings_.samples);
  const TilePixels& pixels = sums.pixels();
  std::vector<Color3f> colors(pixels.size());
  std::vector<ColorBlock> blocks(pixels.blocks().size());
  std::vector<Ray3f> rays(pixels.size());
  std::vector<RayCone> cones(has_textures_ ? pixels.size() : 0);
  std::vector<PathNumber> numbers(pixels.size());
  std::vector<Vector2f> places(pixels.size()), on_lens(pixels.size(), Vector2f(0.5F));
  const bool has_lens = scene_.camera().has_lens();
  PathTracer tracer(scene_, paths_, points_, world_);
  for (int sample = slice_.first_sample; sample < slice_.end_sample; ++sample) {
    for (std::size_t i = 0; i < pixels.size(); ++i) {
      numbers[i] = points_.number(pixels.at(i).x, pixels.at(i).y, sample);
    }
    points_.fill(0, numbers, places);
    if (has_lens) points_.fill(1, numbers, on_lens);
    for (std::size_t i = 0; i < pixels.size(); ++i) {
      rays[i] = camera_ray(scene_, image_, pixels.at(i), places[i], on_lens[i]);
      if (!has_textures_) continue;
      cones[i] = camera_cone(scene_, image_, pixels.at(i), places[i], on_lens[i], rays[i], settings_.samples);
    }
    tracer.trace(rays, cones, numbers, colors);
    for (std::size_t i = 0; i < colors.size(); ++i) {
      blocks[i / kBlockSize].set(static_cast<int>(i % kBlockSize), colors[i]);
    }
    sums.add(blocks, kWhite);
  }
  sums.store();
  return tracer.rays();
}

void PathRenderer::aim(const TilePixels& pixels, std::span<const Vector2f> places,
                       std::span<const Vector2f> on_lens, std::span<Ray3f> rays) const {
  if (!scene_.camera().is_pinhole()) {
    for (std::size_t i = 0; i < rays.size(); ++i) {
      rays[i] = camera_ray(scene_, image_, pixels.at(i), places[i], on_lens[i]);
    }
    return;
  }
  for (std::size_t b = 0; b < pixels.blocks().size(); ++b) {
    WithinPixels within{};
    const std::size_t first = b * kBlockSize, count = pixels.size_of_block(b);
    for (std::size_t i = 0; i < count; ++i) {
      within.x[i] = places[first + i].x;
      within.y[i] = places[first + i].y;
    }
    RayBlock block;
    pinhole_rays(scene_.camera(), places_of(pixels.blocks()[b], within, image_), block);
    for (std::size_t i = 0; i < count; ++i) rays[first + i] = block.ray(static_cast<int>(i));
  }
}

}  // namespace raytracer
