#include "raytracer/camera.hpp"

#include <cmath>
#include <random>

#include "catch.hpp"
#include "raytracer/error.hpp"

using namespace raytracer;

namespace {

bool is_near(const Vector3d& a, const Vector3d& b, double tolerance) {
  return glm::length(a - b) <= tolerance;
}

}  // namespace

TEST_CASE("rays go through the picture's corners, edges and middle", "[camera]") {
  // A square picture of 90 degrees, from the origin along -z:
  //   x, y       direction
  const Camera camera(Vector3d(0), Vector3d(0, 0, -1), Vector3d(0, 1, 0), 1, 1);
  const struct {
    double x, y;
    Vector3d direction;
  } known[] = {
      {0.5, 0.5, {0, 0, -1}}, {0, 0, {-1, 1, -1}},  {1, 0, {1, 1, -1}},   {0, 1, {-1, -1, -1}},
      {1, 1, {1, -1, -1}},    {0.5, 0, {0, 1, -1}}, {1, 0.5, {1, 0, -1}},
  };
  for (const auto& k : known) {
    const Ray3f ray = camera.ray_through(k.x, k.y);
    INFO("x " << k.x << ", y " << k.y);
    REQUIRE(is_near(Vector3d(ray.direction), glm::normalize(k.direction), 2e-7));
    REQUIRE(ray.origin == Vector3f(0));
    REQUIRE(ray.t_min == 0);
    REQUIRE(ray.t_max == kInfinity);
  }
}

TEST_CASE("any camera shoots the ray of the formula", "[camera]") {
  // f + (2x - 1) half_width r + (1 - 2y) half_height u with f = unit(T - P), r = unit(f x U), u = r x f
  std::mt19937 engine(1);
  const auto number = [&](double low, double high) {
    return low + (high - low) * static_cast<double>(engine()) * 0x1p-32;
  };
  const auto vector = [&] { return Vector3d(number(-5, 5), number(-5, 5), number(-5, 5)); };
  for (int i = 0; i < 2000; ++i) {
    const Vector3d from = vector(), at = vector(), up = vector();
    const Vector3d f = glm::normalize(at - from);
    if (glm::length(glm::cross(f, glm::normalize(up))) < 0.05) continue;
    const double half_width = number(0.01, 3), half_height = number(0.01, 3), x = number(0, 1),
                 y = number(0, 1);
    const Vector3d r = glm::normalize(glm::cross(f, up)), u = glm::cross(r, f);
    const Ray3f ray = Camera(from, at, up, half_width, half_height).ray_through(x, y);
    const Vector3d expected =
        glm::normalize(f + (2 * x - 1) * half_width * r + (1 - 2 * y) * half_height * u);
    REQUIRE(is_near(Vector3d(ray.direction), expected, 1e-6));
    REQUIRE(ray.origin == Vector3f(from));
  }
}

TEST_CASE("only the directions of view and up count, not their lengths", "[camera]") {
  const Vector3d from(1, 2, 3), view(0.3, -0.2, -1), up(0.1, 1, 0);
  const Ray3f once = Camera(from, from + view, up, 0.7, 0.4).ray_through(0.3, 0.9);
  const Ray3f far = Camera(from, from + 1e6 * view, 1e-9 * up, 0.7, 0.4).ray_through(0.3, 0.9);
  const Ray3f near = Camera(from, from + 1e-6 * view, 1e9 * up, 0.7, 0.4).ray_through(0.3, 0.9);
  REQUIRE(is_near(Vector3d(once.direction), Vector3d(far.direction), 1e-6));
  REQUIRE(is_near(Vector3d(once.direction), Vector3d(near.direction), 1e-6));
}

