#include "textures/fractal.hpp"
#include "textures/patterns.hpp"
#include "textures/scattered.hpp"

namespace raytracer {
namespace {

class Granite final : public Pattern {
 public:
  using Pattern::Pattern;

 protected:
  float share(const PatternPoint& point) const override {
    const float width = point.width();
    const Vector3f& p = point.position;
    // Grains of three sizes, bent at their edges, each of a mixture of its own.
    float sum = 0;
    const Vector3f bent = p + 0.3F * lattice_noise(3.0F * p);
    for (const float size : {1.0F, 2.3F, 5.1F}) {
      const float left = detail_left(size * width);
      sum += left > 0 ? 0.5F + left * (nearest_points(size * bent, 1, false).number - 0.5F) : 0.5F;
    }
    return 0.5F + 1.2F * (sum / 3 - 0.5F);
  }
};

}  // namespace

TexturePointer make_granite(PatternSetup setup) { return std::make_shared<Granite>(std::move(setup)); }

}  // namespace raytracer
