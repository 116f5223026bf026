// Materials and frames that the tests of the Bsdf have in common.
#pragma once

#include <random>
#include <string>
#include <vector>

#include "materials/bsdf.hpp"

namespace bsdf_cases {

using raytracer::Bsdf;
using raytracer::BsdfFrame;
using raytracer::BsdfSample;
using raytracer::Color3f;
using raytracer::ConductorIndex;
using raytracer::Material;
using raytracer::Vector2f;
using raytracer::Vector3f;

inline const ConductorIndex kGold{{0.143F, 0.375F, 1.442F}, {3.983F, 2.386F, 1.603F}};

/// A frame in air with the normal up; `inside`: the index of what is below.
inline BsdfFrame frame_over(float inside = 1) {
  BsdfFrame frame;
  frame.geometric_normal = frame.normal = {0, 0, 1};
  frame.tangent = {1, 0, 0};
  frame.ior_inside = inside;
  return frame;
}

inline Vector3f toward(float cosine, float turn = 0.1F) {
  const float sine = std::sqrt(std::max(0.0F, 1 - cosine * cosine)), angle = 6.2831853F * turn;
  return glm::normalize(Vector3f(sine * std::cos(angle), sine * std::sin(angle), cosine));
}

struct Random {
  std::mt19937 bits{1};
  float unit() { return float(bits() >> 8U) * 0x1p-24F; }
  Vector2f square() {
    const float x = unit();
    return {x, unit()};
  }
  Vector3f direction() {
    const float z = 2 * unit() - 1;
    return toward(z, unit());
  }
};

struct Case {
  std::string name;
  Material material;
  float inside = 1;  ///< index below the surface
};

inline Case metal(float roughness, float anisotropy = 0, bool compensation = true) {
  Material m;
  m.metallic = 1;
  m.roughness = roughness;
  m.anisotropy = anisotropy;
  m.color = {0.9F, 0.5F, 0.2F};
  m.energy_compensation = compensation;
  return {"metal", m};
}

inline Case gold(float roughness) {
  Case c = metal(roughness);
  c.material.color = Color3f(1);
  c.material.conductor = kGold;
  c.name = "gold";
  return c;
}

inline Case glass(float roughness, float ior = 1.5F) {
  Material m;
  m.transmission = 1;
  m.roughness = roughness;
  m.ior = ior;
  m.color = Color3f(1);
  return {"glass", m, ior};
}

inline Case thin_glass(float roughness) {
  Case c = glass(roughness);
  c.material.thin = true;
  c.material.color = {0.5F, 0.9F, 1};
  c.inside = 1;
  c.name = "thin glass";
  return c;
}

inline Case plastic(float roughness, float ior = 1.5F) {
  Material m;
  m.has_layer = true;
  m.roughness = roughness;
  m.ior = ior;
  m.color = {0.2F, 0.5F, 0.8F};
  return {"plastic", m};
}

inline Case coated(Case c, float coat, float coat_roughness) {
  c.material.coat = coat;
  c.material.coat_roughness = coat_roughness;
  c.name = "coated " + c.name;
  return c;
}

/// A bit of everything.
inline Case mix(float roughness) {
  Case c = plastic(roughness);
  c.material.shininess = 0.2F;
  c.material.metallic = 0.3F;
  c.material.transmission = 0.4F;
  c.material.anisotropy = 0.5F;
  c.material.coat = 0.5F;
  c.material.coat_roughness = 0.3F;
  c.inside = 1.5F;
  c.name = "mix";
  return c;
}

inline std::string text(const Case& c) {
  return c.name + " of roughness " + std::to_string(c.material.roughness) + ", anisotropy " +
         std::to_string(c.material.anisotropy);
}

}  // namespace bsdf_cases