TEST_CASE("a camera that looks nowhere, or along its up, is the scene's mistake", "[camera]") {
  const auto kind_of_error = [](const Vector3d& from, const Vector3d& at, const Vector3d& up) {
    try {
      const Camera camera(from, at, up, 1, 1);
    } catch (const Error& error) {
      return static_cast<int>(error.kind());
    }
    return 0;
  };
  const int scene_error = static_cast<int>(ErrorKind::kScene);
  const Vector3d p(1, 2, 3);
  REQUIRE(kind_of_error(p, p, {0, 1, 0}) == scene_error);
  REQUIRE(kind_of_error(p, p + Vector3d(0, 4, 0), {0, 1, 0}) == scene_error);
  REQUIRE(kind_of_error(p, p - Vector3d(0, 4, 0), {0, 1, 0}) == scene_error);
  REQUIRE(kind_of_error(p, p + Vector3d(1, 1, 1), {-2, -2, -2}) == scene_error);
  REQUIRE(kind_of_error(p, p + Vector3d(0, 0, 1), {0, 0, 0}) == scene_error);
  REQUIRE(kind_of_error(p, p + Vector3d(0, 0, 1), {0, 1, 0}) == 0);
  REQUIRE(kind_of_error(p, p + Vector3d(0, 4, 0.001), {0, 1, 0}) == 0);
}

namespace {

Camera camera_with(const Optics& optics) {
  return Camera(Vector3d(0), Vector3d(0, 0, -1), Vector3d(0, 1, 0), optics);
}

struct KnownRay {
  double x, y;
  Vector3d direction;
};

template <std::size_t N>
void require_directions(const Camera& camera, const KnownRay (&known)[N]) {
  for (const KnownRay& k : known) {
    INFO("x " << k.x << ", y " << k.y);
    const Ray3f ray = camera.ray_through(k.x, k.y);
    REQUIRE(is_near(Vector3d(ray.direction), glm::normalize(k.direction), 1e-6));
    REQUIRE(ray.origin == Vector3f(0));
  }
}

}  // namespace

TEST_CASE("a panorama shows all directions, the view in its middle", "[camera]") {
  Optics optics;
  optics.projection = Projection::kPanorama;
  require_directions(camera_with(optics), {{0.5, 0.5, {0, 0, -1}},
                                           {0.75, 0.5, {1, 0, 0}},
                                           {0.25, 0.5, {-1, 0, 0}},
                                           {0, 0.5, {0, 0, 1}},
                                           {1, 0.5, {0, 0, 1}},
                                           {0.3, 0, {0, 1, 0}},
                                           {0.8, 1, {0, -1, 0}},
                                           {0.5, 0.25, {0, 1, -1}}});
}

TEST_CASE("a panorama that looks along +z is the picture of a sky", "[camera]") {
  // Column u, row v of a sky's picture: (sin(2 pi u) sin(pi v), cos(pi v), -cos(2 pi u) sin(pi v))
  Optics optics;
  optics.projection = Projection::kPanorama;
  const Camera camera(Vector3d(0), Vector3d(0, 0, 1), Vector3d(0, 1, 0), optics);
  for (const double u : {0.1, 0.4, 0.7}) {
    for (const double v : {0.2, 0.5, 0.9}) {
      const double a = 2 * M_PI * u, b = M_PI * v;
      const Vector3d expected = {std::sin(a) * std::sin(b), std::cos(b), -std::cos(a) * std::sin(b)};
      REQUIRE(is_near(Vector3d(camera.ray_through(u, v).direction), expected, 1e-6));
    }
  }
}

TEST_CASE("a fisheye's angle to the view grows evenly from the middle", "[camera]") {
  Optics optics;
  optics.projection = Projection::kFisheye;
  optics.half_width = optics.half_height = M_PI / 2;
  require_directions(camera_with(optics), {{0.5, 0.5, {0, 0, -1}},
                                           {1, 0.5, {1, 0, 0}},
                                           {0.75, 0.5, {1, 0, -1}},
                                           {0.5, 0, {0, 1, 0}},
                                           {0.5, 0.75, {0, -1, -1}}});
}

