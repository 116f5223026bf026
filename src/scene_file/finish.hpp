// The last decisions about a scene: its camera, a light where none was given, and what looks like a slip.
#pragma once

#include <string>

#include "raytracer/scene_file.hpp"
#include "scene_file/diagnostics.hpp"
#include "scene_file/draft.hpp"

namespace raytracer::scene_file {

/// Completes the draft's scene and settings. A scene that doesn't depend on time needs no open shutter.
/// `name` is the scene's name in messages about the whole of it. Throws Error (kUsage) where the options ask
/// for a camera that is not there.
RenderSettings finish(SceneDraft& draft, const LoadOptions& options, const std::string& name,
                      bool depends_on_time, Diagnostics& diagnostics);

}  // namespace raytracer::scene_file
