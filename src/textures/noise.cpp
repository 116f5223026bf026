#include "textures/fractal.hpp"
#include "textures/patterns.hpp"

namespace raytracer {
namespace {

class Noise final : public Pattern {
 public:
  Noise(PatternSetup setup, const NoiseShape& shape) : Pattern(std::move(setup)), shape_(shape) {}

 protected:
  float share(const PatternPoint& point) const override {
    constexpr float kEarly = 2;  // of rough points: fine octaves cost time, and nobody sees them
    const float width = (point.is_rough ? kEarly : 1.0F) * point.width();
    Vector3f p = point.position;
    if (shape_.warp != 0) p += shape_.warp * bend(p, width);
    if (shape_.sort == NoiseSort::kFbm) {
      return 0.5F + 0.5F * shape_.contrast * fractal_noise(p, shape_.octaves, shape_.gain, width);
    }
    // Twice the mean is about as much as there is.
    constexpr float kMost = 2 * kMeanAbsoluteNoise;
    const float billows = turbulence_noise(p, shape_.octaves, shape_.gain, width) / kMost;
    const float value = shape_.sort == NoiseSort::kRidged ? 1 - billows : billows;
    return 0.5F + shape_.contrast * (value - 0.5F);
  }

 private:
  // Three numbers that have nothing to do with each other, from three places far apart.
  Vector3f bend(const Vector3f& p, float width) const {
    const auto component = [&](const Vector3f& aside) {
      return fractal_noise(p + aside, shape_.octaves, shape_.gain, width);
    };
    return {component({31.7F, 0, 0}), component({0, 47.3F, 0}), component({0, 0, 59.9F})};
  }

  NoiseShape shape_;
};

}  // namespace

TexturePointer make_noise(PatternSetup setup, const NoiseShape& shape) {
  return std::make_shared<Noise>(std::move(setup), shape);
}

}  // namespace raytracer
