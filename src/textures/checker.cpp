#include <algorithm>
#include <cmath>

#include "textures/patterns.hpp"

namespace raytracer {
namespace {

// The cells' parity is a product of square waves, and the mean of a product over a box the product of means.
class Checker final : public Pattern {
 public:
  using Pattern::Pattern;

 protected:
  // A footprint that is long and lies askew is cut into shorter ones, whose boxes fit it better.
  float share(const PatternPoint& point) const override {
    const bool is_dy_longer = glm::dot(point.dy, point.dy) > glm::dot(point.dx, point.dx);
    const Vector3f& along = is_dy_longer ? point.dy : point.dx;
    const Vector3f& across = is_dy_longer ? point.dx : point.dy;
    constexpr float kShortest = 0.25F;  // of a cell: no need to cut it
    constexpr float kMostPieces = 8;
    const float pieces = std::clamp(std::floor(glm::length(along) / std::max(glm::length(across), kShortest)),
                                    1.0F, kMostPieces);
    const Vector3f piece = along / pieces;
    const Vector3f width = glm::sqrt(piece * piece + across * across);
    float sum = 0;
    for (float i = 0; i < pieces; ++i) {
      sum += parity(point.position + (i + 0.5F) * piece - 0.5F * along, width);
    }
    return 0.5F - 0.5F * sum / pieces;
  }

 private:
  float parity(const Vector3f& place, const Vector3f& width) const {
    float product = 1;
    for (int axis = 0; axis < (map() == PatternMap::kUv ? 2 : 3); ++axis) {
      product *= 2 * square_wave(place[axis] / 2, 0.5F, width[axis] / 2) - 1;
    }
    return product;
  }
};

}  // namespace

TexturePointer make_checker(PatternSetup setup) { return std::make_shared<Checker>(std::move(setup)); }

}  // namespace raytracer
