// What in a whole scene looks like a slip: valid, but surely not what was meant.
#pragma once

#include <string>

#include "raytracer/render.hpp"
#include "scene_file/diagnostics.hpp"
#include "scene_file/draft.hpp"

namespace raytracer::scene_file {

/// Whether any shape that is there gives off light.
bool has_shape_that_shines(const SceneDescription& scene);

/// Warns of lights, shapes that shine and cameras that stand where they can't be seen or see nothing, and of
/// scenes in the dark. `camera` is the chosen one, `name` the scene's.
void warn_of_slips(const SceneDraft& draft, const CameraDraft& camera, Method method, const std::string& name,
                   Diagnostics& diagnostics);

}  // namespace raytracer::scene_file
