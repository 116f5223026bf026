// What shines, and which of it is looked at: closed forms by sampling, densities, and every light's due
// share.
#include "scene/light_set.hpp"

#include <cmath>
#include <cstdint>
#include <memory>
#include <random>
#include <vector>

#include "catch.hpp"
#include "lights/light_tree.hpp"
#include "raytracer/shapes.hpp"

namespace {

using namespace raytracer;

constexpr double kPi = 3.14159265358979323846;

class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}
  float unit() { return static_cast<float>(engine_() >> 40) * 0x1p-24f; }
  float in(float low, float high) { return low + (high - low) * unit(); }
  Vector2f square() {
    const float x = unit();
    return {x, unit()};
  }
  Vector3f in_box(float half) {
    const float x = in(-half, half), y = in(-half, half);
    return {x, y, in(-half, half)};
  }

 private:
  std::mt19937_64 engine_;
};

std::uint32_t add_material(SceneDescription& scene, const Color3f& emission, bool is_area_light) {
  Material material;
  material.emission = emission;
  material.is_area_light = is_area_light;
  scene.materials.push_back(material);
  return static_cast<std::uint32_t>(scene.materials.size() - 1);
}

void add(SceneDescription& scene, std::unique_ptr<Shape> shape, const Color3f& emission = Color3f(1),
         bool is_area_light = false) {
  scene.shapes.push_back(std::move(shape));
  scene.material_of.push_back(add_material(scene, emission, is_area_light));
}

Light point_light(const Vector3f& position, float lambda, Falloff falloff) {
  Light light;
  light.position = position;
  light.lambda = Color3f(lambda);
  light.falloff = falloff;
  return light;
}

/// The irradiance of a surface, as a path tracer finds it; what stands between does not count.
double irradiance(const LightSet& lights, const Vector3f& position, const Vector3f& normal,
                  int samples = 200000, bool knows_normal = true) {
  Random random(5);
  double sum = 0;
  for (int i = 0; i < samples; ++i) {
    LightSample sample;
    // The first dimension evenly, the others by chance.
    const float u = (static_cast<float>(i) + 0.5f) / static_cast<float>(samples);
    if (!lights.sample(position, knows_normal ? normal : Vector3f(0), u, random.square(), sample)) continue;
    const float cosine = std::max(glm::dot(normal, sample.direction), 0.0f);
    sum += static_cast<double>(sample.radiance.x * cosine) / static_cast<double>(sample.pdf);
  }
  return sum / samples;
}

double rectangle_below_centre(double width, double height, double h) {
  const double x = 0.5 * width / h, y = 0.5 * height / h;
  return 2 * (x / std::sqrt(1 + x * x) * std::atan(y / std::sqrt(1 + x * x)) +
              y / std::sqrt(1 + y * y) * std::atan(x / std::sqrt(1 + y * y)));
}

const Vector3f kUp(0, 1, 0);
const Vector3d kX(1, 0, 0), kY(0, 1, 0), kZ(0, 0, 1);

/// White above the horizon, black below, chosen uniformly over all directions.
class UpperHalf final : public Environment {
 public:
  Color3f radiance(const Vector3f& direction) const override {
    return Color3f(direction.y > 0 ? 1.0f : 0.0f);
  }
  bool sample(const Vector2f& u, Vector3f& direction, float& pdf) const override {
    const float z = 1 - 2 * u.x, r = std::sqrt(std::max(0.0f, 1 - z * z)),
                a = 2 * static_cast<float>(kPi) * u.y;
    direction = {r * std::cos(a), z, r * std::sin(a)};
    pdf = this->pdf(direction);
    return true;
  }
  float pdf(const Vector3f&) const override { return 1 / (4 * static_cast<float>(kPi)); }
  Color3f mean() const override { return Color3f(0.5f); }
};

}  // namespace

