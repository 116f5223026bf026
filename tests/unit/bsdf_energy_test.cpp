// How much light comes back in all: white stays white, nothing gives more than it gets, reversed it is the
// same.
#include <cmath>

#include "bsdf_cases.hpp"
#include "catch.hpp"
#include "materials/ggx.hpp"

using namespace bsdf_cases;

namespace {

/// What the surface shows of a uniform sky of radiance 1 (on both sides, the one below seen through its
/// index), and the standard error of it: the mean of the weights of stratified samples.
struct Albedo {
  Color3f mean{0};
  float error = 0;
};

Albedo albedo(const Bsdf& bsdf, const Vector3f& out, int side_count, float squeezed_below = 1) {
  Random random;
  double sum = 0, sum2 = 0;
  Color3f total{0};
  const int lobes = 4, count = side_count * side_count * lobes;
  for (int k = 0; k < count; ++k) {
    const int cell = k / lobes;
    const Vector2f u =
        (Vector2f(float(cell % side_count), float(cell / side_count)) + random.square()) / float(side_count);
    BsdfSample sample;
    const float u_lobe = (float(k % lobes) + random.unit()) / float(lobes);
    if (!bsdf.sample(out, std::min(0.999999F, u_lobe), u, sample)) continue;
    const float sky = sample.direction.z < 0 ? squeezed_below : 1.0F;
    total += sky * sample.weight;
    const double value = double(sky) * double(sample.weight.x);
    sum += value, sum2 += value * value;
  }
  const double mean = sum / count;
  return {total / float(count), float(std::sqrt(std::max(0.0, sum2 / count - mean * mean) / count))};
}

Case white(Case c) {
  c.material.color = Color3f(1);
  return c;
}

Case random_case(Random& random) {
  Case c;
  Material& m = c.material;
  const auto often_zero = [&] { return random.unit() < 0.5F ? 0.0F : random.unit(); };
  m.color = Color3f(1);
  m.shininess = often_zero() * 0.5F;
  m.has_layer = random.unit() < 0.7F;
  m.roughness = random.unit();
  m.metallic = often_zero();
  m.ior = 1 + 1.5F * random.unit();
  m.specular = random.unit() < 0.5F ? 1.0F : random.unit();
  m.anisotropy = often_zero() * (random.unit() < 0.5F ? -1.0F : 1.0F);
  m.transmission = often_zero();
  m.thin = random.unit() < 0.3F;
  m.coat = often_zero();
  m.coat_roughness = often_zero();
  m.energy_compensation = random.unit() < 0.8F;
  if (random.unit() < 0.3F) m.conductor = kGold;
  c.inside = m.transmission > 0 && !m.thin ? m.ior : 1;
  c.name = "random";
  return c;
}

std::string all_of(const Material& m) {
  return "shininess " + std::to_string(m.shininess) + " layer " + std::to_string(m.has_layer) +
         " roughness " + std::to_string(m.roughness) + " metallic " + std::to_string(m.metallic) + " ior " +
         std::to_string(m.ior) + " specular " + std::to_string(m.specular) + " anisotropy " +
         std::to_string(m.anisotropy) + " transmission " + std::to_string(m.transmission) + " thin " +
         std::to_string(m.thin) + " coat " + std::to_string(m.coat) + " " + std::to_string(m.coat_roughness) +
         " compensation " + std::to_string(m.energy_compensation) + " measured " +
         std::to_string(m.conductor.has_value());
}

}  // namespace

TEST_CASE("a rough mirror that loses nothing shows the sky at every angle and roughness", "[bsdf]") {
  for (const float roughness : {0.1F, 0.2F, 0.316F, 0.447F, 0.632F, 0.8F, 0.894F, 1.0F}) {
    const Bsdf bsdf(white(metal(roughness)).material, frame_over());
    for (const float cosine : {1.0F, 0.7F, 0.4F, 0.2F, 0.1F, 0.03F, 0.01F}) {
      INFO("roughness " << roughness << ", cosine " << cosine);
      const Albedo seen = albedo(bsdf, toward(cosine), 48);
      CHECK(std::abs(seen.mean.x - 1) < 0.004F + 3 * seen.error);
    }
  }
}

