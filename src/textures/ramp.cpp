#include <algorithm>

#include "textures/limited.hpp"
#include "textures/patterns.hpp"

namespace raytracer {
namespace {

class Ramp final : public Texture {
 public:
  Ramp(TextureInput value, std::vector<RampStop> stops)
      : value_(std::move(value)), stops_(std::move(stops)) {}

  Color3f at(const TexturePoint& point) const override {
    const float value = number_of(value_.at(point));
    const auto next = std::ranges::find_if(stops_, [&](const RampStop& stop) { return stop.at > value; });
    if (next == stops_.begin()) return next->color.at(point);
    const auto last = std::prev(next);
    if (next == stops_.end()) return last->color.at(point);
    const float share = (value - last->at) / (next->at - last->at);
    return (1 - share) * last->color.at(point) + share * next->color.at(point);
  }

 private:
  TextureInput value_;
  std::vector<RampStop> stops_;
};

}  // namespace

TexturePointer make_ramp(TextureInput value, std::vector<RampStop> stops) {
  return std::make_shared<Ramp>(std::move(value), std::move(stops));
}

}  // namespace raytracer
