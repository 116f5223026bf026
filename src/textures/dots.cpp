#include <algorithm>
#include <cmath>

#include "core/numeric.hpp"
#include "textures/patterns.hpp"

namespace raytracer {
namespace {

// A disk of that radius around the origin, and what of it lies left of a line and below another.
class DiskArea {
 public:
  explicit DiskArea(double radius) : radius_(radius) {}

  double all() const { return kPi * radius_ * radius_; }

  double left_of_and_below(double x, double y) const {
    x = std::clamp(x, -radius_, radius_);
    y = std::clamp(y, -radius_, radius_);
    if (x * x + y * y < radius_ * radius_) return around_corner(x, y);
    // The corner lies outside: at most one of the lines counts, or both cut off a piece of their own.
    if (x < 0 && y < 0) return 0;
    if (x < 0) return left_of(x);
    if (y < 0) return left_of(y);
    return all() - left_of(-x) - left_of(-y);
  }

 private:
  double root(double x) const { return std::sqrt(std::max(0.0, radius_ * radius_ - x * x)); }
  // The integral of the root from the middle to x.
  double half_sum(double x) const {
    return 0.5 * (x * root(x) + radius_ * radius_ * std::asin(std::clamp(x / radius_, -1.0, 1.0)));
  }
  double left_of(double x) const { return 2 * (half_sum(x) - half_sum(-radius_)); }
  // From where the lower line enters the disk up to the corner there is the line above, the arc below.
  double around_corner(double x, double y) const {
    const double enters = -root(y), before = y >= 0 ? left_of(enters) : 0.0;
    return before + y * (x - enters) + half_sum(x) - half_sum(enters);
  }

  double radius_;
};

class Dots final : public Pattern {
 public:
  Dots(PatternSetup setup, float radius)
      : Pattern(std::move(setup)), radius_(radius), disk_(static_cast<double>(radius)) {}

 protected:
  // The mean over a box is a difference of integrals, as that of a square wave is.
  float share(const PatternPoint& point) const override {
    if (point.is_rough) return share_somewhere(point, map());
    const PlanePoint plane = plane_point(point, map());
    double low[2], high[2], area = 1, away = 0, reach = 0;
    bool is_within_cell = true;
    for (int axis = 0; axis < 2; ++axis) {
      constexpr float kLeast = 1e-4F, kMost = 1e6F;
      const auto half = 0.5 * static_cast<double>(std::clamp(plane.extent[axis], kLeast, kMost));
      const auto place = static_cast<double>(plane.position[axis]);
      low[axis] = place - std::floor(place) - half;  // from near the origin: the integrals are large
      high[axis] = low[axis] + 2 * half;
      area *= 2 * half;
      const double aside = low[axis] + half - 0.5;  // from the middle of the cell
      away += aside * aside;
      reach += half * half;
      is_within_cell &= std::abs(aside) + half <= 0.5;
    }
    // Most boxes are small, and lie in a disk or beside it.
    const double distance = std::sqrt(away), radius = static_cast<double>(radius_);
    reach = std::sqrt(reach);
    if (distance + reach < radius) return 0;
    if (is_within_cell && distance - reach > radius) return 1;
    const double covered = integral(high[0], high[1]) - integral(low[0], high[1]) -
                           integral(high[0], low[1]) + integral(low[0], low[1]);
    return 1 - static_cast<float>(covered / area);
  }

  void shares(const PatternBlock& points, NumberBlock& share) const override {
    if (!points.is_rough) {
      Pattern::shares(points, share);
      return;
    }
    shares_by([&](const PatternPoint& point, auto map) { return share_somewhere(point, map); }, points,
              share);
  }

 private:
  // Of the disks in all cells between the origin and there.
  double integral(double x, double y) const {
    const double across = std::floor(x), up = std::floor(y), rest_x = x - across - 0.5, rest_y = y - up - 0.5;
    return across * up * disk_.all() + across * disk_.left_of_and_below(0.5, rest_y) +
           up * disk_.left_of_and_below(rest_x, 0.5) + disk_.left_of_and_below(rest_x, rest_y);
  }

  float share_somewhere(const PatternPoint& point, PatternMap map) const {
    const PlanePoint plane = plane_point(point, map);
    const float x = plane.position.x - std::floor(plane.position.x) - 0.5F;
    const float y = plane.position.y - std::floor(plane.position.y) - 0.5F;
    const float share = x * x + y * y < radius_ * radius_ ? 0.0F : 1.0F;
    const float mean = 1 - static_cast<float>(kPi) * radius_ * radius_;
    const bool is_wide = (plane.extent.x > 1) | (plane.extent.y > 1);
    return is_wide ? mean : share;
  }

  float radius_;
  DiskArea disk_;
};

}  // namespace

TexturePointer make_dots(PatternSetup setup, float radius) {
  return std::make_shared<Dots>(std::move(setup), radius);
}

}  // namespace raytracer
