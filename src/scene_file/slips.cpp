#include "scene_file/slips.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <functional>
#include <vector>

#include "materials/media.hpp"

namespace raytracer::scene_file {

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

namespace {

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

constexpr std::size_t kMostPairs = 2'000'000;  // of a light and a shape; more take too long

// What keeps light in.
struct Cover {
  bool is_there = false;
  bool is_glass = false;
};

Cover cover_of(const SceneDescription& scene, const Vector3f& point) {
  Cover cover;
  for (std::size_t s = 0; s < scene.shapes.size(); ++s) {
    const Material& material = scene.materials[scene.material_of[s]];
    const bool is_glass = has_inside(material) && material.alpha == 1;
    if (!is_glass && lets_light_pass(material)) continue;
    if (!encloses(*scene.shapes[s], point)) continue;
    if (is_within(scene.shapes[s]->bounds(), Vector3f(scene.camera.position()))) continue;
    cover.is_there = true;
    cover.is_glass = is_glass;
    if (!is_glass) return cover;
  }
  return cover;
}

// A lamp in an opaque ball shines into that ball alone, which is seen only from within. Through glass a path
// meets no light that has no size.
void warn_of_buried_lights(const SceneDraft& draft, Method method, Diagnostics& diagnostics) {
  const SceneDescription& scene = draft.scene;
  if (scene.lights.size() * scene.shapes.size() > kMostPairs) return;
  for (std::size_t i = 0; i < std::min(scene.lights.size(), draft.light_places.size()); ++i) {
    const Light& light = scene.lights[i];
    if (light.kind == Light::Kind::kDirectional) continue;
    const Cover cover = cover_of(scene, light.position);
    if (!cover.is_there) continue;
    if (!cover.is_glass) {
      diagnostics.warning(draft.light_places[i], "the light stands inside a closed shape, which hides it",
                          "give the shape a material with 'emission' to see it shine");
    } else if (method == Method::kPath) {
      diagnostics.warning(draft.light_places[i],
                          "no path finds a light without size through the glass around it",
                          "a small sphere with 'emission' shines through glass");
    }
  }
}

bool is_emitter(const SceneDescription& scene, std::size_t shape) {
  return scene.materials[scene.material_of[shape]].is_emissive() && scene.shapes[shape]->bounds().is_finite();
}

std::array<Vector3f, 8> corners_of(const Box3f& box) {
  std::array<Vector3f, 8> corners;
  for (unsigned i = 0; i < corners.size(); ++i) {
    corners[i] = {(i & 1U) != 0 ? box.upper.x : box.lower.x, (i & 2U) != 0 ? box.upper.y : box.lower.y,
                  (i & 4U) != 0 ? box.upper.z : box.lower.z};
  }
  return corners;
}

// Likewise what shines.
void warn_of_buried_shapes(const SceneDraft& draft, const std::string& name, Diagnostics& diagnostics) {
  const SceneDescription& scene = draft.scene;
  std::vector<std::size_t> emitters;
  for (std::size_t i = 0; i < scene.shapes.size(); ++i) {
    if (is_emitter(scene, i)) emitters.push_back(i);
  }
  if (emitters.size() * scene.shapes.size() > kMostPairs / 8) return;
  const auto is_hidden = [&](std::size_t emitter) {
    return std::ranges::all_of(corners_of(scene.shapes[emitter]->bounds()), [&](const Vector3f& corner) {
      const Cover cover = cover_of(scene, corner);
      return cover.is_there && !cover.is_glass;
    });
  };
  std::erase_if(emitters, std::not_fn(is_hidden));
  if (emitters.empty()) return;
  const std::string message =
      emitters.size() == 1
          ? "a shape that shines stands inside a closed shape, which hides it"
          : fmt::format("{} shapes that shine stand inside closed shapes, which hide them", emitters.size());
  const char* const hint = "give the outer shape a material with 'transmission', or move one of them";
  const auto place = draft.shining_places.find(scene.shapes[emitters.front()].get());
  if (place == draft.shining_places.end()) return diagnostics.warning(name, message, hint);
  diagnostics.warning(place->second, message, hint);
}

// A camera in an opaque shape with no light in it. With a light that is a room.
void warn_of_buried_camera(const SceneDescription& scene, const CameraDraft& camera, const std::string& name,
                           Diagnostics& diagnostics) {
  const Vector3f eye(camera.position);
  for (std::size_t s = 0; s < scene.shapes.size(); ++s) {
    const Material& material = scene.materials[scene.material_of[s]];
    if (lets_light_pass(material) || material.is_emissive() || !encloses(*scene.shapes[s], eye)) continue;
    const Box3f room = scene.shapes[s]->bounds();
    const auto is_in_room = [&](const Light& light) {
      return light.kind != Light::Kind::kDirectional && is_within(room, light.position);
    };
    if (std::ranges::any_of(scene.lights, is_in_room) || scene.ambient != Color3f(0)) continue;
    bool has_emitter = false;
    for (std::size_t i = 0; i < scene.shapes.size() && !has_emitter; ++i) {
      has_emitter = is_emitter(scene, i) && is_within(room, scene.shapes[i]->bounds().center());
    }
    if (has_emitter) continue;
    constexpr const char* kMessage = "the camera stands inside a closed shape that no light gets into";
    constexpr const char* kHint = "move it out with 'position'";
    if (camera.place.source == nullptr) return diagnostics.warning(name, kMessage, kHint);
    return diagnostics.warning(camera.place, kMessage, kHint);
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

}  // namespace

void warn_of_slips(const SceneDraft& draft, const CameraDraft& camera, Method method, const std::string& name,
                   Diagnostics& diagnostics) {
  warn_of_darkness(draft.scene, name, diagnostics);
  warn_of_buried_lights(draft, method, diagnostics);
  warn_of_buried_shapes(draft, name, diagnostics);
  warn_of_buried_camera(draft.scene, camera, name, diagnostics);
  warn_of_camera_in_glass(draft.scene, camera, name, diagnostics);
}

}  // namespace raytracer::scene_file
