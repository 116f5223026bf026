// A scene: what is there, and what a ray sees of it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "raytracer/camera.hpp"
#include "raytracer/light.hpp"
#include "raytracer/material.hpp"
#include "raytracer/shape.hpp"

namespace raytracer {

class Accelerator;

/// How many rays a scene takes at once.
inline constexpr std::size_t kMostRays = 16;

/// Whether rays that are asked at once start close together and go the same way. It changes nothing but the time taken.
enum class Coherence : std::uint8_t { kIncoherent, kCoherent };

/// All that a Scene is made of.
struct SceneDescription {
  std::vector<std::unique_ptr<Shape>> shapes;
  std::vector<std::uint32_t> material_of;  ///< per shape, an index into materials
  std::vector<Material> materials;
  std::vector<Light> lights;
  Camera camera;
  Color3f background{0};         ///< what a ray sees that hits nothing; 1 is white
  Color3f ambient{0};            ///< light from everywhere on the diffuse share; 1 shows a surface in its own colour
  std::optional<float> epsilon;  ///< the paper's constant offset along the normal; without it the offset follows
                                 ///< the rounding error at the point
};

/// Immutable: any number of threads may ask it at once.
class Scene {
 public:
  explicit Scene(SceneDescription description);
  ~Scene();
  Scene(const Scene&) = delete;
  Scene& operator=(const Scene&) = delete;

  /// The nearest shape along the ray.
  bool is_hit(const Ray3f& ray, Hit& hit) const;

  /// Whether anything lies on the ray between t_min and t_max.
  bool is_occluded(const Ray3f& ray) const;

  /// The very same for up to kMostRays rays at once; bit i of the result is the answer for ray i. `hits` is as long as
  /// `rays`.
  std::uint32_t is_hit(std::span<const Ray3f> rays, std::span<Hit> hits, Coherence coherence) const;
  std::uint32_t is_occluded(std::span<const Ray3f> rays, Coherence coherence) const;

  /// The paper's recursion: what the ray sees, in the 0..255 units of the buffers, following at most `bounces_left`
  /// reflections.
  Color3f get_pixel_color(const Ray3f& ray, int bounces_left) const;

  SurfacePoint surface_at(const Ray3f& ray, const Hit& hit) const {
    return description_.shapes[hit.shape]->surface_at(ray, hit);
  }
  const Material& material_of(const Hit& hit) const {
    return description_.materials[description_.material_of[hit.shape]];
  }
  const SceneDescription& description() const { return description_; }
  const Camera& camera() const { return description_.camera; }

 private:
  SceneDescription description_;
  std::unique_ptr<Accelerator> accelerator_;
};

}  // namespace raytracer
