#include <algorithm>

#include "textures/limited.hpp"
#include "textures/patterns.hpp"

namespace raytracer {
namespace {

class Ramp final : public Texture {
 public:
  Ramp(TextureInput value, std::vector<RampStop> stops)
      : Texture(value.asks_uv() ||
                std::ranges::any_of(stops, [](const RampStop& stop) { return stop.color.asks_uv(); })),
        value_(std::move(value)),
        stops_(std::move(stops)) {}

  Color3f at(const TexturePoint& point) const override {
    return color_of(number_of(value_.at(point)), point);
  }

  void colors_at(const TextureBlock& points, ColorBlock& colors) const override {
    ColorBlock values;
    value_.colors_at(points, values);
    for (int i = 0; i < points.count; ++i) colors.set(i, color_of(number_of(values.at(i)), points.at(i)));
  }

 private:
  Color3f color_of(float value, const TexturePoint& point) const {
    const auto next = std::ranges::find_if(stops_, [&](const RampStop& stop) { return stop.at > value; });
    if (next == stops_.begin()) return next->color.at(point);
    const auto last = std::prev(next);
    if (next == stops_.end()) return last->color.at(point);
    const float share = (value - last->at) / (next->at - last->at);
    return (1 - share) * last->color.at(point) + share * next->color.at(point);
  }

  TextureInput value_;
  std::vector<RampStop> stops_;
};

}  // namespace

TexturePointer make_ramp(TextureInput value, std::vector<RampStop> stops) {
  return std::make_shared<Ramp>(std::move(value), std::move(stops));
}

}  // namespace raytracer
