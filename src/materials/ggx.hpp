// Rough surfaces as mirrors or panes of microscopic size: the distribution of Trowbridge and Reitz ("GGX"),
// Smith's masking, and the sampling of the facets that can be seen. Space: z is the surface's normal, x and y
// the axes of its anisotropy. Directions point away from the surface.
#pragma once

#include <algorithm>
#include <cmath>

#include "raytracer/vector3f.hpp"
#include "sampling/hemisphere.hpp"

namespace raytracer {

class Ggx {
 public:
  /// A direction above the surface that facets are looked at from, and what only depends on it.
  struct Eye {
    Vector3f o;
    float stretch;  ///< see stretch()
    float bound;    ///< see sample_bounded()
  };

  Ggx() = default;
  /// Roughness along x and y, > 0.
  Ggx(float alpha_x, float alpha_y)
      : x_(alpha_x),
        y_(alpha_y),
        inverse_x_(1 / alpha_x),
        inverse_y_(1 / alpha_y),
        greatest_density_(0.3183098861837907F * inverse_x_ * inverse_y_) {}

  Eye eye(const Vector3f& o) const { return {o, stretch(o), bound(o)}; }

  /// The density of facets with unit normal h, h.z >= 0: the integral of density * h.z is 1 (Heitz 2014,
  /// "Understanding the Masking-Shadowing Function", equation 85).
  float density(const Vector3f& h) const {
    const float x = h.x * inverse_x_, y = h.y * inverse_y_;
    const float length2 = x * x + y * y + h.z * h.z;
    return greatest_density_ / (length2 * length2);
  }

  /// |(alpha_x v.x, alpha_y v.y, v.z)|. Smith's Lambda is (stretch(v) / |v.z| - 1) / 2 (Heitz 2014,
  /// equations 86 and 87), so all of masking follows from it.
  float stretch(const Vector3f& v) const {
    const float x = x_ * v.x, y = y_ * v.y;
    return std::sqrt(x * x + y * y + v.z * v.z);
  }

  /// G1: the share of facets turned towards v that v sees.
  float visible(const Vector3f& v) const { return visible(v, stretch(v)); }
  float visible(const Eye& eye) const { return visible(eye.o, eye.stretch); }

  /// G2 / (4 cos_o cos_i) with G2 = 1 / (1 + Lambda(o) + Lambda(i)), both on one side: heights of masking
  /// and shadowing are correlated (Heitz 2014, equation 99).
  float joint_visibility(const Eye& eye, const Vector3f& i) const {
    return 0.5F / (i.z * eye.stretch + eye.o.z * stretch(i));
  }

  /// A facet's normal with density G1(o) max(0, o.h) density(h) / o.z, o.z > 0 (Heitz 2018, "Sampling the
  /// GGX Distribution of Visible Normals", by the spherical caps of Dupuy and Benyoub 2023, listing 3).
  Vector3f sample_visible(const Eye& eye, const Vector2f& u) const { return sample_cap(eye, 1, u); }
  float visible_pdf(const Eye& eye, float cosine_to_h, float density_of_h) const {
    return 4 * cosine_to_h * visible_reflection_pdf(eye, density_of_h);
  }
  /// The density per steradian of the reflection of o at such a normal.
  float visible_reflection_pdf(const Eye& eye, float density_of_h) const {
    return density_of_h / (2 * (eye.o.z + eye.stretch));
  }

  /// Likewise, but only the part of the cap whose reflections of o can be above the surface (Eto and
  /// Tokuyoshi 2023, "Bounded VNDF Sampling for Smith-GGX Reflections", listings 1 and 2).
  Vector3f sample_bounded(const Eye& eye, const Vector2f& u) const { return sample_cap(eye, eye.bound, u); }
  float bounded_reflection_pdf(const Eye& eye, float density_of_h) const {
    return density_of_h / (2 * (eye.bound * eye.o.z + eye.stretch));
  }

 private:
  static float visible(const Vector3f& v, float stretch_of_v) {
    const float cosine = std::abs(v.z);
    return 2 * cosine / (cosine + stretch_of_v);
  }

  float bound(const Vector3f& o) const {
    const float a = std::min(1.0F, std::min(x_, y_)), a2 = a * a;
    const float s = 1 + std::sqrt(o.x * o.x + o.y * o.y), s2 = s * s;
    return (1 - a2) * s2 / (s2 + a2 * o.z * o.z);
  }

  Vector3f sample_cap(const Eye& eye, float share, const Vector2f& u) const {
    const float scale = 1 / eye.stretch;
    const Vector3f round(x_ * eye.o.x * scale, y_ * eye.o.y * scale, eye.o.z * scale);
    // The height of a point of the cap, from -share * round.z to 1; without cancellation near the top.
    const float below_top = u.y * (1 + share * round.z);
    const float sine = std::sqrt(std::max(0.0F, below_top * (2 - below_top)));
    const Vector2f around = cos_sin_of_turn(u.x);
    const Vector3f h = round + Vector3f(sine * around.x, sine * around.y, 1 - below_top);
    return glm::normalize(Vector3f(x_ * h.x, y_ * h.y, std::max(1e-7F, h.z)));
  }

  float x_, y_, inverse_x_, inverse_y_, greatest_density_;
};

}  // namespace raytracer
