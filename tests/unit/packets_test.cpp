// Rays in bulk see what rays one by one see, to the last bit.
#include <bit>
#include <cstdint>
#include <cstring>
#include <memory>
#include <random>
#include <vector>

#include "catch.hpp"
#include "lights/illuminate.hpp"
#include "raytracer/scene.hpp"
#include "raytracer/shapes.hpp"
#include "scene/pixel_color.hpp"
#include "shapes/hit_block.hpp"
#include "shapes/mesh.hpp"
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
  for (int i = 0; i < RayPacket::kSize; ++i) packet.set(i, rays[static_cast<std::size_t>(i)]);
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

std::shared_ptr<const MeshData> pyramid(bool is_smooth) {
  auto data = std::make_shared<MeshData>();
  data->positions = {{-2, 0, -2}, {2, 0.3F, -2}, {1.5F, 0, 2}, {-2, -0.2F, 1}, {0.1F, 2, 0}};
  data->triangles = {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}, {0, 2, 1}, {0, 3, 2}};
  if (is_smooth) {
    for (const Vector3f& p : data->positions)
      data->normals.push_back(glm::normalize(p - Vector3f(0, 0.5F, 0)));
    data->normals[3] = Vector3f(0);  // as of a file that has none there
  }
  data->positions.reserve(data->positions.size() + 1);
  return data;
}

bool is_same(const Vector3f& a, const Vector3f& b) { return std::memcmp(&a, &b, sizeof a) == 0; }

TEST_CASE("a shape says the same of the surfaces of a block as of each, and leaves the others alone") {
  Random random;
  std::vector<std::unique_ptr<Shape>> shapes = one_of_each();
  for (const bool is_smooth : {false, true}) {
    shapes.push_back(std::make_unique<TriangleMesh>(pyramid(is_smooth), 0, 6));
  }
  const SurfacePoint untouched{{1, 2, 3}, 4, {5, 6, 7}, {8, 9, 10}, {11, 12, 13}};
  for (const auto& shape : shapes) {
    int found = 0;
    for (int turn = 0; turn < 100; ++turn) {
      RayBlock rays;
      HitBlock hits{};
      BlockMask asked = BlockMask::none();
      SurfaceBlock surfaces;
      for (int i = 0; i < kBlockSize; ++i) {
        rays.set(i, random.ray());
        Hit hit;
        asked.set(i, shape->is_hit(rays.ray(i), hit));
        hits.set(i, hit);
        surfaces.set(i, untouched);
      }
      shape->surfaces_at(rays, hits, asked, surfaces);
      for (int i = 0; i < kBlockSize; ++i) {
        const SurfacePoint expected = asked.has(i) ? shape->surface_at(rays.ray(i), hits.at(i)) : untouched;
        const SurfacePoint point = surfaces.at(i);
        REQUIRE(is_same(point.position, expected.position));
        REQUIRE(point.position_error == expected.position_error);
        REQUIRE(is_same(point.normal, expected.normal));
        REQUIRE(is_same(point.shading_normal, expected.shading_normal));
        REQUIRE(point.shadow_offset == expected.shadow_offset);
      }
      found += asked.count();
    }
    REQUIRE(found > 100);
  }
}

TEST_CASE("a light gives a block of points what it gives each") {
  Random random;
  int lit = 0;
  for (const Light::Kind kind : {Light::Kind::kPoint, Light::Kind::kDirectional, Light::Kind::kSpot}) {
    for (const Falloff falloff : {Falloff::kNone, Falloff::kLinear, Falloff::kQuadratic}) {
      Light light;
      light.kind = kind;
      light.falloff = falloff;
      light.position = {0.5F, 1, 0};
      light.direction = glm::normalize(Vector3f(0.2F, -1, 0.1F));
      light.cos_inner = 0.8F;
      light.cos_outer = 0.2F;
      Vector3Block positions, normals, origins;
      for (int i = 0; i < kBlockSize; ++i) {
        positions.set(i, random.in_box(3));
        normals.set(i, glm::normalize(random.in_box(1)));
        origins.set(i, positions.at(i) + 0.01F * normals.at(i));
      }
      positions.set(5, light.position);  // no light comes from nowhere
      ColorBlock colors;
      RayBlock shadow_rays;
      illuminate(light, positions, normals, origins, colors, shadow_rays);
      for (int i = 0; i < kBlockSize; ++i) {
        const Illumination one = illuminate(light, positions.at(i), normals.at(i), origins.at(i));
        REQUIRE(is_same(colors.at(i), one.color));
        REQUIRE(is_same(shadow_rays.origin(i), one.shadow_ray.origin));
        REQUIRE(is_same(shadow_rays.direction(i), one.shadow_ray.direction));
        REQUIRE(shadow_rays.t_max[i] == one.shadow_ray.t_max);
        lit += one.color != Color3f(0);
      }
    }
  }
  REQUIRE(lit > 30);
}

TEST_CASE("a scene answers for the lanes that it is asked about") {
  const Scene scene(mirrors_and_lights());
  RayBlock rays;
  BlockMask asked;
  for (int i = 0; i < kBlockSize; ++i) {
    rays.set(i, {{0.1F * static_cast<float>(i), 5, 0}, {0, -1, 0}});
    asked.set(i, i % 3 == 0);
  }
  HitBlock hits;
  REQUIRE(scene.is_hit(rays, asked, hits, Coherence::kCoherent).bits() == asked.bits());
  REQUIRE(scene.is_occluded(rays, asked, Coherence::kCoherent).bits() == asked.bits());
  REQUIRE(scene.is_hit(rays, BlockMask::none(), hits, Coherence::kCoherent).is_empty());
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
      std::vector<RayBlock> rays(blocks_for(count));
      std::vector<ColorBlock> colors(rays.size());
      for (std::size_t i = 0; i < count; ++i) rays[i / 16].set(static_cast<int>(i % 16), random.ray());
      tracer.trace({rays, count}, bounces, colors);
      for (std::size_t i = 0; i < count; ++i) {
        const int lane = static_cast<int>(i % 16);
        const Color3f expected = get_pixel_color(scene, rays[i / 16].ray(lane), bounces, expected_rays);
        REQUIRE(is_same(colors[i / 16].at(lane), expected));
      }
    }
  }
  REQUIRE(tracer.rays() == expected_rays);
}

TEST_CASE("a light too bright for any number does nothing where it is hidden") {
  SceneDescription description;
  description.shapes.push_back(make_quad({-1, 0, 1}, {2, 0, 0}, {0, 0, -2}));
  description.shapes.push_back(make_quad({-1, 4e-6, 1}, {2, 0, 0}, {0, 0, -2}));
  description.material_of = {0, 0};
  description.materials.resize(1);
  Light light;
  light.falloff = Falloff::kQuadratic;
  light.position = {0, 8e-6F, 0};
  light.lambda = Color3f(1e32F);
  description.lights = {light};
  description.ambient = Color3f(0.5F);
  const Scene scene(std::move(description));
  std::vector<RayBlock> rays(1);
  std::vector<ColorBlock> colors(1);
  for (int i = 0; i < kBlockSize; ++i) {
    rays[0].set(i, {{1e-7F * static_cast<float>(i), 2e-6F, 0}, {0, -1, 0}});
  }
  PixelColors(scene).trace({rays, kBlockSize}, 0, colors);
  for (int i = 0; i < kBlockSize; ++i) {
    REQUIRE(is_same(colors[0].at(i), Color3f(255 * 0.5F * 0.8F)));
  }
}

}  // namespace
