// Unbiased path tracing with next-event estimation and multiple importance sampling (Veach 1997, "Robust
// Monte Carlo methods for light transport simulation", chapters 9 and 10).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "integrators/matt_vertices.hpp"
#include "materials/bsdf.hpp"
#include "materials/media.hpp"
#include "raytracer/method.hpp"
#include "raytracer/scene.hpp"
#include "sampling/path_points.hpp"
#include "scene/light_set.hpp"
#include "scene/shading_point.hpp"
#include "scene/texture_queries.hpp"

namespace raytracer {

/// What of a render's settings its paths follow from.
struct PathSettings {
  int bounces = kUnlimitedBounces;
  Sampling sampling = Sampling::kBoth;
  float clamp_indirect = 0;
  std::uint32_t seed = 0;
};

/// The media around a point: what a path from there starts inside of.
Media media_at(const Scene& scene, const Vector3f& position);

/// What all paths through a scene have in common; found once for all tiles.
struct PathWorld {
  explicit PathWorld(const Scene& scene);

  bool has_cutouts;        ///< whether any material is there for some rays only
  bool has_media;          ///< whether any has an inside
  bool has_hidden_lights;  ///< whether any area light is not seen by the camera
  float weak;              ///< paths of less throughput may end
  Media media;             ///< around the eye
};

/// Follows many paths at once, bounce by bounce, so that the shadow rays of every depth are traced in
/// packets. Keeps its memory from one call to the next.
class PathTracer {
 public:
  /// All of them must outlive it.
  PathTracer(const Scene& scene, const PathSettings& settings, const PathPoints& points,
             const PathWorld& world);

  /// colors[i] becomes the radiance, 1 is white, that one path along rays[i], of unit direction, estimates.
  /// Its random numbers are those of numbers[i]; pair 0 of them has been spent on the picture and pair 1 on
  /// the lens. cones[i] is how much of the picture it stands for; without them it is a point.
  void trace(std::span<const Ray3f> rays, std::span<const RayCone> cones, std::span<const PathNumber> numbers,
             std::span<Color3f> colors);

  /// How many rays that took so far.
  std::uint64_t rays() const { return ray_count_; }

 private:
  struct Path {
    Ray3f ray;
    Color3f throughput{1};
    Vector3f from{0}, from_normal{0};  // where the ray's direction was chosen, as LightSet wants it
    float pdf = 0;             // of that choice; 0: the eye's or a mirror's, which no light could have chosen
    float radiance_scale = 1;  // what refractions have made of the throughput, for the roulette
    RaySpread spread;          // of the ray; the eye's have their cones besides
    std::uint32_t slot = 0;    // in colors, and in cones
    std::uint8_t splits = 0;   // how often it has become two
  };

  // Shadow rays that wait until they are a packet, and what each lets pass.
  struct ShadowRays {
    std::size_t count = 0;
    RayBlock rays{};
    Color3f light[kBlockSize];
    std::uint32_t slot[kBlockSize];
    Media media[kBlockSize];  // around their origins, where cut-outs and glass are about
  };

  // Vertices that wait to be shaded, and where the texture of their colours is asked.
  struct MattGroup {
    const MaterialTextures* textures = nullptr;  // null: their colours are known
    MattVertices vertices;
    TextureQueries queries;
  };

  // A path's latest hit, with all that shading needs.
  struct Vertex;

  Footprint footprint_of(const Path& path, float distance, int depth) const;
  void order_rays(int depth);
  void find_hits(int depth);
  void drop_missed(int depth);
  void keep_paths(const std::vector<std::uint8_t>& stays);
  void pass_through(Path& path, std::uint32_t index, int depth);
  bool is_passed(const Path& path, std::uint32_t index, int depth, std::uint32_t passes) const;
  void shade(int depth);
  void move_path(std::size_t from, std::size_t to);
  void split_strong();
  void shade_hit(std::uint32_t index, int depth);
  void ask_color(MattGroup& group, const Path& path, const Hit& hit);
  MattGroup* group_of(const MaterialTextures& textures, bool is_rough);
  MattGroup* new_group(const MaterialTextures& textures, bool is_rough);
  void shade_matt(MattGroup& group, int depth);
  bool shade_any(Path& path, const Material& material, const SurfacePoint& surface, std::uint32_t index,
                 int depth);
  void add_sky(const Path& path, int depth);
  void add_emission(const Path& path, const Vertex& vertex, int depth);
  void add_direct_light(const Path& path, const Vertex& vertex, const Bsdf& bsdf, std::uint32_t index,
                        int depth);
  void let_wait(const Ray3f& ray, Color3f light, std::uint32_t slot, const Media* media, int depth);
  bool scatter(Path& path, const Vertex& vertex, const Bsdf& bsdf, std::uint32_t index, int depth);
  float roulette(const Path& path, int depth, float u) const;
  void add(std::uint32_t slot, Color3f light, int depth);
  void add_unoccluded();
  float share_seen(Ray3f ray, const Media& media) const;
  void draw_points(int depth);

  const Scene& scene_;
  const PathSettings& settings_;
  const PathPoints& points_;
  const Media& media_;
  const LightSet& lights_;
  bool has_cutouts_, has_media_, has_hidden_lights_;
  float weak_;
  std::uint64_t ray_count_ = 0;

  std::vector<Path> paths_;  // those that go on; compacted after every bounce
  std::vector<PathNumber> numbers_;
  std::vector<Media> media_of_;  // likewise; empty where nothing is see-through
  std::vector<Hit> hits_;
  std::vector<std::uint8_t> is_hit_, goes_on_;
  std::vector<std::uint32_t> order_;  // of the rays as they are asked for
  std::vector<Vector2f> light_points_, choice_points_, scatter_points_, chance_points_;
  std::span<Color3f> colors_;
  std::span<const RayCone> cones_;  // empty where there are no textures
  ShadowRays waiting_;
  std::vector<MattGroup> groups_;  // the first is of known colours
  std::size_t group_count_ = 1;    // that are in use; each of the others has textures of its own
  LightSamples light_samples_{};
};

}  // namespace raytracer