TEST_CASE("a drawn mirror, pane or layer shows the sky at every angle, turn and roughness", "[bsdf]") {
  for (const float roughness : {0.1F, 0.3F, 0.5F, 0.7F}) {
    for (const float anisotropy : {-0.8F, 0.2F, 0.5F, 0.8F, 1.0F}) {
      for (Case c : {white(metal(roughness)), white(thin_glass(roughness)), white(plastic(roughness))}) {
        c.material.anisotropy = anisotropy;
        const Bsdf bsdf(c.material, frame_over());
        for (const float cosine : {1.0F, 0.8F, 0.5F, 0.25F, 0.1F, 0.03F}) {
          for (const float turn : {0.0F, 0.1F, 0.25F}) {
            INFO(text(c) << ", cosine " << cosine << ", turn " << turn);
            const Albedo seen = albedo(bsdf, toward(cosine, turn), 32);
            const float tolerance = cosine < 0.1F ? 0.03F : 0.008F;
            CHECK(std::abs(seen.mean.x - 1) < tolerance + 3.5F * seen.error);
          }
        }
      }
    }
  }
}

// From inside, total reflection begins at an angle of its own for each facet; the table has that coarsely.
// The mean over diffuse light is what counts after a few reflections.
TEST_CASE("drawn glass shows the sky, from outside at every angle, from inside in the mean", "[bsdf]") {
  for (const float roughness : {0.1F, 0.5F, 0.8F}) {
    for (const float anisotropy : {-0.5F, 0.3F, 0.8F}) {
      Case c = glass(roughness);
      c.material.anisotropy = anisotropy;
      const Bsdf bsdf(c.material, frame_over(c.inside));
      const float sky_below = c.inside * c.inside;
      Random random;
      float inside = 0, error2 = 0;
      constexpr int kViews = 64;
      for (int k = 0; k < kViews; ++k) {
        const float cosine = std::sqrt((float(k) + random.unit()) / kViews), turn = random.unit();
        INFO(text(c) << ", cosine " << cosine << ", turn " << turn);
        const Albedo outside = albedo(bsdf, toward(cosine, turn), 24, sky_below);
        CHECK(std::abs(outside.mean.x - 1) < 0.01F + 4 * outside.error);
        const Albedo from_inside = albedo(bsdf, toward(-cosine, turn), 24, sky_below);
        inside += from_inside.mean.x / sky_below / kViews;
        error2 += from_inside.error * from_inside.error / (sky_below * sky_below * kViews * kViews);
      }
      INFO(text(c));
      CHECK(std::abs(inside - 1) < 0.006F + 3 * std::sqrt(error2));
    }
  }
}

TEST_CASE("under its coat, white stays white", "[bsdf]") {
  Case base{"matt", Material{}};
  base.material.color = Color3f(1);
  for (const float coat : {0.5F, 1.0F}) {
    for (const float coat_roughness : {0.0F, 0.3F, 0.7F}) {
      for (const Case& c :
           {base, white(plastic(0)), white(plastic(0.5F)), white(metal(0)), white(metal(0.3F)),
            white(metal(0.7F)), white(metal(0.4F, 0.6F)), white(thin_glass(0)), glass(0)}) {
        const Case over = coated(c, coat, coat_roughness);
        const Bsdf bsdf(over.material, frame_over(c.inside));
        for (const float cosine : {1.0F, 0.7F, 0.4F, 0.1F}) {
          INFO(text(over) << ", coat " << coat << " of roughness " << coat_roughness << ", cosine "
                          << cosine);
          const Albedo seen = albedo(bsdf, toward(cosine), 40, c.inside * c.inside);
          CHECK(std::abs(seen.mean.x - 1) < 0.01F + 3 * seen.error);
        }
      }
    }
  }
}

TEST_CASE("glass under its coat loses nothing from inside either", "[bsdf]") {
  for (const float roughness : {0.0F, 0.3F, 0.7F}) {
    const Case c = coated(glass(roughness), 1, 0);
    const Bsdf bsdf(c.material, frame_over(c.inside));
    for (const float side : {1.0F, -1.0F}) {
      for (const float cosine : {1.0F, 0.8F, 0.6F, 0.3F}) {
        INFO(text(c) << ", cosine " << side * cosine);
        const Albedo seen = albedo(bsdf, toward(side * cosine), 40, c.inside * c.inside);
        const float expected = side > 0 ? 1.0F : c.inside * c.inside;
        // Rough: what is thrown back is not bent as what goes out is.
        const float tolerance = roughness > 0 ? 0.03F : 0.005F;
        CHECK(std::abs(seen.mean.x / expected - 1) < tolerance + 3 * seen.error / expected);
      }
    }
  }
}

