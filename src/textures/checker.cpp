#include "textures/patterns.hpp"

namespace raytracer {
namespace {

// The cells' parity is a product of square waves, and the mean of a product over a box the product of means.
class Checker final : public Pattern {
 public:
  using Pattern::Pattern;

 protected:
  float share(const PatternPoint& point) const override {
    const Vector3f width = point.extent();
    float product = 1;
    for (int axis = 0; axis < (map() == PatternMap::kUv ? 2 : 3); ++axis) {
      product *= 2 * square_wave(point.position[axis] / 2, 0.5F, width[axis] / 2) - 1;
    }
    return 0.5F - 0.5F * product;
  }
};

}  // namespace

TexturePointer make_checker(PatternSetup setup) { return std::make_shared<Checker>(std::move(setup)); }

}  // namespace raytracer
