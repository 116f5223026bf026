// How light is followed.
#pragma once

#include <cstdint>

namespace raytracer {

/// How light is computed.
enum class Method : std::uint8_t {
  kClassic,  ///< the paper's recursion
  kPath,     ///< unbiased path tracing
};

/// What chooses the directions in which light is looked for, `path` alone.
enum class Sampling : std::uint8_t {
  kBoth,       ///< the lights and the materials, weighted against each other
  kLights,     ///< the lights alone, where they can be chosen
  kMaterials,  ///< the materials alone, where they can meet a light
};

/// More bounces than any path takes.
inline constexpr int kUnlimitedBounces = 1 << 30;

}  // namespace raytracer
