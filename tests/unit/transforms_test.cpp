// Where things go: every transform word against L (p - a) + a + translations, computed here a second time.
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "catch.hpp"
#include "raytracer/scene_file.hpp"

using raytracer::Box3f;
using raytracer::Camera;
using raytracer::Hit;
using raytracer::Light;
using raytracer::load_scene_text;
using raytracer::LoadedScene;
using raytracer::Ray3f;
using raytracer::Scene;
using raytracer::SceneDescription;
using raytracer::Vector3d;
using raytracer::Vector3f;

namespace {

using Matrix = glm::dmat3;

constexpr double kDegree = 3.14159265358979323846 / 180;

// Counter-clockwise seen from the tip of the axis, written out by hand (columns one per line).
Matrix about_x(double degrees) {
  const double c = std::cos(degrees * kDegree), s = std::sin(degrees * kDegree);
  return {{1, 0, 0}, {0, c, s}, {0, -s, c}};
}
Matrix about_y(double degrees) {
  const double c = std::cos(degrees * kDegree), s = std::sin(degrees * kDegree);
  return {{c, 0, -s}, {0, 1, 0}, {s, 0, c}};
}
Matrix about_z(double degrees) {
  const double c = std::cos(degrees * kDegree), s = std::sin(degrees * kDegree);
  return {{c, s, 0}, {-s, c, 0}, {0, 0, 1}};
}
Matrix rotated(double x, double y, double z) { return about_z(z) * about_y(y) * about_x(x); }
Matrix scaled(double x, double y, double z) { return {{x, 0, 0}, {0, y, 0}, {0, 0, z}}; }

// p -> linear (p - spot) + spot + move
struct Map {
  Matrix linear{1.0};
  Vector3d spot{0}, move{0};
  Vector3d operator()(const Vector3d& p) const { return linear * (p - spot) + spot + move; }
};

std::shared_ptr<const Scene> scene_of(const std::string& text) {
  const LoadedScene loaded = load_scene_text(text, "transforms.txt");
  INFO(text);
  for (const auto& diagnostic : loaded.diagnostics) UNSCOPED_INFO(to_text(diagnostic));
  REQUIRE(loaded.ok());
  return loaded.scene_at(0);
}

// Whether a surface passes through the point: a short ray from both of its sides, along each axis in turn,
// meets it there.
bool is_on_surface(const Scene& scene, const Vector3d& p) {
  const Vector3d directions[] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0.6, 0.48, 0.64}, {-0.48, 0.6, 0.64}};
  for (const Vector3d& direction : directions) {
    constexpr float kReach = 0.01f;
    const Ray3f ray{Vector3f(p) - kReach * Vector3f(direction), Vector3f(direction), 0, 2 * kReach};
    Hit hit;
    if (!scene.is_hit(ray, hit)) continue;
    if (std::abs(hit.t - kReach) < 2e-3f) return true;
  }
  return false;
}

// A shape, its own middle, and points on it.
struct Sample {
  const char* text;
  Vector3d middle;
  std::vector<Vector3d> points;
};

const std::vector<Sample>& samples() {
  static const std::vector<Sample> all = {
      {"sphere { center 1 2 3 radius 2", {1, 2, 3}, {{3, 2, 3}, {1, 4, 3}, {1, 2, 1}, {2.2, 3.6, 3}}},
      {"quad { origin 1 0 2 width 2 1 0 height 0 1 3",
       {2, 1, 3.5},
       {{2, 1, 3.5}, {1.4, 0.4, 2.6}, {2.8, 1.8, 4.7}, {2.4, 1, 2.9}}},
      {"cube { center 1 -1 2 size 2 4 1", {1, -1, 2}, {{2, -1, 2}, {1, 1, 2}, {1, -1, 2.5}, {1.5, -3, 1.8}}},
      {"plane { point 1 2 3 normal 1 2 2", {1, 2, 3}, {{1, 2, 3}, {3, 1, 3}, {1, 1, 4}}},
      {"disk { center 2 1 0 normal 0 1 1 radius 2", {2, 1, 0}, {{2, 1, 0}, {3.5, 1, 0}, {2, 2, -1}}},
      {"cylinder { base 1 0 0 top 1 4 0 radius 0.5",
       {1, 2, 0},
       {{1.5, 1, 0}, {1, 3, 0.5}, {1.1, 4, 0.1}, {0.9, 0, 0}}},
      {"cone { base 0 1 1 radius 2 top 4 1 1 top_radius 1",
       {2, 1, 1},
       {{2, 2.5, 1}, {0, 2, 1}, {4, 1.5, 1}, {2, 1, -0.5}}},
      {"torus { center 1 1 1 axis 0 0 1 radius 2 tube_radius 0.5",
       {1, 1, 1},
       {{3.5, 1, 1}, {2.5, 1, 1}, {1, 3, 1.5}, {1, -1.5, 1}}},
      {"triangle { a 0 0 0 b 3 0 0 c 0 3 3", {1, 1, 1}, {{1, 1, 1}, {1.5, 0.5, 0.5}, {0.5, 2, 2}}},
  };
  return all;
}

