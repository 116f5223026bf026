// Which files a scene may read at any time.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "scene_file/files.hpp"

namespace raytracer::scene_file {

/// As canonical paths, whether there is such a file or not: all that the scene's texts have in quotes,
/// evaluated or not, likewise the texts that they include at some time, and what meshes among these files
/// name. `further`: names that the caller gives to the scene.
std::vector<std::string> files_named(Files& files, std::span<const std::string> further);

}  // namespace raytracer::scene_file
