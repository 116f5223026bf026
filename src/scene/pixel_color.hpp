// The paper's recursion, for one ray and for many at once.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "raytracer/scene.hpp"
#include "scene/shading_point.hpp"

namespace raytracer {

/// Scene::get_pixel_color; adds the rays it traced to `rays`.
Color3f get_pixel_color(const Scene& scene, const Ray3f& ray, int bounces_left, std::uint64_t& rays);

/// The very same colours for many rays at once: all go one bounce, then all that are reflected the next, so
/// that the shadow rays of each bounce can be traced in packets. Keeps its memory from one call to the next.
class PixelColors {
 public:
  explicit PixelColors(const Scene& scene) : scene_(scene), shining_(scene.shining()) {}

  /// colors[i] becomes what rays[i] sees; rays that follow each other should start close together and go the
  /// same way. light_points[i] in [0, 1)^2 is the place on what shines from which light is looked for;
  /// without them it is the middle.
  /// cones[i] is how much of the picture rays[i] stands for; without them it is a point.
  void trace(std::span<const Ray3f> rays, int bounces, std::span<Color3f> colors,
             std::span<const Vector2f> light_points = {}, std::span<const RayCone> cones = {});

  /// How many rays that took so far.
  std::uint64_t rays() const { return rays_; }

 private:
  // All the rays that have been reflected equally often, and what they see. `parent` is the ray of the level
  // before from which a ray comes, `share` what it adds to that one.
  struct Level {
    std::vector<Ray3f> rays;
    std::vector<std::uint32_t> parent;
    std::vector<Color3f> share;
    std::vector<Color3f> colors;
    std::vector<RayCone> cones;
    std::vector<std::uint32_t> origin;  // the ray of the first level, where that matters; empty: the same
  };
  // A point that the lights may reach, and what has arrived so far.
  struct LitPoint {
    ShadingPoint point;
    std::uint32_t ray;
    Color3f share;
    Color3f light;
  };

  // Shadow rays that wait until they are a packet, and the light that each lets pass to which lit point.
  struct ShadowRays {
    std::size_t count = 0;
    Ray3f rays[kMostRays];
    Color3f color[kMostRays];
    std::uint32_t to[kMostRays];
  };

  void shade(std::size_t depth, int bounces_left);
  void shade_hit(std::size_t depth, int bounces_left, std::uint32_t ray, Level* next);
  const Vector2f* light_point(const Level& level, std::uint32_t ray) const;
  void add_light_of_shapes(const Level& level);
  void find_hits(const std::vector<Ray3f>& rays, Coherence coherence);
  void add_light(const Light& light, Coherence coherence);
  void add_seen(ShadowRays& waiting);

  const Scene& scene_;
  const ShiningParts& shining_;
  std::uint64_t rays_ = 0;
  std::vector<Level> levels_;
  std::vector<Hit> hits_;
  std::vector<bool> is_hit_;
  std::vector<LitPoint> lit_;
  std::span<const Vector2f> light_points_;
};

}  // namespace raytracer
