#include "materials/drawn_tables.hpp"

#include <algorithm>
#include <cmath>

#include "materials/facet_quadrature.hpp"

namespace raytracer {

namespace {

constexpr int kMeanCosines = 24, kMeanTurns = 12;  // points of the quadrature over diffuse light

using Quadrature = FacetQuadrature<16, 16>;
constexpr Quadrature kFacets;

float position(const AxisCell& cell) { return static_cast<float>(cell.node) + cell.weight; }

float root_mean_square(float a, float b) { return std::sqrt(0.5F * (a * a + b * b)); }

// The greater alpha even in its root, as roughness is; the other over it likewise.
float wide_of(int node) {
  const float root = static_cast<float>(node) / (DrawnGrid::kWide - 1);
  return std::max(kLeastTabledAlpha, root * root);
}
float narrow_of(int node, float wide) {
  const float root = static_cast<float>(node) / (DrawnGrid::kRatios - 1);
  return std::max(kLeastTabledAlpha, wide * root * root);
}

/// The roughness along the direction, which is what it sees.
float along(const DrawnCell& cell, const Vector3f& v) {
  const float x2 = v.x * v.x, y2 = v.y * v.y, sum = x2 + y2;
  if (!(sum > 0)) return root_mean_square(cell.alpha_x, cell.alpha_y);
  return std::sqrt((cell.alpha_x * cell.alpha_x * x2 + cell.alpha_y * cell.alpha_y * y2) / sum);
}

float cosine_of(const Vector3f& v) { return std::min(1.0F, std::abs(v.z)); }

/// The mean of Fresnel's reflectance over the facets of one roughness.
float fresnel_of_facets(const AlphaCell& alpha, const AxisCell& eta_cell, float eta, float cosine) {
  const ReflectionTable& table = ReflectionTable::get();
  return table.boundary(alpha, eta_cell, eta, cosine) / table.mirror(alpha, cosine);
}

}  // namespace

// --- the grid
// ---------------------------------------------------------------------------------------------------

DrawnCell::DrawnCell(float x, float y) : alpha_x(x), alpha_y(y) {
  const float greater = std::max(x, y), other = std::min(x, y);
  wide = AxisCell::at(std::sqrt(greater) * (DrawnGrid::kWide - 1), DrawnGrid::kWide);
  ratio = AxisCell::at(std::sqrt(other / greater) * (DrawnGrid::kRatios - 1), DrawnGrid::kRatios);
  const float even = root_mean_square(x, y);
  reflection = ReflectionTable::Grid::cell_of(even);
  glass = GlassTable::Grid::cell_of(even);
}

// Turns even in the component along the greater roughness: with a small other one that is what the roughness
// along the direction follows.
DrawnGrid::Place DrawnGrid::place(const DrawnCell& cell, const Vector3f& v) {
  const float component = std::abs(cell.alpha_x >= cell.alpha_y ? v.x : v.y);
  const float sine = std::sqrt(v.x * v.x + v.y * v.y);
  const float turn = sine > 0 ? std::min(1.0F, component / sine) : 0.0F;
  return {cell.wide, cell.ratio, cell.reflection.at_cosine(cosine_of(v), kCosines),
          AxisCell::at(turn * (kTurns - 1), kTurns)};
}

float DrawnGrid::at(const Place& place) const {
  const auto over_turns = [&](int row) {
    const float* p = values.data() + (row * kCosines + place.cosine.node) * kTurns + place.turn.node;
    return interpolated(interpolated(p[0], p[1], place.turn.weight),
                        interpolated(p[kTurns], p[kTurns + 1], place.turn.weight), place.cosine.weight);
  };
  const int row = place.wide.node * kRatios + place.ratio.node;
  return interpolated(
      interpolated(over_turns(row), over_turns(row + 1), place.ratio.weight),
      interpolated(over_turns(row + kRatios), over_turns(row + kRatios + 1), place.ratio.weight),
      place.wide.weight);
}

template <typename Use>
void DrawnGrid::for_nodes(const Use& use) {
  std::size_t index = 0;
  for (int w = 0; w < kWide; ++w) {
    for (int r = 0; r < kRatios; ++r) {
      const float wide = wide_of(w), narrow = narrow_of(r, wide);
      for (int c = 0; c < kCosines; ++c) {
        const float cosine = AlphaCell::cosine_of(c, kCosines, root_mean_square(wide, narrow));
        const float sine = std::sqrt(1 - cosine * cosine);
        for (int t = 0; t < kTurns; ++t) {
          const float x = static_cast<float>(t) / (kTurns - 1), y = std::sqrt(1 - x * x);
          use(index++, wide, narrow, Vector3f(sine * x, sine * y, cosine));
        }
      }
    }
  }
}

template <typename Function>
DrawnMeans DrawnMeans::of(const Function& function) {
  DrawnMeans means;
  for (int w = 0; w < DrawnGrid::kWide; ++w) {
    for (int r = 0; r < DrawnGrid::kRatios; ++r) {
      const float wide = wide_of(w);
      const DrawnCell cell(wide, narrow_of(r, wide));
      float sum = 0;
      for (int c = 0; c < kMeanCosines; ++c) {
        const float cosine = std::sqrt((static_cast<float>(c) + 0.5F) / kMeanCosines);
        const float sine = std::sqrt(1 - cosine * cosine);
        for (int t = 0; t < kMeanTurns; ++t) {
          const float angle = 1.5707963F * (static_cast<float>(t) + 0.5F) / kMeanTurns;
          sum += function(cell, Vector3f(sine * std::cos(angle), sine * std::sin(angle), cosine));
        }
      }
      means.values_[static_cast<std::size_t>(w)][static_cast<std::size_t>(r)] =
          sum / (kMeanCosines * kMeanTurns);
    }
  }
  return means;
}

DrawnMeans::DrawnMeans(const DrawnGrid& grid)
    : DrawnMeans(
          of([&](const DrawnCell& cell, const Vector3f& v) { return grid.at(DrawnGrid::place(cell, v)); })) {}

float DrawnMeans::at(const DrawnCell& cell) const {
  const auto over_ratios = [&](int wide) {
    const auto& row = values_[static_cast<std::size_t>(wide)];
    const auto node = static_cast<std::size_t>(cell.ratio.node);
    return interpolated(row[node], row[node + 1], cell.ratio.weight);
  };
  return interpolated(over_ratios(cell.wide.node), over_ratios(cell.wide.node + 1), cell.wide.weight);
}

// --- reflection
// ---------------------------------------------------------------------------------------------

const DrawnReflectionTable& DrawnReflectionTable::get() {
  static const DrawnReflectionTable table;
  return table;
}

DrawnReflectionTable::DrawnReflectionTable() {
  const ReflectionTable& even = ReflectionTable::get();
  std::array<float, kEtas> etas{};
  for (int e = 0; e < kEtas; ++e) etas[static_cast<std::size_t>(e)] = ReflectionTable::eta_of(e * kEtaStep);
  DrawnGrid::for_nodes([&](std::size_t index, float wide, float narrow, const Vector3f& o) {
    float all = 0;
    std::array<float, kEtas> reflected{};
    kFacets.for_reflections(Ggx(wide, narrow), o, [&](float c, float share, const Vector3f&) {
      all += share;
      for (std::size_t e = 0; e < kEtas; ++e) {
        reflected[e] += share * fresnel_dielectric(c, etas[e]).reflectance;
      }
    });
    const DrawnCell cell(wide, narrow);
    mirror_.values[index] = std::min(1.0F, all) - even.mirror(cell.reflection, o.z);
    const AlphaCell alpha = ReflectionTable::Grid::cell_of(along(cell, o));
    for (std::size_t e = 0; e < kEtas; ++e) {
      fresnel_[e].values[index] =
          reflected[e] / all - fresnel_of_facets(alpha, ReflectionTable::eta_cell(etas[e]), etas[e], o.z);
    }
  });
  mirror_mean_ = DrawnMeans(mirror_);
  for (std::size_t e = 0; e < kEtas; ++e) {
    const AxisCell eta_cell = ReflectionTable::eta_cell(etas[e]);
    boundary_mean_[e] = DrawnMeans::of([&](const DrawnCell& cell, const Vector3f& v) {
      return boundary(cell, eta_cell, etas[e], v) - even.boundary(cell.reflection, eta_cell, etas[e], v.z);
    });
  }
}

AxisCell DrawnReflectionTable::coarse(const AxisCell& eta_cell) {
  return AxisCell::at(position(eta_cell) / kEtaStep, kEtas);
}

float DrawnReflectionTable::mirror(const DrawnCell& cell, const DrawnGrid::Place& place, float cosine) const {
  return std::clamp(ReflectionTable::get().mirror(cell.reflection, cosine) + mirror_.at(place), 0.0F, 1.0F);
}

float DrawnReflectionTable::mirror(const DrawnCell& cell, const Vector3f& v) const {
  return mirror(cell, DrawnGrid::place(cell, v), cosine_of(v));
}

float DrawnReflectionTable::mirror_mean(const DrawnCell& cell) const {
  return ReflectionTable::get().mirror_mean(cell.reflection) + mirror_mean_.at(cell);
}

float DrawnReflectionTable::boundary(const DrawnCell& cell, const AxisCell& eta_cell, float eta,
                                     const Vector3f& v) const {
  const DrawnGrid::Place place = DrawnGrid::place(cell, v);
  const float cosine = cosine_of(v);
  const AxisCell slice = coarse(eta_cell);
  const auto node = static_cast<std::size_t>(slice.node);
  const AlphaCell alpha = ReflectionTable::Grid::cell_of(along(cell, v));
  const float fresnel = fresnel_of_facets(alpha, eta_cell, eta, cosine) +
                        interpolated(fresnel_[node].at(place), fresnel_[node + 1].at(place), slice.weight);
  return std::clamp(fresnel, 0.0F, 1.0F) * mirror(cell, place, cosine);
}

float DrawnReflectionTable::boundary_mean(const DrawnCell& cell, const AxisCell& eta_cell) const {
  const AxisCell slice = coarse(eta_cell);
  const auto node = static_cast<std::size_t>(slice.node);
  return ReflectionTable::get().boundary_mean(cell.reflection, eta_cell) +
         interpolated(boundary_mean_[node].at(cell), boundary_mean_[node + 1].at(cell), slice.weight);
}

// --- glass
// --------------------------------------------------------------------------------------------------

const DrawnGlassTable& DrawnGlassTable::get() {
  static const DrawnGlassTable table;
  return table;
}

DrawnGlassTable::DrawnGlassTable() {
  const GlassTable& even = GlassTable::get();
  Quadrature::Facets facets;
  DrawnGrid::for_nodes([&](std::size_t index, float wide, float narrow, const Vector3f& o) {
    const Ggx ggx(wide, narrow);
    const AlphaCell alpha = DrawnCell(wide, narrow).glass;
    const std::size_t count = kFacets.find_facets(ggx, o, facets);
    for (std::size_t e = 0; e < kEtas; ++e) {
      const float eta = GlassTable::eta_of(static_cast<int>(e) * kEtaStep + kFirstEta);
      float sum = 0;
      for (std::size_t k = 0; k < count; ++k) sum += Quadrature::glass_shares(ggx, o, facets[k], eta).x;
      grids_[e].values[index] = std::min(1.0F, sum) - even.albedo(alpha, GlassTable::eta_cell(eta), 1, o.z);
    }
  });
  for (std::size_t e = 0; e < kEtas; ++e) means_[e] = DrawnMeans(grids_[e]);
}

AxisCell DrawnGlassTable::coarse(const AxisCell& eta) {
  return AxisCell::at(std::max(0.0F, position(eta) - kFirstEta) / kEtaStep, kEtas);
}

float DrawnGlassTable::albedo(const DrawnCell& cell, const AxisCell& eta, float specular,
                              const Vector3f& v) const {
  const DrawnGrid::Place place = DrawnGrid::place(cell, v);
  const AxisCell slice = coarse(eta);
  const auto node = static_cast<std::size_t>(slice.node);
  const float difference = interpolated(grids_[node].at(place), grids_[node + 1].at(place), slice.weight);
  return std::clamp(GlassTable::get().albedo(cell.glass, eta, specular, cosine_of(v)) + difference, 0.0F,
                    1.0F);
}

float DrawnGlassTable::mean(const DrawnCell& cell, const AxisCell& eta, float specular) const {
  const AxisCell slice = coarse(eta);
  const auto node = static_cast<std::size_t>(slice.node);
  return GlassTable::get().mean(cell.glass, eta, specular) +
         interpolated(means_[node].at(cell), means_[node + 1].at(cell), slice.weight);
}

}  // namespace raytracer
