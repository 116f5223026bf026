// Where rays go from the eye, and how much of the picture each stands for.
#pragma once

#include "cameras/pinhole.hpp"
#include "raytracer/scene.hpp"
#include "render/tile.hpp"
#include "scene/shading_point.hpp"

namespace raytracer {

/// Points of sixteen pixels; (0, 0) is a pixel's upper left corner, (1, 1) its lower right one.
struct alignas(64) WithinPixels {
  float x[kBlockSize], y[kBlockSize];
};

PlaceBlock places_of(const PixelBlock& pixels, const WithinPixels& within, const Image& image);

/// The ray through the point `within` of a pixel and a point of the lens.
Ray3f camera_ray(const Scene& scene, const Image& image, const glm::ivec2& pixel, const Vector2f& within,
                 const Vector2f& lens);

/// Whether so few samples share a pixel that each has to stand for its part of it as exactly as can be.
constexpr bool are_few(int samples) { return samples < 16; }

/// Whether so many do that no part of it has to stand for itself.
constexpr bool are_many(int samples) { return samples > 64; }

/// How wide what that ray stands for is, one of as many samples of the pixel.
RayCone camera_cone(const Scene& scene, const Image& image, const glm::ivec2& pixel, const Vector2f& within,
                    const Vector2f& lens, const Ray3f& ray, int samples);

/// Likewise for all of many samples of a pixel, whose rays differ little in it.
RayCone pixel_cone(const Scene& scene, const Image& image, const glm::ivec2& pixel, int samples);

/// Whether anything needs those cones.
bool has_textures(const SceneDescription& scene);

}  // namespace raytracer
