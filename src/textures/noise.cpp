#include "textures/fractal.hpp"
#include "textures/patterns.hpp"

namespace raytracer {
namespace {

class Noise final : public Pattern {
 public:
  Noise(PatternSetup setup, const NoiseShape& shape) : Pattern(std::move(setup)), shape_(shape) {}

 protected:
  float share(const PatternPoint& point) const override {
    const float width = point.detail_width();
    Vector3f p = point.position;
    if (shape_.warp != 0) {
      Vector3f bend;
      for (int axis = 0; axis < 3; ++axis) {
        bend[axis] = fractal_noise(point.position + kAside[axis], shape_.octaves, shape_.gain, width);
      }
      p += shape_.warp * bend;
    }
    if (shape_.sort == NoiseSort::kFbm) {
      return clouds(fractal_noise(p, shape_.octaves, shape_.gain, width));
    }
    return billows(turbulence_noise(p, shape_.octaves, shape_.gain, width));
  }

  void shares(const PatternBlock& points, NumberBlock& share) const override {
    const NumberBlock width = points.detail_widths();
    NumberBlock noise;
    Vector3Block p = points.position;
    if (shape_.warp != 0) bend(width, p);
    if (shape_.sort == NoiseSort::kFbm) {
      fractal_noise(p, shape_.octaves, shape_.gain, width, noise);
      for (int i = 0; i < kBlockSize; ++i) share.at[i] = clouds(noise.at[i]);
    } else {
      turbulence_noise(p, shape_.octaves, shape_.gain, width, noise);
      for (int i = 0; i < kBlockSize; ++i) share.at[i] = billows(noise.at[i]);
    }
  }

 private:
  // Three numbers that have nothing to do with each other, from three places far apart.
  static constexpr Vector3f kAside[] = {{31.7F, 0, 0}, {0, 47.3F, 0}, {0, 0, 59.9F}};

  void bend(const NumberBlock& width, Vector3Block& p) const {
    NumberBlock by[3];
    for (int axis = 0; axis < 3; ++axis) {
      Vector3Block there;
      for (int i = 0; i < kBlockSize; ++i) there.set(i, p.at(i) + kAside[axis]);
      fractal_noise(there, shape_.octaves, shape_.gain, width, by[axis]);
    }
    for (int i = 0; i < kBlockSize; ++i) {
      p.set(i, p.at(i) + shape_.warp * Vector3f(by[0].at[i], by[1].at[i], by[2].at[i]));
    }
  }

  float clouds(float noise) const { return 0.5F + 0.5F * shape_.contrast * noise; }

  float billows(float noise) const {
    constexpr float kMost = 2 * kMeanAbsoluteNoise;  // twice the mean is about as much as there is
    const float share = noise / kMost, value = shape_.sort == NoiseSort::kRidged ? 1 - share : share;
    return 0.5F + shape_.contrast * (value - 0.5F);
  }

  NoiseShape shape_;
};

}  // namespace

TexturePointer make_noise(PatternSetup setup, const NoiseShape& shape) {
  return std::make_shared<Noise>(std::move(setup), shape);
}

}  // namespace raytracer
