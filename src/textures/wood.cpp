#include <cmath>

#include "textures/fractal.hpp"
#include "textures/patterns.hpp"

namespace raytracer {
namespace {

// A year's ring darkens slowly and ends at once.
constexpr float kDarkens = 0.8F, kEnds = 0.9F;
constexpr float kMean = kDarkens / 2 + (kEnds - kDarkens) + (1 - kEnds) / 2;
constexpr float kFibres = 0.25F;  // their strength

class Wood final : public Pattern {
 public:
  Wood(PatternSetup setup, float turbulence) : Pattern(std::move(setup)), turbulence_(turbulence) {}

 protected:
  float share(const PatternPoint& point) const override {
    const Vector3f& p = point.position;
    const float width = point.width();
    // A trunk is much the same along its length.
    const Vector3f slow = p * Vector3f(1, 0.2F, 1);
    const float distance =
        std::sqrt(p.x * p.x + p.z * p.z) + turbulence_ * fractal_noise(slow, 4, 0.5F, width);
    const float year = distance - std::floor(distance);
    const float ring = glm::smoothstep(0.0F, kDarkens, year) * (1 - glm::smoothstep(kEnds, 1.0F, year));
    const float fibres = fractal_noise(p * Vector3f(24, 1.5F, 24), 2, 0.5F, 24 * width);
    return kMean + detail_left(2 * width) * (ring - kMean) + kFibres * fibres;
  }

 private:
  float turbulence_;
};

}  // namespace

TexturePointer make_wood(PatternSetup setup, float turbulence) {
  return std::make_shared<Wood>(std::move(setup), turbulence);
}

}  // namespace raytracer
