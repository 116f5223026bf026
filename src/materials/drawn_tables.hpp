// How much light rough surfaces with two roughnesses return in all. No single roughness stands for two: what
// is seen depends on the one along the direction, what it loses on the way out on the one across. So what the
// two do differently from one in their place, their root mean square, is tabulated over both roughnesses, the
// cosine and the turn about the normal; it is smooth, and few nodes do. With it the compensation of Kulla and
// Conty 2017 ("Revisiting Physically Based Shading at Imageworks") holds for two roughnesses as for one.
#pragma once

#include <array>

#include "materials/albedo_tables.hpp"
#include "raytracer/vector3f.hpp"

namespace raytracer {

/// A pair of roughnesses among the tables.
struct DrawnCell {
  AxisCell wide, ratio;  ///< the greater alpha, and the other over it
  float alpha_x, alpha_y;
  AlphaCell reflection, glass;  ///< their root mean square in the tables of one roughness

  DrawnCell() = default;
  DrawnCell(float alpha_x, float alpha_y);
};

/// Numbers over both roughnesses, cosine and turn.
class DrawnGrid {
 public:
  static constexpr int kWide = 8, kRatios = 6, kCosines = 12, kTurns = 7;

  /// A pair of roughnesses and a direction.
  struct Place {
    AxisCell wide, ratio, cosine, turn;
  };
  /// `v`: unit length, z along the normal; on either side.
  static Place place(const DrawnCell& cell, const Vector3f& v);
  float at(const Place& place) const;

  /// Calls use(index, the alphas along x (the greater one) and y, direction) for each node.
  template <typename Use>
  static void for_nodes(const Use& use);

  std::array<float, static_cast<std::size_t>(kWide) * kRatios * kCosines * kTurns> values{};
};

/// Their means over diffuse light.
class DrawnMeans {
 public:
  DrawnMeans() = default;
  explicit DrawnMeans(const DrawnGrid& grid);
  /// Of function(cell, direction) for every pair of roughnesses.
  template <typename Function>
  static DrawnMeans of(const Function& function);
  float at(const DrawnCell& cell) const;

 private:
  std::array<std::array<float, DrawnGrid::kRatios>, DrawnGrid::kWide> values_{};
};

/// As ReflectionTable, for a pair of roughnesses.
class DrawnReflectionTable {
 public:
  static const DrawnReflectionTable& get();

  float mirror(const DrawnCell& cell, const Vector3f& v) const;
  float mirror_mean(const DrawnCell& cell) const;
  float boundary(const DrawnCell& cell, const AxisCell& eta_cell, float eta, const Vector3f& v) const;
  float boundary_mean(const DrawnCell& cell, const AxisCell& eta_cell) const;

 private:
  // Every third eta of ReflectionTable.
  static constexpr int kEtaStep = 3, kEtas = (ReflectionTable::kEtas - 1) / kEtaStep + 1;

  DrawnReflectionTable();
  static AxisCell coarse(const AxisCell& eta_cell);
  float mirror(const DrawnCell& cell, const DrawnGrid::Place& place, float cosine) const;

  DrawnGrid mirror_;
  DrawnMeans mirror_mean_;
  // Of the mean of Fresnel's reflectance over the facets that act, less that with the roughness along the
  // direction on all sides.
  std::array<DrawnGrid, kEtas> fresnel_;
  std::array<DrawnMeans, kEtas> boundary_mean_;
};

/// As GlassTable. What difference the strength of the reflection makes is taken from one roughness.
class DrawnGlassTable {
 public:
  static const DrawnGlassTable& get();

  float albedo(const DrawnCell& cell, const AxisCell& eta, float specular, const Vector3f& v) const;
  float mean(const DrawnCell& cell, const AxisCell& eta, float specular) const;

 private:
  // Every fourth eta of GlassTable, the middle, 1, among them.
  static constexpr int kEtaStep = 4, kFirstEta = (GlassTable::kEtas / 2) % kEtaStep;
  static constexpr int kEtas = (GlassTable::kEtas - 1 - kFirstEta) / kEtaStep + 1;

  DrawnGlassTable();
  static AxisCell coarse(const AxisCell& eta);

  std::array<DrawnGrid, kEtas> grids_;
  std::array<DrawnMeans, kEtas> means_;
};

}  // namespace raytracer
