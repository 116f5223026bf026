// An open shutter: which moments a picture shows, and how they come together.
#include <fmt/format.h>

#include <cmath>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "catch.hpp"
#include "raytracer/error.hpp"
#include "raytracer/render.hpp"
#include "raytracer/scene_file.hpp"
#include "raytracer/shapes.hpp"

namespace {

using namespace raytracer;

SceneDescription ball_at(double x) {
  SceneDescription scene;
  scene.shapes.push_back(make_sphere({x, 0, -4}, 1));
  scene.material_of = {0};
  scene.materials.resize(1);
  scene.materials[0].color = {0.9F, 0.5F, 0.2F};
  scene.ambient = Color3f(1);
  return scene;
}

std::shared_ptr<const Scene> empty(float brightness) {
  SceneDescription scene;
  scene.background = Color3f(brightness);
  return std::make_shared<const Scene>(std::move(scene));
}

RenderSettings settings(int samples, double shutter) {
  RenderSettings result;
  result.width = 40;
  result.height = 36;
  result.samples = samples;
  result.threads = 2;
  result.shutter = shutter;
  return result;
}

bool is_same(const Image& a, const Image& b) {
  return a.red == b.red && a.green == b.green && a.blue == b.blue;
}

std::vector<double> times_asked(double time, int samples, double shutter) {
  std::vector<double> times;
  std::weak_ptr<const Scene> last;
  const SceneAt scene_at = [&](double t) {
    REQUIRE(last.expired());  // one scene at a time
    times.push_back(t);
    auto scene = empty(0.5F);
    last = scene;
    return scene;
  };
  render(scene_at, time, settings(samples, shutter));
  return times;
}

TEST_CASE("the shutter's time is cut into slices, and their middles are shown in order") {
  REQUIRE(times_asked(3, 8, 0) == std::vector<double>{3});
  REQUIRE(times_asked(3, 1, 0.5) == std::vector<double>{3.25});
  REQUIRE(times_asked(3, 4, 0.5) == std::vector<double>{3.0625, 3.1875, 3.3125, 3.4375});
  REQUIRE(times_asked(0, 64, 1).size() == 64);
  const std::vector<double> many = times_asked(0, 100, 1);
  REQUIRE(many.size() == 64);
  REQUIRE(many.front() == 0.5 / 64);
  REQUIRE(many.back() == 63.5 / 64);
}

// A background of powers of two adds up without rounding, so that the sum tells how many samples saw which
// slice.
TEST_CASE("sample k belongs to slice floor(k n / samples)") {
  constexpr int kSamples = 100, kSlices = 64;
  int expected[kSlices] = {};
  for (int k = 0; k < kSamples; ++k) ++expected[k * kSlices / kSamples];
  for (int seen = 0; seen < kSlices; ++seen) {
    int slice = 0;
    const SceneAt scene_at = [&](double) { return empty(slice++ == seen ? 1.0F : 0.0F); };
    const Image image = render(scene_at, 0, settings(kSamples, 1));
    REQUIRE(image.red[0] == static_cast<float>(255 * expected[seen]) / kSamples);
  }
}

TEST_CASE("a blurred picture is the average of its slices") {
  constexpr int kSamples = 8;  // a power of two: dividing by it rounds nothing
  const auto moving = [](double t) { return std::make_shared<const Scene>(ball_at(4 * t - 2)); };
  const Image blurred = render(moving, 0, settings(kSamples, 1));
  Image sum(blurred.width, blurred.height);
  for (int seen = 0; seen < kSamples; ++seen) {
    int slice = 0;
    const SceneAt scene_at = [&](double t) { return slice++ == seen ? moving(t) : empty(0); };
    const Image one = render(scene_at, 0, settings(kSamples, 1));
    for (std::size_t i = 0; i < sum.red.size(); ++i) {
      sum.red[i] += one.red[i];
      sum.green[i] += one.green[i];
      sum.blue[i] += one.blue[i];
    }
  }
  REQUIRE(is_same(sum, blurred));
  REQUIRE_FALSE(is_same(blurred, render(moving, 0.5, settings(kSamples, 0))));
}

TEST_CASE("what stands still is not blurred") {
  const auto still = [](double) { return std::make_shared<const Scene>(ball_at(0.3)); };
  for (const int samples : {5, 16, 100}) {
    REQUIRE(is_same(render(still, 0, settings(samples, 0.5)), render(still, 0, settings(samples, 0))));
  }
}

TEST_CASE("a blurred picture is the same for any number of threads") {
  const auto moving = [](double t) { return std::make_shared<const Scene>(ball_at(4 * t - 2)); };
  RenderSettings one = settings(16, 1), three = one;
  one.threads = 1;
  three.threads = 3;
  REQUIRE(is_same(render(moving, 0, one), render(moving, 0, three)));
}

class Listener : public RenderObserver {
 public:
  explicit Listener(std::uint64_t last) : last_(last) {}
  bool on_progress(std::uint64_t done, std::uint64_t total) override {
    REQUIRE(done == ++calls);
    total_told = total;
    return done < last_;
  }
  std::uint64_t calls = 0, total_told = 0;

