// A material where a ray has met it.
#pragma once

#include "raytracer/material.hpp"
#include "raytracer/shape.hpp"
#include "raytracer/texture.hpp"
#include "textures/texture_block.hpp"

namespace raytracer {

/// The material's values, those of its textures there in place of its own, in their ranges.
MaterialValues material_at(const Material& material, const TexturePoint& point);

/// Whether textures say its colour and nothing else: all else is the same everywhere.
bool varies_in_color_alone(const MaterialTextures& textures);

/// What a texture for its colour makes of that colour.
Color3f color_at(const Texture& color, const TexturePoint& point);
/// Likewise of as many as a block holds.
void colors_at(const Texture& color, const TextureBlock& points, ColorBlock& colors);

/// How much of the surface is there, 0..1: alpha alone, for rays that ask only for that.
float alpha_at(const Material& material, const TexturePoint& point);

/// What shines from there on average, 1 is white: the emission, as far as the surface is there.
Color3f emitted_at(const Material& material, const TexturePoint& point);

/// The shading normal after the material's normal map and bump, unit length, on the same side of the surface.
/// `normal` is the shading normal before. Where the surface has no u and v directions a normal map does
/// nothing and bump follows the position alone.
Vector3f perturbed_normal(const Material& material, const SurfaceDetail& detail, const TexturePoint& point,
                          const Vector3f& normal);

}  // namespace raytracer
