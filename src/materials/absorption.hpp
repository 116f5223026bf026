// What a medium takes from light on its way through.
#pragma once

#include <algorithm>
#include <cmath>

#include "raytracer/material.hpp"

namespace raytracer {

/// The share that is lost per scene unit, sigma of exp(-sigma distance) (Beer and Lambert), such that white
/// light is attenuation_color after attenuation_distance. A channel of 0 loses all but 1e-6 by then; whatever
/// the values, it is finite and not negative.
inline Color3f absorption_of(const MaterialValues& material) {
  constexpr float kGreatest = 1e30F;
  const float distance = material.attenuation_distance;
  Color3f sigma{0};
  if (!(distance < kInfinity)) return sigma;
  for (int c = 0; c < 3; ++c) {
    const float rest = material.attenuation_color[c];
    if (!(rest < 1)) continue;  // also what is not a number
    const float optical = -std::log(std::max(1e-6F, rest));
    sigma[c] = distance > 0 ? std::min(kGreatest, optical / distance) : kGreatest;
  }
  return sigma;
}

}  // namespace raytracer
