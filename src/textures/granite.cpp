#include "core/lane_math.hpp"
#include "textures/fractal.hpp"
#include "textures/patterns.hpp"
#include "textures/scattered.hpp"

namespace raytracer {
namespace {

class Granite final : public Pattern {
 public:
  using Pattern::Pattern;

 protected:
  // Grains of three sizes, bent at their edges, each of a mixture of its own.
  float share(const PatternPoint& point) const override {
    const float width = point.detail_width();
    const Vector3f bent = point.position + kBend * lattice_noise(kBends * point.position);
    float sum = 0;
    for (const float size : kSizes) {
      const float left = detail_left(size * width);
      sum += faded(left > 0 ? nearest_points(size * bent, 1, false).number : 0.5F, left);
    }
    return contrasted(sum);
  }

  void shares(const PatternBlock& points, NumberBlock& share) const override {
    Vector3Block bent, place;
    const NumberBlock width = points.detail_widths();
    NumberBlock noise, sum{}, left;
    for (int i = 0; i < kBlockSize; ++i) place.set(i, kBends * points.position.at(i));
    lattice_noise(place, noise);
    for (int i = 0; i < kBlockSize; ++i) bent.set(i, points.position.at(i) + kBend * noise.at[i]);
    NearestBlock nearest{};
    for (const float size : kSizes) {
      for (int i = 0; i < kBlockSize; ++i) {
        left.at[i] = detail_left(size * width.at[i]);
        place.set(i, size * bent.at(i));
      }
      if (left.is_any()) nearest_points(place, 1, false, nearest);
      for (int i = 0; i < kBlockSize; ++i) {
        sum.at[i] += faded(chosen(left.at[i] > 0, nearest.number.at[i], 0.5F), left.at[i]);
      }
    }
    for (int i = 0; i < kBlockSize; ++i) share.at[i] = contrasted(sum.at[i]);
  }

 private:
  static constexpr float kBend = 0.3F, kBends = 3, kSizes[] = {1.0F, 2.3F, 5.1F};

  static float faded(float number, float left) { return 0.5F + left * (number - 0.5F); }
  static float contrasted(float sum) { return 0.5F + 1.2F * (sum / 3 - 0.5F); }
};

}  // namespace

TexturePointer make_granite(PatternSetup setup) { return std::make_shared<Granite>(std::move(setup)); }

}  // namespace raytracer
