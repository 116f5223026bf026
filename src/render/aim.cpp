#include "render/aim.hpp"

#include <bit>
#include <cmath>

#include "scene/any_material.hpp"

namespace raytracer {
namespace {

// 4^k samples lie in as many squares of the pixel, and each stands for its own; else each stands for as much
// around itself.
struct PixelShare {
  Vector2f middle;  // within the pixel
  float edge;
};

PixelShare share_of(const Vector2f& within, int samples) {
  const auto count = static_cast<unsigned>(samples);
  if (!std::has_single_bit(count) || std::countr_zero(count) % 2 != 0) {
    return {within, 1 / std::sqrt(static_cast<float>(samples))};
  }
  const auto squares = static_cast<float>(1U << static_cast<unsigned>(std::countr_zero(count) / 2));
  return {(glm::floor(within * squares) + 0.5F) / squares, 1 / squares};
}

}  // namespace

PlaceBlock places_of(const PixelBlock& pixels, const WithinPixels& within, const Image& image) {
  PlaceBlock places;
  const double width = image.width, height = image.height;
  for (int i = 0; i < kBlockSize; ++i) {
    places.x[i] = (pixels.x[i] + static_cast<double>(within.x[i])) / width;
    places.y[i] = (pixels.y[i] + static_cast<double>(within.y[i])) / height;
  }
  return places;
}

Ray3f camera_ray(const Scene& scene, const Image& image, const glm::ivec2& pixel, const Vector2f& within,
                 const Vector2f& lens) {
  const double across = (pixel.x + static_cast<double>(within.x)) / image.width;
  const double down = (pixel.y + static_cast<double>(within.y)) / image.height;
  return scene.camera().ray_through(across, down, lens);
}

RayCone camera_cone(const Scene& scene, const Image& image, const glm::ivec2& pixel, const Vector2f& within,
                    const Vector2f& lens, const Ray3f& ray, int samples) {
  const PixelShare share = share_of(within, samples);
  const double across = (pixel.x + static_cast<double>(share.middle.x)) / image.width;
  const double down = (pixel.y + static_cast<double>(share.middle.y)) / image.height;
  const Ray3f middle = scene.camera().ray_through(across, down, lens);
  RayCone cone;
  cone.aside_origin = middle.origin - ray.origin;
  cone.aside_direction = middle.direction - ray.direction;
  cone.edges = scene.camera().differential(across, down, lens, static_cast<double>(share.edge) / image.width,
                                           static_cast<double>(share.edge) / image.height);
  constexpr int kFew = 16;
  cone.is_coarse = samples < kFew;
  cone.width = glm::length(cone.edges.origin_dx);
  cone.spread = glm::length(cone.edges.direction_dx);
  return cone;
}

bool has_textures(const SceneDescription& scene) {
  return any_material(scene, [](const Material& material) { return material.textures != nullptr; });
}

}  // namespace raytracer