TEST_CASE("clear and rough glass shows the sky, from outside and from inside", "[bsdf]") {
  for (const float roughness : {0.0F, 0.1F, 0.3F, 0.6F, 1.0F}) {
    for (const float ior : {1.1F, 1.33F, 1.5F, 2.4F, 4.0F}) {
      const Bsdf bsdf(glass(roughness, ior).material, frame_over(ior));
      for (const float cosine : {1.0F, 0.7F, 0.4F, 0.1F, 0.02F}) {
        for (const float side : {1.0F, -1.0F}) {
          INFO("roughness " << roughness << ", ior " << ior << ", cosine " << side * cosine);
          // Radiance over the index squared is what stays the same: below, a uniform sky is ior^2.
          const Albedo seen = albedo(bsdf, toward(side * cosine), 40, ior * ior);
          const float expected = side > 0 ? 1.0F : ior * ior;
          CHECK(std::abs(seen.mean.x / expected - 1) < 0.01F + 3 * seen.error / expected);
        }
      }
    }
  }
}

TEST_CASE("a thin pane and a white base under its layer lose nothing either", "[bsdf]") {
  for (const float roughness : {0.0F, 0.2F, 0.5F, 1.0F}) {
    for (const Case& c : {white(thin_glass(roughness)), white(plastic(roughness)),
                          white(plastic(roughness, 2.0F)), white(plastic(roughness, 1.1F)),
                          white(plastic(roughness, 4.0F)), white(plastic(roughness, 10.0F))}) {
      const Bsdf bsdf(c.material, frame_over());
      for (const float cosine : {1.0F, 0.7F, 0.4F, 0.1F, 0.02F}) {
        INFO(text(c) << ", ior " << c.material.ior << ", cosine " << cosine);
        const Albedo seen = albedo(bsdf, toward(cosine), 40);
        CHECK(std::abs(seen.mean.x - 1) < 0.005F + 3 * seen.error);
      }
    }
  }
}

TEST_CASE("no material returns more light than it gets", "[bsdf]") {
  Random random;
  for (int k = 0; k < 300; ++k) {
    const Case c = random_case(random);
    const Bsdf bsdf(c.material, frame_over(c.inside));
    const float cosine = 0.005F + 0.995F * random.unit();
    for (const float side : {1.0F, -1.0F}) {
      const Vector3f out = toward(side * cosine, random.unit());
      const Albedo seen = albedo(bsdf, out, 24, c.inside * c.inside);
      const float limit = side > 0 ? 1.0F : c.inside * c.inside;
      INFO(all_of(c.material) << ", cosine " << side * cosine << ", error " << seen.error);
      for (int i = 0; i < 3; ++i) CHECK(seen.mean[i] / limit < 1 + 1e-3F + 4 * seen.error / limit);
    }
  }
}

TEST_CASE("light goes the same way back", "[bsdf]") {
  Random random;
  for (int k = 0; k < 20000; ++k) {
    const Case c = random_case(random);
    const Bsdf bsdf(c.material, frame_over(c.inside));
    const Vector3f a = random.direction(), b = random.direction();
    if (std::abs(a.z) < 0.01F || std::abs(b.z) < 0.01F) continue;
    // value / index of out's side squared is symmetric; evaluate() has the cosine of `in` as well.
    const float squeezed = (a.z > 0) == (b.z > 0) ? 1.0F
                           : a.z > 0              ? c.inside * c.inside
                                                  : 1 / (c.inside * c.inside);
    const Color3f there = bsdf.evaluate(a, b) / std::abs(b.z) * squeezed;
    const Color3f back = bsdf.evaluate(b, a) / std::abs(a.z);
    INFO(all_of(c.material) << ", from " << a.z << " to " << b.z);
    for (int i = 0; i < 3; ++i) {
      CHECK(std::abs(there[i] - back[i]) <= 2e-3F * std::max(there[i], back[i]) + 1e-6F);
    }
  }
}
