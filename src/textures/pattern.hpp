// What all computed textures have in common: two colours, a space of their own, and a share between the two.
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <utility>

#include "core/with_constant.hpp"
#include "raytracer/texture.hpp"
#include "textures/texture_block.hpp"

namespace raytracer {

/// A colour that a texture makes use of: the same everywhere, or another texture's.
struct TextureInput {
  Color3f color{0};
  TexturePointer texture;  ///< null: the colour

  TextureInput(const Color3f& same) : color(same) {}
  TextureInput(TexturePointer other) : texture(std::move(other)) {}
  Color3f at(const TexturePoint& point) const { return texture ? texture->at(point) : color; }
  void colors_at(const TextureBlock& points, ColorBlock& colors) const;
  bool is_exact() const { return texture == nullptr || texture->is_exact(); }
  bool asks_uv() const { return texture != nullptr && texture->asks_uv(); }
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
  Vector3f extent() const {
    const Vector3f square = dx * dx + dy * dy;
    return {std::sqrt(square.x), std::sqrt(square.y), std::sqrt(square.z)};
  }
  /// The longer edge of the footprint.
  float width() const { return longer_of(dx, dy); }
  /// Likewise for what fades out as it gets too fine. Of rough points that is early: fine detail costs time,
  /// and nobody sees it.
  float detail_width() const { return early(is_rough) * width(); }
  static constexpr float early(bool is_rough) { return is_rough ? 2.0F : 1.0F; }
  static float longer_of(const Vector3f& dx, const Vector3f& dy) {
    const float x = glm::dot(dx, dx), y = glm::dot(dy, dy);
    return std::sqrt(x < y ? y : x);
  }
};

/// One number for each lane.
struct alignas(64) NumberBlock {
  float at[kBlockSize];

  /// Whether one of them is not 0, there being no -0; in bits, as compilers make vectors of those.
  bool is_any() const {
    std::uint32_t bits = 0;
    for (const float each : at) bits |= std::bit_cast<std::uint32_t>(each);
    return bits != 0;
  }
};

/// Sixteen of them; lanes from `count` on hold anything that is a number.
struct PatternBlock {
  int count;
  bool is_rough;
  Vector3Block position, normal, dx, dy;

  PatternPoint at(int i) const { return {position.at(i), normal.at(i), dx.at(i), dy.at(i), is_rough}; }
  void set(int i, const PatternPoint& point) {
    position.set(i, point.position);
    normal.set(i, point.normal);
    dx.set(i, point.dx);
    dy.set(i, point.dy);
  }
  NumberBlock widths() const {
    NumberBlock result;
    for (int i = 0; i < kBlockSize; ++i) result.at[i] = PatternPoint::longer_of(dx.at(i), dy.at(i));
    return result;
  }
  NumberBlock detail_widths() const { return detail_widths(widths()); }
  NumberBlock detail_widths(NumberBlock all_widths) const {
    for (float& each : all_widths.at) each *= PatternPoint::early(is_rough);
    return all_widths;
  }
};

/// A plane's coordinates: x and y of uv; else the two axes that lie most along the surface.
struct PlanePoint {
  Vector2f position, extent;
};
inline PlanePoint plane_point(const PatternPoint& point, PatternMap map) {
  const Vector3f p = point.position, extent = point.extent(), n = glm::abs(point.normal);
  const bool is_z = (map == PatternMap::kUv) | ((n.z >= n.x) & (n.z >= n.y));
  const bool is_x = !is_z & (n.x > n.y);
  const bool is_upright = is_z | is_x;
  return {{is_x ? p.z : p.x, is_upright ? p.y : p.z},
          {is_x ? extent.z : extent.x, is_upright ? extent.y : extent.z}};
}

/// A pattern's colours and where it stands.
struct PatternSetup {
  TextureInput a{Color3f(1)}, b{Color3f(0)};
  PatternSpace space;
};

/// A texture that mixes two others by a share that each kind computes.
class Pattern : public Texture {
 public:
  explicit Pattern(PatternSetup setup)
      : Texture(setup.space.map == PatternMap::kUv || setup.a.asks_uv() || setup.b.asks_uv()),
        setup_(std::move(setup)) {}

  Color3f at(const TexturePoint& point) const final;
  void colors_at(const TextureBlock& points, ColorBlock& colors) const final;

 protected:
  /// How much of `b` is there, 0..1, on average over the footprint.
  virtual float share(const PatternPoint& point) const = 0;
  /// The very same of sixteen points; by default one by one.
  virtual void shares(const PatternBlock& points, NumberBlock& share) const;
  PatternMap map() const { return setup_.space.map; }
  /// Calls function(map), the map being a constant.
  template <class Function>
  auto with_map(const Function& function) const {
    return with_constant<PatternMap::kUv, PatternMap::kPosition>(map(), function);
  }
  /// shares() by a function of a point and the constant map that has no branches and calls nothing.
  template <class ShareAt>
  void shares_by(const ShareAt& share_at, const PatternBlock& points, NumberBlock& share) const {
    with_map([&](auto map) {
      NumberBlock result;  // of its own: compilers fear that `share` is one of the pattern's numbers
      for (int i = 0; i < kBlockSize; ++i) result.at[i] = share_at(points.at(i), map);
      share = result;
    });
  }
  bool has_exact_colors() const { return setup_.a.is_exact() && setup_.b.is_exact(); }

 private:
  PatternSetup setup_;
};

/// The average of a wave of period 1 that is 1 over the first `duty` of each period and 0 over the rest, over
/// `width` around x.
inline float square_wave(float x, float duty, float width) {
  // In double, from near the origin: the two integrals are large and close to each other.
  const double at = static_cast<double>(x) - std::floor(static_cast<double>(x));
  const auto on = static_cast<double>(duty), half = static_cast<double>(width) / 2;
  const auto integral = [&](double to) {
    const double whole = std::floor(to), rest = to - whole;
    return on * whole + (rest < on ? rest : on);
  };
  const bool has_width = width > 1e-5F;
  const auto mean =
      static_cast<float>((integral(at + half) - integral(at - half)) / (has_width ? 2 * half : 1.0));
  const float here = at < on ? 1.0F : 0.0F;
  return has_width ? mean : here;
}

/// How much is left of detail of size 1 under a footprint of that width: 1 for a point, 0 from a little above
/// the detail's size on.
inline constexpr float kNoDetail = 1.2F;  ///< from that width on it is 0
inline float detail_left(float width) { return 1 - glm::smoothstep(0.4F, kNoDetail, width); }

/// A pattern whose share has no branches and calls nothing: Kind::share_of<map>(point).
template <class Kind>
class LanePattern : public Pattern {
 public:
  using Pattern::Pattern;

 protected:
  float share(const PatternPoint& point) const final {
    return with_map([&](auto map) { return kind().template share_of<map>(point); });
  }
  void shares(const PatternBlock& points, NumberBlock& share) const final {
    shares_by([&](const PatternPoint& point, auto map) { return kind().template share_of<map>(point); },
              points, share);
  }

 private:
  const Kind& kind() const { return static_cast<const Kind&>(*this); }
};

}  // namespace raytracer
