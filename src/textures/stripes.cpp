#include "textures/patterns.hpp"

namespace raytracer {
namespace {

class Stripes final : public LanePattern<Stripes> {
 public:
  Stripes(PatternSetup setup, float width) : LanePattern(std::move(setup)), width_(width) {}

  template <PatternMap>
  [[gnu::always_inline]] float share_of(const PatternPoint& point) const {
    return 1 - square_wave(point.position.x, width_, point.extent().x);
  }

 private:
  float width_;
};

}  // namespace

TexturePointer make_stripes(PatternSetup setup, float width) {
  return std::make_shared<Stripes>(std::move(setup), width);
}

}  // namespace raytracer
