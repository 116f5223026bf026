// `--set name=value`: the caller's values for top-level lets.
#pragma once

#include <span>
#include <string>

#include "raytracer/scene_file.hpp"
#include "scene_file/builder.hpp"

namespace raytracer::scene_file {

/// Hands the values to the builder. Throws Error (kUsage) for a value that can't be read.
void apply_settings(std::span<const Setting> settings, Files& files, Builder& builder);

/// After the scene was built: throws Error (kUsage) for a setting that replaced no `let`, listing those that
/// are there.
void check_settings(std::span<const Setting> settings, const Builder& builder);

/// A value as it would be written in a scene.
std::string to_source(const Value& value);

}  // namespace raytracer::scene_file
