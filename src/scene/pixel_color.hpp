// The paper's recursion, for one ray and for many at once.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/lanes.hpp"
#include "raytracer/scene.hpp"
#include "scene/shading_block.hpp"
#include "shapes/hit_block.hpp"

namespace raytracer {

/// Scene::get_pixel_color; adds the rays it traced to `rays`.
Color3f get_pixel_color(const Scene& scene, const Ray3f& ray, int bounces_left, std::uint64_t& rays);

/// What many rays are asked for. Rays that follow each other should start close together and go the same way.
struct RaysToTrace {
  std::span<const RayBlock> blocks;
  std::size_t count = 0;  ///< in all of them
  /// Per ray, the place in [0, 1)^2 on what shines from which light is looked for; none: the middle.
  std::span<const Vector2f> light_points{};
  /// Per ray, how much of the picture it stands for; none: a point.
  std::span<const RayCone> cones{};
};

/// The very same colours for many rays at once: all go one bounce, then all that are reflected the next, in
/// blocks that are shaded lane by lane, so that whatever is done to all can be done in vector instructions.
/// Keeps its memory from one call to the next.
class PixelColors {
 public:
  explicit PixelColors(const Scene& scene) : scene_(scene), shining_(scene.shining()) {}

  /// colors[i] becomes what ray i sees, each lane i % kBlockSize of its block.
  void trace(const RaysToTrace& rays, int bounces, std::span<ColorBlock> colors);

  /// How many rays that took so far.
  std::uint64_t rays() const { return rays_; }

 private:
  // All the rays that have been reflected equally often, and what they see. `parent` is the ray of the level
  // before from which a ray comes, `share` what it adds to that one.
  struct Level {
    std::size_t count = 0;
    std::vector<RayBlock> rays;
    std::vector<ColorBlock> share, colors;
    std::vector<std::uint32_t> parent;
    std::vector<RayCone> cones;
    std::vector<std::uint32_t> origin;  // the ray of the first level, where that matters; empty: the same

    void clear();
    void add(const Ray3f& ray, const Color3f& share_of_parent, std::uint32_t from);
  };
  // A block of a level that is to be shaded.
  struct Task;

  void shade(std::size_t depth, int bounces_left);
  void shade_block(const Task& task);
  void find_hits(const Task& task);
  void add_background(const Task& task);
  void gather(const Task& task);
  void gather(const Task& task, int first, const BlockMask& lanes);
  void look_at_layers(const Task& task, const BlockMask& lanes);
  void add_lights(const Task& task);
  void add_light(const Task& task, const Light& light, const BlockMask& lit);
  BlockMask find_hidden(const RayBlock& rays, const BlockMask& asked, Coherence coherence) const;
  void add_light_of_shapes(const Task& task, const BlockMask& lit);
  void reflect(const Task& task);
  const Vector2f* light_point(const Level& level, std::uint32_t ray) const;
  void add_to_parents(std::size_t depth);

  const Scene& scene_;
  const ShiningParts& shining_;
  std::uint64_t rays_ = 0;
  std::vector<Level> levels_;
  std::span<const Vector2f> light_points_;
  // Of the block that is being shaded. Zeros at first, so that idle lanes compute with numbers.
  HitBlock hits_{};
  BlockMask is_hit_{};
  ShadingBlock points_{};
};

}  // namespace raytracer
