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
/// cosines depends: near grazing the albedo follows cosine / alpha, and from there on it changes slowly.
struct AlphaCell : AxisCell {
  float alpha;
  AxisCell at_cosine(float cosine, int count) const {
    return at(place_of(cosine, alpha) * static_cast<float>(count - 1), count);
  }
  /// The cosine of a node of that axis.
  static float cosine_of(int node, int count, float alpha) {
    const float place = static_cast<float>(node) / static_cast<float>(count - 1);
    float low = 0, high = 1;
    for (int i = 0; i < 30; ++i) {
      const float middle = 0.5F * (low + high);
      (place_of(middle, alpha) < place ? low : high) = middle;
    }
    return std::clamp(high, 1e-6F, 1.0F);
  }

 private:
  static float place_of(float cosine, float alpha) {
    const float k = 2 * alpha;
    constexpr float kEven = 0.4F;  // the share of an even axis
    return (1 - kEven) * std::sqrt(cosine * (1 + k) / (cosine + k)) + kEven * cosine;
  }
};

/// The alpha of the first row of tables; less of it is a mirror to them.
inline constexpr float kLeastTabledAlpha = 1e-4F;

/// Rows of alpha, each with its cosines side by side.
template <int Rows, int Columns = Rows>
struct AlbedoGrid {
  std::array<float, Rows * Columns> values{};

  static float alpha_of(int row) {
    constexpr float kStep = 1.0F / (Rows - 1);
    const float roughness = static_cast<float>(row) * kStep;
    return std::max(kLeastTabledAlpha, roughness * roughness);
  }
  static AlphaCell cell_of(float alpha) {
    const int row = std::clamp(static_cast<int>(std::sqrt(alpha) * (Rows - 1)), 0, Rows - 2);
    const float low = alpha_of(row), high = alpha_of(row + 1);
    return {{row, std::clamp((alpha - low) / (high - low), 0.0F, 1.0F)}, std::max(kLeastTabledAlpha, alpha)};
  }

  float at(const AlphaCell& row, const AxisCell& column) const {
    const float* p = values.data() + row.node * Columns + column.node;
    const float low = p[0] + column.weight * (p[1] - p[0]);
    const float high = p[Columns] + column.weight * (p[Columns + 1] - p[Columns]);
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
  /// From inside, where total reflection begins changes the albedo fast: hence more cosines.
  static constexpr int kRows = 16, kColumns = 32, kEtas = 29;
  using Grid = AlbedoGrid<kRows, kColumns>;

  static const GlassTable& get();

  /// eta: the index behind over the one before. Beyond the tables, 1/4.4 .. 4.4, the last counts.
  static AxisCell eta_cell(float eta);
  static float eta_of(int node);
  /// `specular`: the share of Fresnel's reflection that is there, the rest is refracted.
  float albedo(const AlphaCell& alpha, const AxisCell& eta, float specular, float cosine) const;
  float mean(const AlphaCell& alpha, const AxisCell& eta, float specular) const;

 private:
  using Grids = std::array<Grid, kEtas>;
  using Means = std::array<std::array<float, kRows>, kEtas>;

  GlassTable();
  void fill(int row, int column);

  // Everything is linear in specular: of 1 and of 0 (then only total reflection is left).
  Grids with_reflection_, without_;
  Means mean_with_{}, mean_without_{};
};

}  // namespace raytracer