TEST_CASE("a cube map has right, left, up, down, front, back", "[camera]") {
  Optics optics;
  optics.projection = Projection::kCubeMap;
  const Vector3d sides[] = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, -1}, {0, 0, 1}};
  for (const int columns : {3, 6}) {
    optics.cube_columns = columns;
    const Camera camera = camera_with(optics);
    for (int i = 0; i < 6; ++i) {
      const double x = (i % columns + 0.5) / columns, y = (i / columns + 0.5) / (6 / columns);
      REQUIRE(is_near(Vector3d(camera.ray_through(x, y).direction), sides[i], 1e-6));
    }
  }
  // In a row: neighbours in space meet at the edges.
  const Camera row = camera_with(optics);
  require_directions(row, {{0.5 / 6, 0, {1, 1, 0}},
                           {1e-9, 0.5, {1, 0, -1}},
                           {2.5 / 6, 1, {0, 1, -1}},
                           {3.5 / 6, 0, {0, -1, -1}},
                           {4.5 / 6, 0, {0, 1, -1}},
                           {5.0 / 6 - 1e-9, 0.5, {1, 0, -1}},
                           {1 - 1e-9, 0.5, {-1, 0, 1}}});
}

TEST_CASE("an orthographic camera's rays are parallel", "[camera]") {
  Optics optics;
  optics.projection = Projection::kOrthographic;
  optics.half_width = 4;
  optics.half_height = 3;
  const Camera camera(Vector3d(1, 2, 3), Vector3d(1, 2, 0), Vector3d(0, 1, 0), optics);
  for (const double x : {0.0, 0.5, 1.0}) {
    const Ray3f ray = camera.ray_through(x, 0.25);
    REQUIRE(ray.direction == Vector3f(0, 0, -1));
    REQUIRE(is_near(Vector3d(ray.origin), {1 + 4 * (2 * x - 1), 2 + 3 * 0.5, 3}, 1e-6));
  }
}

TEST_CASE("all rays through a lens meet where it is sharp", "[camera]") {
  Optics optics;
  optics.half_width = 0.8;
  optics.half_height = 0.5;
  optics.focus_distance = 4;
  for (const int blades : {0, 5}) {
    optics.blades = blades;
    optics.lens_radius = 0;
    const Camera pinhole(Vector3d(1, 2, 3), Vector3d(2, 1, -5), Vector3d(0.1, 1, 0), optics);
    optics.lens_radius = 0.3;
    const Camera camera(Vector3d(1, 2, 3), Vector3d(2, 1, -5), Vector3d(0.1, 1, 0), optics);
    Vector3d sum(0);
    double mean_square = 0;
    constexpr int kSide = 64;
    for (int i = 0; i < kSide * kSide; ++i) {
      const Vector2f lens = (Vector2f(i % kSide, i / kSide) + 0.5F) / float{kSide};
      const Ray3f sharp = pinhole.ray_through(0.2, 0.7), ray = camera.ray_through(0.2, 0.7, lens);
      const Vector3d focus =
          Vector3d(sharp.origin) +
          4.0 / glm::dot(Vector3d(sharp.direction), Vector3d(camera.forward())) * Vector3d(sharp.direction);
      const Vector3d on_lens = Vector3d(ray.origin - sharp.origin);
      REQUIRE(std::abs(glm::dot(on_lens, Vector3d(camera.forward()))) < 1e-6);
      REQUIRE(glm::length(on_lens) < 0.3 + 1e-6);
      REQUIRE(is_near(Vector3d(ray.direction), glm::normalize(focus - Vector3d(ray.origin)), 1e-6));
      sum += on_lens;
      mean_square += glm::dot(on_lens, on_lens) / (kSide * kSide);
    }
    REQUIRE(glm::length(sum) / (kSide * kSide) < 1e-3);
    // Of a disk R^2 / 2, of a regular polygon of n corners R^2 (2 + cos(2 pi / n)) / 6.
    const double expected = blades == 0 ? 0.5 : (2 + std::cos(2 * M_PI / blades)) / 6;
    REQUIRE(std::abs(mean_square - 0.09 * expected) < 1e-4);
  }
}

TEST_CASE("without a lens the point on it means nothing", "[camera]") {
  const Camera camera(Vector3d(1, 2, 3), Vector3d(2, 1, -5), Vector3d(0, 1, 0), 0.6, 0.4);
  const Ray3f a = camera.ray_through(0.3, 0.6), b = camera.ray_through(0.3, 0.6, Vector2f(0.9F, 0.1F));
  REQUIRE(a.origin == b.origin);
  REQUIRE(a.direction == b.direction);
  REQUIRE(camera.is_pinhole());
}

