// `method path`, tile by tile.
#pragma once

#include <cstdint>

#include "integrators/path_tracer.hpp"
#include "raytracer/render.hpp"
#include "render/tile.hpp"

namespace raytracer {

/// Renders the samples of one slice of time by path tracing. Any number of threads may call it.
class PathRenderer {
 public:
  PathRenderer(const Scene& scene, const RenderSettings& settings, const Slice& slice, Image& image);

  /// Adds to the tile's pixels; returns how many rays that took.
  std::uint64_t render(const Tile& tile) const;

 private:
  struct Batch;

  void set_up(Batch& batch, int first_sample, int end_sample) const;
  void aim(Batch& batch, std::size_t samples) const;
  void set_cones(Batch& batch, std::size_t samples) const;

  const Scene& scene_;
  const RenderSettings& settings_;
  const Slice& slice_;
  Image& image_;
  PathSettings paths_;
  PathPoints points_;
  bool has_textures_;
  PathWorld world_;
};

}  // namespace raytracer
