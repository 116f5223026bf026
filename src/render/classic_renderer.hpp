// `method classic`, tile by tile.
#pragma once

#include <cstdint>
#include <span>

#include "raytracer/render.hpp"
#include "render/aim.hpp"
#include "render/tile.hpp"

namespace raytracer {

/// Renders the samples of one slice of time by the paper's recursion. Any number of threads may call it.
class ClassicRenderer {
 public:
  ClassicRenderer(const Scene& scene, const RenderSettings& settings, const Slice& slice, Image& image)
      : scene_(scene),
        settings_(settings),
        slice_(slice),
        image_(image),
        has_textures_(has_textures(scene.description())) {}

  /// Adds to the tile's pixels; returns how many rays that took.
  std::uint64_t render(const Tile& tile) const;

 private:
  void aim(const PixelBlock& pixels, int sample, RayBlock& rays, std::span<RayCone> cones) const;
  WithinPixels places_in_pixels(const PixelBlock& pixels, int sample) const;
  Vector2f place_on_lens(std::uint32_t pixel, int sample) const;
  Vector2f point_of_lights(std::uint32_t pixel, int sample) const;

  const Scene& scene_;
  const RenderSettings& settings_;
  const Slice& slice_;
  Image& image_;
  bool has_textures_;
};

}  // namespace raytracer
