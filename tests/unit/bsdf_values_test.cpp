// Numbers that are known beforehand.
#include <cmath>
#include <limits>

#include "bsdf_cases.hpp"
#include "catch.hpp"
#include "materials/absorption.hpp"
#include "materials/albedo_tables.hpp"
#include "materials/fresnel.hpp"
#include "materials/ggx.hpp"
#include "materials/metals.hpp"

using namespace bsdf_cases;
using raytracer::Ggx;

namespace {

constexpr float kPi = 3.14159265F;
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinite = std::numeric_limits<float>::infinity();

float cos_degrees(float degrees) { return std::cos(degrees * kPi / 180); }

/// The sum of function(direction) * solid angle over the upper half, by `count`^2 directions close together
/// near the pole.
template <typename Function>
double over_hemisphere(int count, const Function& function) {
  double sum = 0;
  for (int i = 0; i < count; ++i) {
    const double x = (i + 0.5) / count, angle = x * x * kPi / 2;
    const double steradian = std::sin(angle) * kPi * x / count * 2 * kPi / count;
    for (int j = 0; j < count; ++j) {
      const double turn = 2 * kPi * (j + 0.5) / count;
      sum += steradian * function(Vector3f(float(std::sin(angle) * std::cos(turn)),
                                           float(std::sin(angle) * std::sin(turn)), float(std::cos(angle))));
    }
  }
  return sum;
}

/// GGX without Fresnel, masking and shadowing apart: what is tabulated for E1 and E3.
double separable_albedo(const Ggx& ggx, const Vector3f& o) {
  return over_hemisphere(400, [&](const Vector3f& i) {
    const Vector3f h = glm::normalize(o + i);
    return double(ggx.density(h) * ggx.visible(o) * ggx.visible(i) / (4 * o.z));
  });
}

double correlated_albedo(const Ggx& ggx, const Vector3f& o) {
  return over_hemisphere(400, [&](const Vector3f& i) {
    return double(ggx.density(glm::normalize(o + i)) * ggx.joint_visibility(ggx.eye(o), i) * i.z);
  });
}

bool is_sound(const Color3f& c) {
  for (int k = 0; k < 3; ++k) {
    if (!(c[k] >= 0 && c[k] < kInfinite)) return false;
  }
  return true;
}

}  // namespace

TEST_CASE("Fresnel's reflectance of clear media", "[bsdf]") {
  const std::pair<float, float> at_normal[] = {
      {1.33F, 0.0200593F}, {1.5F, 0.04F}, {1.52F, 0.04258F}, {2.42F, 0.172395F}};
  for (const auto& [eta, expected] : at_normal) {
    CHECK(std::abs(raytracer::fresnel_dielectric(1, eta).reflectance - expected) < 1e-5F);
  }
  const std::pair<float, float> of_glass[] = {{0, 0.04F},       {30, 0.0415226F}, {45, 0.0502399F},
                                              {60, 0.0891867F}, {75, 0.253061F},  {85, 0.6128F}};
  for (const auto& [degrees, expected] : of_glass) {
    INFO(degrees);
    CHECK(std::abs(raytracer::fresnel_dielectric(cos_degrees(degrees), 1.5F).reflectance - expected) < 1e-4F);
  }
  // Brewster's angle: only s is reflected, 0.147929, so half of it.
  CHECK(std::abs(raytracer::fresnel_dielectric(cos_degrees(56.3099F), 1.5F).reflectance - 0.0739645F) <
        1e-5F);
  // The critical angle.
  CHECK(raytracer::fresnel_dielectric(cos_degrees(41.82F), 1 / 1.5F).is_total);
  CHECK_FALSE(raytracer::fresnel_dielectric(cos_degrees(41.80F), 1 / 1.5F).is_total);
  CHECK(raytracer::fresnel_dielectric(0, 1.5F).reflectance == 1);
  CHECK(raytracer::fresnel_dielectric(0.3F, 1).reflectance < 1e-12F);
  const std::pair<float, float> refracted[] = {
      {30, 19.4712F}, {45, 28.1255F}, {60, 35.2644F}, {80, 41.0364F}};
  for (const auto& [degrees, expected] : refracted) {
    const float through = raytracer::fresnel_dielectric(cos_degrees(degrees), 1.5F).cosine_through;
    CHECK(std::abs(std::acos(through) * 180 / kPi - expected) < 1e-3F);
  }
}

