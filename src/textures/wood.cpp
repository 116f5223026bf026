#include <cmath>

#include "textures/fractal.hpp"
#include "textures/patterns.hpp"

namespace raytracer {
namespace {

// A year's ring darkens slowly and ends at once, both by the curve 3 s^2 - 2 s^3.
constexpr float kDarkens = 0.8F, kEnds = 0.9F;
constexpr float kMean = kDarkens / 2 + (kEnds - kDarkens) + (1 - kEnds) / 2;
constexpr float kFibres = 0.25F;  // their strength

[[gnu::always_inline]] inline float ring_at(float distance) {
  const float year = distance - std::floor(distance);
  return glm::smoothstep(0.0F, kDarkens, year) * (1 - glm::smoothstep(kEnds, 1.0F, year));
}

// The integral from 0 on of a step from 0 to 1 between two places.
double sum_of_step(double from, double to, double x) {
  const double s = glm::clamp((x - from) / (to - from), 0.0, 1.0), beyond = x > to ? x - to : 0.0;
  return (to - from) * s * s * s * (1 - 0.5 * s) + beyond;
}

// The integral of ring_at() from 0 on.
[[gnu::always_inline]] inline double sum_of_rings(double distance) {
  const double whole = std::floor(distance), year = distance - whole;
  constexpr auto darkens = static_cast<double>(kDarkens), ends = static_cast<double>(kEnds);
  return static_cast<double>(kMean) * whole + sum_of_step(0, darkens, year) - sum_of_step(ends, 1, year);
}

[[gnu::always_inline]] inline float mean_of_rings(float distance, float width) {
  const bool has_width = width > 1e-3F, is_too_wide = !(width < 16);
  const auto at = static_cast<double>(distance - std::floor(distance));
  const double half = has_width && !is_too_wide ? 0.5 * static_cast<double>(width) : 0.5;
  const auto mean = static_cast<float>((sum_of_rings(at + half) - sum_of_rings(at - half)) / (2 * half));
  const float narrow = has_width ? mean : ring_at(distance);
  return is_too_wide ? kMean : narrow;
}

// How wide a footprint is in noise that is stretched.
float width_by(const Vector3f& dx, const Vector3f& dy, const Vector3f& scale) {
  return PatternPoint::longer_of(dx * scale, dy * scale);
}

// A trunk is much the same along its length.
constexpr Vector3f kSlow{1, 0.2F, 1}, kFine{24, 1.5F, 24};
constexpr int kBends = 4, kFibreSizes = 2;  // octaves
constexpr float kGain = 0.5F;

// Of the box across the rings with the variance of the footprint, of how far they curve away along it, and
// of the bends that are lost in it.
[[gnu::always_inline]] inline float width_of_rings(const Vector3f& p, const Vector3f& dx, const Vector3f& dy,
                                                   float distance, float turbulence) {
  const float divisor = distance > 0 ? distance : 1.0F;
  const Vector3f outwards(p.x / divisor, 0, p.z / divisor);
  const float x = glm::dot(dx, outwards), y = glm::dot(dy, outwards);
  const float all = dx.x * dx.x + dx.z * dx.z + dy.x * dy.x + dy.z * dy.z;
  const float curve = (all - x * x - y * y) / (8 * divisor);
  const float blur = blur_of_lost_bends(turbulence, width_by(dx, dy, kSlow));
  const float width = std::sqrt(x * x + y * y + curve * curve + blur);
  return distance > 0 ? width : PatternPoint::longer_of(dx, dy);
}

[[gnu::always_inline]] inline float share_of_rings(const Vector3f& p, const Vector3f& dx, const Vector3f& dy,
                                                   float bend, float fibres, float turbulence) {
  const float distance = std::sqrt(p.x * p.x + p.z * p.z);
  const float width = width_of_rings(p, dx, dy, distance, turbulence);
  return mean_of_rings(distance + turbulence * bend, width) + kFibres * fibres;
}

class Wood final : public Pattern {
 public:
  Wood(PatternSetup setup, float turbulence) : Pattern(std::move(setup)), turbulence_(turbulence) {}

 protected:
  float share(const PatternPoint& point) const override {
    const auto noise = [&](const Vector3f& scale, int octaves) {
      return fractal_noise(point.position * scale, octaves, kGain, width_by(point.dx, point.dy, scale));
    };
    return share_of_rings(point.position, point.dx, point.dy, noise(kSlow, kBends), noise(kFine, kFibreSizes),
                          turbulence_);
  }

  void shares(const PatternBlock& points, NumberBlock& share) const override {
    const auto noise = [&](const Vector3f& scale, int octaves, NumberBlock& result) {
      Vector3Block place;
      NumberBlock width;
      for (int i = 0; i < kBlockSize; ++i) {
        place.set(i, points.position.at(i) * scale);
        width.at[i] = width_by(points.dx.at(i), points.dy.at(i), scale);
      }
      fractal_noise(place, octaves, kGain, width, result);
    };
    NumberBlock bend, fibres;
    noise(kSlow, kBends, bend);
    noise(kFine, kFibreSizes, fibres);
    const float turbulence = turbulence_;
    for (int i = 0; i < kBlockSize; ++i) {
      share.at[i] = share_of_rings(points.position.at(i), points.dx.at(i), points.dy.at(i), bend.at[i],
                                   fibres.at[i], turbulence);
    }
  }

 private:
  float turbulence_;
};

}  // namespace

TexturePointer make_wood(PatternSetup setup, float turbulence) {
  return std::make_shared<Wood>(std::move(setup), turbulence);
}

}  // namespace raytracer
