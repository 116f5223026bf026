#include <cmath>

#include "core/numeric.hpp"
#include "textures/patterns.hpp"

namespace raytracer {
namespace {

class Gradient final : public Pattern {
 public:
  Gradient(PatternSetup setup, GradientShape shape) : Pattern(std::move(setup)), shape_(shape) {}

 protected:
  float share(const PatternPoint& point) const override {
    const Vector3f& p = point.position;
    switch (shape_) {
      case GradientShape::kLinear:
        return p.y;
      case GradientShape::kRadial:
        return glm::length(p);
      case GradientShape::kAngle: {
        const float turn = std::atan2(p.z, p.x) / static_cast<float>(2 * kPi);
        return turn < 0 ? turn + 1 : turn;
      }
    }
    return 0;
  }

 private:
  GradientShape shape_;
};

}  // namespace

TexturePointer make_gradient(PatternSetup setup, GradientShape shape) {
  return std::make_shared<Gradient>(std::move(setup), shape);
}

}  // namespace raytracer
