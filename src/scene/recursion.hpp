// The paper's recursion, and what it makes of surfaces that the paper does not know: layers, metal, glass,
// and what shines.
#pragma once

#include <cstdint>

#include "materials/media.hpp"
#include "raytracer/scene.hpp"
#include "scene/shading_point.hpp"

namespace raytracer {

class Bsdf;

/// Whether a material has nothing but the paper's two words, color and shininess.
inline bool is_of_paper(const Material& m) {
  return !m.has_layer && !(m.metallic > 0) && !(m.transmission > 0) && !(m.coat > 0) && !(m.alpha < 1) &&
         !m.conductor && m.textures == nullptr && !m.is_area_light && !m.is_emissive();
}

/// A ray of the recursion, and what it has come through.
struct Sight {
  Ray3f ray;
  int bounces_left = 0;
  bool is_camera = true;  ///< it starts at the eye
  float weight = 1;       ///< the most that what it sees may still count
  int splits = 0;         ///< how often both the reflected and the refracted ray were followed
  Media media{};
  RayCone cone{};
};

/// What a ray sees, in the 0..255 units of the buffers.
struct Seen {
  Color3f color{0};
  Color3f emitted{0};  ///< the part of it that the very surface it meets gives off
};

/// Follows one ray and all that comes of it. `light_point` in [0, 1)^2 chooses the places on what shines that
/// light is looked for from; null: their middles.
class Recursion {
 public:
  Recursion(const Scene& scene, const Vector2f* light_point, std::uint64_t& rays)
      : scene_(scene), shining_(scene.shining()), light_point_(light_point), rays_(rays) {}

  /// get_pixel_color of the paper.
  Seen look(const Sight& sight);
  /// What a surface that the paper does not know looks like.
  Seen look_at_layers(const Sight& sight, const Hit& hit);

  /// The sum over what shines of the light that arrives at a matt white surface, 0..255 units.
  Color3f light_of_shapes(const ShadingPoint& point);

 private:
  struct Surface;
  struct Shares;

  Color3f direct_light(const ShadingPoint& point);
  Color3f lit_by_lights(const Surface& surface, const Bsdf& bsdf);
  Shares shares_of(const Surface& surface) const;
  Color3f look_on(const Sight& sight, const Surface& surface, const Shares& shares);
  Seen look_behind(const Sight& sight, const Hit& hit);
  Color3f passing(const Ray3f& shadow_ray);
  template <class Function>
  void for_each_shining(const ShadingPoint& point, const Function& function);

  const Scene& scene_;
  const ShiningParts& shining_;
  const Vector2f* light_point_;
  std::uint64_t& rays_;
};

}  // namespace raytracer
