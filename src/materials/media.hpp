// What a path is inside of.
#pragma once

#include <array>
#include <cstdint>

#include "materials/absorption.hpp"
#include "raytracer/material.hpp"

namespace raytracer {

/// The inside of a see-through shape, as light on its way has it.
struct Medium {
  const Material* material = nullptr;  ///< tells one from another
  float ior = 1;
  Color3f absorption{0};  ///< as absorption_of() has it

  Medium() = default;
  /// With the values where the light came in.
  Medium(const Material& own, const MaterialValues& here)
      : material(&own), ior(here.ior), absorption(absorption_of(here)) {}
};

/// The insides of the closed, see-through shapes around a point, the innermost last: a path that enters a
/// shape puts it on top, one that leaves takes it off wherever it is. So an air bubble in water needs no word
/// of its own. Beyond the depth that it holds the outermost are forgotten.
class Media {
 public:
  Media() = default;
  // Of the stack what is there: most paths are in nothing.
  Media(const Media& other) { *this = other; }
  Media& operator=(const Media& other) {
    for (std::uint32_t i = 0; i < other.count_; ++i) stack_[i] = other.stack_[i];
    count_ = other.count_;
    return *this;
  }

  /// Null outside of everything.
  const Medium* innermost() const { return count_ > 0 ? &stack_[count_ - 1] : nullptr; }
  float ior() const { return count_ > 0 ? stack_[count_ - 1].ior : 1.0F; }

  bool contains(const Material* material) const { return find(material) < count_; }

  /// Whether the shape of this material ends inside of another that was entered later: where it ends nothing
  /// is seen.
  bool is_covered(const Material* material) const {
    return contains(material) && innermost()->material != material;
  }

  /// The index of refraction inside the shape of this material; `otherwise` where it was not entered.
  float ior_of(const Material* material, float otherwise) const {
    const std::uint32_t index = find(material);
    return index < count_ ? stack_[index].ior : otherwise;
  }

  /// The index of refraction where one is after leaving the shape of this material.
  float ior_without(const Material* material) const {
    const std::uint32_t left_out = find(material);
    for (std::uint32_t i = count_; i-- > 0;) {
      if (i != left_out) return stack_[i].ior;
    }
    return 1;
  }

  void enter(const Medium& medium) {
    if (count_ == kDepth) {
      for (std::uint32_t i = 1; i < kDepth; ++i) stack_[i - 1] = stack_[i];
      --count_;
    }
    stack_[count_++] = medium;
  }

  void leave(const Material* material) {
    const std::uint32_t index = find(material);
    if (index == count_) return;
    for (std::uint32_t i = index + 1; i < count_; ++i) stack_[i - 1] = stack_[i];
    --count_;
  }

  /// Puts a medium below all others.
  void surround(const Medium& medium) {
    if (count_ == kDepth) return;
    for (std::uint32_t i = count_; i > 0; --i) stack_[i] = stack_[i - 1];
    stack_[0] = medium;
    ++count_;
  }

 private:
  // The latest that was entered; count_ where there is none.
  std::uint32_t find(const Material* material) const {
    for (std::uint32_t i = count_; i-- > 0;) {
      if (stack_[i].material == material) return i;
    }
    return count_;
  }

  static constexpr std::uint32_t kDepth = 6;
  std::array<Medium, kDepth> stack_;
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