 private:
  std::uint64_t last_;
};

TEST_CASE("progress counts the tiles of every slice, and stops between them too") {
  int scenes = 0;
  const SceneAt scene_at = [&](double) {
    ++scenes;
    return empty(0);
  };
  RenderSettings small = settings(5, 1);  // two by two tiles
  Listener patient(1000);
  render(scene_at, 0, small, &patient);
  REQUIRE(patient.total_told == 20);
  REQUIRE(patient.calls == 20);
  REQUIRE(scenes == 5);
  scenes = 0;
  small.threads = 1;
  Listener hasty(8);
  REQUIRE_THROWS_AS(render(scene_at, 0, small, &hasty), Error);
  REQUIRE(hasty.calls == 8);
  REQUIRE(scenes == 2);
}

LoadedScene load(const std::string& text) { return load_scene_text(text, "test.txt"); }

TEST_CASE("a camera's shutter is a share of a frame's time") {
  const std::string camera =
      "camera { position 0 0 9 shutter 0.5 }\nlight { position 0 9 0 }\nrender { samples 16 }\n";
  const LoadedScene moving = load("animation { duration 2 fps 20 }\nsphere { center t 0 0 }\n" + camera);
  REQUIRE(moving.diagnostics.empty());
  REQUIRE(std::abs(moving.settings.shutter - 0.025) < 1e-15);
  REQUIRE(std::abs(moving.moment_at(1).settings.shutter - 0.025) < 1e-15);
  const LoadedScene still = load("animation { duration 2 fps 20 }\nsphere { }\n" + camera);
  REQUIRE(still.diagnostics.empty());
  REQUIRE(still.settings.shutter == 0);
}

TEST_CASE("all moments of an open shutter belong to its frame") {
  const LoadedScene scene = load(
      "animation { duration 4 fps 30 }\nsphere { center t 0 0 }\nlight { position 0 9 0 }\nrender { samples "
      "64 }\n"
      "camera { position 0 0 (9 + frame) shutter 1 }\n");
  REQUIRE(scene.diagnostics.empty());
  for (const int frame : {1, 2, 30, 31, 100, 120}) {
    RenderSettings settings = scene.settings;
    settings.width = settings.height = 2;
    const SceneAt scene_at = [&](double t) {
      auto moment = scene.scene_at(t);
      REQUIRE(moment->camera().position().z == 9.0F + static_cast<float>(frame));
      return moment;
    };
    render(scene_at, (frame - 1) / 30.0, settings);
  }
}

TEST_CASE("too few samples for an open shutter are warned of") {
  const auto warnings = [](int samples, const char* center) {
    std::string all;
    const LoadedScene scene = load(fmt::format(
        "camera {{ position 0 0 9 shutter 0.5 }}\nlight {{ position 0 9 0 }}\nsphere {{ center {} 0 0 "
        "}}\nrender {{ samples {} }}\n",
        center, samples));
    REQUIRE(scene.ok());
    for (const Diagnostic& diagnostic : scene.diagnostics) {
      REQUIRE(diagnostic.line == 1);
      all += diagnostic.message + '|' + diagnostic.suggestion;
    }
    return all;
  };
  REQUIRE(warnings(4, "t") == "motion blur with 4 samples shows 4 ghosts|samples 16");
  REQUIRE(warnings(1, "t") == "with 1 sample an open shutter blurs nothing|samples 16");
  REQUIRE(warnings(8, "t").empty());
  REQUIRE(warnings(4, "2").empty());
}

}  // namespace
