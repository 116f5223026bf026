// What all computed textures have in common: two colours, a space of their own, and a share between the two.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

#include "raytracer/texture.hpp"

namespace raytracer {

/// A colour that a texture makes use of: the same everywhere, or another texture's.
struct TextureInput {
  Color3f color{0};
  TexturePointer texture;  ///< null: the colour

  TextureInput(const Color3f& same) : color(same) {}
  TextureInput(TexturePointer other) : texture(std::move(other)) {}
  Color3f at(const TexturePoint& point) const { return texture ? texture->at(point) : color; }
  bool is_exact() const { return texture == nullptr || texture->is_exact(); }
};

/// What a pattern's coordinates follow.
enum class PatternMap : std::uint8_t {
  kPosition,  ///< the place in the world: solid, as if the thing were cut out of it
  kUv,        ///< the surface's u and v are x and y, z is 0
};

/// From where a texture is asked to the pattern's own space: own = linear * place + translation.
struct PatternSpace {
  PatternMap map = PatternMap::kPosition;
  glm::mat3 linear{1.0f};
  Vector3f translation{0};
};

/// A place in the pattern's own space.
struct PatternPoint {
  Vector3f position{0};
  Vector3f normal{0, 0, 1};
  Vector3f dx{0}, dy{0};  ///< the edges of the footprint
  bool is_rough = false;  ///< as TexturePoint has it

  /// The standard-deviation-preserving width of the footprint along each axis.
  Vector3f extent() const { return glm::sqrt(dx * dx + dy * dy); }
  /// The longer edge of the footprint.
  float width() const { return std::sqrt(std::max(glm::dot(dx, dx), glm::dot(dy, dy))); }
};

/// A plane's coordinates: x and y of uv; else the two axes that lie most along the surface.
struct PlanePoint {
  Vector2f position, extent;
};
PlanePoint plane_point(const PatternPoint& point, PatternMap map);

/// A pattern's colours and where it stands.
struct PatternSetup {
  TextureInput a{Color3f(1)}, b{Color3f(0)};
  PatternSpace space;
};

/// A texture that mixes two others by a share that each kind computes.
class Pattern : public Texture {
 public:
  explicit Pattern(PatternSetup setup) : setup_(std::move(setup)) {}

  Color3f at(const TexturePoint& point) const final;

 protected:
  /// How much of `b` is there, 0..1, on average over the footprint.
  virtual float share(const PatternPoint& point) const = 0;
  PatternMap map() const { return setup_.space.map; }
  bool has_exact_colors() const { return setup_.a.is_exact() && setup_.b.is_exact(); }

 private:
  PatternPoint own_point(const TexturePoint& point) const;
  PatternSetup setup_;
};

/// The average of a wave of period 1 that is 1 over the first `duty` of each period and 0 over the rest, over
/// `width` around x.
float square_wave(float x, float duty, float width);

/// How much is left of detail of size 1 under a footprint of that width: 1 for a point, 0 from a little above
/// the detail's size on.
float detail_left(float width);
inline constexpr float kNoDetail = 1.2F;  ///< from that width on it is 0

}  // namespace raytracer
