#include "render/classic_renderer.hpp"

#include <algorithm>
#include <vector>

#include "sampling/sobol.hpp"
#include "scene/pixel_color.hpp"
#include "scene/shining_parts.hpp"

namespace raytracer {

std::uint64_t ClassicRenderer::render(const Tile& tile) const {
  TileSums sums(tile, image_, slice_, settings_.samples);
  const TilePixels& pixels = sums.pixels();
  const std::size_t blocks = pixels.blocks().size();
  std::vector<ColorBlock> colors(blocks);
  std::vector<RayBlock> rays(blocks);
  const bool has_light_points = settings_.samples > 1 && !scene_.shining().is_empty();
  std::vector<Vector2f> light_points(has_light_points ? pixels.size() : 0);
  std::vector<RayCone> cones(has_textures_ ? pixels.size() : 0);
  PixelColors tracer(scene_);
  for (int sample = slice_.first_sample; sample < slice_.end_sample; ++sample) {
    for (std::size_t b = 0; b < blocks; ++b) {
      const bool has_cones = !cones.empty();
      const std::span<RayCone> own(cones.data() + (has_cones ? b * kBlockSize : 0),
                                   has_cones ? pixels.size_of_block(b) : 0);
      aim(pixels.blocks()[b], sample, rays[b], own);
    }
    for (std::size_t i = 0; i < light_points.size(); ++i) {
      light_points[i] = point_of_lights(pixels.blocks()[i / kBlockSize].number[i % kBlockSize], sample);
    }
    tracer.trace({rays, pixels.size(), light_points, cones}, settings_.bounces, colors);
    sums.add(colors, 1);
  }
  sums.store();
  return tracer.rays();
}

// The rays of a block of pixels, and the cones of as many of them as are wanted.
void ClassicRenderer::aim(const PixelBlock& pixels, int sample, RayBlock& rays,
                          std::span<RayCone> cones) const {
  const WithinPixels within = places_in_pixels(pixels, sample);
  const Camera& camera = scene_.camera();
  const bool is_pinhole = camera.is_pinhole();
  if (is_pinhole) pinhole_rays(camera, places_of(pixels, within, image_), rays);
  if (is_pinhole && cones.empty()) return;
  for (int i = 0; i < kBlockSize; ++i) {
    const Vector2f here{within.x[i], within.y[i]};
    const Vector2f lens = camera.has_lens() ? place_on_lens(pixels.number[i], sample) : Vector2f(0.5F);
    if (!is_pinhole) rays.set(i, camera_ray(scene_, image_, pixels.at(i), here, lens));
    if (static_cast<std::size_t>(i) >= cones.size()) continue;
    cones[static_cast<std::size_t>(i)] =
        camera_cone(scene_, image_, pixels.at(i), here, lens, rays.ray(i), settings_.samples);
  }
}

WithinPixels ClassicRenderer::places_in_pixels(const PixelBlock& pixels, int sample) const {
  WithinPixels within;
  if (settings_.samples == 1) {
    std::ranges::fill(within.x, 0.5F);
    std::ranges::fill(within.y, 0.5F);
    return within;
  }
  const SobolBits bits(static_cast<std::uint32_t>(sample));
  const std::uint32_t seed = hash_bits(settings_.seed);
  for (int i = 0; i < kBlockSize; ++i) {
    const Vector2f point = sobol_point(bits, hash_bits(pixels.number[i] ^ seed));
    within.x[i] = point.x;
    within.y[i] = point.y;
  }
  return within;
}

// The same points in an order of their own, so that no place in the pixel belongs to a place on the lens.
Vector2f ClassicRenderer::place_on_lens(std::uint32_t pixel, int sample) const {
  if (settings_.samples == 1) return Vector2f(0.5F);
  const std::uint32_t seed = hash_bits(pixel ^ hash_bits(settings_.seed ^ 0x6C656E73U));
  return sobol_point(owen_scramble(static_cast<std::uint32_t>(sample), seed), hash_bits(seed));
}

// Another point of the same kind, for the places on what shines.
Vector2f ClassicRenderer::point_of_lights(std::uint32_t pixel, int sample) const {
  constexpr std::uint32_t kOther = 0x68BC21EBU;
  return sobol_point(static_cast<std::uint32_t>(sample),
                     hash_bits(pixel ^ hash_bits(settings_.seed ^ kOther)));
}

}  // namespace raytracer
