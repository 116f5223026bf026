// Rays in bulk see what rays one by one see, to the last bit.
#include <bit>
#include <cstdint>
#include <random>
#include <vector>

#include "catch.hpp"
#include "raytracer/scene.hpp"
#include "raytracer/shapes.hpp"
#include "scene/pixel_color.hpp"
#include "shapes/ray_packet.hpp"

namespace {

using namespace raytracer;

class Random {
 public:
  float in(float low, float high) {
    return low + (high - low) * static_cast<float>(engine_() >> 40) * 0x1p-24F;
  }
  Vector3f in_box(float half) { return {in(-half, half), in(-half, half), in(-half, half)}; }
  /// Towards the middle of the scene, so that most rays hit.
  Ray3f ray() {
    const Vector3f origin = in_box(6);
    return {origin, in_box(2) - origin, 0, in(0, 1) < 0.5F ? kInfinity : in(0.2F, 1.5F)};
  }

 private:
  std::mt19937_64 engine_{7};
};

Transform tilted() {
  Transform tilt;
  tilt.linear = glm::dmat3(0.8, 0.6, 0, -0.6, 0.8, 0, 0.1, 0, 1.2);
  return tilt;
}

std::vector<std::unique_ptr<Shape>> one_of_each() {
  std::vector<std::unique_ptr<Shape>> shapes;
  shapes.push_back(make_sphere({0.3, 0, 0}, 1.5));
  shapes.push_back(make_sphere({-1, 1, 0}, 1, tilted()));
  shapes.push_back(make_quad({-3, -1, -3}, {6, 0, 0}, {0, 0.5, 6}));
  shapes.push_back(make_cube({1, 1, 1}, {1, 2, 1.5}));
  shapes.push_back(make_cube({-1, -1, 1}, {1, 2, 1.5}, tilted()));
  shapes.push_back(make_triangle({-2, 0, 0}, {2, 0, 1}, {0, 2, -1}));
  shapes.push_back(make_disk({0, 0, 1}, {0, 1, 1}, 1.5));
  shapes.push_back(make_cylinder({0, -1, 0}, {1, 2, 0}, 0.5, false));
  shapes.push_back(make_torus({0, 0, 0}, {0, 1, 0.2}, 1.5, 0.4));
  shapes.push_back(make_plane({0, -1.5, 0}, {0, 1, 0.1}));
  return shapes;
}

SceneDescription mirrors_and_lights() {
  SceneDescription scene;
  scene.shapes = one_of_each();
  // Pairs at the same place: only their order says which is hit.
  scene.shapes.push_back(make_sphere({0.3, 0, 0}, 1.5));
  scene.shapes.push_back(make_quad({-3, -1, -3}, {6, 0, 0}, {0, 0.5, 6}));
  scene.shapes.push_back(make_plane({0, -1.5, 0}, {0, 1, 0.1}));
  const auto add_material = [&scene](const Color3f& color, float shininess) {
    Material& material = scene.materials.emplace_back();
    material.color = color;
    material.shininess = shininess;
  };
  add_material({0.9F, 0.5F, 0.3F}, 0.4F);
  add_material({0.7F, 0.8F, 0.9F}, 0);
  add_material({0.9F, 0.9F, 0.8F}, 1);
  for (std::uint32_t i = 0; i < scene.shapes.size(); ++i) scene.material_of.push_back(i % 3);
  Light point, spot;
  point.position = {2, 6, 5};
  spot.kind = Light::Kind::kSpot;
  spot.position = {-5, 4, 3};
  spot.direction = glm::normalize(Vector3f(5, -4, -3));
  spot.cos_outer = 0.8F;
  scene.lights = {point, spot};
  scene.background = {0.2F, 0.3F, 0.4F};
  scene.ambient = Color3f(0.05F);
  return scene;
}

void require_same(const Hit& a, const Hit& b) {
  REQUIRE(std::bit_cast<std::uint32_t>(a.t) == std::bit_cast<std::uint32_t>(b.t));
  REQUIRE(a.shape == b.shape);
  REQUIRE(a.primitive == b.primitive);
  REQUIRE(std::bit_cast<std::uint32_t>(a.u) == std::bit_cast<std::uint32_t>(b.u));
  REQUIRE(std::bit_cast<std::uint32_t>(a.v) == std::bit_cast<std::uint32_t>(b.v));
}

RayPacket packet_of(const std::vector<Ray3f>& rays) {
  RayPacket packet;
  for (std::size_t i = 0; i < RayPacket::kSize; ++i) {
    packet.origin_x[i] = rays[i].origin.x;
    packet.origin_y[i] = rays[i].origin.y;
    packet.origin_z[i] = rays[i].origin.z;
    packet.direction_x[i] = rays[i].direction.x;
    packet.direction_y[i] = rays[i].direction.y;
    packet.direction_z[i] = rays[i].direction.z;
    packet.t_min[i] = rays[i].t_min;
    packet.t_max[i] = rays[i].t_max;
  }
  return packet;
}

TEST_CASE("a shape says the same of eight rays as of each") {
  Random random;
  for (const auto& shape : one_of_each()) {
    int found = 0;
    for (int turn = 0; turn < 500; ++turn) {
      std::vector<Ray3f> rays(RayPacket::kSize);
      for (Ray3f& ray : rays) ray = random.ray();
      rays[3].t_max = -kInfinity;  // idle
      HitPacket hits;
      shape->find_hits(packet_of(rays), hits);
      for (std::size_t i = 0; i < rays.size(); ++i) {
        Hit hit;
        const bool is_hit = shape->is_hit(rays[i], hit);
        REQUIRE((hits.t[i] < kInfinity) == is_hit);
        if (is_hit) require_same({hits.t[i], 0, hits.primitive[i], hits.u[i], hits.v[i]}, hit);
        found += is_hit;
      }
      REQUIRE(hits.t[3] == kInfinity);
    }
    REQUIRE(found > 100);
  }
}

TEST_CASE("a scene says the same of a packet of rays as of each") {
  const Scene scene(mirrors_and_lights());
  Random random;
  for (int turn = 0; turn < 3000; ++turn) {
    const std::size_t count = 1 + static_cast<std::size_t>(turn) % kMostRays;
    const Coherence coherence = turn / 16 % 2 == 0 ? Coherence::kCoherent : Coherence::kIncoherent;
    std::vector<Ray3f> rays(count);
    const Ray3f first = random.ray();
    for (Ray3f& ray : rays) {
      ray = random.ray();
      if (turn % 3 == 0) ray = {first.origin, first.direction + 0.01F * ray.direction};  // as a camera's
    }
    if (turn % 7 == 0) rays[0].origin.x = 3e18F;  // farther than the tree can be seen
    std::vector<Hit> hits(count);
    const std::uint32_t found = scene.is_hit(rays, hits, coherence);
    const std::uint32_t hidden = scene.is_occluded(rays, coherence);
    REQUIRE(std::uint64_t{found | hidden} >> count == 0);
    for (std::size_t i = 0; i < count; ++i) {
      Hit hit;
      const bool is_hit = scene.is_hit(rays[i], hit);
      REQUIRE((found >> i & 1U) == is_hit);
      REQUIRE((hidden >> i & 1U) == scene.is_occluded(rays[i]));
      if (is_hit) require_same(hits[i], hit);
    }
  }
}

TEST_CASE("colours of many rays are those of each, and the rays are counted alike") {
  const Scene scene(mirrors_and_lights());
  Random random;
  PixelColors tracer(scene);
  std::uint64_t expected_rays = 0;
  for (const int bounces : {3, 0, 8, 1}) {
    for (const std::size_t count : {0U, 1U, 16U, 203U}) {
      std::vector<Ray3f> rays(count);
      for (Ray3f& ray : rays) ray = random.ray();
      std::vector<Color3f> colors(count);
      tracer.trace(rays, bounces, colors);
      for (std::size_t i = 0; i < count; ++i) {
        const Color3f expected = get_pixel_color(scene, rays[i], bounces, expected_rays);
        for (int c = 0; c < 3; ++c) {
          REQUIRE(std::bit_cast<std::uint32_t>(colors[i][c]) == std::bit_cast<std::uint32_t>(expected[c]));
        }
      }
    }
  }
  REQUIRE(tracer.rays() == expected_rays);
}

}  // namespace
