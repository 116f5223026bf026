#include "scene_file/finish.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "core/suggest.hpp"
#include "raytracer/error.hpp"
#include "scene_file/method.hpp"

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

bool has_shape_that_shines(const SceneDescription& scene) {
  const auto shines = [](const Material& material) { return material.is_emissive(); };
  if (std::ranges::any_of(scene.materials, shines) &&
      std::ranges::any_of(scene.material_of, [&](std::uint32_t i) { return shines(scene.materials[i]); })) {
    return true;
  }
  const auto shines_here = [&](const Instance& instance) {
    return instance.material != Instance::kOwnMaterials && shines(scene.materials[instance.material]);
  };
  if (std::ranges::any_of(scene.instances, shines_here)) return true;
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

// --- what looks like a slip -------------------------------------------------------------------------------

bool is_within(const Box3f& box, const Vector3f& point) {
  return glm::all(glm::greaterThan(point, box.lower)) && glm::all(glm::lessThan(point, box.upper));
}

// Whether a finite shape encloses the point: seen from there it shows its inside in all directions. An open
// cylinder does not, and neither does a sheet.
bool encloses(const Shape& shape, const Vector3f& point) {
  const Box3f box = shape.bounds();
  if (!box.is_finite() || !is_within(box, point)) return false;
  constexpr float kAside = 0.123f;  // edges and seams lie along the axes
  for (int axis = 0; axis < 3; ++axis) {
    for (const float side : {-1.0f, 1.0f}) {
      Ray3f ray{point, Vector3f(kAside, 0.7f * kAside, -0.4f * kAside)};
      ray.direction[axis] = side;
      Hit hit;
      if (!shape.is_hit(ray, hit)) return false;
      if (glm::dot(shape.surface_at(ray, hit).normal, ray.direction) < 0) return false;
    }
  }
  return true;
}

bool lets_light_out(const Material& material) {
  return material.transmission > 0 || material.alpha < 1 ||
         (material.textures != nullptr && (material.textures->alpha || material.textures->transmission));
}

// A lamp in an opaque ball shines into that ball alone, which is seen only from within.
void warn_of_buried_lights(const SceneDraft& draft, Diagnostics& diagnostics) {
  constexpr std::size_t kMostPairs = 2'000'000;  // of a light and a shape; more take too long
  const SceneDescription& scene = draft.scene;
  if (scene.lights.size() * scene.shapes.size() > kMostPairs) return;
  for (std::size_t i = 0; i < std::min(scene.lights.size(), draft.light_places.size()); ++i) {
    const Light& light = scene.lights[i];
    if (light.kind == Light::Kind::kDirectional) continue;
    for (std::size_t s = 0; s < scene.shapes.size(); ++s) {
      if (lets_light_out(scene.materials[scene.material_of[s]])) continue;
      if (!encloses(*scene.shapes[s], light.position)) continue;
      if (is_within(scene.shapes[s]->bounds(), Vector3f(scene.camera.position()))) continue;
      diagnostics.warning(draft.light_places[i], "the light stands inside a closed shape, which hides it",
                          "give the shape a material with 'emission' to see it shine");
      break;
    }
  }
}

void warn_of_camera_in_glass(const SceneDescription& scene, const CameraDraft& camera,
                             const std::string& name, Diagnostics& diagnostics) {
  for (std::size_t s = 0; s < scene.shapes.size(); ++s) {
    const Material& material = scene.materials[scene.material_of[s]];
    if (material.transmission == 0 || material.thin) continue;
    if (!encloses(*scene.shapes[s], Vector3f(camera.position))) continue;
    constexpr const char* kMessage = "the camera stands inside a shape that lets light in";
    constexpr const char* kHint = "it sees as an eye under water does";
    if (camera.place.source == nullptr) return diagnostics.warning(name, kMessage, kHint);
    return diagnostics.warning(camera.place, kMessage, kHint);
  }
}

// Whether no light has any strength although there are some.
void warn_of_darkness(const SceneDescription& scene, const std::string& name, Diagnostics& diagnostics) {
  const bool is_dark =
      std::ranges::all_of(scene.lights, [](const Light& l) { return l.lambda == Color3f(0); });
  const bool is_lit = !is_dark || scene.sky != nullptr || scene.ambient != Color3f(0) ||
                      scene.background != Color3f(0) || has_shape_that_shines(scene);
  if (is_lit) return;
  diagnostics.warning(name, "the picture will be black: no light has any strength",
                      "light { intensity 1000 }");
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

  if (!has_light(scene, settings.method)) {
    add_headlight(scene);
    diagnostics.warning(name, "the scene has no light", "one shines from the camera");
  }
  warn_of_darkness(scene, name, diagnostics);
  warn_of_buried_lights(draft, diagnostics);
  warn_of_camera_in_glass(scene, camera, name, diagnostics);
  if (scene.shapes.empty() && scene.instances.empty()) {
    diagnostics.warning(name, "nothing is in view: the scene has no shapes", "sphere { }");
  } else if (!is_anything_in_view(scene)) {
    diagnostics.warning(name, "nothing is in view: no shape lies where the camera looks",
                        "turn the camera with 'look_at', or leave it out to see everything");
  }
  return settings;
}

}  // namespace raytracer::scene_file
