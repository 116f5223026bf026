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
    const float left = detail_left(point.detail_width());
    if (!(left > 0)) return mean();
    const NearestPoints points = nearest_points(point.position, jitter_, map() == PatternMap::kUv);
    return mean() + left * (detail(points, point.width()) - mean());
  }

  void shares(const PatternBlock& points, NumberBlock& share) const override {
    const NumberBlock width = points.widths(), detail_width = points.detail_widths(width);
    NumberBlock left;
    for (int i = 0; i < kBlockSize; ++i) left.at[i] = detail_left(detail_width.at[i]);
    NearestBlock nearest{};
    if (left.is_any()) nearest_points(points.position, jitter_, map() == PatternMap::kUv, nearest);
    for (int i = 0; i < kBlockSize; ++i) {
      const float fine = left.at[i] > 0 ? left.at[i] * (detail(nearest.at(i), width.at[i]) - mean()) : 0.0F;
      share.at[i] = mean() + fine;
    }
  }

 private:
  float mean() const {
    return sort_ == CellSort::kDistance ? kMeanDistance
           : sort_ == CellSort::kFlat   ? kMeanFlat
                                        : std::min(1.0F, kMeanBorderPerWidth * border_);
  }

  float detail(const NearestPoints& points, float width) const {
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