TEST_CASE("irradiance of a disk, a ball and rectangles is what the formulas say", "[lights]") {
  for (const double h : {0.5, 1.0, 2.0, 4.0}) {
    SceneDescription scene;
    add(scene, make_disk(h * kY, kY, 1));
    CHECK(irradiance(LightSet(scene), Vector3f(0), kUp) == Approx(kPi / (1 + h * h)).epsilon(0.005));
  }
  for (const double d : {1.0, 3.0, 10.0}) {
    SceneDescription scene;
    add(scene, make_sphere(d * kY, 0.5));
    CHECK(irradiance(LightSet(scene), Vector3f(0), kUp) == Approx(kPi * 0.25 / (d * d)).epsilon(0.005));
  }
  for (const Vector3d& size : {Vector3d(2, 2, 1), Vector3d(1, 1, 1), Vector3d(4, 1, 2), Vector3d(1, 1, 50)}) {
    SceneDescription scene;
    add(scene, make_quad({-0.5 * size.x, size.z, 0.5 * size.y}, size.x * kX, -size.y * kZ), Color3f(1));
    CHECK(irradiance(LightSet(scene), Vector3f(0), kUp) ==
          Approx(rectangle_below_centre(size.x, size.y, size.z)).epsilon(0.005));
  }
}

TEST_CASE("from on the inside of a ball that shines it is all around", "[lights]") {
  Random random(15);
  for (const double radius : {1e-3, 2.0, 1e5}) {
    for (const Vector3d& center : {Vector3d(0), Vector3d(30 * radius, -7 * radius, radius)}) {
      SceneDescription scene;
      add(scene, make_sphere(center, radius), Color3f(0.5f));
      const Scene owner(std::move(scene));
      const LightSet lights(owner.description());
      double sum = 0;
      const int kSamples = 20000;
      for (int i = 0; i < kSamples; ++i) {
        const Ray3f ray = {Vector3f(center), glm::normalize(random.in_box(1))};
        Hit hit;
        REQUIRE(owner.is_hit(ray, hit));
        const SurfacePoint point = owner.surface_at(ray, hit);
        LightSample sample;
        if (!lights.sample(point.position, -point.normal, random.unit(), random.square(), sample)) continue;
        const float cosine = std::max(-glm::dot(point.normal, sample.direction), 0.0f);
        if (owner.is_occluded(sample.shadow_ray(point.position - point.position_error * point.normal)))
          continue;
        sum += static_cast<double>(sample.radiance.x * cosine / sample.pdf);
      }
      CHECK(sum / kSamples == Approx(0.5 * kPi).epsilon(0.01));
    }
  }
}

TEST_CASE("an area light shines on the side of its normal only", "[lights]") {
  SceneDescription scene;
  add(scene, make_quad({-1, 1, -1}, 2.0 * kX, 2.0 * kZ), Color3f(1), true);  // normal downwards
  const LightSet lights(scene);
  CHECK(irradiance(lights, Vector3f(0), kUp) == Approx(rectangle_below_centre(2, 2, 1)).epsilon(0.005));
  CHECK(irradiance(lights, Vector3f(0, 2, 0), -kUp) == 0);
}

TEST_CASE("form factors of unit squares", "[lights]") {
  Random random(6);
  const auto mean = [&](const SceneDescription& scene) {
    const LightSet lights(scene);
    double sum = 0;
    const int kSamples = 100000;
    for (int i = 0; i < kSamples; ++i) {
      LightSample sample;
      const Vector3f position(random.unit(), 0, random.unit());
      if (!lights.sample(position, kUp, random.unit(), random.square(), sample)) continue;
      sum += static_cast<double>(std::max(sample.direction.y, 0.0f) / sample.pdf) / kPi;
    }
    return sum / kSamples;
  };
  SceneDescription facing, corner;
  add(facing, make_quad(kY, kX, kZ));
  add(corner, make_quad({0, 0, 0}, kX, kY));
  CHECK(mean(facing) == Approx(0.199825).epsilon(0.005));
  CHECK(mean(corner) == Approx(0.200044).epsilon(0.005));
}

