// How much light rough surfaces return in all, with a single scattering between their facets: what is missing
// to 1 comes back by compensation, and what a layer returns does not reach the base below. Computed once,
// from the very functions of ggx.hpp and fresnel.hpp.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

namespace raytracer {

inline float interpolated(float low, float high, float weight) { return low + weight * (high - low); }

/// A place between two nodes of an axis.
struct AxisCell {
  int node;      ///< the lower of the two
  float weight;  ///< of the upper, 0..1

  /// The place `x`, counted in nodes, or the nearest of the axis.
  static AxisCell at(float x, int count) {
    const int node_below = std::clamp(static_cast<int>(x), 0, count - 2);
    return {node_below, std::clamp(x - static_cast<float>(node_below), 0.0F, 1.0F)};
  }
};

/// The alpha axis, a grid with nodes even in roughness. Also carries alpha itself, on which the axis of
/// cosines depends: near grazing the albedo follows cosine / alpha.
struct AlphaCell : AxisCell {
  float alpha;
  AxisCell at_cosine(float cosine, int count) const {
    const float k = 2 * alpha;
    return at(std::sqrt(cosine * (1 + k) / (cosine + k)) * static_cast<float>(count - 1), count);
  }
  /// The cosine of a node of that axis.
  static float cosine_of(int node, int count, float alpha) {
    const float k = 2 * alpha, x = static_cast<float>(node) / static_cast<float>(count - 1), x2 = x * x;
    return std::clamp(x2 * k / (1 + k - x2), 1e-6F, 1.0F);
  }
};

/// `Count` x `Count` numbers, rows of alpha with the cosines side by side.
template <int Count>
struct AlbedoGrid {
  std::array<float, Count * Count> values{};

  static float alpha_of(int row);
  static AlphaCell cell_of(float alpha);

  float at(const AlphaCell& row, const AxisCell& column) const {
    const float* p = values.data() + row.node * Count + column.node;
    const float low = p[0] + column.weight * (p[1] - p[0]);
    const float high = p[Count] + column.weight * (p[Count + 1] - p[Count]);
    return low + row.weight * (high - low);
  }
};

/// Rough mirrors, and the rough boundary above an opaque base.
class ReflectionTable {
 public:
  static constexpr int kCount = 24, kEtas = 16;
  using Grid = AlbedoGrid<kCount>;

  /// Made by the first call; any thread may call.
  static const ReflectionTable& get();

  /// Of a mirror that loses nothing: the integral of its value times cosine, 0..1.
  float mirror(const AlphaCell& alpha, float cosine) const {
    return mirror_.at(alpha, alpha.at_cosine(cosine, kCount));
  }
  /// Its mean over diffuse light.
  float mirror_mean(const AlphaCell& alpha) const;

  /// Where a boundary stands among the tables. Below the first, eta 1.02, the first counts: never too little
  /// is held for reflected.
  static AxisCell eta_cell(float eta);
  static float eta_of(int node);
  /// Of a boundary with Fresnel's reflectance, eta >= 1.
  float boundary(const AlphaCell& alpha, const AxisCell& eta_cell, float eta, float cosine) const;
  float boundary_mean(const AlphaCell& alpha, const AxisCell& eta_cell) const;

 private:
  ReflectionTable();
  void fill(int row, int column);
  void take_means();

  Grid mirror_;
  // The mean of Fresnel's reflectance over the facets that act, less that of a typical facet.
  std::array<Grid, kEtas> excess_;
  std::array<float, kCount> mirror_mean_{};
  std::array<std::array<float, kCount>, kEtas> boundary_mean_{};
};

/// Rough glass: reflected and refracted light together.
class GlassTable {
 public:
  static constexpr int kCount = 16, kEtas = 29;
  using Grid = AlbedoGrid<kCount>;

  static const GlassTable& get();

  /// eta: the index behind over the one before. Beyond the tables, 1/4.4 .. 4.4, the last counts.
  static AxisCell eta_cell(float eta);
  static float eta_of(int node);
  /// `specular`: the share of Fresnel's reflection that is there, the rest is refracted.
  float albedo(const AlphaCell& alpha, const AxisCell& eta, float specular, float cosine) const;
  float mean(const AlphaCell& alpha, const AxisCell& eta, float specular) const;

 private:
  using Grids = std::array<Grid, kEtas>;
  using Means = std::array<std::array<float, kCount>, kEtas>;

  GlassTable();
  void fill(int row, int column);

  // Everything is linear in specular: of 1 and of 0 (then only total reflection is left).
  Grids with_reflection_, without_;
  Means mean_with_{}, mean_without_{};
};

}  // namespace raytracer
