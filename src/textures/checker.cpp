#include <algorithm>
#include <cmath>

#include "textures/patterns.hpp"

namespace raytracer {
namespace {

// The cells' parity is a product of square waves, and the mean of a product over a box the product of means.
class Checker final : public Pattern {
 public:
  using Pattern::Pattern;
  bool is_exact() const override { return has_exact_colors(); }

 protected:
  // A footprint that is long and lies askew is cut into shorter ones, whose boxes fit it better.
  float share(const PatternPoint& point) const override {
    if (point.is_rough) return share_somewhere(point, map());
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

  void shares(const PatternBlock& points, NumberBlock& share) const override {
    if (!points.is_rough) {
      Pattern::shares(points, share);
      return;
    }
    shares_by([](const PatternPoint& point, auto map) { return share_somewhere(point, map); }, points, share);
  }

 private:
  static constexpr int axes_of(PatternMap map) { return map == PatternMap::kUv ? 2 : 3; }

  static float share_somewhere(const PatternPoint& point, PatternMap map) {
    int cell = 0;
    for (int axis = 0; axis < axes_of(map); ++axis) cell ^= cell_of(point.position[axis]);
    const auto share = static_cast<float>(cell & 1);
    return glm::dot(point.dx, point.dx) > 1 ? 0.5F : share;
  }

  static int cell_of(float x) {
    constexpr float kWhole = 0x1p24F;  // from here on all are even
    const float near = std::abs(x) < kWhole ? x : 0.0F;
    return static_cast<int>(std::floor(near));
  }

  // Each mean is a difference of integrals over a width; in double, as they are close to each other.
  float parity(const Vector3f& place, const Vector3f& width) const {
    double differences = 1, widths = 1;
    for (int axis = 0; axis < axes_of(map()); ++axis) {
      const auto x = static_cast<double>(place[axis]), across = static_cast<double>(width[axis]);
      constexpr double kPoint = 1e-5;
      if (across > kPoint) {
        differences *= triangle_wave(x + 0.5 * across) - triangle_wave(x - 0.5 * across);
        widths *= across;
      } else if (std::floor(x) != 2 * std::floor(0.5 * x)) {
        differences = -differences;
      }
    }
    return static_cast<float>(differences / widths);
  }

  // The integral from 0 of the wave that is 1 in the first cell and -1 in the second.
  static double triangle_wave(double x) { return 1 - std::abs(1 - (x - 2 * std::floor(0.5 * x))); }
};

}  // namespace

TexturePointer make_checker(PatternSetup setup) { return std::make_shared<Checker>(std::move(setup)); }

}  // namespace raytracer