TEST_CASE("half a white sky on a tilted plane", "[lights]") {
  SceneDescription scene;
  scene.sky = std::make_shared<UpperHalf>();
  const LightSet lights(scene);
  for (const double degrees : {0.0, 30.0, 60.0, 90.0, 120.0, 180.0}) {
    const double b = degrees * kPi / 180;
    const Vector3f normal(Vector3d(std::sin(b), std::cos(b), 0));
    CHECK(irradiance(lights, Vector3f(0), normal, 200000) ==
          Approx(kPi * (1 + std::cos(b)) / 2).epsilon(0.006).margin(1e-3));
  }
  CHECK(lights.sky_pdf(Vector3f(0), kUp, kUp) == Approx(1 / (4 * kPi)));
}

TEST_CASE("points, spots and distant lights: the paper's units times pi", "[lights]") {
  for (const Falloff falloff : {Falloff::kNone, Falloff::kLinear, Falloff::kQuadratic}) {
    SceneDescription scene;
    scene.lights.push_back(point_light({0, 2, 2}, 255, falloff));
    const double d = std::sqrt(8.0);
    const double fade = falloff == Falloff::kNone ? 1 : falloff == Falloff::kLinear ? 1 / d : 1 / (d * d);
    CHECK(irradiance(LightSet(scene), Vector3f(0), kUp, 10) == Approx(kPi * fade * 2 / d));
    CHECK(irradiance(LightSet(scene), Vector3f(0), -kUp, 10) == 0);
  }
  SceneDescription far;
  far.lights.push_back({});
  far.lights[0].kind = Light::Kind::kDirectional;
  CHECK(irradiance(LightSet(far), Vector3f(0), kUp, 10) == Approx(kPi));
  CHECK(irradiance(LightSet(far), Vector3f(0), -kUp, 10) == 0);
  far.lights.push_back(far.lights[0]);
  far.lights[1].lambda = Color3f(25.5f);
  far.lights[1].direction = glm::normalize(Vector3f(1, -1, 0));
  CHECK(irradiance(LightSet(far), Vector3f(0), kUp) ==
        Approx(kPi * (1 + 0.1 * std::sqrt(0.5))).epsilon(1e-3));

  SceneDescription spot;
  spot.lights.push_back(point_light({0, 1, 0}, 255, Falloff::kQuadratic));
  spot.lights[0].kind = Light::Kind::kSpot;
  spot.lights[0].cos_inner = 0.9f;
  spot.lights[0].cos_outer = 0.8f;
  spot.lights.push_back(spot.lights[0]);
  spot.lights[1].position.x = 5;
  const LightSet lights(spot);
  CHECK(irradiance(lights, Vector3f(0), kUp) == Approx(kPi).epsilon(0.01));
  CHECK(irradiance(lights, Vector3f(2.5f, 0, 0), kUp) == 0);
}

TEST_CASE("any number of lights has its due share", "[lights]") {
  for (const int count : {1, 2, 1000, 100000}) {
    Random random(7);
    SceneDescription scene;
    std::vector<double> truth(4, 0.0);
    const Vector3f places[] = {{0, 0, 0}, {3, 1, -2}, {0.3f, -0.8f, 0.1f}, {30, 0, 0}};
    const Vector3f normals[] = {kUp, glm::normalize(Vector3f(-1, 0.2f, 0.4f)), -kUp, {-1, 0, 0}};
    for (int i = 0; i < count; ++i) {
      const Falloff falloff = static_cast<Falloff>(i % 3);
      Light light = point_light(random.in_box(2), random.in(1, 100), falloff);
      if (i % 5 == 4) {
        light.kind = Light::Kind::kSpot;
        light.direction = glm::normalize(random.in_box(1) + Vector3f(0, 0.01f, 0));
        light.cos_inner = random.in(0, 0.9f);
        light.cos_outer = light.cos_inner - random.in(0, 0.9f);
      }
      scene.lights.push_back(light);
      for (std::size_t k = 0; k < 4; ++k) {
        const Vector3f way = light.position - places[k];
        const float d = glm::length(way), cosine = std::max(glm::dot(way, normals[k]) / d, 0.0f);
        const float fade = falloff == Falloff::kNone ? 1 : falloff == Falloff::kLinear ? 1 / d : 1 / (d * d);
        float share = 1;
        if (light.kind == Light::Kind::kSpot) {
          const float c = -glm::dot(way, light.direction) / d;
          share = glm::smoothstep(light.cos_outer, light.cos_inner, c);
        }
        truth[k] += static_cast<double>(light.lambda.x * cosine * fade * share) * kPi / 255;
      }
    }
    const LightSet lights(scene);
    for (std::size_t k = 0; k < 4; ++k) {
      INFO(count << " lights, place " << k);
      CHECK(irradiance(lights, places[k], normals[k], 100000) == Approx(truth[k]).epsilon(0.02));
      CHECK(irradiance(lights, places[k], normals[k], 100000, false) == Approx(truth[k]).epsilon(0.03));
    }
  }
}

