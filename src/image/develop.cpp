// From linear light to what a display is told.
#include <algorithm>
#include <cmath>

#include "core/display_curve.hpp"
#include "core/parallel.hpp"
#include "raytracer/image.hpp"

namespace raytracer {
namespace {

constexpr float kWhite = 255;

glm::mat3 rows(const Vector3f& first, const Vector3f& second, const Vector3f& third) {
  return glm::transpose(glm::mat3(first, second, third));
}

// --- white
// ------------------------------------------------------------------------------------------------------

// Linear Rec.709 to the sharpened cone responses of Bradford (Lam 1985), through CIE XYZ.
glm::mat3 to_cones() {
  const glm::mat3 to_xyz = rows({0.4123908F, 0.3575843F, 0.1804808F}, {0.2126390F, 0.7151687F, 0.0721923F},
                                {0.0193308F, 0.1191948F, 0.9505322F});
  const glm::mat3 bradford =
      rows({0.8951F, 0.2664F, -0.1614F}, {-0.7502F, 1.7135F, 0.0367F}, {0.0389F, -0.0685F, 1.0296F});
  return bradford * to_xyz;
}

// Takes light of the colour `white` to neutral, and leaves its luminance.
glm::mat3 adaptation(const Color3f& white) {
  const glm::mat3 cones = to_cones();
  const float luminance = glm::dot(white, Color3f(0.2126390F, 0.7151687F, 0.0721923F));
  const Vector3f from = cones * (white / luminance), to = cones * Vector3f(1);
  const Vector3f scale = to / from;
  return glm::inverse(cones) * glm::mat3(scale.x, 0, 0, 0, scale.y, 0, 0, 0, scale.z) * cones;
}

// --- tone curves: linear light to linear display light, 1 is white
// ----------------------------------------------

// J. Hable, "Uncharted 2: HDR Lighting", GDC 2010, with its white at 11.2 and its exposure.
Color3f filmic(const Color3f& light) {
  const auto curve = [](const Color3f& x) {
    constexpr float a = 0.15F, b = 0.50F, c = 0.10F, d = 0.20F, e = 0.02F, f = 0.30F;
    return (x * (a * x + c * b) + d * e) / (x * (a * x + b) + d * f) - e / f;
  };
  constexpr float kLinearWhite = 11.2F, kExposure = 2;
  return curve(kExposure * light) / curve(Color3f(kLinearWhite));
}

// S. Hill's fit of the Academy's reference rendering and output transforms for Rec.709 (2016).
Color3f aces(const Color3f& light) {
  static const glm::mat3 in =
      rows({0.59719F, 0.35458F, 0.04823F}, {0.07600F, 0.90834F, 0.01566F}, {0.02840F, 0.13383F, 0.83777F});
  static const glm::mat3 out = rows({1.60475F, -0.53108F, -0.07367F}, {-0.10208F, 1.10813F, -0.00605F},
                                    {-0.00327F, -0.07276F, 1.07602F});
  const Color3f x = in * light;
  const Color3f a = x * (x + 0.0245786F) - 0.000090537F;
  const Color3f b = x * (0.983729F * x + 0.4329510F) + 0.238081F;
  return out * (a / b);
}

// T. Sobotka's AgX (2022): light is mixed towards grey, its logarithm bent by a sigmoid (here the polynomial
// fit of B. Wrensch, 2023), and the mixing undone. The curve ends in display values of gamma 2.2.
Color3f agx(const Color3f& light) {
  static const glm::mat3 in(0.842479062253094F, 0.0423282422610123F, 0.0423756549057051F, 0.0784335999999992F,
                            0.878468636469772F, 0.0784336F, 0.0792237451477643F, 0.0791661274605434F,
                            0.879142973793104F);
  static const glm::mat3 out = glm::inverse(in);
  constexpr float kLeast = -12.47393F, kMost = 4.026069F, kDarkest = 1e-10F, kGamma = 2.2F;
  const Color3f mixed = glm::max(in * light, Color3f(kDarkest));
  const Color3f x = (glm::clamp(glm::log2(mixed), kLeast, kMost) - kLeast) / (kMost - kLeast);
  const Color3f x2 = x * x, x4 = x2 * x2;
  const Color3f bent = 15.5F * x4 * x2 - 40.14F * x4 * x + 31.96F * x4 - 6.868F * x2 * x + 0.4298F * x2 +
                       0.1191F * x - 0.00232F;
  return glm::pow(glm::max(out * bent, Color3f(0)), Color3f(kGamma));
}

Color3f toned(const Color3f& light, Tone tone) {
  switch (tone) {
    case Tone::kFilmic:
      return filmic(light);
    case Tone::kAces:
      return aces(light);
    case Tone::kAgx:
      return agx(light);
    case Tone::kNone:
      break;
  }
  return light;
}

// --- display values
// ---------------------------------------------------------------------------------------------

// Less than half a step up or down, spread so evenly over neighbours that their mean is the value itself.
// J. Jimenez, "Next Generation Post Processing in Call of Duty: Advanced Warfare", SIGGRAPH 2014.
float dither(int x, int y, int channel) {
  constexpr int kOtherPlace = 67;  // for channels that don't go up and down together
  const double sum = 0.06711056 * (x + kOtherPlace * channel) + 0.00583715 * y;
  const double noise = 52.9829189 * (sum - std::floor(sum));
  return static_cast<float>(noise - std::floor(noise)) - 0.5F;
}

// What is no number stays none; what is brighter than any number is white.
float in_range(float x) { return x < kInfinity ? x : std::isnan(x) ? x : 1e30F; }

}  // namespace

Image develop(Image image, const Development& development) {
  if (!development.is_linear) return image;
  const bool has_cast = development.white != Color3f(1);
  const glm::mat3 adapt =
      (std::exp2(development.exposure) / kWhite) * (has_cast ? adaptation(development.white) : glm::mat3(1));
  parallel_for(static_cast<std::size_t>(image.height), [&](std::size_t row) {
    const int y = static_cast<int>(row);
    for (int x = 0; x < image.width; ++x) {
      Color3f light = image.at(x, y);
      light = adapt * Color3f(in_range(light.x), in_range(light.y), in_range(light.z));
      constexpr float kBrightest = 1e6F;  // the squares in the curves stay numbers
      if (development.tone != Tone::kNone)
        light = toned(glm::clamp(light, 0.0F, kBrightest), development.tone);
      for (int c = 0; c < 3; ++c) {
        const float value =
            kWhite *
            static_cast<float>(display_from_linear(static_cast<double>(glm::clamp(light[c], 0.0F, 1.0F))));
        light[c] = glm::clamp(value + dither(x, y, c), 0.0F, kWhite);
      }
      image.set(x, y, light);
    }
  });
  return image;
}

}  // namespace raytracer
