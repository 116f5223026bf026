#include <cmath>

#include "core/numeric.hpp"
#include "textures/patterns.hpp"

namespace raytracer {
namespace {

class Dots final : public LanePattern<Dots> {
 public:
  Dots(PatternSetup setup, float radius) : LanePattern(std::move(setup)), radius_(radius) {}

  template <PatternMap kMap>
  [[gnu::always_inline]] float share_of(const PatternPoint& point) const {
    const PlanePoint plane = plane_point(point, kMap);
    const Vector2f within = plane.position - glm::floor(plane.position) - 0.5F;
    const float longer = plane.extent.x > plane.extent.y ? plane.extent.x : plane.extent.y;
    const float width = longer > 1e-5F ? longer : 1e-5F;
    const float covered = glm::clamp(0.5F + (radius_ - glm::length(within)) / width, 0.0F, 1.0F);
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
