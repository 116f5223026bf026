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
