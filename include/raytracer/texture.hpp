// What a material's colours and numbers follow from where they are not the same everywhere.
#pragma once

#include <memory>

#include "raytracer/vector3f.hpp"

namespace raytracer {

/// Where a texture is asked, and over how much of the surface it may average.
struct TexturePoint {
  Vector2f uv{0};
  Vector3f position{0};         ///< world space
  Vector3f normal{0, 1, 0};     ///< world space, unit length, the shading normal
  Vector2f uv_dx{0}, uv_dy{0};  ///< how uv changes to the next sample to the right and below; 0: a point
  Vector3f position_dx{0}, position_dy{0};  ///< likewise the position, world space
  /// Few samples share the pixel, and the footprint is what one of them stands for: no other look will make
  /// up for a bad average.
  bool is_coarse = false;
  /// The light goes on to where a matt surface or a blurred mirror adds it up with much else: whatever is
  /// seen at one place of about this size will do. Never together with is_coarse.
  bool is_rough = false;
};

struct TextureBlock;
template <int N>
struct Vector3Lanes;

/// A function over surfaces. Immutable; any number of threads may ask it at once.
class Texture {
 public:
  virtual ~Texture() = default;

  /// The average over the point's footprint, as good as can be had. A colour is linear where the scene's
  /// method is `path`, a display value in `classic`; a texture for a number puts it into every channel.
  virtual Color3f at(const TexturePoint& point) const = 0;

  /// The very same for sixteen points at once, none of them coarse. What this class does, asking at() for
  /// each, is right for every texture; those that are asked often do it faster.
  virtual void colors_at(const TextureBlock& points, Vector3Lanes<16>& colors) const;

  /// Whether that is the average over the very parallelogram of the footprint. Else it is one over something
  /// about as large, and more looks at parts of it come closer.
  virtual bool is_exact() const { return false; }

  /// Whether it matters what a point's uv is.
  bool asks_uv() const { return asks_uv_; }

 protected:
  explicit Texture(bool asks_uv = true) : asks_uv_(asks_uv) {}

 private:
  bool asks_uv_;
};

using TexturePointer = std::shared_ptr<const Texture>;

}  // namespace raytracer
