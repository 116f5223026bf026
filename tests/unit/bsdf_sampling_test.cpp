// What sample() chooses is what pdf() and evaluate() say.
#include <cmath>

#include "bsdf_cases.hpp"
#include "catch.hpp"
#include "sphere_statistics.hpp"

using namespace bsdf_cases;
using sphere_statistics::Cells;

namespace {

struct View {
  Case of;
  float cosine;
};

std::vector<View> views() {
  std::vector<Case> cases{{"matt", Material{}}};
  for (const float roughness : {0.22F, 0.5F, 1.0F}) {
    for (const Case& c : {metal(roughness), glass(roughness), mix(roughness)}) cases.push_back(c);
  }
  for (const Case& c : {metal(0.4F, 0, false), gold(0.3F), thin_glass(0.25F), thin_glass(0.7F), plastic(0.3F),
                        plastic(0.8F)}) {
    cases.push_back(c);
  }
  for (const float anisotropy : {-0.9F, 0.4F, 0.8F}) cases.push_back(metal(0.3F, anisotropy));
  cases.push_back(coated(plastic(0.5F), 1, 0.2F));
  cases.push_back(coated(plastic(0), 0.7F, 0.4F));
  cases.push_back(coated(glass(0.4F), 0.7F, 0.4F));
  cases.push_back(glass(0.4F, 1.1F));
  cases.push_back(coated(metal(0.6F), 1, 0.3F));
  cases.push_back(glass(0.4F));
  cases.back().material.anisotropy = 0.6F;
  std::vector<View> result;
  for (const Case& c : cases) {
    for (const float cosine : {0.95F, 0.5F, 0.08F}) result.push_back({c, cosine});
    if (c.inside != 1) {
      for (const float cosine : {-0.9F, -0.4F}) result.push_back({c, cosine});
    }
  }
  return result;
}

struct Sampled {
  std::vector<double> counts = std::vector<double>(std::size_t(Cells::count()), 0.0);
  double deltas = 0, lost = 0;
};

Sampled sample_often(const Bsdf& bsdf, const Vector3f& out, const Cells& cells, int count) {
  Sampled result;
  Random random;
  BsdfSample sample;
  for (int k = 0; k < count; ++k) {
    const float u_lobe = random.unit();
    if (!bsdf.sample(out, u_lobe, random.square(), sample)) {
      ++result.lost;
    } else if (sample.is_delta) {
      ++result.deltas;
    } else {
      ++result.counts[std::size_t(cells.of(sample.direction))];
    }
  }
  return result;
}

}  // namespace

TEST_CASE("samples of every lobe have the density that pdf() says", "[bsdf]") {
  constexpr int kCount = 20000;
  const auto all = views();
  const double level = sphere_statistics::sidak_level(int(all.size()));
  for (const View& view : all) {
    INFO(text(view.of) << " seen at cosine " << view.cosine);
    const Bsdf bsdf(view.of.material, frame_over(view.of.inside));
    const Vector3f out = toward(view.cosine);
    const float alpha = view.of.material.roughness * view.of.material.roughness;
    const bool is_glass = view.of.material.transmission > 0;  // two lobes: cells of one size
    const Cells cells({-out.x, -out.y, out.z},
                      is_glass && view.cosine > 0.3F ? 0.7F : std::max(0.05F, alpha));
    const Sampled sampled = sample_often(bsdf, out, cells, kCount);
    auto expected =
        cells.integrals([&](const Vector3f& in) { return double(bsdf.pdf(out, in)); }, sampled.counts);
    double total = 0;
    for (double& e : expected) total += e, e *= kCount;
    CHECK(total < 1.005);
    // Beside the cells: deltas and paths that end, together.
    auto counts = sampled.counts;
    counts.push_back(sampled.deltas + sampled.lost);
    expected.push_back(std::max(0.0, 1 - total) * kCount);
    CHECK(sphere_statistics::chi_square_probability(counts, expected) > level);
  }
}

TEST_CASE("the chi-square test notices a density that is a tenth off", "[bsdf]") {
  const Bsdf rough(gold(0.5F).material, frame_over()), rougher(gold(0.53F).material, frame_over());
  const Vector3f out = toward(0.6F);
  const Cells cells({-out.x, -out.y, out.z}, 0.3F);
  const Sampled sampled = sample_often(rough, out, cells, 30000);
  auto expected = cells.integrals([&](const Vector3f& in) { return 30000.0 * double(rougher.pdf(out, in)); },
                                  sampled.counts);
  CHECK(sphere_statistics::chi_square_probability(sampled.counts, expected) < 1e-6);
}

TEST_CASE("a sample's weight is its value over its density", "[bsdf]") {
  Random random;
  for (const View& view : views()) {
    INFO(text(view.of) << " seen at cosine " << view.cosine);
    const Bsdf bsdf(view.of.material, frame_over(view.of.inside));
    const Vector3f out = toward(view.cosine);
    for (int k = 0; k < 200; ++k) {
      BsdfSample sample;
      const float u_lobe = random.unit();
      if (!bsdf.sample(out, u_lobe, random.square(), sample) || sample.is_delta) continue;
      float pdf = 0;
      const Color3f value = bsdf.evaluate(out, sample.direction, pdf);
      CHECK(bsdf.pdf(out, sample.direction) == pdf);
      CHECK(bsdf.evaluate(out, sample.direction) == value);
      CHECK(std::abs(glm::length(sample.direction) - 1) < 1e-5F);
      CHECK(sample.is_transmission == (sample.direction.z * out.z < 0));
      CHECK(std::abs(pdf / sample.pdf - 1) < 5e-3F);
      for (int c = 0; c < 3; ++c)
        CHECK(std::abs(sample.weight[c] * pdf - value[c]) <= 5e-3F * value[c] + 1e-6F);
    }
  }
}

TEST_CASE("lobes are chosen by their largest channel, whichever it is", "[bsdf]") {
  // Blue is 7 % of a luminance: a choice by luminance would hardly ever take the blue base.
  for (int channel = 0; channel < 3; ++channel) {
    Case c = plastic(0);
    c.material.color = Color3f(0);
    c.material.color[channel] = 0.9F;
    c.material.shininess = 0;
    const Bsdf bsdf(c.material, frame_over());
    const Vector3f out = toward(1);
    BsdfSample delta;
    REQUIRE(bsdf.sample(out, 0, {0.3F, 0.4F}, delta));
    REQUIRE(delta.is_delta);
    // 0.04 of the light for the layer, 0.9 of the rest for the base.
    CHECK(std::abs(delta.pdf - 0.04F / (0.04F + 0.96F * 0.9F)) < 1e-4F);
    CHECK(std::abs(delta.weight.x * delta.pdf - 0.04F) < 1e-5F);
  }
}
