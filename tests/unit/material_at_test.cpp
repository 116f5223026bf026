#include "textures/material_at.hpp"

#include <cmath>
#include <functional>
#include <memory>
#include <utility>

#include "catch.hpp"

using raytracer::alpha_at;
using raytracer::Color3f;
using raytracer::Material;
using raytracer::material_at;
using raytracer::MaterialTextures;
using raytracer::perturbed_normal;
using raytracer::SurfaceDetail;
using raytracer::Texture;
using raytracer::TexturePoint;
using raytracer::TexturePointer;
using raytracer::Vector2f;
using raytracer::Vector3f;

namespace {

class Formula : public Texture {
 public:
  explicit Formula(std::function<Color3f(const TexturePoint&)> formula) : formula_(std::move(formula)) {}
  Color3f at(const TexturePoint& point) const override { return formula_(point); }

 private:
  std::function<Color3f(const TexturePoint&)> formula_;
};

TexturePointer formula(std::function<Color3f(const TexturePoint&)> function) {
  return std::make_shared<Formula>(std::move(function));
}

TexturePointer constant(float red, float green, float blue) {
  return formula([=](const TexturePoint&) { return Color3f(red, green, blue); });
}

Material with(const std::function<void(MaterialTextures&)>& set) {
  auto textures = std::make_shared<MaterialTextures>();
  set(*textures);
  Material material;
  material.textures = textures;
  return material;
}

/// Of a floor: u to the right, v away from the eye.
SurfaceDetail floor_detail(float size = 1) { return {{0.5f, 0.5f}, {size, 0, 0}, {0, 0, -size}, Color3f(1)}; }

const Vector3f kUp{0, 1, 0};

void check_close(const Vector3f& a, const Vector3f& b) {
  CAPTURE(a.x, a.y, a.z, b.x, b.y, b.z);
  CHECK(glm::length(a - b) < 2e-3f);
}

}  // namespace

TEST_CASE("a material without textures is itself") {
  Material plain;
  plain.color = {0.1f, 0.2f, 0.3f};
  plain.alpha = 0.25f;
  CHECK(material_at(plain, {}).color == plain.color);
  CHECK(alpha_at(plain, {}) == 0.25f);
  CHECK(perturbed_normal(plain, floor_detail(), {}, kUp) == kUp);
}

TEST_CASE("textures stand in for a material's values, within their ranges") {
  const Material material = with([](MaterialTextures& t) {
    t.color = formula([](const TexturePoint& p) { return Color3f(p.uv.x, 7, -1); });
    t.emission = constant(50, -1, std::nanf(""));
    t.roughness = constant(0.9f, 0.2f, 0.4f);
    t.metallic = constant(std::nanf(""), 0, 0);
    t.anisotropy = constant(-0.5f, -0.5f, -0.5f);
    t.coat = constant(3, 3, 3);
    t.alpha = constant(0.75f, 0.75f, 0.75f);
    t.ior = constant(0.2f, 0.2f, 0.2f);
    t.attenuation_color = constant(0.5f, 1.5f, -1);
    t.attenuation_distance = constant(50, 50, 50);
    t.eta = constant(0, 1.5f, 1000);
    t.k = constant(-1, 3, std::nanf(""));
  });
  TexturePoint point;
  point.uv = {0.25f, 0};
  const auto at = material_at(material, point);
  CHECK(at.color == Color3f(0.25f, 1, 0));
  CHECK(at.emission == Color3f(50, 0, 0));
  CHECK(std::abs(at.roughness - 0.5f) < 1e-6f);  // the mean
  CHECK(at.metallic == 0);
  CHECK(at.anisotropy == -0.5f);
  CHECK(at.coat == 1);
  CHECK(at.alpha == 0.75f);
  CHECK(at.ior == 1);
  CHECK(at.attenuation_color == Color3f(0.5f, 1, 0));
  CHECK(at.attenuation_distance == 50);
  REQUIRE(at.conductor);
  CHECK(at.conductor->eta == Vector3f(0.01f, 1.5f, 100));
  CHECK(at.conductor->k == Vector3f(0, 3, 0));
  CHECK(alpha_at(material, point) == 0.75f);
  CHECK(at.shininess == material.shininess);
}

