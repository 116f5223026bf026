#include "raytracer/scene.hpp"

#include <algorithm>
#include <utility>

#include "raytracer/error.hpp"
#include "scene/accelerator.hpp"
#include "scene/light_set.hpp"
#include "scene/pixel_color.hpp"
#include "scene/shining_parts.hpp"
#include "scene/vertex_colors.hpp"
#include "shapes/hit_block.hpp"

namespace raytracer {

Scene::Scene(SceneDescription description) : description_(std::move(description)) {
  if (description_.material_of.size() != description_.shapes.size()) {
    throw Error(ErrorKind::kUsage, "a scene needs one material index per shape");
  }
  for (const std::uint32_t index : description_.material_of) {
    if (index >= description_.materials.size())
      throw Error(ErrorKind::kUsage, "a shape's material does not exist");
  }
  for (const Instance& instance : description_.instances) {
    if (instance.shared >= description_.shared.size()) {
      throw Error(ErrorKind::kUsage, "an instance's shapes do not exist");
    }
    if (instance.material != Instance::kOwnMaterials && instance.material >= description_.materials.size())
      throw Error(ErrorKind::kUsage, "an instance's material does not exist");
  }
  has_vertex_colors_ = any_vertex_colors(description_.shapes) ||
                       std::ranges::any_of(description_.shared,
                                           [](const auto& shared) { return shared->has_vertex_colors(); });
  accelerator_ =
      std::make_unique<Accelerator>(description_.shapes, description_.shared, description_.instances);
  has_meshes_ = accelerator_->has_meshes();
}

Scene::~Scene() = default;

bool Scene::is_hit(const Ray3f& ray, Hit& hit) const { return accelerator_->is_hit(ray, hit); }

bool Scene::is_occluded(const Ray3f& ray) const { return accelerator_->is_occluded(ray); }

BlockMask Scene::is_hit(const RayBlock& rays, const BlockMask& asked, HitBlock& hits,
                        Coherence coherence) const {
  return accelerator_->is_hit(rays, asked, hits, coherence);
}

BlockMask Scene::is_occluded(const RayBlock& rays, const BlockMask& asked, Coherence coherence) const {
  return accelerator_->is_occluded(rays, asked, coherence);
}

namespace {

RayBlock block_of(std::span<const Ray3f> rays) {
  RayBlock block{};
  for (std::size_t i = 0; i < rays.size(); ++i) block.set(static_cast<int>(i), rays[i]);
  return block;
}

}  // namespace

std::uint32_t Scene::is_hit(std::span<const Ray3f> rays, std::span<Hit> hits, Coherence coherence) const {
  HitBlock found;
  const BlockMask is_found = is_hit(block_of(rays), BlockMask::first(rays.size()), found, coherence);
  for (std::size_t i = 0; i < rays.size(); ++i) {
    if (is_found.has(static_cast<int>(i))) hits[i] = found.at(static_cast<int>(i));
  }
  return is_found.bits();
}

std::uint32_t Scene::is_occluded(std::span<const Ray3f> rays, Coherence coherence) const {
  return is_occluded(block_of(rays), BlockMask::first(rays.size()), coherence).bits();
}

void Scene::prefetch(const Hit& hit) const {
  const Shape& shape =
      hit.instance == kNoInstance
          ? *description_.shapes[hit.shape]
          : description_.shared[description_.instances[hit.instance].shared]->shape(hit.shape);
  if (const TriangleMesh* mesh = shape.as_mesh()) mesh->prefetch(hit.primitive);
}

void Scene::surfaces_at(const RayBlock& rays, const HitBlock& hits, const BlockMask& asked,
                        SurfaceBlock& surfaces) const {
  constexpr int kFew = 2;  // are done sooner one by one
  int first = 0;
  while (first < kBlockSize && !asked.has(first)) ++first;
  if (first == kBlockSize) return;
  if (hits.instance[first] == kNoInstance && asked.count() > kFew) {
    return description_.shapes[hits.shape[first]]->surfaces_at(rays, hits, asked, surfaces);
  }
  for (int i = first; i < kBlockSize; ++i) {
    if (asked.has(i)) surfaces.set(i, surface_at(rays.ray(i), hits.at(i)));
  }
}

Color3f Scene::get_pixel_color(const Ray3f& ray, int bounces_left) const {
  std::uint64_t rays = 0;
  return raytracer::get_pixel_color(*this, ray, bounces_left, rays);
}

const LightSet& Scene::lights() const {
  std::call_once(lights_gathered_, [this] { lights_ = std::make_unique<const LightSet>(description_); });
  return *lights_;
}

const ShiningParts& Scene::shining() const {
  std::call_once(shining_gathered_,
                 [this] { shining_ = std::make_unique<const ShiningParts>(description_); });
  return *shining_;
}

}  // namespace raytracer