TEST_CASE("a thousand small panels, some to one side", "[lights]") {
  Random random(8);
  SceneDescription scene;
  double truth = 0;
  const Vector3f place(0.1f, -1.5f, 0.2f);
  for (int i = 0; i < 1000; ++i) {
    const Vector3d corner(random.in_box(1));
    const Vector3d w = 0.01 * glm::normalize(Vector3d(random.in_box(1)));
    const Vector3d h = 0.01 * glm::normalize(glm::cross(w, Vector3d(random.in_box(1))));
    const bool is_area_light = i % 2 == 0;
    const float radiance = random.in(0.5f, 20);
    add(scene, make_quad(corner, w, h), Color3f(radiance), is_area_light);
    const Vector3d way = corner + 0.5 * (w + h) - Vector3d(place);
    const double squared = glm::dot(way, way);
    const double facing = -glm::dot(way, glm::cross(w, h)) / std::sqrt(squared);  // times the area
    truth += static_cast<double>(radiance) * (is_area_light ? std::max(facing, 0.0) : std::abs(facing)) *
             std::max(way.y, 0.0) / std::sqrt(squared) / squared;
  }
  CHECK(irradiance(LightSet(scene), place, kUp, 200000) == Approx(truth).epsilon(0.01));
}

TEST_CASE("a light of 1e30 beside one of 1e-30", "[lights]") {
  SceneDescription scene;
  add(scene, make_quad({-1, 1, -1}, 2.0 * kX, 2.0 * kZ), Color3f(1e30f));
  add(scene, make_quad({4, 1, -1}, 2.0 * kX, 2.0 * kZ), Color3f(1e-30f));
  scene.lights.push_back(point_light({0, 3, 0}, 1e-30f, Falloff::kQuadratic));
  const LightSet lights(scene);
  Random random(9);
  for (int i = 0; i < 10000; ++i) {
    LightSample sample;
    if (!lights.sample(random.in_box(0.9f), kUp, random.unit(), random.square(), sample)) continue;
    CHECK((sample.pdf > 0 && std::isfinite(sample.pdf)));
    CHECK(std::isfinite(sample.radiance.x / sample.pdf));
  }
  CHECK(irradiance(lights, Vector3f(0), kUp) / 1e30 ==
        Approx(rectangle_below_centre(2, 2, 1)).epsilon(0.005));
  // Both ways around; what shines not at all, or is no number, is left out.
  SceneDescription dark;
  add(dark, make_sphere({0, 3, 0}, 1), Color3f(0));
  add(dark, make_sphere({0, 3, 0}, 1), Color3f(NAN));
  dark.lights.push_back(point_light({0, 3, 0}, 0, Falloff::kLinear));
  CHECK(LightSet(dark).is_empty());
  LightSample sample;
  CHECK_FALSE(LightSet(dark).sample(Vector3f(0), kUp, 0.5f, {0.5f, 0.5f}, sample));
}

TEST_CASE("doubling all that shines doubles it to the bit", "[lights]") {
  const auto scene_of = [](float factor) {
    SceneDescription scene;
    Random random(10);
    for (int i = 0; i < 20; ++i) {
      add(scene, make_sphere(Vector3d(random.in_box(3)), 0.2),
          factor * Color3f(random.unit(), random.unit(), 1));
      scene.lights.push_back(point_light(random.in_box(3), factor * random.in(1, 300), Falloff::kLinear));
    }
    return scene;
  };
  const SceneDescription one = scene_of(1), two = scene_of(2);
  const LightSet lights(one), bright(two);
  Random random(11);
  for (int i = 0; i < 1000; ++i) {
    const Vector3f place = random.in_box(3);
    const float u = random.unit();
    const Vector2f v = random.square();
    LightSample a, b;
    REQUIRE(lights.sample(place, kUp, u, v, a) == bright.sample(place, kUp, u, v, b));
    if (a.pdf == 0) continue;
    CHECK(a.direction == b.direction);
    CHECK(a.pdf == b.pdf);
    CHECK(2.0f * a.radiance == b.radiance);
  }
}

