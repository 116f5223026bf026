#include <cmath>

#include "textures/patterns.hpp"

namespace raytracer {
namespace {

class Brick final : public LanePattern<Brick> {
 public:
  Brick(PatternSetup setup, const BrickShape& shape) : LanePattern(std::move(setup)), shape_(shape) {}

  template <PatternMap kMap>
  [[gnu::always_inline]] float share_of(const PatternPoint& point) const {
    const PlanePoint plane = plane_point(point, kMap);
    const float row = plane.position.y / shape_.height;
    const float along = plane.position.x + shape_.offset * std::floor(row);
    const float in_row = square_wave(row, 1 - shape_.mortar / shape_.height, plane.extent.y / shape_.height);
    return 1 - in_row * square_wave(along, 1 - shape_.mortar, plane.extent.x);
  }

 private:
  BrickShape shape_;
};

}  // namespace

TexturePointer make_brick(PatternSetup setup, const BrickShape& shape) {
  return std::make_shared<Brick>(std::move(setup), shape);
}

}  // namespace raytracer
