// Sixteen matt vertices at once are shaded as each would be alone.
#include "integrators/matt_vertices.hpp"

#include <cmath>
#include <memory>
#include <random>
#include <vector>

#include "catch.hpp"
#include "integrators/weights.hpp"
#include "raytracer/shapes.hpp"

namespace {

using namespace raytracer;

struct Random {
  std::mt19937 engine{7};
  float in(float low, float high) {
    return low + (high - low) * static_cast<float>(engine() >> 8U) * 0x1p-24F;
  }
  Vector3f vector() {
    const float x = in(-1, 1), y = in(-1, 1);
    return {x, y, in(-1, 1)};
  }
  Vector3f direction() { return glm::normalize(vector() + Vector3f(1e-3F)); }
};

MattVertices random_vertices(Random& random, std::vector<Vector3f>& ways, std::size_t count) {
  MattVertices vertices;
  for (std::uint32_t k = 0; k < count; ++k) {
    SurfacePoint surface;
    surface.position = 2.0F * random.vector();
    surface.normal = surface.shading_normal = random.direction();
    ways.push_back(random.direction());
    vertices.add(k, surface, ways.back());
    const auto i = static_cast<int>(k);
    vertices.offset[i] = 1e-4F;
    vertices.color.set(i, {random.in(-0.1F, 1.1F), random.in(0, 1), random.in(0, 1)});
    vertices.throughput.set(i, {random.in(0, 1), random.in(0, 1), random.in(0, 1)});
    vertices.lights.from.u[i] = random.in(0, 1);
    vertices.lights.from.v[i] = random.in(0, 1);
    vertices.lights.u_light[i] = random.in(0, 1);
    vertices.u[i] = random.in(0, 1);
    vertices.v[i] = random.in(0, 1);
  }
  vertices.lights.count = static_cast<int>(count);
  return vertices;
}

Bsdf bsdf_of(const MattVertices& vertices, int i) {
  Material material;
  material.color = vertices.color.at(i);
  BsdfFrame frame;
  frame.geometric_normal = frame.normal = vertices.normal.at(i);
  return {material, frame};
}

SceneDescription lit_by(std::size_t lamps) {
  SceneDescription scene;
  for (std::size_t i = 0; i < lamps; ++i) {
    Material material;
    material.emission = {3, 2, 1};
    material.is_area_light = i % 2 == 0;
    scene.material_of.push_back(static_cast<std::uint32_t>(scene.materials.size()));
    scene.materials.push_back(material);
    const double x = static_cast<double>(i);
    scene.shapes.push_back(make_quad({x, 2, 0}, {1, 0, 0}, {0, 0.2, 1}, {}));
  }
  return scene;
}

}  // namespace

TEST_CASE("the light that sixteen vertices look at is that of each alone") {
  Random random;
  for (const std::size_t lamps : {1U, 3U}) {
    const SceneDescription scene = lit_by(lamps);
    const LightSet lights(scene);
    int lit = 0;
    for (int turn = 0; turn < 300; ++turn) {
      const std::size_t count = turn % 3 == 0 ? 5 : 16;
      std::vector<Vector3f> ways;
      MattVertices vertices = random_vertices(random, ways, count);
      LightSamples samples;
      lights.sample(vertices.lights, samples);
      vertices.find_light(samples, Sampling::kBoth);
      for (int i = 0; i < static_cast<int>(count); ++i) {
        const Vector3f out = -ways[static_cast<std::size_t>(i)];
        const Vector3f normal = vertices.normal.at(i);
        const Vector3f facing = glm::dot(normal, out) > 0 ? normal : -normal;
        LightSample light;
        const LightQueries& asked = vertices.lights;
        const bool is_some = lights.sample(vertices.position.at(i), facing, asked.u_light[i],
                                           {asked.from.u[i], asked.from.v[i]}, light);
        REQUIRE((samples.pdf[i] > 0) == is_some);
        if (!is_some) continue;
        REQUIRE(samples.pdf[i] == light.pdf);
        REQUIRE(samples.direction.x[i] == light.direction.x);
        REQUIRE(samples.target.y[i] == light.target.y);
        float chosen = 0;
        const Color3f value = bsdf_of(vertices, i).evaluate(out, light.direction, chosen);
        REQUIRE((vertices.is_lit[i] != 0) == (value.x > 0 || value.y > 0 || value.z > 0));
        if (vertices.is_lit[i] == 0) continue;
        ++lit;
        REQUIRE(vertices.light.at(i) == vertices.throughput.at(i) * value *
                                            (power_heuristic(light.pdf, chosen) / light.pdf) *
                                            light.radiance);
      }
    }
    CHECK(lit > 500);
  }
}

TEST_CASE("the way on from sixteen vertices is that of each alone") {
  Random random;
  for (int turn = 0; turn < 300; ++turn) {
    std::vector<Vector3f> ways;
    MattVertices vertices = random_vertices(random, ways, 16);
    const Vector3Block before = vertices.throughput;
    vertices.scatter();
    for (int i = 0; i < 16; ++i) {
      BsdfSample sample;
      const bool goes_on =
          bsdf_of(vertices, i)
              .sample(-ways[static_cast<std::size_t>(i)], 0.5F, {vertices.u[i], vertices.v[i]}, sample);
      REQUIRE((vertices.pdf[i] > 0) == goes_on);
      if (!goes_on) continue;
      REQUIRE(vertices.direction.at(i) == sample.direction);
      REQUIRE(vertices.pdf[i] == sample.pdf);
      REQUIRE(vertices.throughput.at(i) == before.at(i) * sample.weight);
    }
  }
}