TEST_CASE("a lens blurs a point to a disk of the size of the formula", "[camera]") {
  // Radius 0.1, focus 4, vertical field 35 degrees, 160 rows; the point at distance d on the view.
  Optics optics;
  optics.half_width = optics.half_height = std::tan(glm::radians(35.0) / 2);
  optics.lens_radius = 0.1;
  optics.focus_distance = 4;
  const Camera camera = camera_with(optics);
  const struct {
    float distance;
    double diameter;
  } known[] = {{2, 12.6864}, {3, 4.22879}, {4, 0}, {6, 4.22879}, {12, 8.45759}};
  for (const auto& k : known) {
    // Where in the picture the ray from the lens's rim through the point goes: bisect x at y = 0.5.
    const auto sees = [&](const Vector2f& lens) {
      double low = 0, high = 1;
      for (int i = 0; i < 40; ++i) {
        const double middle = (low + high) / 2;
        const Ray3f ray = camera.ray_through(middle, 0.5, lens);
        const float x = ray.origin.x + k.distance * ray.direction.x / -ray.direction.z;
        (x < 0 ? low : high) = middle;
      }
      return 160 * low;
    };
    const double diameter = std::abs(sees({0.99999F, 0.5F}) - sees({0.0F, 0.5F}));
    REQUIRE(std::abs(diameter - k.diameter) < 0.01 * k.diameter + 1e-3);
  }
}

TEST_CASE("a tilted plane is sharp", "[camera]") {
  Optics optics;
  optics.lens_radius = 0.2;
  optics.focus_distance = 5;
  optics.tilt_x = glm::radians(30.0);
  const Camera camera = camera_with(optics);
  for (const double x : {0.2, 0.5, 0.8}) {
    // The plane through (0, 0, -5) that goes away to the right: z = -5 - x tan(30 degrees).
    const Vector3d d = Vector3d(2 * x - 1, 0, -1);
    const double t = 5 / (1 - d.x * std::tan(glm::radians(30.0)));
    const Ray3f ray = camera.ray_through(x, 0.5, Vector2f(0.1F, 0.8F));
    REQUIRE(is_near(Vector3d(ray.direction), glm::normalize(t * d - Vector3d(ray.origin)), 1e-6));
  }
}

TEST_CASE("two eyes agree on what is at the focus distance", "[camera]") {
  Optics optics;
  optics.eye_distance = 0.5;
  optics.focus_distance = 3;
  const Camera camera = camera_with(optics);
  const Ray3f left = camera.ray_through(0.15, 0.4), right = camera.ray_through(0.65, 0.4);
  REQUIRE(left.origin == Vector3f(-0.25F, 0, 0));
  REQUIRE(right.origin == Vector3f(0.25F, 0, 0));
  const auto at_focus = [](const Ray3f& ray) { return ray.at(-3 / ray.direction.z); };
  REQUIRE(is_near(Vector3d(at_focus(left)), Vector3d(at_focus(right)), 1e-5));
}

TEST_CASE("a ray's differential leads to the next ray", "[camera]") {
  for (const Projection projection : {Projection::kPerspective, Projection::kOrthographic,
                                      Projection::kFisheye, Projection::kPanorama, Projection::kCubeMap}) {
    Optics optics;
    optics.projection = projection;
    optics.lens_radius = 0.1;
    const Camera camera = camera_with(optics);
    const Vector2f lens(0.3F, 0.6F);
    const Ray3f here = camera.ray_through(0.4, 0.3, lens), next = camera.ray_through(0.41, 0.3, lens),
                below = camera.ray_through(0.4, 0.32, lens);
    const RayDifferential d = camera.differential(0.4, 0.3, lens, 0.01, 0.02);
    REQUIRE(is_near(Vector3d(here.direction + d.direction_dx), Vector3d(next.direction), 1e-6));
    REQUIRE(is_near(Vector3d(here.direction + d.direction_dy), Vector3d(below.direction), 1e-6));
    REQUIRE(is_near(Vector3d(here.origin + d.origin_dx), Vector3d(next.origin), 1e-6));
    REQUIRE(is_near(Vector3d(here.origin + d.origin_dy), Vector3d(below.origin), 1e-6));
  }
}