TEST_CASE("Fresnel's reflectance of gold, and Schlick's approximation", "[bsdf]") {
  const std::pair<float, Color3f> of_gold[] = {{0, {0.966688F, 0.802205F, 0.324034F}},
                                               {60, {0.96222F, 0.80455F, 0.371108F}},
                                               {80, {0.963216F, 0.875662F, 0.59171F}}};
  for (const auto& [degrees, expected] : of_gold) {
    const Color3f seen =
        raytracer::fresnel_conductor(raytracer::ConductorSquares(kGold), cos_degrees(degrees));
    for (int c = 0; c < 3; ++c) CHECK(std::abs(seen[c] - expected[c]) < 1e-4F);
    // The same through the whole of a smooth material.
    const Case c = gold(0);
    BsdfSample sample;
    REQUIRE(Bsdf(c.material, frame_over()).sample(toward(cos_degrees(degrees)), 0.5F, {0.5F, 0.5F}, sample));
    CHECK((sample.is_delta && !sample.is_transmission));
    CHECK(std::abs(sample.pdf - 1) < 1e-6F);
    for (int k = 0; k < 3; ++k) CHECK(std::abs(sample.weight[k] - expected[k]) < 1e-4F);
  }
  const std::pair<float, float> of_schlick[] = {{0, 0.04F},  {30, 0.0400414F}, {45, 0.0420693F},
                                                {60, 0.07F}, {75, 0.25473F},   {85, 0.648492F}};
  for (const auto& [degrees, expected] : of_schlick) {
    CHECK(std::abs(raytracer::fresnel_schlick(Color3f(0.04F), cos_degrees(degrees)).x - expected) < 1e-5F);
  }
}

TEST_CASE("a metal that is hardly there reflects hardly anything, and never less", "[bsdf]") {
  for (int k = 0; k < 3000; ++k) {
    const float eta = 0.9F + 0.0001F * float(k % 2000);
    const ConductorIndex index{Vector3f(eta), {0, 1e-4F, 1e-3F}};
    const Color3f seen = raytracer::fresnel_conductor(index, float(k) / 3000);
    CHECK((is_sound(seen) && seen.x <= 1 && seen.y <= 1 && seen.z <= 1));
  }
}

TEST_CASE("means of Fresnel's reflectance over diffuse light", "[bsdf]") {
  const auto mean = [](const auto& function) {
    double sum = 0;
    for (int i = 0; i < 2000; ++i) sum += double(function(std::sqrt((float(i) + 0.5F) / 2000))) / 2000;
    return float(sum);
  };
  for (const float eta : {0.4F, 0.67F, 0.9F, 1.1F, 1.5F, 2.4F}) {
    const float expected = mean([&](float c) { return raytracer::fresnel_dielectric(c, eta).reflectance; });
    CHECK(std::abs(raytracer::fresnel_dielectric_mean(eta) - expected) < 7e-3F);
  }
  for (const raytracer::Metal& metal : raytracer::metals()) {
    const Color3f seen = raytracer::fresnel_conductor_mean(raytracer::ConductorSquares(metal.index));
    for (int c = 0; c < 3; ++c) {
      const float expected = mean([&](float x) {
        return raytracer::fresnel_conductor(raytracer::ConductorSquares(metal.index), x)[c];
      });
      CHECK(std::abs(seen[c] - expected) < 3e-3F);
    }
  }
}

