// A scene: what is there, and what a ray sees of it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <vector>

#include "raytracer/camera.hpp"
#include "raytracer/light.hpp"
#include "raytracer/material.hpp"
#include "raytracer/shape.hpp"

namespace raytracer {

class Accelerator;
struct BlockMask;
struct HitBlock;
struct RayBlock;
struct SurfaceBlock;
class LightSet;
class ShiningParts;

/// How many rays a scene takes at once.
inline constexpr std::size_t kMostRays = 16;

/// Whether rays that are asked at once start close together and go the same way. It changes nothing but the
/// time taken.
enum class Coherence : std::uint8_t { kIncoherent, kCoherent };

/// Finite shapes with what they are made of, stored once with the tree over them, however many places in a
/// scene, and however many scenes, they stand in. Immutable.
class SharedShapes {
 public:
  /// `material_of` holds an index into `materials` per shape. Throws Error (kUsage) for an index or a shape
  /// that does not fit.
  SharedShapes(std::vector<std::unique_ptr<Shape>> shapes, std::vector<std::uint32_t> material_of,
               std::vector<Material> materials);
  ~SharedShapes();
  SharedShapes(const SharedShapes&) = delete;
  SharedShapes& operator=(const SharedShapes&) = delete;

  const Shape& shape(std::uint32_t index) const { return *shapes_[index]; }
  const Material& material_of(std::uint32_t shape) const { return materials_[material_of_[shape]]; }
  bool is_of_first_material(std::uint32_t shape) const { return material_of_[shape] == 0; }
  std::size_t size() const { return shapes_.size(); }
  const Box3f& bounds() const { return bounds_; }  ///< in the shapes' own space
  bool has_vertex_colors() const { return has_vertex_colors_; }
  const Accelerator& accelerator() const { return *accelerator_; }

 private:
  std::vector<std::unique_ptr<Shape>> shapes_;
  std::vector<std::uint32_t> material_of_;
  std::vector<Material> materials_;
  Box3f bounds_;
  bool has_vertex_colors_ = false;
  std::unique_ptr<Accelerator> accelerator_;
};

/// A place where shared shapes stand.
struct Instance {
  std::uint32_t shared = 0;  ///< an index into SceneDescription::shared
  glm::mat3 linear{1.0f};    ///< from the shapes' own space to the world
  Vector3f translation{0};
  static constexpr std::uint32_t kOwnMaterials = 0xFFFFFFFF;
  /// An index into SceneDescription::materials: what stands here for the first of the shared materials.
  std::uint32_t material = kOwnMaterials;

  bool is_identity() const { return linear == glm::mat3(1.0f) && translation == Vector3f(0); }
  Box3f bounds(const Box3f& own) const;  ///< a box in the world around a box in the shapes' own space
};

/// All that a Scene is made of.
struct SceneDescription {
  std::vector<std::unique_ptr<Shape>> shapes;
  std::vector<std::uint32_t> material_of;  ///< per shape, an index into materials
  std::vector<Material> materials;
  std::vector<std::shared_ptr<const SharedShapes>> shared;
  std::vector<Instance> instances;
  std::vector<Light> lights;
  Camera camera;
  Color3f background{0};                   ///< what a ray sees that hits nothing; 1 is white
  std::shared_ptr<const Environment> sky;  ///< in place of the background; null: none
  bool is_sky_visible = true;              ///< to the camera; where it is not, the camera sees the background
  Color3f ambient{0};  ///< light from everywhere on the diffuse share; 1 shows a surface in its own colour
  std::optional<float> epsilon;  ///< the paper's constant offset along the normal; without it the offset
                                 ///< follows the rounding error at the point

