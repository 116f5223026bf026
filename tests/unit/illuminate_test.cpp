#include "lights/illuminate.hpp"

#include <cmath>

#include "catch.hpp"

using namespace raytracer;

namespace {

Light point_light(const Vector3f& position, Falloff falloff) {
  Light light;
  light.position = position;
  light.falloff = falloff;
  light.lambda = {100, 200, 50};
  return light;
}

/// A spot at the height 1 above the origin that shines straight down.
Light spot(float full_angle_degrees, float soft_edge) {
  Light light = point_light({0, 1, 0}, Falloff::kNone);
  light.kind = Light::Kind::kSpot;
  const double half_angle = glm::radians(static_cast<double>(full_angle_degrees)) / 2;
  light.cos_outer = static_cast<float>(std::cos(half_angle));
  light.cos_inner = static_cast<float>(std::cos(half_angle * (1 - static_cast<double>(soft_edge))));
  return light;
}

const Vector3f kUp(0, 1, 0);

/// What comes of the light at a place of the floor, which lies 1e-3 below where its rays start.
Illumination on_floor(const Light& light, float x, float z = 0) {
  const Vector3f place(x, 0, z);
  return illuminate(light, place, kUp, place + 1e-3f * kUp);
}

/// The share of a spot's light in a direction that is an angle off its axis.
double share_at(const Light& light, double degrees) {
  const double x = std::tan(glm::radians(degrees));
  return static_cast<double>(on_floor(light, static_cast<float>(x)).color.x) / 100 * std::hypot(1, x);
}

void require_near(double value, double expected) {
  INFO(value << " is not " << expected);
  REQUIRE(std::abs(value - expected) <= 1e-5 * std::abs(expected));
}

}  // namespace

TEST_CASE("light fades with the power that its falloff says", "[light]") {
  const double height = 3;
  for (const float x : {0.0f, 1.0f, 4.0f, 40.0f}) {
    const double distance = std::hypot(height, static_cast<double>(x)), cosine = height / distance;
    const auto value = [&](Falloff falloff) { return on_floor(point_light({0, 3, 0}, falloff), x).color; };
    require_near(static_cast<double>(value(Falloff::kNone).x), 100 * cosine);
    require_near(static_cast<double>(value(Falloff::kLinear).x), 100 * cosine / distance);
    require_near(static_cast<double>(value(Falloff::kQuadratic).x), 100 * cosine / distance / distance);
    const Color3f color = value(Falloff::kLinear);
    require_near(static_cast<double>(color.y), 2 * static_cast<double>(color.x));
    require_near(static_cast<double>(color.z), 0.5 * static_cast<double>(color.x));
  }
}

TEST_CASE("light from behind, along the surface, or from the point itself is none", "[light]") {
  for (const Falloff falloff : {Falloff::kNone, Falloff::kLinear, Falloff::kQuadratic}) {
    REQUIRE(on_floor(point_light({0, -1, 0}, falloff), 2).color == Color3f(0));
    REQUIRE(on_floor(point_light({7, 0, 0}, falloff), 2).color == Color3f(0));
    REQUIRE(on_floor(point_light({2, 0, 0}, falloff), 2).color == Color3f(0));
    REQUIRE(on_floor(point_light({2, 1e-6f, 0}, falloff), 2).color.x > 0);
  }
  Light light;
  light.kind = Light::Kind::kDirectional;
  light.direction = {0, 1, 0};
  REQUIRE(on_floor(light, 0).color == Color3f(0));
  light.direction = {1, 0, 0};
  REQUIRE(on_floor(light, 0).color == Color3f(0));
}

TEST_CASE("a shadow ray runs from the offset point to the light and no further", "[light]") {
  const Light light = point_light({4, 3, -2}, Falloff::kLinear);
  const Illumination arriving = on_floor(light, 1, 5);
  REQUIRE(arriving.shadow_ray.origin == Vector3f(1, 1e-3f, 5));
  REQUIRE(arriving.shadow_ray.t_min == 0);
  REQUIRE(arriving.shadow_ray.t_max == 1);
  REQUIRE(glm::length(arriving.shadow_ray.at(1) - light.position) < 1e-6f);
}

TEST_CASE("directional light is the same at every distance and its shadow rays are endless", "[light]") {
  Light light = point_light({0, 1, 0}, Falloff::kQuadratic);
  light.kind = Light::Kind::kDirectional;
  light.direction = glm::normalize(Vector3f(3, -4, 0));
  for (const float x : {-1e6f, 0.0f, 50.0f}) {
    const Illumination arriving = on_floor(light, x);
    require_near(static_cast<double>(arriving.color.x), 80);
    require_near(static_cast<double>(arriving.color.y), 160);
    REQUIRE(arriving.shadow_ray.direction == -light.direction);
    REQUIRE(arriving.shadow_ray.t_max == kInfinity);
  }
}

TEST_CASE("a spot with a hard edge is a point light within its cone and dark outside", "[light]") {
  for (const float angle : {10.0f, 60.0f, 150.0f}) {
    const Light light = spot(angle, 0);
    const double half = static_cast<double>(angle) / 2;
    require_near(share_at(light, 0), 1);
    require_near(share_at(light, half - 0.01), 1);
    REQUIRE(share_at(light, half + 0.01) == 0);
  }
}

TEST_CASE("a spot with a soft edge fades smoothly from the inner cone to the rim", "[light]") {
  const Light light = spot(60, 0.5f);  // full up to 15 degrees, none from 30 on
  require_near(share_at(light, 14.9), 1);
  REQUIRE(share_at(light, 30.01) == 0);
  double last = 1;
  for (double degrees = 15.5; degrees < 30; degrees += 0.5) {
    const double share = share_at(light, degrees);
    REQUIRE(share < last);
    REQUIRE(share > 0);
    last = share;
  }
  // Half way between the two cosines it is a half.
  const double middle = std::acos(0.5 * (std::cos(glm::radians(15.0)) + std::cos(glm::radians(30.0))));
  require_near(share_at(light, glm::degrees(middle)), 0.5);
}

TEST_CASE("a spot of the full circle is a point light", "[light]") {
  Light light = spot(360, 0);
  light.direction = {0, 1, 0};  // away from the floor
  require_near(share_at(light, 60), 1);
  light.direction = glm::normalize(Vector3f(1, 1, 0));
  require_near(share_at(light, 60), 1);
}