TEST_CASE("facets cover the surface once, whatever their roughness", "[bsdf]") {
  for (const auto& [alpha, at_pole] : {std::pair{0.1F, 31.831F}, {0.5F, 1.27324F}, {1.0F, 0.31831F}}) {
    const Ggx ggx(alpha, alpha);
    CHECK(std::abs(ggx.density({0, 0, 1}) / at_pole - 1) < 1e-4F);
    CHECK(std::abs(over_hemisphere(800, [&](const Vector3f& h) { return double(ggx.density(h) * h.z); }) -
                   1) < 1e-3);
    const Vector3f o = toward(0.4F);
    // What is seen of them fills the view (Heitz 2014, equation 14).
    const double seen = over_hemisphere(800, [&](const Vector3f& h) {
      return double(ggx.visible(o) * std::max(0.0F, glm::dot(o, h)) * ggx.density(h));
    });
    CHECK(std::abs(seen / double(o.z) - 1) < 2e-3);
  }
  const Ggx stretched(0.2F, 0.7F);
  CHECK(std::abs(over_hemisphere(800, [&](const Vector3f& h) { return double(stretched.density(h) * h.z); }) -
                 1) < 1e-3);
}

TEST_CASE("albedo of rough mirrors with single scattering", "[bsdf]") {
  const float alphas[] = {0.1F, 0.2F, 0.4F, 0.8F}, cosines[] = {1, 0.7F, 0.4F, 0.1F};
  const float separable[] = {0.988318F, 0.981391F, 0.956474F, 0.873142F, 0.94766F,  0.923367F,
                             0.875189F, 0.863998F, 0.786561F, 0.759465F, 0.751793F, 0.810528F,
                             0.427002F, 0.469262F, 0.53531F,  0.642624F};
  const auto& table = raytracer::ReflectionTable::get();
  for (int a = 0; a < 4; ++a) {
    const Ggx ggx(alphas[a], alphas[a]);
    Material m = metal(std::sqrt(alphas[a]), 0, false).material;
    m.color = Color3f(1);
    const Bsdf bsdf(m, frame_over());
    for (int c = 0; c < 4; ++c) {
      INFO("alpha " << alphas[a] << ", cosine " << cosines[c]);
      const Vector3f o = toward(cosines[c]);
      CHECK(std::abs(separable_albedo(ggx, o) / double(separable[4 * a + c]) - 1) < 5e-3);
      const double correlated = correlated_albedo(ggx, o);
      CHECK(std::abs(double(table.mirror(raytracer::ReflectionTable::Grid::cell_of(alphas[a]), cosines[c])) -
                     correlated) < 4e-3);
      const double seen =
          over_hemisphere(400, [&](const Vector3f& i) { return double(bsdf.evaluate(o, i).x); });
      CHECK(std::abs(seen - correlated) < 3e-3);
    }
  }
}

TEST_CASE("mean albedo of rough mirrors with separable masking", "[bsdf]") {
  const std::pair<float, double> expected[] = {
      {0.1F, 0.971663}, {0.2F, 0.914011}, {0.4F, 0.766246}, {0.8F, 0.483715}};
  for (const auto& [alpha, mean] : expected) {
    const Ggx ggx(alpha, alpha);
    double sum = 0;
    for (int k = 0; k < 12; ++k) sum += separable_albedo(ggx, toward(std::sqrt((float(k) + 0.5F) / 12))) / 12;
    CHECK(std::abs(sum / mean - 1) < 5e-3);
  }
}

TEST_CASE("a matt surface returns its colour over pi, on both sides and only there", "[bsdf]") {
  Material m;
  m.color = {0.2F, 0.5F, 0.8F};
  const Bsdf bsdf(m, frame_over());
  CHECK_FALSE(bsdf.is_delta());
  for (const float side : {1.0F, -1.0F}) {
    const Vector3f out = side * toward(0.3F), in = side * toward(0.6F, 0.7F);
    float pdf = 0;
    const Color3f value = bsdf.evaluate(out, in, pdf);
    for (int c = 0; c < 3; ++c) CHECK(std::abs(value[c] - m.color[c] * 0.6F / kPi) < 1e-6F);
    CHECK(std::abs(pdf - 0.6F / kPi) < 1e-6F);
    CHECK(bsdf.evaluate(out, -in) == Color3f(0));
    CHECK(bsdf.pdf(out, -in) == 0);
    BsdfSample sample;
    REQUIRE(bsdf.sample(out, 0.5F, {0.2F, 0.9F}, sample));
    CHECK(sample.weight == m.color);
    CHECK(sample.direction.z * side > 0);
  }
}