// Each shape with these words in it goes where `map` says, whose spot is the shape's middle unless it is
// given.
void check_words(const std::string& words, Map map, bool has_spot = false) {
  for (const Sample& sample : samples()) {
    const auto scene = scene_of(std::string(sample.text) + " " + words + " }");
    if (!has_spot) map.spot = sample.middle;
    for (const Vector3d& p : sample.points) {
      const Vector3d q = map(p);
      INFO(sample.text << " " << words << ": " << p.x << ' ' << p.y << ' ' << p.z << " -> " << q.x << ' '
                       << q.y << ' ' << q.z);
      CHECK(is_on_surface(*scene, q));
    }
  }
}

void check_near(const Vector3d& found, const Vector3d& wanted) {
  INFO(found.x << ' ' << found.y << ' ' << found.z << " is wanted at " << wanted.x << ' ' << wanted.y << ' '
               << wanted.z);
  CHECK(glm::length(found - wanted) < 1e-5 * std::max(1.0, glm::length(wanted)));
}

Vector3d middle_of(const std::string& text, std::size_t shape = 0) {
  return Vector3d(scene_of(text)->description().shapes[shape]->bounds().center());
}

}  // namespace

TEST_CASE("the samples lie on their shapes, and the test can tell", "[transforms]") {
  check_words("", {});
  const auto scene = scene_of(std::string(samples()[0].text) + " }");
  REQUIRE_FALSE(is_on_surface(*scene, {3.05, 2, 3}));
  REQUIRE_FALSE(is_on_surface(*scene, {1, 2, 3}));
}

TEST_CASE("every shape is moved, turned and grown about its own middle", "[transforms]") {
  check_words("translate 1 -2 3", {Matrix(1), {}, {1, -2, 3}});
  check_words("rotate 30 0 0", {about_x(30), {}, {}});
  check_words("rotate 0 40 0", {about_y(40), {}, {}});
  check_words("rotate 0 0 -50", {about_z(-50), {}, {}});
  check_words("rotate 20 30 40", {rotated(20, 30, 40), {}, {}});
  check_words("scale 2", {scaled(2, 2, 2), {}, {}});
  check_words("scale 1.5 0.8 2", {scaled(1.5, 0.8, 2), {}, {}});
  check_words("scale -1 1 1", {scaled(-1, 1, 1), {}, {}});
  check_words("scale -1.5", {scaled(-1.5, -1.5, -1.5), {}, {}});
  check_words("rotate_axis 0 2 0 40", {about_y(40), {}, {}});
  check_words("rotate_axis -1 0 0 40", {about_x(-40), {}, {}});
}

TEST_CASE("turns and sizes count in the order written, translate's place does not", "[transforms]") {
  const Matrix turn = rotated(20, 30, 40), size = scaled(1.5, 0.8, 2);
  check_words("rotate 20 30 40 scale 1.5 0.8 2", {size * turn, {}, {}});
  check_words("scale 1.5 0.8 2 rotate 20 30 40", {turn * size, {}, {}});
  check_words("rotate 10 0 0 rotate 0 20 0 rotate 10 0 0", {about_x(10) * about_y(20) * about_x(10), {}, {}});
  check_words("translate 1 2 3 rotate 20 30 40 scale 1.5 0.8 2", {size * turn, {}, {1, 2, 3}});
  check_words("rotate 20 30 40 translate 1 2 3 scale 1.5 0.8 2", {size * turn, {}, {1, 2, 3}});
  check_words("rotate 20 30 40 scale 1.5 0.8 2 translate 1 2 3", {size * turn, {}, {1, 2, 3}});
  check_words("translate 1 0 0 rotate 20 30 40 translate 0 2 0 scale 1.5 0.8 2 translate 0 0 3",
              {size * turn, {}, {1, 2, 3}});
}

