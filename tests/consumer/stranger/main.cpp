// A red ball, lit from where it is looked at; written as a picture by a program that knows only the installed
// library.
#include <cmath>
#include <cstdio>
#include <memory>
#include <raytracer/error.hpp>
#include <raytracer/render.hpp>
#include <raytracer/shapes.hpp>

namespace rt = raytracer;

static std::shared_ptr<const rt::Scene> make_scene() {
  rt::SceneDescription scene;
  scene.shapes.push_back(rt::make_sphere({0, 0, 0}, 1));
  rt::Material terracotta;
  terracotta.color = {0.8f, 0.4f, 0.2f};
  scene.materials.push_back(terracotta);
  scene.material_of.push_back(0);
  rt::Light light;
  light.position = {0, 0, 3};
  scene.lights.push_back(light);
  scene.camera = rt::Camera({0, 0, 3}, {0, 0, 0}, {0, 1, 0}, 0.5, 0.5);
  scene.background = rt::Color3f(0, 0, 1);
  return std::make_shared<const rt::Scene>(std::move(scene));
}

static bool is_near(const rt::Color3f& a, const rt::Color3f& b) {
  return std::abs(a.x - b.x) < 0.01f && std::abs(a.y - b.y) < 0.01f && std::abs(a.z - b.z) < 0.01f;
}

int main(int, char** arguments) try {
  const auto scene = make_scene();
  rt::RenderSettings settings;
  settings.width = settings.height = 9;
  const rt::Image picture = rt::render([&](double) { return scene; }, 0, settings);
  rt::write_file(arguments[1], rt::encode_png(picture));

  // The middle ray meets the ball two units in front of the light: colour * 255 * 2 / 2^2. The corner misses
  // it.
  const bool is_right = is_near(picture.at(4, 4), {102, 51, 25.5f}) && is_near(picture.at(0, 0), {0, 0, 255});
  std::puts(is_right ? "the picture is right" : "the picture is wrong");
  return is_right ? 0 : 1;
} catch (const rt::Error& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return static_cast<int>(error.kind());
}