  /// Of a shape of the scene itself, or in one of its instances.
  const Material& material(std::uint32_t instance, std::uint32_t shape) const {
    if (instance == kNoInstance) return materials[material_of[shape]];
    const Instance& place = instances[instance];
    const SharedShapes& own = *shared[place.shared];
    const bool is_replaced = place.material != Instance::kOwnMaterials && own.is_of_first_material(shape);
    return is_replaced ? materials[place.material] : own.material_of(shape);
  }
};

/// How much around a hit textures are averaged over: of a bundle of rays, its cut at the hit. Scene units.
struct Footprint {
  float width = 0;        ///< across the ray, where nothing more is known
  Vector3f dx{0}, dy{0};  ///< the edges of what the ray stands for; 0: a square of that width
  /// From the hit to the middle of what the ray stands for, so that samples spread over a pixel average all
  /// of it, and none of it twice.
  Vector3f aside{0};
  bool is_coarse = false;  ///< few rays share the pixel that is averaged
  bool is_rough = false;   ///< as TexturePoint has it
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

  /// The very same for up to kMostRays rays at once; bit i of the result is the answer for ray i. `hits` is
  /// as long as `rays`.
  std::uint32_t is_hit(std::span<const Ray3f> rays, std::span<Hit> hits, Coherence coherence) const;
  std::uint32_t is_occluded(std::span<const Ray3f> rays, Coherence coherence) const;

  /// Likewise for the lanes of a block that are asked about; tells which of them are answered by yes.
  BlockMask is_hit(const RayBlock& rays, const BlockMask& asked, HitBlock& hits, Coherence coherence) const;
  BlockMask is_occluded(const RayBlock& rays, const BlockMask& asked, Coherence coherence) const;

  /// The paper's recursion: what the ray sees, in the 0..255 units of the buffers, following at most
  /// `bounces_left` reflections.
  Color3f get_pixel_color(const Ray3f& ray, int bounces_left) const;

  SurfacePoint surface_at(const Ray3f& ray, const Hit& hit) const {
    if (hit.instance != kNoInstance) return instance_surface_at(ray, hit);
    return description_.shapes[hit.shape]->surface_at(ray, hit);
  }
  /// Has the memory fetched that surface_at() will read, in time for somebody who asks a little later: of a
  /// big mesh next to nothing is in the processor's cache.
  void prefetch(const Hit& hit) const;
  /// Whether there is anything to fetch.
  bool has_meshes() const { return has_meshes_; }
  /// Likewise for lanes that have met the same shape, of the same instance.
  void surfaces_at(const RayBlock& rays, const HitBlock& hits, const BlockMask& asked,
                   SurfaceBlock& surfaces) const;
  SurfaceDetail detail_at(const Ray3f& ray, const Hit& hit) const {
    if (hit.instance != kNoInstance) return instance_detail_at(ray, hit);
    return description_.shapes[hit.shape]->detail_at(ray, hit);
  }
  const Material& material_of(const Hit& hit) const { return description_.material(hit.instance, hit.shape); }
  /// Its material with the values that its textures have there, averaged over the footprint. The surface's
  /// shading normal follows the material's normal map or bumps.
  MaterialValues textured(const Ray3f& ray, const Hit& hit, const Footprint& footprint,
                          SurfacePoint& surface) const;
  /// Where its textures are asked.
  TexturePoint texture_point(const Ray3f& ray, const Hit& hit, const Footprint& footprint,
                             const SurfacePoint& surface) const;
  /// The share of rays for which the surface is there.
  float alpha_at(const Ray3f& ray, const Hit& hit) const;

  /// All that shines; gathered when it is first asked for.
  const LightSet& lights() const;
  /// Likewise the shapes among it, as `classic` wants them.
  const ShiningParts& shining() const;

  /// Whether any mesh has colours at its vertices.
  bool has_vertex_colors() const { return has_vertex_colors_; }
  const SceneDescription& description() const { return description_; }
  const Camera& camera() const { return description_.camera; }

 private:
  SurfacePoint instance_surface_at(const Ray3f& ray, const Hit& hit) const;
  SurfaceDetail instance_detail_at(const Ray3f& ray, const Hit& hit) const;

  SceneDescription description_;
  std::unique_ptr<Accelerator> accelerator_;
  bool has_meshes_ = false, has_vertex_colors_ = false;
  mutable std::once_flag lights_gathered_;
  mutable std::unique_ptr<const LightSet> lights_;
  mutable std::once_flag shining_gathered_;
  mutable std::unique_ptr<const ShiningParts> shining_;
};

}  // namespace raytracer
