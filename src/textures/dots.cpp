#include <algorithm>
#include <cmath>

#include "core/numeric.hpp"
#include "textures/patterns.hpp"

namespace raytracer {
namespace {

class Dots final : public Pattern {
 public:
  Dots(PatternSetup setup, float radius) : Pattern(std::move(setup)), radius_(radius) {}

 protected:
  float share(const PatternPoint& point) const override {
    const PlanePoint plane = plane_point(point, map());
    const Vector2f within = plane.position - glm::floor(plane.position) - 0.5F;
    const float width = std::max({plane.extent.x, plane.extent.y, 1e-5F});
    const float covered = std::clamp(0.5F + (radius_ - glm::length(within)) / width, 0.0F, 1.0F);
    const float mean = static_cast<float>(kPi) * radius_ * radius_;
    return 1 - (mean + detail_left(width) * (covered - mean));
  }

 private:
  float radius_;
};

}  // namespace

TexturePointer make_dots(PatternSetup setup, float radius) {
  return std::make_shared<Dots>(std::move(setup), radius);
}

}  // namespace raytracer
