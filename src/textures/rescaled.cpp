#include "textures/patterns.hpp"

namespace raytracer {
namespace {

class Rescaled final : public Texture {
 public:
  Rescaled(TexturePointer texture, const Color3f& around, const Color3f& factor)
      : texture_(std::move(texture)), around_(around), factor_(factor) {}

  Color3f at(const TexturePoint& point) const override {
    return around_ + factor_ * (texture_->at(point) - around_);
  }

  bool is_exact() const override { return texture_->is_exact(); }

 private:
  TexturePointer texture_;
  Color3f around_, factor_;
};

}  // namespace

TexturePointer make_rescaled(TexturePointer texture, const Color3f& around, const Color3f& factor) {
  return std::make_shared<Rescaled>(std::move(texture), around, factor);
}

}  // namespace raytracer
