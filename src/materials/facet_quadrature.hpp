// Sums over the facets that a direction sees and over directions, for the albedo tables.
#pragma once

#include <array>
#include <cstddef>

#include "materials/fresnel.hpp"
#include "materials/ggx.hpp"

namespace raytracer {

/// The mean over diffuse light of a function of the cosine.
template <typename Function>
float diffuse_mean(const Function& function) {
  constexpr int kPoints = 64;
  float sum = 0;
  for (int i = 0; i < kPoints; ++i) {
    sum += function(std::sqrt((static_cast<float>(i) + 0.5F) / kPoints));
  }
  return sum / kPoints;
}

/// A rule of `Around` x `Up` points over facets. `Turns`: 1, or 1/2 where the other half is the mirror image.
template <int Around, int Up>
struct FacetQuadrature {
  float turns = 1;

  /// Calls use(u, weight) for points of the unit square, closer together towards u.y = 1, where facets turn
  /// away; the weights' sum is 1.
  template <typename Use>
  void for_points(const Use& use) const {
    for (int j = 0; j < Up; ++j) {
      const float rest = 1 - (static_cast<float>(j) + 0.5F) / Up;
      for (int i = 0; i < Around; ++i) {
        use(Vector2f((static_cast<float>(i) + 0.5F) * turns / Around, 1 - rest * rest),
            2 * rest / (Around * Up));
      }
    }
  }

  /// Calls use(cosine of o to the facet, share, direction) for the facets of a mirror that reflect o upwards;
  /// the shares' sum is the mirror's albedo.
  template <typename Use>
  void for_reflections(const Ggx& ggx, const Vector3f& o, const Use& use) const {
    const Ggx::Eye eye = ggx.eye(o);
    for_points([&](const Vector2f& u, float weight) {
      const Vector3f h = ggx.sample_bounded(eye, u);
      const float c = std::min(1.0F, glm::dot(o, h));
      const Vector3f i = 2 * c * h - o;
      if (!(i.z > 0)) return;
      const float density = ggx.density(h);
      const float value = density * i.z * ggx.joint_visibility(eye, i);
      use(c, weight * value / ggx.bounded_reflection_pdf(eye, density), i);
    });
  }

  /// What a facet does that a rough pane shows.
  struct Facet {
    Vector3f normal;
    float cosine;            ///< of the direction looked from
    float weight;            ///< the weights' sum is 1
    float reflection_shows;  ///< the share of reflected light that no other facet holds back
  };
  using Facets = std::array<Facet, static_cast<std::size_t>(Around) * Up>;

  std::size_t find_facets(const Ggx& ggx, const Vector3f& o, Facets& facets) const {
    const Ggx::Eye eye = ggx.eye(o);
    std::size_t count = 0;
    for_points([&](const Vector2f& u, float weight) {
      const Vector3f h = ggx.sample_visible(eye, u);
      const float c = std::min(1.0F, glm::dot(o, h));
      if (!(c > 0)) return;
      const Vector3f i = 2 * c * h - o;
      const float shows = i.z > 0 ? 4 * o.z * i.z * ggx.joint_visibility(eye, i) / ggx.visible(eye) : 0.0F;
      facets[count++] = {h, c, weight, shows};
    });
    return count;
  }

  /// What such a facet of glass reflects and refracts in all: with Fresnel's reflection, and without any but
  /// total reflection.
  static Vector2f glass_shares(const Ggx& ggx, const Vector3f& o, const Facet& facet, float eta) {
    const Boundary boundary = fresnel_dielectric(facet.cosine, eta);
    if (boundary.is_total) return Vector2f(facet.weight * facet.reflection_shows);
    const Vector3f through = (facet.cosine / eta - boundary.cosine_through) * facet.normal - o / eta;
    const float refraction_shows = through.z < 0 ? ggx.visible(through) : 0.0F;
    const float both = refraction_shows + boundary.reflectance * (facet.reflection_shows - refraction_shows);
    return facet.weight * Vector2f(both, refraction_shows);
  }
};

}  // namespace raytracer
