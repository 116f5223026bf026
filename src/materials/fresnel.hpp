// How much light a perfectly smooth boundary reflects. All cosines are to the normal, 0..1.
#pragma once

#include <algorithm>
#include <cmath>

#include "raytracer/material.hpp"

namespace raytracer {

/// What a boundary between two clear media does with light from one side.
struct Boundary {
  float reflectance = 1;     ///< unpolarised; 1 of total reflection
  float cosine_through = 0;  ///< of the refracted direction, on the other side; 0 if none
  bool is_total = false;     ///< all is reflected
};

/// `eta`: the index behind the boundary over that before it. Fresnel's equations, mean of both polarisations.
inline Boundary fresnel_dielectric(float cosine, float eta) {
  const float sine2_through = (1 - cosine * cosine) / (eta * eta);
  if (sine2_through >= 1) return {1, 0, true};
  const float through = std::sqrt(1 - sine2_through);
  const float s = (cosine - eta * through) / (cosine + eta * through);
  const float p = (eta * cosine - through) / (eta * cosine + through);
  return {std::min(1.0F, 0.5F * (s * s + p * p)), through, false};
}

/// The mean of fresnel_dielectric over diffuse light: the integral of 2 F(mu) mu. Kulla and Conty 2017,
/// "Revisiting Physically Based Shading at Imageworks", their fit for eta >= 1, within 6e-3; below 1 from the
/// law that as much diffuse light goes through either way, eta^2 (1 - F(eta)) = 1 - F(1 / eta).
inline float fresnel_dielectric_mean(float eta) {
  if (eta >= 1) return (eta - 1) / (4.08567F + 1.00071F * eta);
  const float inverse = 1 / eta;
  return 1 - (1 - (inverse - 1) / (4.08567F + 1.00071F * inverse)) * (eta * eta);
}

/// Schlick 1994, equation 24: f0 at the normal, 1 at grazing.
inline Color3f fresnel_schlick(const Color3f& f0, float cosine) {
  const float rest = 1 - cosine, rest2 = rest * rest;
  return f0 + (Color3f(1) - f0) * (rest2 * rest2 * rest);
}

/// The mean of fresnel_schlick over diffuse light, exact.
inline Color3f fresnel_schlick_mean(const Color3f& f0) { return f0 + (Color3f(1) - f0) * (1.0F / 21); }

/// A metal's index relative to the medium before it, squared, as its reflectance takes it. Four channels, the
/// last idle: so many go at once.
struct ConductorSquares {
  alignas(16) float eta2[4], k2[4];

  ConductorSquares() = default;
  /// `outside`: the index of the medium before the metal, where `index` is relative to vacuum. Not explicit:
  /// it is the same thing in another form.
  ConductorSquares(const ConductorIndex& index, float outside = 1) {
    for (int c = 0; c < 3; ++c) {
      // Bounds that no metal reaches; also what is not a number ends up at one of them.
      const float eta = std::max(1e-3F, std::min(1e3F, index.eta[c] / outside));
      const float k = std::max(0.0F, std::min(1e3F, index.k[c] / outside));
      eta2[c] = eta * eta, k2[c] = k * k;
    }
    eta2[3] = k2[3] = 1;
  }
};

/// The exact reflectance of a metal (Born and Wolf, section 14.2), mean of both polarisations.
inline Color3f fresnel_conductor(const ConductorSquares& index, float cosine) {
  const float cosine2 = cosine * cosine, sine2 = 1 - cosine2;
  alignas(16) float result[4];
  for (int c = 0; c < 4; ++c) {
    // length and a: absolute value and real part of the refracted direction's normal component, times the
    // index; the former squared.
    const float difference = index.eta2[c] - index.k2[c] - sine2;
    const float length = std::sqrt(difference * difference + 4 * index.eta2[c] * index.k2[c]);
    const float a = std::sqrt(std::max(0.0F, 0.5F * (length + difference)));
    const float s_sum = length + cosine2, s_cross = 2 * a * cosine;
    const float p_sum = cosine2 * length + sine2 * sine2, p_cross = s_cross * sine2;
    // s and p = s (p_sum - p_cross) / (p_sum + p_cross), and their mean over one denominator.
    // Where the metal is hardly there, the difference rounds to less than 0.
    const float s_difference = std::max(0.0F, s_sum - s_cross);
    result[c] = std::min(1.0F, s_difference * p_sum / ((s_sum + s_cross) * (p_sum + p_cross)));
  }
  return {result[0], result[1], result[2]};
}

/// The mean of fresnel_conductor over diffuse light: Gauss and Jacobi's three points for the weight 2 mu.
inline Color3f fresnel_conductor_mean(const ConductorSquares& index) {
  return 0.13965396F * fresnel_conductor(index, 0.21234054F) +
         0.45848221F * fresnel_conductor(index, 0.59053314F) +
         0.40186383F * fresnel_conductor(index, 0.91141204F);
}

/// A thin pane: light that goes to and fro between its two faces added up, R + (1-R)^2 R + ...
inline float both_faces(float reflectance) { return 2 * reflectance / (1 + reflectance); }

}  // namespace raytracer