namespace {

/// Several kinds of things that shine, also as instances.
SceneDescription varied_scene() {
  SceneDescription scene;
  add(scene, make_sphere({2, 0, 0}, 0.5), Color3f(3));
  add(scene, make_plane({0, -9, 0}, kY), Color3f(1));  // endless: shines, but is never chosen
  add(scene, make_cube({-2, 0.2, 0}, {0.5, 1, 0.7}), Color3f(2));
  add(scene, make_quad({-1, 3, -1}, {0, 0, 2}, {2, 0, 0}), Color3f(0.5f), true);
  add(scene, make_cylinder({0, -2, 0}, {0.3, -2, 1}, 0.3, false), Color3f(4));
  std::vector<std::unique_ptr<Shape>> shapes;
  shapes.push_back(make_sphere({0, 0, 0}, 0.4));
  shapes.push_back(make_torus({1, 0, 0}, kY, 0.3, 0.1));
  shapes.push_back(make_quad({0, 1, 0}, {0.5, 0, 0}, {0, 0.4, 0}));
  shapes.push_back(make_cube({0, -1, 0}, {0.3, 0.3, 0.3}));
  std::vector<Material> materials(2);
  materials[1].emission = Color3f(1.5f);
  scene.shared.push_back(
      std::make_shared<SharedShapes>(std::move(shapes), std::vector<std::uint32_t>{1, 0, 1, 1}, materials));
  for (int i = 0; i < 3; ++i) {
    Instance instance;
    instance.translation = {static_cast<float>(i - 1) * 3, 0.5f, -4};
    if (i == 1) instance.linear = {0.5f, 0.2f, 0, 0.1f, 1.2f, 0.3f, 0, -0.2f, -0.8f};
    if (i == 2) instance.linear = 2.0f * instance.linear;
    scene.instances.push_back(instance);
  }
  return scene;
}

}  // namespace

TEST_CASE("what a ray meets has the density with which it would have been chosen", "[lights]") {
  SceneDescription description = varied_scene();
  description.sky = std::make_shared<UpperHalf>();
  const Scene scene(std::move(description));
  const LightSet lights(scene.description());
  Random random(12);
  int met = 0, weak = 0, off = 0;
  for (int i = 0; i < 20000; ++i) {
    const Vector3f from = random.in_box(4);
    const Vector3f normal = i % 3 == 0 ? Vector3f(0) : glm::normalize(random.in_box(1));
    LightSample sample;
    if (!lights.sample(from, normal, random.unit(), random.square(), sample) || sample.is_far) continue;
    Hit hit;
    const Ray3f ray = {from, sample.direction};
    if (!scene.is_hit(ray, hit)) continue;
    const SurfacePoint point = scene.surface_at(ray, hit);
    if (glm::length(point.position - sample.target) > 1e-3f) continue;  // something in between
    const bool is_clear = !scene.is_occluded(sample.shadow_ray(from));
    const float cosine = std::abs(glm::dot(point.normal, sample.direction));
    if (cosine < 0.05f) continue;
    ++met;
    if (!is_clear) ++weak;
    const float pdf = lights.pdf(from, normal, hit, point);
    if (std::abs(pdf / sample.pdf - 1) > 5e-3f) ++off;  // beside an edge it may meet the other face
  }
  CHECK(met > 3000);
  CHECK(weak <= met / 1000);
  CHECK(off <= met / 1000);
}

