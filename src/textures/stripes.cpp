#include "textures/patterns.hpp"

namespace raytracer {
namespace {

class Stripes final : public Pattern {
 public:
  Stripes(PatternSetup setup, float width) : Pattern(std::move(setup)), width_(width) {}

 protected:
  float share(const PatternPoint& point) const override {
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