TEST_CASE("shininess is the share of a perfect mirror, the rest is matt", "[bsdf]") {
  Material m;
  m.color = {0.2F, 0.5F, 0.8F};
  m.shininess = 0.3F;
  const Bsdf bsdf(m, frame_over());
  const Vector3f out = toward(0.5F), in = toward(0.6F, 0.7F);
  for (int c = 0; c < 3; ++c) {
    CHECK(std::abs(bsdf.evaluate(out, in)[c] - 0.7F * m.color[c] * 0.6F / kPi) < 1e-6F);
  }
  BsdfSample sample;
  REQUIRE(bsdf.sample(out, 0, {0.2F, 0.9F}, sample));
  CHECK(sample.is_delta);
  CHECK(std::abs(sample.pdf - 0.3F) < 1e-6F);
  CHECK(glm::length(sample.direction - Vector3f(-out.x, -out.y, out.z)) < 1e-6F);
  for (int c = 0; c < 3; ++c) CHECK(std::abs(sample.weight[c] * sample.pdf - 0.3F * m.color[c]) < 1e-6F);
  m.shininess = 1.7F;
  CHECK(Bsdf(m, frame_over()).is_delta());
}

TEST_CASE("smooth glass reflects, bends and squeezes light", "[bsdf]") {
  const Bsdf bsdf(glass(0).material, frame_over(1.5F));
  CHECK(bsdf.is_delta());
  for (const float side : {1.0F, -1.0F}) {
    const float cosine = 0.8F, eta = side > 0 ? 1.5F : 1 / 1.5F;
    const Vector3f out = toward(side * cosine);
    const float reflectance = raytracer::fresnel_dielectric(cosine, eta).reflectance;
    BsdfSample sample;
    REQUIRE(bsdf.sample(out, 0, {0.5F, 0.5F}, sample));
    CHECK((sample.is_delta && !sample.is_transmission));
    CHECK(std::abs(sample.pdf - reflectance) < 1e-5F);
    CHECK(std::abs(sample.weight.x - 1) < 1e-5F);
    REQUIRE(bsdf.sample(out, 0.999F, {0.5F, 0.5F}, sample));
    CHECK((sample.is_delta && sample.is_transmission));
    CHECK(std::abs(sample.pdf - (1 - reflectance)) < 1e-5F);
    CHECK(std::abs(sample.weight.x * eta * eta - 1) < 1e-5F);
    // Snell: the component along the surface goes down by eta, the direction away from out.
    CHECK(std::abs(sample.direction.x + out.x / eta) < 1e-5F);
    CHECK(std::abs(sample.direction.y + out.y / eta) < 1e-5F);
    CHECK(sample.direction.z * side < 0);
  }
  // Beyond the critical angle all is reflected.
  for (const float u : {0.0F, 0.5F, 0.9999F}) {
    BsdfSample sample;
    REQUIRE(bsdf.sample(toward(-0.5F), u, {0.5F, 0.5F}, sample));
    CHECK((!sample.is_transmission && sample.pdf == 1 && sample.weight == Color3f(1)));
  }
}

TEST_CASE("glass between equal indices is not there", "[bsdf]") {
  for (const float roughness : {0.0F, 0.5F}) {
    const Bsdf bsdf(glass(roughness, 1).material, frame_over(1));
    CHECK(bsdf.is_delta());
    for (const float cosine : {1.0F, 0.5F, 1e-3F, -0.3F}) {
      BsdfSample sample;
      REQUIRE(bsdf.sample(toward(cosine), 0.7F, {0.1F, 0.2F}, sample));
      CHECK((sample.is_delta && sample.is_transmission && sample.pdf == 1 && sample.weight == Color3f(1)));
      CHECK(sample.direction == -toward(cosine));
    }
  }
}

