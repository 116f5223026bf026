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

namespace {

/// Around the middle of what it stands for.
RayCone cone_around(const Scene& scene, const Image& image, const glm::ivec2& pixel, const PixelShare& share,
                    const Vector2f& lens) {
  const double across = (pixel.x + static_cast<double>(share.middle.x)) / image.width;
  const double down = (pixel.y + static_cast<double>(share.middle.y)) / image.height;
  RayCone cone;
  cone.edges = scene.camera().differential(across, down, lens, static_cast<double>(share.edge) / image.width,
                                           static_cast<double>(share.edge) / image.height);
  cone.spread.width = glm::length(cone.edges.origin_dx);
  cone.spread.spread = glm::length(cone.edges.direction_dx);
  return cone;
}

}  // namespace

RayCone camera_cone(const Scene& scene, const Image& image, const glm::ivec2& pixel, const Vector2f& within,
                    const Vector2f& lens, const Ray3f& ray, int samples) {
  const PixelShare share = share_of(within, samples);
  RayCone cone = cone_around(scene, image, pixel, share, lens);
  const Ray3f middle = camera_ray(scene, image, pixel, share.middle, lens);
  cone.aside_origin = middle.origin - ray.origin;
  cone.aside_direction = middle.direction - ray.direction;
  cone.is_coarse = are_few(samples);
  return cone;
}

RayCone pixel_cone(const Scene& scene, const Image& image, const glm::ivec2& pixel, int samples) {
  const Vector2f middle(0.5F);
  return cone_around(scene, image, pixel, {middle, 1 / std::sqrt(static_cast<float>(samples))}, middle);
}

bool has_textures(const SceneDescription& scene) {
  return any_material(scene, [](const Material& material) { return material.textures != nullptr; });
}

}  // namespace raytracer
