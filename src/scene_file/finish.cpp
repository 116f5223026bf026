#include "scene_file/finish.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "core/suggest.hpp"
#include "raytracer/error.hpp"
#include "scene_file/method.hpp"
#include "scene_file/slips.hpp"

namespace raytracer::scene_file {
namespace {

constexpr double kDefaultFov = 50;

struct FieldOfView {
  double half_width, half_height;  // tangents of the half angles
};

// A fisheye's picture shows angles, not tangents.
FieldOfView fisheye_view(const CameraDraft& camera, double aspect) {
  constexpr double kHalfSpace = 180;
  if (camera.vertical_fov_degrees) {
    const double half_height = glm::radians(*camera.vertical_fov_degrees) / 2;
    return {half_height * aspect, half_height};
  }
  const double half_width = glm::radians(camera.fov_degrees.value_or(kHalfSpace)) / 2;
  return {half_width, half_width / aspect};
}

FieldOfView field_of_view(const CameraDraft& camera, double aspect) {
  if (camera.optics.projection == Projection::kFisheye) return fisheye_view(camera, aspect);
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

// How far away is sharp. Nothing where the shape that shall be is not there, which has been reported.
std::optional<double> focus_distance(const CameraDraft& camera, const SceneDraft& draft,
                                     Diagnostics& diagnostics) {
  const Vector3d view = camera.look_at - camera.position;
  if (camera.focus_on.empty()) return camera.focus.value_or(glm::length(view));
  const auto shape = draft.named_shapes.find(camera.focus_on);
  if (shape == draft.named_shapes.end()) {
    std::vector<std::string_view> known;
    for (const auto& named : draft.named_shapes) known.push_back(named.first);
    const std::string_view nearest = nearest_word(camera.focus_on, known);
    diagnostics.error(camera.focus_place, fmt::format("there is no shape '{}'", camera.focus_on),
                      nearest.empty() ? "a shape's name stands in front of its brace: sphere ball { … }"
                                      : fmt::format("did you mean '{}'?", nearest));
    return std::nullopt;
  }
  const double distance = glm::dot(Vector3d(shape->second.center()) - camera.position, glm::normalize(view));
  if (distance > 0) return distance;
  diagnostics.error(camera.focus_place, fmt::format("'{}' lies behind the camera", camera.focus_on));
  return std::nullopt;
}

Optics optics_of(const CameraDraft& camera, const SceneDraft& draft, double aspect,
                 Diagnostics& diagnostics) {
  Optics optics = camera.optics;
  optics.focus_distance = focus_distance(camera, draft, diagnostics).value_or(1);
  // Two eyes share the picture's width.
  const double shape = optics.eye_distance > 0 ? aspect / 2 : aspect;
  const FieldOfView fov = field_of_view(camera, shape);
  optics.half_width = fov.half_width;
  optics.half_height = fov.half_height;
  if (optics.projection == Projection::kOrthographic) {
    const double distance = glm::length(camera.look_at - camera.position);
    optics.half_width = camera.width ? *camera.width / 2 : fov.half_width * distance;
    optics.half_height = optics.half_width / shape;
  }
  optics.cube_columns = shape < 3 ? 3 : 6;  // 3 to 2, or 6 to 1
  return optics;
}

// Whether a box lies wholly outside of the pyramid that a flat picture shows. An orthographic camera's is a
// prism; what a lens, or a second eye, sees besides is `reach` wider where it starts.
bool is_outside_of_view(const Box3f& box, const Camera& camera) {
  if (camera.sees_all_around()) return false;
  const Vector3d eye = camera.position(), forward = camera.forward(), right = camera.right(),
                 up = camera.up();
  if (camera.projection() == Projection::kOrthographic) {
    const auto is_beyond = [&](const Vector3d& normal, double most) {
      return std::ranges::all_of(corners(box), [&](const Vector3d& corner) {
        return glm::dot(corner - eye, normal) > most * glm::dot(normal, normal);
      });
    };
    return is_beyond(-forward, 0) || is_beyond(right, 1) || is_beyond(-right, 1) || is_beyond(up, 1) ||
           is_beyond(-up, 1);
  }
  const double width2 = glm::dot(right, right), height2 = glm::dot(up, up);
  const Vector3d normals[] = {forward, width2 * forward + right, width2 * forward - right,
                              height2 * forward + up, height2 * forward - up};
  for (const Vector3d& normal : normals) {
    const double reach = static_cast<double>(camera.reach()) * glm::length(normal);
    bool all_behind = true;
    for (const Vector3d& corner : corners(box)) {
      all_behind = all_behind && glm::dot(corner - eye, normal) < -reach;
    }
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
  settings.development.exposure = static_cast<float>(render.exposure);
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
  scene.camera =
      Camera(camera.position, camera.look_at, camera.up, optics_of(camera, draft, aspect, diagnostics));
  if (settings.method == Method::kPath) settings.development.exposure += static_cast<float>(camera.exposure);
  if (depends_on_time && camera.shutter > 0) {
    settings.shutter = camera.shutter / draft.fps;
    warn_of_ghosts(camera, settings.samples, diagnostics);
  }
  if (diagnostics.has_errors()) return settings;  // no warning follows from an error

  if (!has_light(scene, settings.method)) {
    add_headlight(scene);
    diagnostics.warning(name, "the scene has no light", "one shines from the camera");
  }
  warn_of_slips(draft, camera, settings.method, name, diagnostics);
  if (scene.shapes.empty() && scene.instances.empty()) {
    diagnostics.warning(name, "nothing is in view: the scene has no shapes", "sphere { }");
  } else if (!is_anything_in_view(scene)) {
    diagnostics.warning(name, "nothing is in view: no shape lies where the camera looks",
                        "turn the camera with 'look_at', or leave it out to see everything");
  }
  return settings;
}

}  // namespace raytracer::scene_file