TEST_CASE("a thin pane lets light straight through, tinted", "[bsdf]") {
  const Bsdf bsdf(thin_glass(0).material, frame_over());
  CHECK(bsdf.is_delta());
  const Vector3f out = toward(0.5F);
  const float r = 0.0891867F, both = 2 * r / (1 + r);
  BsdfSample sample;
  REQUIRE(bsdf.sample(out, 0.999F, {0.1F, 0.2F}, sample));
  CHECK(sample.is_transmission);
  CHECK(sample.direction == -out);
  const Color3f tint{0.5F, 0.9F, 1};
  for (int c = 0; c < 3; ++c) CHECK(std::abs(sample.weight[c] * sample.pdf - (1 - both) * tint[c]) < 1e-4F);
  REQUIRE(bsdf.sample(out, 0, {0.1F, 0.2F}, sample));
  CHECK_FALSE(sample.is_transmission);
  CHECK(std::abs(sample.weight.x * sample.pdf - both) < 1e-4F);
}

TEST_CASE("the surface of a light is black", "[bsdf]") {
  Material m;
  m.is_area_light = true;
  const Bsdf bsdf(m, frame_over());
  BsdfSample sample;
  CHECK(bsdf.is_delta());
  CHECK_FALSE(bsdf.sample(toward(0.5F), 0.5F, {0.5F, 0.5F}, sample));
  CHECK(bsdf.evaluate(toward(0.5F), toward(0.4F)) == Color3f(0));
}

TEST_CASE("anisotropy draws highlights along the tangent", "[bsdf]") {
  const Vector3f out(0, 0, 1), along = glm::normalize(Vector3f(0.5F, 0, 1)),
                               across = glm::normalize(Vector3f(0, 0.5F, 1));
  const Bsdf drawn(metal(0.3F, 0.8F).material, frame_over()),
      turned(metal(0.3F, -0.8F).material, frame_over());
  CHECK(drawn.evaluate(out, along).x > 3 * drawn.evaluate(out, across).x);
  CHECK(turned.evaluate(out, across).x > 3 * turned.evaluate(out, along).x);
}

TEST_CASE("nothing leaks where the normals disagree", "[bsdf]") {
  BsdfFrame frame = frame_over(1.5F);
  frame.normal = glm::normalize(Vector3f(0.6F, 0, 1));
  Random random;
  for (const Case& c :
       {Case{"matt", Material{}}, plastic(0.4F), glass(0), glass(0.5F), thin_glass(0.3F), mix(0.5F)}) {
    const Bsdf bsdf(c.material, frame);
    for (int k = 0; k < 3000; ++k) {
      const Vector3f out = random.direction(), in = random.direction();
      const auto is_wrong = [&](const Vector3f& v) {
        return glm::dot(v, frame.normal) * glm::dot(v, frame.geometric_normal) <= 0;
      };
      if (is_wrong(out) || is_wrong(in)) {
        CHECK(bsdf.evaluate(out, in) == Color3f(0));
        CHECK(bsdf.pdf(out, in) == 0);
      }
      BsdfSample sample;
      const float u_lobe = random.unit();
      if (bsdf.sample(out, u_lobe, random.square(), sample)) {
        CHECK_FALSE((is_wrong(out) || is_wrong(sample.direction)));
        CHECK(
            sample.is_transmission ==
            (glm::dot(out, frame.geometric_normal) * glm::dot(sample.direction, frame.geometric_normal) < 0));
      }
    }
  }
}

TEST_CASE("values out of their range count as the nearest within", "[bsdf]") {
  Material wild = plastic(1.7F).material, tame = plastic(1).material;
  wild.color = {kNan, 3, -1};
  tame.color = {0, 1, 0};
  wild.metallic = 7, tame.metallic = 1;
  const Bsdf a(wild, frame_over()), b(tame, frame_over());
  const Vector3f out = toward(0.5F), in = toward(0.6F, 0.7F);
  CHECK(a.evaluate(out, in) == b.evaluate(out, in));
  CHECK(a.pdf(out, in) == b.pdf(out, in));
}