TEST_CASE("a normal map leans the normal along u and v") {
  const auto leaning = [](float x, float y, float z, const SurfaceDetail& detail) {
    const Material material = with([&](MaterialTextures& t) {
      t.normal_map = constant(0.5f + 0.5f * x, 0.5f + 0.5f * y, 0.5f + 0.5f * z);
    });
    return perturbed_normal(material, detail, {}, kUp);
  };
  check_close(leaning(0, 0, 1, floor_detail()), kUp);
  check_close(leaning(0.6f, 0, 0.8f, floor_detail(30)), {0.6f, 0.8f, 0});
  check_close(leaning(0, 0.6f, 0.8f, floor_detail()), {0, 0.8f, -0.6f});
  SurfaceDetail mirrored = floor_detail();
  mirrored.along_u = {-1, 0, 0};
  check_close(leaning(0.6f, 0, 0.8f, mirrored), {-0.6f, 0.8f, 0});
  check_close(leaning(0, 0.6f, 0.8f, mirrored), {0, 0.8f, -0.6f});
  CHECK(glm::dot(leaning(1, 0, -1, floor_detail()), kUp) > 0);
  check_close(leaning(0.6f, 0, 0.8f, SurfaceDetail{}), kUp);
}

TEST_CASE("bump leans the normal against the slope, in scene units") {
  // A slope of 1 in 1 along x, whatever the length of u.
  for (const float size : {0.5f, 1.0f, 20.0f}) {
    const Material material = with([&](MaterialTextures& t) {
      t.bump = formula([=](const TexturePoint& p) { return Color3f(p.uv.x * size); });
    });
    check_close(perturbed_normal(material, floor_detail(size), {}, kUp), glm::normalize(Vector3f(-1, 1, 0)));
    SurfaceDetail mirrored = floor_detail(size);
    mirrored.along_u *= -1.0f;
    check_close(perturbed_normal(material, mirrored, {}, kUp), glm::normalize(Vector3f(1, 1, 0)));
    // From below the height goes the other way.
    check_close(perturbed_normal(material, floor_detail(size), {}, -kUp),
                glm::normalize(Vector3f(-1, -1, 0)));
  }
}

TEST_CASE("bump by position works with and without u and v") {
  const Material material = with([](MaterialTextures& t) {
    t.bump = formula([](const TexturePoint& p) { return Color3f(0.5f * p.position.z); });
  });
  const Vector3f expected = glm::normalize(Vector3f(0, 1, -0.5f));
  check_close(perturbed_normal(material, floor_detail(), {}, kUp), expected);
  check_close(perturbed_normal(material, SurfaceDetail{}, {}, kUp), expected);
}

TEST_CASE("a wide footprint smooths bump") {
  const Material material = with([](MaterialTextures& t) {
    t.bump = formula([](const TexturePoint& p) { return Color3f(std::sin(100 * p.uv.x)); });
  });
  TexturePoint point;
  CHECK(perturbed_normal(material, floor_detail(), point, kUp).x < -0.9f);
  point.uv_dx = {1, 0};
  CHECK(std::abs(perturbed_normal(material, floor_detail(), point, kUp).x) < 0.9f);
}

TEST_CASE("no height makes a normal that is none") {
  for (const float odd : {1e38f, raytracer::kInfinity, std::nanf("")}) {
    const Material material = with([&](MaterialTextures& t) {
      t.bump = formula([=](const TexturePoint& p) { return Color3f(p.uv.x > 0 ? odd : -odd); });
      t.normal_map = constant(odd, odd, odd);
    });
    const Vector3f normal = perturbed_normal(material, floor_detail(), {}, kUp);
    CHECK(glm::length(normal) == Approx(1));
    CHECK(normal.y > 0);
  }
}
