// The shapes that shine, as `method classic` sees them: it asks all of them, or of very many a choice, and
// where light may pass what stands in its way.
#pragma once

#include <cstdint>
#include <vector>

#include "raytracer/scene.hpp"

namespace raytracer {

/// Light that would arrive from a point of a shape that shines if nothing stood between.
struct ShiningSample {
  Vector3f direction{0};  ///< unit length, from the lit point
  Color3f light{0};       ///< the radiance over the density of its choice, 1 is white
  Vector3f target{0};     ///< where the shadow ray ends, a little off the shape
};

class ShiningParts {
 public:
  explicit ShiningParts(const SceneDescription& scene);

  bool is_empty() const { return parts_.empty(); }
  /// Whether there is anything that lets some light pass.
  bool has_see_through() const { return has_see_through_; }

  /// How many samples a lit point takes.
  std::uint32_t sample_count() const {
    return static_cast<std::uint32_t>(std::min<std::size_t>(parts_.size(), kMostSamples));
  }
  /// The k-th of them as seen from `from`; false where nothing can arrive. `u` in [0, 1)^2 is the place on
  /// the part.
  bool sample(std::uint32_t k, const Vector3f& from, const Vector2f& u, ShiningSample& sample) const;

 private:
  static constexpr std::size_t kMostSamples = 16;

  struct Part {
    const Shape* shape;
    const Material* material;
    const Instance* instance;  // null: it stands in the scene itself
    std::uint32_t part;
    double power_up_to;  // of all parts before it and its own
  };

  void add(const Shape& shape, const Material& material, const Instance* instance);
  static Color3f light_of(const Part& part, const Vector3f& own_from, const ShapeSample& chosen,
                          const Vector3f& position, const Vector3f& normal);

  std::vector<Part> parts_;
  bool has_see_through_ = false;
};

/// The share of light that comes along a shadow ray. Glass and what is partly there lets it pass in a
/// straight line, as ray tracers of old have it.
Color3f share_passing(const Scene& scene, const Ray3f& shadow_ray, std::uint64_t& rays);

}  // namespace raytracer