TEST_CASE("no combination of values gives anything but light", "[bsdf]") {
  Random random;
  const float odd[] = {0, 1, -1, 2, 1e-6F, 1e-4F, 1e-3F, 0.999999F, 1e30F, -1e30F, kInfinite, kNan};
  const auto any = [&] {
    return random.unit() < 0.15F ? odd[random.bits() % std::size(odd)] : random.unit();
  };
  const auto direction = [&] {
    const float tiny[] = {0, 1e-6F, -1e-6F, 1e-3F, 1, -1};
    return random.unit() < 0.2F ? toward(tiny[random.bits() % 6], random.unit()) : random.direction();
  };
  int wrong = 0;
  for (int k = 0; k < 250000; ++k) {
    Material m;
    m.color = {any(), any(), any()};
    m.shininess = random.unit() < 0.5F ? 0 : any();
    m.has_layer = random.unit() < 0.5F;
    m.roughness = any();
    m.metallic = random.unit() < 0.5F ? 0 : any();
    m.ior = 0.5F + 2 * any();
    m.specular = any();
    m.anisotropy = random.unit() < 0.5F ? 0 : 2 * any() - 1;
    m.transmission = random.unit() < 0.5F ? 0 : any();
    m.thin = random.unit() < 0.3F;
    m.coat = random.unit() < 0.5F ? 0 : any();
    m.coat_roughness = any();
    m.energy_compensation = random.unit() < 0.7F;
    if (random.unit() < 0.3F) m.conductor = ConductorIndex{{any(), any(), any()}, {any(), 5 * any(), any()}};
    BsdfFrame frame;
    frame.geometric_normal = direction();
    frame.normal = random.unit() < 0.5F ? frame.geometric_normal : direction();
    frame.tangent = direction();
    frame.ior_outside = random.unit() < 0.7F ? 1 : 1 + any();
    frame.ior_inside = random.unit() < 0.2F ? 1 : 1 + any();
    const Bsdf bsdf(m, frame);
    for (int turn = 0; turn < 4; ++turn) {
      const Vector3f out = direction(), in = direction();
      float pdf = 0;
      const Color3f value = bsdf.evaluate(out, in, pdf);
      BsdfSample sample;
      const float u_lobe = random.unit();
      const bool goes_on = bsdf.sample(out, u_lobe, random.square(), sample);
      const bool is_right =
          is_sound(value) && pdf >= 0 && pdf < kInfinite &&
          (!goes_on || (is_sound(sample.weight) && sample.pdf > 0 && sample.pdf < kInfinite &&
                        std::abs(glm::length(sample.direction) - 1) < 1e-3F));
      if (!is_right) ++wrong;
    }
  }
  CHECK(wrong == 0);
}

TEST_CASE("absorption follows the colour that is left after a way", "[bsdf]") {
  Material m;
  CHECK(raytracer::absorption_of(m) == Color3f(0));
  m.attenuation_color = {0.5F, 1, 0};
  CHECK(raytracer::absorption_of(m) == Color3f(0));
  m.attenuation_distance = 2;
  const Color3f sigma = raytracer::absorption_of(m);
  CHECK(std::abs(std::exp(-2 * sigma.x) - 0.5F) < 1e-6F);
  CHECK(sigma.y == 0);
  CHECK((sigma.z > 6 && sigma.z < kInfinite));
  m.attenuation_distance = 0;
  CHECK(is_sound(raytracer::absorption_of(m)));
  m.attenuation_color = Color3f(kNan);
  CHECK(raytracer::absorption_of(m) == Color3f(0));
}

TEST_CASE("metals are found by name, sorted, and look like themselves", "[bsdf]") {
  const auto all = raytracer::metals();
  for (std::size_t k = 1; k < all.size(); ++k) CHECK(all[k - 1].name < all[k].name);
  CHECK(raytracer::find_metal("tin foil") == nullptr);
  REQUIRE(raytracer::find_metal("gold") != nullptr);
  CHECK((raytracer::find_metal("gold")->eta == kGold.eta && raytracer::find_metal("gold")->k == kGold.k));
  for (const raytracer::Metal& metal : all) {
    const Color3f seen = raytracer::fresnel_conductor(raytracer::ConductorSquares(metal.index), 1);
    for (int c = 0; c < 3; ++c) CHECK((seen[c] > 0.3F && seen[c] < 1));
  }
  const Color3f copper =
      raytracer::fresnel_conductor(raytracer::ConductorSquares(*raytracer::find_metal("copper")), 1);
  CHECK((copper.x > 0.85F && copper.y < 0.7F && copper.z < copper.y));
}
