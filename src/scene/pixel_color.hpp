// The paper's recursion with the account of its rays.
#pragma once

#include <cstdint>

#include "raytracer/scene.hpp"

namespace raytracer {

/// Scene::get_pixel_color; adds the rays it traced to `rays`.
Color3f get_pixel_color(const Scene& scene, const Ray3f& ray, int bounces_left, std::uint64_t& rays);

}  // namespace raytracer