TEST_CASE("an instance shines like the shape in its place", "[lights]") {
  const glm::dmat3 m(0.5, 0.2, 0, 0.1, 1.2, 0.3, 0, -0.2, -0.8);
  const Vector3d to(1, 2, -0.5);
  const auto makers = {+[](const Transform& t) {
                         return make_sphere({0.2, 0, 0}, 0.7, t);
                       },
                       +[](const Transform& t) {
                         return make_cube({0, 0, 0}, {1, 0.5, 2}, t);
                       },
                       +[](const Transform& t) {
                         return make_torus({0, 0, 0}, {0, 1, 0}, 0.6, 0.2, t);
                       }};
  for (const auto& make : makers) {
    SceneDescription direct, placed;
    add(direct, make({m, to}));
    std::vector<std::unique_ptr<Shape>> shapes;
    shapes.push_back(make({}));
    placed.shared.push_back(
        std::make_shared<SharedShapes>(std::move(shapes), std::vector<std::uint32_t>{0}, direct.materials));
    placed.instances.push_back({0, glm::mat3(m), Vector3f(to)});
    const LightSet a(direct), b(placed);
    for (const Vector3f& place : {Vector3f(0), Vector3f(3, 1, 0.4f)}) {
      const Vector3f normal = glm::normalize(Vector3f(to) - place);
      const double expected = irradiance(a, place, normal, 200000);
      CHECK(irradiance(b, place, normal, 200000) == Approx(expected).epsilon(0.01));
    }
  }
}

TEST_CASE("a textured light is as bright as its texture says where it is met", "[lights]") {
  struct Ramp final : Texture {
    Color3f at(const TexturePoint& point) const override { return Color3f(point.uv.x, point.position.y, 0); }
  };
  SceneDescription scene;
  add(scene, make_quad({-1, 2, -1}, 2.0 * kX, 2.0 * kZ));
  auto textures = std::make_shared<MaterialTextures>();
  textures->emission = std::make_shared<Ramp>();
  scene.materials[0].textures = textures;
  const LightSet lights(scene);
  Random random(13);
  for (int i = 0; i < 1000; ++i) {
    LightSample sample;
    REQUIRE(lights.sample(Vector3f(0), kUp, random.unit(), random.square(), sample));
    const float x = sample.direction.x / sample.direction.y * 2;
    CHECK(sample.radiance.x == Approx(0.5f * (x + 1)).margin(1e-5));
    CHECK(sample.radiance.y == Approx(2));
  }
}

TEST_CASE("the probabilities of a tree's items add up to 1", "[lights]") {
  const bool is_everywhere = GENERATE(false, true);
  Random random(14);
  std::vector<LightItem> items;
  for (int i = 0; i < 300; ++i) {
    LightItem item;
    item.bounds.extend(random.in_box(2));
    item.bounds.extend(item.bounds.lower + random.in(0, 0.3f) * Vector3f(1, 1, 0));
    item.cone.axis = glm::normalize(random.in_box(1));
    item.cone.cos_spread = is_everywhere || i % 4 == 0 ? -1 : random.in(0, 1);
    item.cone.back = i % 3 == 0 ? 1.0f : 0.0f;
    item.strength[static_cast<std::size_t>(i) % 3] =
        i % 10 == 0 ? 0 : std::exp(static_cast<double>(random.in(-20, 20)));
    items.push_back(item);
  }
  const LightTree tree(items);
  for (int i = 0; i < 200; ++i) {
    const Vector3f place = random.in_box(3);
    const Vector3f normal = i % 2 == 0 ? Vector3f(0) : glm::normalize(random.in_box(1));
    double sum = 0;
    for (std::uint32_t k = 0; k < 300; ++k) sum += tree.probability(place, normal, k);
    // Below 1 where a node's bounds promise light that none of its items sends here.
    CHECK(sum <= 1 + 1e-9);
    if (is_everywhere && i % 2 == 0) CHECK(sum == Approx(1));
    std::uint32_t item;
    double probability, u = static_cast<double>(random.unit());
    if (tree.choose(place, normal, u, item, probability)) {
      CHECK(probability == Approx(tree.probability(place, normal, item)));
      CHECK((u >= 0 && u < 1));
      CHECK(item % 10 != 0);
    }
  }
  CHECK(LightTree(std::vector<LightItem>(5)).is_empty());
}
