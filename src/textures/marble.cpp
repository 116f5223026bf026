#include <cmath>

#include "core/lane_math.hpp"
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
    const float noise = fractal_noise(point.position, kOctaves, kGain, point.detail_width());
    return vein(point.position.x + turbulence_ * noise, vein_width(point.dx, point.dy, turbulence_),
                sharpness_, mean_);
  }

  void shares(const PatternBlock& points, NumberBlock& share) const override {
    NumberBlock noise;
    fractal_noise(points.position, kOctaves, kGain, points.detail_widths(), noise);
    const float turbulence = turbulence_, sharpness = sharpness_, mean = mean_;
    for (int i = 0; i < kBlockSize; ++i) {
      const float bent = points.position.x[i] + turbulence * noise.at[i];
      const float across = vein_width(points.dx.at(i), points.dy.at(i), turbulence);
      share.at[i] = vein(bent, across, sharpness, mean);
    }
  }

 private:
  static constexpr int kOctaves = 6;
  static constexpr float kGain = 0.55F;

  // Of the footprint across the veins, and of the bends that are lost in it.
  [[gnu::always_inline]] static float vein_width(const Vector3f& dx, const Vector3f& dy, float turbulence) {
    const float blur = blur_of_lost_bends(turbulence, PatternPoint::longer_of(dx, dy));
    return std::sqrt(dx.x * dx.x + dy.x * dy.x + blur);
  }

  static float vein(float x, float width, float sharpness, float mean) {
    const float wave = 0.5F + 0.5F * sine_of_turns(x);
    const float left = detail_left(2 * width);  // a vein is about half a period
    return mean + left * (power_of(wave, sharpness) - mean);
  }

  float turbulence_, sharpness_, mean_;
};

}  // namespace

TexturePointer make_marble(PatternSetup setup, float turbulence, float sharpness) {
  return std::make_shared<Marble>(std::move(setup), turbulence, sharpness);
}

}  // namespace raytracer
