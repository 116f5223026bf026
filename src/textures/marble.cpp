#include <cmath>

#include "core/numeric.hpp"
#include "textures/fractal.hpp"
#include "textures/patterns.hpp"

namespace raytracer {
namespace {

class Marble final : public Pattern {
 public:
  Marble(PatternSetup setup, float turbulence, float sharpness)
      : Pattern(std::move(setup)),
        turbulence_(turbulence),
        sharpness_(sharpness),
        // Of ((1 + sin) / 2)^k over a period: Gamma(k + 1/2) / (sqrt(pi) Gamma(k + 1)).
        mean_(std::tgamma(sharpness + 0.5F) /
              (std::sqrt(static_cast<float>(kPi)) * std::tgamma(sharpness + 1))) {}

 protected:
  float share(const PatternPoint& point) const override {
    constexpr int kOctaves = 6;
    const float width = point.width();
    const float bent = point.position.x + turbulence_ * fractal_noise(point.position, kOctaves, 0.55F, width);
    const float wave = 0.5F + 0.5F * std::sin(static_cast<float>(2 * kPi) * bent);
    const float left = detail_left(2 * width);  // a vein is about half a period
    return mean_ + left * (std::pow(wave, sharpness_) - mean_);
  }

 private:
  float turbulence_, sharpness_, mean_;
};

}  // namespace

TexturePointer make_marble(PatternSetup setup, float turbulence, float sharpness) {
  return std::make_shared<Marble>(std::move(setup), turbulence, sharpness);
}

}  // namespace raytracer