TEST_CASE("a pivot takes the place of the middle, wherever it is written", "[transforms]") {
  check_words("pivot 1 1 -1 rotate 20 30 40", {rotated(20, 30, 40), {1, 1, -1}, {}}, true);
  check_words("rotate 20 30 40 pivot 1 1 -1", {rotated(20, 30, 40), {1, 1, -1}, {}}, true);
  check_words("scale 2 pivot 0 0 0 translate 0 1 0", {scaled(2, 2, 2), {0, 0, 0}, {0, 1, 0}}, true);
  check_words("pivot 5 5 5", {}, true);
}

TEST_CASE("a matrix stands in place of all, in the parent's space", "[transforms]") {
  const Matrix linear = rotated(20, 30, 40) * scaled(1.5, 0.8, 2);
  std::string words = "matrix";
  const Vector3d move(1, -2, 0.5);
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) words += " (" + std::to_string(linear[column][row]) + ")";
    words += " (" + std::to_string(move[row]) + ")";
  }
  check_words(words, {linear, {0, 0, 0}, move}, true);
  check_words("matrix 0 0 1 5  1 0 0 6  0 1 0 7",
              {Matrix({0, 1, 0}, {0, 0, 1}, {1, 0, 0}), {0, 0, 0}, {5, 6, 7}}, true);
}

TEST_CASE("a group turns and grows about its origin, and groups in groups one after the other",
          "[transforms]") {
  const Map outer{rotated(0, 50, 10), {}, {2, 0, -1}},
      inner{scaled(1.2, 1.2, 0.9) * about_x(15), {}, {0, 1, 0}};
  for (const Sample& sample : samples()) {
    const Map own{about_z(25), sample.middle, {0.5, 0, 0}};
    const auto scene = scene_of(
        "group { rotate 0 50 10 translate 2 0 -1 group { translate 0 1 0 rotate 15 0 0 scale 1.2 1.2 0.9 " +
        std::string(sample.text) + " rotate 0 0 25 translate 0.5 0 0 } } }");
    for (const Vector3d& p : sample.points) {
      INFO(sample.text);
      CHECK(is_on_surface(*scene, outer(inner(own(p)))));
    }
  }
  check_near(middle_of("group { pivot 1 0 0 rotate 0 0 90 sphere { center 3 0 0 } }"), {1, 2, 0});
  check_near(middle_of("group { matrix 1 0 0 5  0 1 0 6  0 0 1 7 sphere { center 1 1 1 } }"), {6, 7, 8});
}

TEST_CASE("a use of a definition is placed as a group is", "[transforms]") {
  const std::string d = "define d (x 1) { sphere { center x 0 0 radius 0.25 } }\n";
  check_near(middle_of(d + "d { x 2 rotate 0 0 90 }"), {0, 2, 0});
  check_near(middle_of(d + "d { x 2 scale 3 translate 0 1 0 }"), {6, 1, 0});
  check_near(middle_of(d + "d { x 2 pivot 1 0 0 rotate 0 180 0 }"), {0, 0, 0});
  check_near(middle_of(d + "group { translate 0 0 5 d { rotate 0 90 0 } }"), {0, 0, 4});
  check_near(middle_of(d + "define e { d { rotate 0 0 90 } }\ne { rotate 90 0 0 translate 1 0 0 }"),
             {1, 0, 1});
}

TEST_CASE("turns are counter-clockwise seen from the tip of the axis, about x, then y, then z",
          "[transforms]") {
  const auto turned = [](const std::string& rotate, const std::string& center) {
    return middle_of("group { rotate " + rotate + " sphere { center " + center + " radius 0.25 } }");
  };
  check_near(turned("90 0 0", "0 1 0"), {0, 0, 1});
  check_near(turned("0 90 0", "0 0 1"), {1, 0, 0});
  check_near(turned("0 0 90", "1 0 0"), {0, 1, 0});
  check_near(turned("90 90 0", "0 1 0"), {1, 0, 0});
  check_near(turned("90 0 90", "0 1 0"), {0, 0, 1});
  check_near(turned("0 90 90", "0 0 1"), {0, 1, 0});
  check_near(middle_of("group { rotate_axis 1 1 1 120 sphere { center 1 0 0 radius 0.25 } }"), {0, 1, 0});
}

TEST_CASE("a mirrored closed shape still has its normals outside", "[transforms]") {
  for (const std::string words :
       {"scale -1 1 1", "scale -1", "scale 1 -2 1", "matrix 0 0 1 0  0 1 0 0  1 0 0 0"}) {
    for (const std::string shape :
         {"sphere { radius 2 ", "cube { size 3 ", "cylinder { base 0 -1 0 top 0 1 0 ", "torus { "}) {
      const auto scene = scene_of(shape + words + " }");
      const Vector3f eye(3, 5, 4);
      const Ray3f ray{eye, glm::normalize(Vector3f(0.9f, 0.02f, 0.1f) - eye)};
      Hit hit;
      INFO(shape << words);
      REQUIRE(scene->is_hit(ray, hit));
      CHECK(glm::dot(scene->surface_at(ray, hit).normal, ray.direction) < 0);
    }
  }
}

