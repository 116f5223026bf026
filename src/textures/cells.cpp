#include <algorithm>

#include "textures/patterns.hpp"
#include "textures/scattered.hpp"

namespace raytracer {
namespace {

// Means over space at full jitter, which a wide footprint sees; counted once.
constexpr float kMeanDistance = 0.55F, kMeanFlat = 0.5F, kMeanBorderPerWidth = 3.0F;

class Cells final : public Pattern {
 public:
  Cells(PatternSetup setup, CellSort sort, float jitter, float border)
      : Pattern(std::move(setup)), sort_(sort), jitter_(jitter), border_(border) {}

 protected:
  float share(const PatternPoint& point) const override {
    const float width = point.width(), left = detail_left(width);
    const float mean = sort_ == CellSort::kDistance ? kMeanDistance
                       : sort_ == CellSort::kFlat   ? kMeanFlat
                                                    : std::min(1.0F, kMeanBorderPerWidth * border_);
    if (left <= 0) return mean;
    return mean + left * (detail(point, width) - mean);
  }

 private:
  float detail(const PatternPoint& point, float width) const {
    const NearestPoints points = nearest_points(point.position, jitter_, map() == PatternMap::kUv);
    if (sort_ == CellSort::kDistance) return points.nearest;
    if (sort_ == CellSort::kFlat) return points.number;
    // Half the difference of the distances is about how far the border is.
    const float to_border = 0.5F * (points.second - points.nearest);
    const float soft = std::max(width, 1e-4F);
    return std::clamp(0.5F + (0.5F * border_ - to_border) / soft, 0.0F, 1.0F);
  }

  CellSort sort_;
  float jitter_, border_;
};

}  // namespace

TexturePointer make_cells(PatternSetup setup, CellSort sort, float jitter, float border) {
  return std::make_shared<Cells>(std::move(setup), sort, jitter, border);
}

}  // namespace raytracer
