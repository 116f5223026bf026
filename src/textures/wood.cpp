#include <algorithm>
#include <cmath>

#include "textures/fractal.hpp"
#include "textures/patterns.hpp"

namespace raytracer {
namespace {

// A year's ring darkens slowly and ends at once, both by the curve 3 s^2 - 2 s^3.
constexpr float kDarkens = 0.8F, kEnds = 0.9F;
constexpr float kMean = kDarkens / 2 + (kEnds - kDarkens) + (1 - kEnds) / 2;
constexpr float kFibres = 0.25F;  // their strength

float ring_at(float distance) {
  const float year = distance - std::floor(distance);
  return glm::smoothstep(0.0F, kDarkens, year) * (1 - glm::smoothstep(kEnds, 1.0F, year));
}

// The integral of ring_at() from 0 on.
double sum_of_rings(double distance) {
  const double whole = std::floor(distance), year = distance - whole;
  const auto rise = [](double from, double to, double x) {
    const double s = std::clamp((x - from) / (to - from), 0.0, 1.0);
    return (to - from) * s * s * s * (1 - 0.5 * s) + std::max(0.0, x - to);
  };
  constexpr auto darkens = static_cast<double>(kDarkens), ends = static_cast<double>(kEnds);
  return static_cast<double>(kMean) * whole + rise(0, darkens, year) - rise(ends, 1, year);
}

float mean_of_rings(float distance, float width) {
  if (!(width > 1e-3F)) return ring_at(distance);
  if (!(width < 16)) return kMean;
  const auto at = static_cast<double>(distance - std::floor(distance)),
             half = 0.5 * static_cast<double>(width);
  return static_cast<float>((sum_of_rings(at + half) - sum_of_rings(at - half)) / (2 * half));
}

class Wood final : public Pattern {
 public:
  Wood(PatternSetup setup, float turbulence) : Pattern(std::move(setup)), turbulence_(turbulence) {}

 protected:
  float share(const PatternPoint& point) const override {
    const Vector3f& p = point.position;
    // A trunk is much the same along its length.
    const Vector3f slow = p * kSlow;
    const float bend = turbulence_ * fractal_noise(slow, 4, 0.5F, width_by(point, kSlow));
    const float distance = std::sqrt(p.x * p.x + p.z * p.z);
    const float ring = mean_of_rings(distance + bend, width_of_rings(point, distance));
    const float fibres = fractal_noise(p * kFine, 2, 0.5F, width_by(point, kFine));
    return ring + kFibres * fibres;
  }

 private:
  static constexpr Vector3f kSlow{1, 0.2F, 1}, kFine{24, 1.5F, 24};

  static float width_by(const PatternPoint& point, const Vector3f& scale) {
    const Vector3f dx = point.dx * scale, dy = point.dy * scale;
    return std::sqrt(std::max(glm::dot(dx, dx), glm::dot(dy, dy)));
  }

  // Of the box across the rings with the variance of the footprint, of how far they curve away along it, and
  // of the bends that are lost in it.
  float width_of_rings(const PatternPoint& point, float distance) const {
    if (!(distance > 0)) return point.width();
    const Vector3f outwards(point.position.x / distance, 0, point.position.z / distance);
    const float x = glm::dot(point.dx, outwards), y = glm::dot(point.dy, outwards);
    const float all =
        point.dx.x * point.dx.x + point.dx.z * point.dx.z + point.dy.x * point.dy.x + point.dy.z * point.dy.z;
    const float curve = (all - x * x - y * y) / (8 * distance);
    constexpr float kVariance = 0.05F;  // of the noise
    const float lost = turbulence_ * (1 - detail_left(width_by(point, kSlow)));
    return std::sqrt(x * x + y * y + curve * curve + 12 * kVariance * lost * lost);
  }

  float turbulence_;
};

}  // namespace

TexturePointer make_wood(PatternSetup setup, float turbulence) {
  return std::make_shared<Wood>(std::move(setup), turbulence);
}

}  // namespace raytracer
