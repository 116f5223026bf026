// A scene while it is being built: what the blocks said, before the last decisions are made.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "raytracer/render.hpp"
#include "raytracer/scene.hpp"
#include "scene_file/schema.hpp"
#include "scene_file/source.hpp"
#include "scene_file/syntax.hpp"

namespace raytracer::scene_file {

/// `camera`, as written, placed in the world.
struct CameraDraft {
  std::string name;
  Place place;
  Vector3d position{0}, look_at{0}, up{0, 1, 0};
  std::optional<double> fov_degrees, vertical_fov_degrees;  ///< at most one of them
  double shutter = 0;                                       ///< the share of a frame's time that it is open
};

struct RenderDraft {
  Method method = Method::kClassic;
  int samples = 1;
  int bounces = 8;
  std::optional<double> epsilon;
  int seed = 0;
  ColorValue ambient{Vector3d(0)};
};

struct SceneDraft {
  SceneDescription scene;
  std::array<int, 2> image_size{960, 540};
  std::vector<CameraDraft> cameras;
  RenderDraft render;
  double duration = 0, fps = 24;  ///< of `animation`
  Arena nodes;                    ///< of nodes put together while building
};

}  // namespace raytracer::scene_file
