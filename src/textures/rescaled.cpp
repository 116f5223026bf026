#include "textures/limited.hpp"
#include "textures/patterns.hpp"

namespace raytracer {
namespace {

class Rescaled final : public Texture {
 public:
  Rescaled(TextureInput texture, Rescaling rescaling)
      : texture_(std::move(texture)), rescaling_(std::move(rescaling)) {}

  Color3f at(const TexturePoint& point) const override {
    const Rescaling& r = rescaling_;
    const float factor = limited(number_of(r.factor.at(point)), r.least, r.most);
    return r.around + (1.0F + (factor - 1) * r.channels) * (texture_.at(point) - r.around);
  }

  // The average of a product is not the product of the averages.
  bool is_exact() const override {
    const bool is_product = texture_.texture != nullptr && rescaling_.factor.texture != nullptr;
    return !is_product && texture_.is_exact() && rescaling_.factor.is_exact();
  }

 private:
  TextureInput texture_;
  Rescaling rescaling_;
};

}  // namespace

TexturePointer make_rescaled(TextureInput texture, Rescaling rescaling) {
  return std::make_shared<Rescaled>(std::move(texture), std::move(rescaling));
}

}  // namespace raytracer