TEST_CASE("lights are moved and turned", "[transforms]") {
  const auto light = [](const std::string& text) {
    return scene_of(text + " sphere { }")->description().lights.at(0);
  };
  check_near(light("light { position 1 2 3 translate 1 1 1 }").position, {2, 3, 4});
  check_near(light("light { position 1 2 3 rotate 0 90 0 }").position, {1, 2, 3});
  check_near(light("light { position 1 0 0 pivot 0 0 0 rotate 0 0 90 }").position, {0, 1, 0});
  check_near(light("group { rotate 0 0 90 scale 2 light { position 1 0 0 } }").position, {0, 2, 0});
  check_near(light("light directional { direction 1 0 0 rotate 0 0 90 }").direction, {0, 1, 0});
  check_near(light("light directional { direction 0 -3 0 translate 5 5 5 }").direction, {0, -1, 0});
  check_near(light("group { scale 3 rotate 90 0 0 light directional { direction 0 1 0 } }").direction,
             {0, 0, 1});
  const Light spot =
      light("group { translate 0 0 5 light spot { position 1 0 0 look_at 1 -2 0 rotate 0 0 90 } }");
  check_near(spot.position, {1, 0, 5});
  check_near(spot.direction, {1, 0, 0});
}

TEST_CASE("cameras are moved and turned", "[transforms]") {
  const auto camera = [](const std::string& text) {
    return scene_of(text + " sphere { }")->description().camera;
  };
  const Camera moved = camera("camera { position 0 0 5 look_at 0 0 0 translate 1 2 3 }");
  check_near(moved.position(), {1, 2, 8});
  check_near(moved.forward(), {0, 0, -1});
  const Camera turned = camera("camera { position 0 0 5 look_at 0 0 0 rotate 0 90 0 }");
  check_near(turned.position(), {0, 0, 5});
  check_near(turned.forward(), {-1, 0, 0});
  const Camera swung = camera("camera { position 0 0 5 look_at 0 0 0 pivot 0 0 0 rotate 0 90 0 }");
  check_near(swung.position(), {5, 0, 0});
  check_near(swung.forward(), {-1, 0, 0});
  const Camera rolled = camera("camera { position 0 0 5 look_at 0 0 0 rotate 0 0 90 }");
  check_near(glm::normalize(rolled.up()), {-1, 0, 0});
  const Camera plain = camera("camera { position 1 2 3 }");
  check_near(plain.forward(), {0, 0, -1});
}

TEST_CASE("transforms that make no sense are errors at their place", "[transforms]") {
  const struct {
    const char* text;
    std::uint32_t column;
  } wrong[] = {
      {"sphere { scale 0 }", 10},
      {"sphere { scale 1 0 1 }", 10},
      {"group { scale 0 sphere { } }", 9},
      {"sphere { rotate_axis 0 0 0 30 }", 10},
      {"sphere { matrix 1 0 0 0  0 1 0 0  1 1 0 0 }", 10},
      {"sphere { matrix 1 0 0 0  0 1 0 0  0 0 1 0 rotate 0 30 0 }", 43},
      {"sphere { translate 1 0 0 matrix 1 0 0 0  0 1 0 0  0 0 1 0 }", 26},
      {"sphere { pivot 0 0 0 matrix 1 0 0 0  0 1 0 0  0 0 1 0 }", 22},
      {"sphere { pivot 0 0 0 pivot 1 0 0 }", 22},
      {"camera { position 0 0 5 look_at 0 0 0 scale 2 }", 39},
      {"light { scale 2 }", 9},
      {"light spot { scale 1 2 3 }", 14},
      {"sphere { rotate 30 }", 17},
      {"sphere { rotate 10 20 }", 17},
      {"sphere { translate (1, 2, 3) 4 }", 30},
      {"sphere { scale \"2\" }", 16},
      {"image { translate 1 0 0 }", 9},
      {"material m { rotate 1 0 0 } sphere { material m }", 14},
  };
  for (const auto& row : wrong) {
    const LoadedScene scene = load_scene_text(row.text, "transforms.txt");
    INFO(row.text);
    CHECK_FALSE(scene.ok());
    CHECK(scene.diagnostics.size() == 1);
    if (!scene.diagnostics.empty()) CHECK(scene.diagnostics[0].column == row.column);
  }
}
