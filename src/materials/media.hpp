// What a path is inside of.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

#include "raytracer/material.hpp"

namespace raytracer {

/// The materials of the closed, see-through shapes around a point, the innermost last: a path that enters a
/// shape puts its material on top, one that leaves takes it off wherever it is. So an air bubble in water
/// needs no word of its own. Beyond the depth that it holds the outermost are forgotten.
class Media {
 public:
  /// Null outside of everything.
  const Material* innermost() const { return count_ > 0 ? stack_[count_ - 1] : nullptr; }
  float ior() const { return count_ > 0 ? stack_[count_ - 1]->ior : 1.0F; }

  bool contains(const Material* material) const {
    return std::find(stack_.begin(), stack_.begin() + count_, material) != stack_.begin() + count_;
  }

  /// Whether the shape of this material ends inside of another that was entered later: where it ends nothing
  /// is seen.
  bool is_covered(const Material* material) const { return innermost() != material && contains(material); }

  /// The index of refraction where one is after leaving the shape of this material.
  float ior_without(const Material* material) const {
    Media rest = *this;
    rest.leave(material);
    return rest.ior();
  }

  void enter(const Material* material) {
    if (count_ == kDepth) {
      for (std::uint32_t i = 1; i < kDepth; ++i) stack_[i - 1] = stack_[i];
      --count_;
    }
    stack_[count_++] = material;
  }

  void leave(const Material* material) {
    for (std::uint32_t i = count_; i-- > 0;) {
      if (stack_[i] != material) continue;
      for (std::uint32_t j = i + 1; j < count_; ++j) stack_[j - 1] = stack_[j];
      --count_;
      return;
    }
  }

  /// Puts a material below all others.
  void surround(const Material* material) {
    if (count_ == kDepth) return;
    for (std::uint32_t i = count_; i > 0; --i) stack_[i] = stack_[i - 1];
    stack_[0] = material;
    ++count_;
  }

 private:
  static constexpr std::uint32_t kDepth = 6;
  std::array<const Material*, kDepth> stack_{};
  std::uint32_t count_ = 0;
};

/// Whether a material has an inside that a path can be in.
inline bool has_inside(const Material& material) { return material.transmission > 0 && !material.thin; }

/// Whether some light may come through, anywhere on the surface.
inline bool lets_light_pass(const Material& material) {
  return material.alpha < 1 || material.transmission > 0 ||
         (material.textures && (material.textures->alpha || material.textures->transmission));
}

}  // namespace raytracer
