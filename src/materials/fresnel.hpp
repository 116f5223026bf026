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

/// The exact reflectance of a metal (Born and Wolf, section 14.2), mean of both polarisations, its index
/// relative to the medium before it.
inline Color3f fresnel_conductor(const ConductorIndex& index, float cosine) {
  const float cosine2 = cosine * cosine, sine2 = 1 - cosine2;
  Color3f result;
  for (int c = 0; c < 3; ++c) {
    const float eta2 = index.eta[c] * index.eta[c], k2 = index.k[c] * index.k[c];
    // a and b: real and imaginary part of the refracted direction's normal component, times the index.
    const float difference = eta2 - k2 - sine2;
    const float length = std::sqrt(difference * difference + 4 * eta2 * k2);
    const float a = std::sqrt(std::max(0.0F, 0.5F * (length + difference)));
    const float s_sum = length + cosine2, s_cross = 2 * a * cosine;
    const float s = (s_sum - s_cross) / (s_sum + s_cross);
    const float p_sum = cosine2 * length + sine2 * sine2, p_cross = s_cross * sine2;
    const float p = s * (p_sum - p_cross) / (p_sum + p_cross);
    result[c] = std::min(1.0F, 0.5F * (s + p));
  }
  return result;
}

/// The mean of fresnel_conductor over diffuse light: Gauss and Jacobi's three points for the weight 2 mu.
inline Color3f fresnel_conductor_mean(const ConductorIndex& index) {
  return 0.13965396F * fresnel_conductor(index, 0.21234054F) +
         0.45848221F * fresnel_conductor(index, 0.59053314F) +
         0.40186383F * fresnel_conductor(index, 0.91141204F);
}

}  // namespace raytracer
