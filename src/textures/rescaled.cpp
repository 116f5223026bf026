#include "textures/limited.hpp"
#include "textures/patterns.hpp"

namespace raytracer {
namespace {

class Rescaled final : public Texture {
 public:
  Rescaled(TextureInput texture, Rescaling rescaling)
      : Texture(texture.asks_uv() || rescaling.factor.asks_uv()),
        texture_(std::move(texture)),
        rescaling_(std::move(rescaling)) {}

  Color3f at(const TexturePoint& point) const override {
    return rescaled(texture_.at(point), rescaling_.factor.at(point));
  }

  void colors_at(const TextureBlock& points, ColorBlock& colors) const override {
    ColorBlock factors;
    texture_.colors_at(points, colors);
    rescaling_.factor.colors_at(points, factors);
    for (int i = 0; i < points.count; ++i) colors.set(i, rescaled(colors.at(i), factors.at(i)));
  }

  // The average of a product is not the product of the averages.
  bool is_exact() const override {
    const bool is_product = texture_.texture != nullptr && rescaling_.factor.texture != nullptr;
    return !is_product && texture_.is_exact() && rescaling_.factor.is_exact();
  }

 private:
  Color3f rescaled(const Color3f& color, const Color3f& by) const {
    const Rescaling& r = rescaling_;
    const float factor = limited(number_of(by), r.least, r.most);
    return r.around + (1.0F + (factor - 1) * r.channels) * (color - r.around);
  }

  TextureInput texture_;
  Rescaling rescaling_;
};

}  // namespace

TexturePointer make_rescaled(TextureInput texture, Rescaling rescaling) {
  return std::make_shared<Rescaled>(std::move(texture), std::move(rescaling));
}

}  // namespace raytracer
