// Skies that are a formula.
#include <algorithm>
#include <cmath>

#include "core/numeric.hpp"
#include "lights/environments.hpp"
#include "lights/sphere_distribution.hpp"
#include "raytracer/error.hpp"

namespace raytracer {

namespace {

void require_radiance(const Color3f& color) {
  if (!is_finite(Vector3d(color)) || color.x < 0 || color.y < 0 || color.z < 0) {
    throw Error(ErrorKind::kScene, "a sky's radiance must be a number that is not below 0");
  }
}

class ConstantSky final : public Environment {
 public:
  explicit ConstantSky(const Color3f& radiance) : radiance_(radiance) {}

  Color3f radiance(const Vector3f&) const override { return radiance_; }
  bool sample(const Vector2f& u, Vector3f& direction, float& pdf_there) const override {
    const float z = 1 - 2 * u.y, r = std::sqrt(std::max(1 - z * z, 0.0F));
    const float angle = static_cast<float>(2 * kPi) * u.x;
    direction = {r * std::cos(angle), z, r * std::sin(angle)};
    pdf_there = pdf(direction);
    return radiance_ != Color3f(0);
  }
  float pdf(const Vector3f&) const override { return static_cast<float>(1 / (4 * kPi)); }
  bool is_constant() const override { return true; }
  Color3f mean() const override { return radiance_; }

 private:
  Color3f radiance_;
};

class GradientSky final : public Environment {
 public:
  GradientSky(const Color3f& zenith, const Color3f& horizon, const Color3f& ground)
      : zenith_(zenith), horizon_(horizon), ground_(ground) {
    constexpr int kRows = 64;
    std::vector<float> weights;
    for (int i = 0; i < kRows; ++i) {
      const float y = std::cos(static_cast<float>(kPi) * (static_cast<float>(i) + 0.5F) / kRows);
      const Color3f color = at_height(y);
      weights.push_back(std::max({color.x, color.y, color.z}));
    }
    distribution_ = SphereDistribution(1, kRows, std::move(weights));
  }

  Color3f radiance(const Vector3f& direction) const override { return at_height(direction.y); }
  bool sample(const Vector2f& u, Vector3f& direction, float& pdf_there) const override {
    if (distribution_.is_empty()) return false;
    distribution_.sample(u, direction, pdf_there);
    return pdf_there > 0;
  }
  float pdf(const Vector3f& direction) const override { return distribution_.pdf(direction); }
  Color3f mean() const override { return 0.25F * zenith_ + 0.5F * horizon_ + 0.25F * ground_; }

 private:
  Color3f at_height(float y) const {
    return glm::mix(horizon_, y > 0 ? zenith_ : ground_, std::min(std::abs(y), 1.0F));
  }

  Color3f zenith_, horizon_, ground_;
  SphereDistribution distribution_;
};

}  // namespace

glm::dmat3 turn_about_y(double degrees) {
  const double angle = degrees * kPi / 180, c = std::cos(angle), s = std::sin(angle);
  return {c, 0, -s, 0, 1, 0, s, 0, c};
}

std::shared_ptr<const Environment> make_constant_sky(const Color3f& radiance) {
  require_radiance(radiance);
  return std::make_shared<ConstantSky>(radiance);
}

std::shared_ptr<const Environment> make_gradient_sky(const Color3f& zenith, const Color3f& horizon,
                                                     const Color3f& ground) {
  for (const Color3f& color : {zenith, horizon, ground}) require_radiance(color);
  if (zenith == horizon && horizon == ground) return make_constant_sky(horizon);
  return std::make_shared<GradientSky>(zenith, horizon, ground);
}

}  // namespace raytracer
