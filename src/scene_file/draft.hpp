// A scene while it is being built: what the blocks said, before the last decisions are made.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <unordered_map>
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
  std::optional<double> width;                              ///< of what an orthographic one shows
  Optics optics;                ///< but for what follows from the picture's shape, and the focus
  std::optional<double> focus;  ///< else the distance to look_at
  std::string focus_on;         ///< the name of a shape; empty: none
  Place focus_place;
  double exposure = 0;  ///< stops, by iso, shutter_speed and f_number
  double shutter = 0;   ///< the share of a frame's time that it is open
};

/// `render`, as written; what was not depends on the method.
struct RenderDraft {
  Method method = Method::kClassic;
  std::optional<int> samples, bounces;
  Sampling sampling = Sampling::kBoth;
  double clamp = 0;
  std::optional<double> epsilon;
  int seed = 0;
  ColorValue ambient{Vector3d(0)};
  double exposure = 0;
  Tone tone = Tone::kNone;
  Vector3d white{1};
  /// The properties that mean something to one method only and were given.
  struct Word {
    std::string_view name;
    Method method = Method::kClassic;
    Place place;
  };
  std::vector<Word> particular;
};

struct SceneDraft {
  SceneDescription scene;
  std::unordered_map<std::string, Box3f> named_shapes;  ///< the first of each name, world space
  std::array<int, 2> image_size{960, 540};
  std::vector<CameraDraft> cameras;
  RenderDraft render;
  std::vector<Place> light_places;  ///< of the scene's lights, in their order
  /// Of shapes that shine and stand by themselves, as many as messages may need.
  std::unordered_map<const Shape*, Place> shining_places;
  double duration = 0, fps = 24;  ///< of `animation`
  Arena nodes;                    ///< of nodes put together while building
};

}  // namespace raytracer::scene_file
