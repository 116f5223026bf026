#include "scene_file/finish.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "raytracer/error.hpp"
#include "scene_file/method.hpp"

namespace raytracer::scene_file {
namespace {

constexpr double kDefaultFov = 50;

struct FieldOfView {
  double half_width, half_height;  // tangents of the half angles
};

FieldOfView field_of_view(const CameraDraft& camera, double aspect) {
  if (camera.vertical_fov_degrees) {
    const double half_height = std::tan(glm::radians(*camera.vertical_fov_degrees) / 2);
    return {half_height * aspect, half_height};
  }
  const double half_width = std::tan(glm::radians(camera.fov_degrees.value_or(kDefaultFov)) / 2);
  return {half_width, half_width / aspect};
}

std::array<Vector3d, 8> corners(const Box3f& box) {
  std::array<Vector3d, 8> points;
  for (std::size_t i = 0; i < 8; ++i) {
    points[i] = {(i & 1U) != 0 ? box.upper.x : box.lower.x, (i & 2U) != 0 ? box.upper.y : box.lower.y,
                 (i & 4U) != 0 ? box.upper.z : box.lower.z};
  }
  return points;
}

// A camera from the front, a little from above and the right, just far enough away to see all finite shapes.
CameraDraft framing_camera(const SceneDescription& scene, double aspect) {
  Box3f box;
  for (const auto& shape : scene.shapes) {
    const Box3f bounds = shape->bounds();
    if (bounds.is_finite()) box.extend(bounds);
  }
  for (const Instance& instance : scene.instances)
    box.extend(instance.bounds(scene.shared[instance.shared]->bounds()));
  if (box.is_empty()) box = {Vector3f(-1), Vector3f(1)};
  CameraDraft camera;
  const FieldOfView fov = field_of_view(camera, aspect);
  const Vector3d middle = box.center();
  const Vector3d back = glm::normalize(Vector3d(0.35, 0.3, 1));
  const Vector3d right = glm::normalize(glm::cross(Vector3d(0, 1, 0), back));
  const Vector3d up = glm::cross(back, right);
  double distance = 0;
  for (const Vector3d& corner : corners(box)) {
    const Vector3d p = corner - middle;
    const double across =
        std::max(std::abs(glm::dot(p, right)) / fov.half_width, std::abs(glm::dot(p, up)) / fov.half_height);
    distance = std::max(distance, glm::dot(p, back) + across);
  }
  constexpr double kMargin = 1.05;
  camera.position = middle + kMargin * distance * back;
  camera.look_at = middle;
  return camera;
}

const CameraDraft& chosen_camera(const SceneDraft& draft, const std::string& name) {
  if (name.empty()) return draft.cameras.front();
  std::vector<std::string> known;
  for (const CameraDraft& camera : draft.cameras) {
    if (camera.name == name) return camera;
    if (!camera.name.empty()) known.push_back(camera.name);
  }
  throw Error(ErrorKind::kUsage,
              fmt::format("the scene has no camera '{}'; {}", name,
                          known.empty() ? "none of its cameras has a name"
                                        : fmt::format("it has {}", fmt::join(known, ", "))));
}

// Whether a box lies wholly outside of the pyramid that the camera sees.
bool is_outside_of_view(const Box3f& box, const Camera& camera) {
  const Vector3d eye = camera.position(), forward = camera.forward(), right = camera.right(),
                 up = camera.up();
  const double width2 = glm::dot(right, right), height2 = glm::dot(up, up);
  const Vector3d normals[] = {forward, width2 * forward + right, width2 * forward - right,
                              height2 * forward + up, height2 * forward - up};
  for (const Vector3d& normal : normals) {
    bool all_behind = true;
    for (const Vector3d& corner : corners(box)) all_behind = all_behind && glm::dot(corner - eye, normal) < 0;
    if (all_behind) return true;
  }
  return false;
}

// Whether any ray of a coarse grid over the picture meets an endless shape.
bool sees_endless_shape(const Shape& shape, const Camera& camera) {
  constexpr int kGrid = 16;
  Hit hit;
  for (int y = 0; y <= kGrid; ++y) {
    for (int x = 0; x <= kGrid; ++x) {
      if (shape.is_hit(camera.ray_through(x / double{kGrid}, y / double{kGrid}), hit)) return true;
    }
  }
  return false;
}

bool is_anything_in_view(const SceneDescription& scene) {
  for (const auto& shape : scene.shapes) {
    const Box3f bounds = shape->bounds();
    if (bounds.is_finite() ? !is_outside_of_view(bounds, scene.camera)
                           : sees_endless_shape(*shape, scene.camera)) {
      return true;
    }
  }
  return std::ranges::any_of(scene.instances, [&](const Instance& instance) {
    return !is_outside_of_view(instance.bounds(scene.shared[instance.shared]->bounds()), scene.camera);
  });
}

// Each sample shows a moment of its own.
void warn_of_ghosts(const CameraDraft& camera, int samples, Diagnostics& diagnostics) {
  constexpr int kFewestSamples = 8;
  if (samples >= kFewestSamples) return;
  diagnostics.warning(camera.place,
                      samples == 1 ? "with 1 sample an open shutter blurs nothing"
                                   : fmt::format("motion blur with {0} samples shows {0} ghosts", samples),
                      "samples 16");
}

// What the settings say for either method, and what the caller says over their head.
RenderSettings settings_of(const SceneDraft& draft, const LoadOptions& options) {
  constexpr int kPathSamples = 64, kClassicSamples = 1, kClassicBounces = 8;
  const RenderDraft& render = draft.render;
  RenderSettings settings;
  settings.width = options.width.value_or(draft.image_size[0]);
  settings.height = options.height.value_or(draft.image_size[1]);
  settings.method = options.method.value_or(render.method);
  const bool is_path = settings.method == Method::kPath;
  settings.samples =
      options.samples.value_or(render.samples.value_or(is_path ? kPathSamples : kClassicSamples));
  settings.bounces =
      options.bounces.value_or(render.bounces.value_or(is_path ? kUnlimitedBounces : kClassicBounces));
  settings.sampling = render.sampling;
  settings.clamp_indirect = static_cast<float>(render.clamp);
  settings.seed = options.seed.value_or(static_cast<std::uint32_t>(render.seed));
  settings.development.is_linear = is_path;
  if (!is_path) return settings;  // its values are what the picture shows
  settings.development.exposure = static_cast<float>(options.exposure.value_or(render.exposure));
  settings.development.tone = render.tone;
  settings.development.white = Color3f(render.white);
  return settings;
}

// Whoever looks at a scene by the other method for once knows that some words are for the first.
void warn_of_other_methods_words(const RenderDraft& render, const LoadOptions& options,
                                 Diagnostics& diagnostics) {
  if (options.method) return;
  for (const RenderDraft::Word& word : render.particular) {
    if (word.method == render.method) continue;
    const std::string_view wanted = kMethodWords[static_cast<std::size_t>(word.method)];
    diagnostics.warning(word.place,
                        fmt::format("'{}' is for method {} and has no effect in method {}", word.name, wanted,
                                    kMethodWords[static_cast<std::size_t>(render.method)]),
                        fmt::format("render {{ method {} }}", wanted));
  }
}

bool has_shape_that_shines(const SceneDescription& scene) {
  const auto shines = [](const Material& material) { return material.is_emissive(); };
  if (std::ranges::any_of(scene.materials, shines) &&
      std::ranges::any_of(scene.material_of, [&](std::uint32_t i) { return shines(scene.materials[i]); })) {
    return true;
  }
  return std::ranges::any_of(scene.shared, [&](const auto& shared) {
    for (std::uint32_t i = 0; i < shared->size(); ++i) {
      if (shines(shared->material_of(i))) return true;
    }
    return false;
  });
}

// Whether light comes from anywhere. In `path` the background shines, too.
bool has_light(const SceneDescription& scene, Method method) {
  if (!scene.lights.empty() || scene.sky != nullptr || has_shape_that_shines(scene)) return true;
  return (method == Method::kPath ? scene.background : scene.ambient) != Color3f(0);
}

void add_headlight(SceneDescription& scene) {
  // Without falloff the surface nearest to the eye is white if it faces it, however far away it is.
  Light headlight;
  headlight.position = scene.camera.position();
  headlight.falloff = Falloff::kNone;
  scene.lights.push_back(headlight);
}

}  // namespace

RenderSettings finish(SceneDraft& draft, const LoadOptions& options, const std::string& name,
                      bool depends_on_time, Diagnostics& diagnostics) {
  RenderSettings settings = settings_of(draft, options);
  warn_of_other_methods_words(draft.render, options, diagnostics);

  SceneDescription& scene = draft.scene;
  if (draft.render.epsilon) scene.epsilon = static_cast<float>(*draft.render.epsilon);
  scene.ambient = Color3f(draft.render.ambient.rgb);

  const double aspect = static_cast<double>(settings.width) / settings.height;
  if (draft.cameras.empty()) {
    draft.cameras.push_back(framing_camera(scene, aspect));
    diagnostics.warning(name, "the scene has no camera", "one is placed so that all shapes are in view");
  }
  const CameraDraft& camera = chosen_camera(draft, options.camera);
  const FieldOfView fov = field_of_view(camera, aspect);
  scene.camera = Camera(camera.position, camera.look_at, camera.up, fov.half_width, fov.half_height);
  if (depends_on_time && camera.shutter > 0) {
    settings.shutter = camera.shutter / draft.fps;
    warn_of_ghosts(camera, settings.samples, diagnostics);
  }

  if (!has_light(scene, settings.method)) {
    add_headlight(scene);
    diagnostics.warning(name, "the scene has no light", "one shines from the camera");
  }
  if (scene.shapes.empty() && scene.instances.empty()) {
    diagnostics.warning(name, "nothing is in view: the scene has no shapes", "sphere { }");
  } else if (!is_anything_in_view(scene)) {
    diagnostics.warning(name, "nothing is in view: no shape lies where the camera looks",
                        "turn the camera with 'look_at', or leave it out to see everything");
  }
  return settings;
}

}  // namespace raytracer::scene_file
