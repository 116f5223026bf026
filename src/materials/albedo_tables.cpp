#include "materials/albedo_tables.hpp"

#include "materials/facet_quadrature.hpp"

namespace raytracer {

namespace {

using Quadrature = FacetQuadrature<16, 32>;
constexpr Quadrature kFacets{0.5F};  // alike all around, so half of them

Vector3f direction_at(float cosine) { return {std::sqrt(std::max(0.0F, 1 - cosine * cosine)), 0, cosine}; }

/// A cosine that the facets acting at `cosine` typically have; only has to be near it, see excess_.
float typical_cosine(float cosine, float alpha) {
  const float alpha2 = alpha * alpha;
  return std::sqrt((cosine * cosine + alpha2) / (1 + alpha2));
}

// The eta axis of boundaries: even in sqrt((eta - 1) / (eta + 1)), since near 1 the reflectance at grazing
// depends on cosine / sqrt(eta^2 - 1). The last steps are half as wide: from 4 on, what little is not
// reflected is what counts. The last node is beyond any index that a material can have.
constexpr float kLeastEtaX = 0.0995037F, kEtaStep = 0.0750103F;  // of eta 1.02
constexpr int kWideEtaSteps = 9;                                 // to eta 4

// The eta axis of glass, even in the root of the logarithm, so closer together about 1, where total
// reflection begins.
constexpr float kGlassStep = 0.0873460F;  // twelve steps to 3

}  // namespace

// --- reflection
// ---------------------------------------------------------------------------------------------

const ReflectionTable& ReflectionTable::get() {
  static const ReflectionTable table;
  return table;
}

ReflectionTable::ReflectionTable() {
  for (int row = 0; row < kCount; ++row) {
    for (int column = 0; column < kCount; ++column) fill(row, column);
  }
  take_means();
}

void ReflectionTable::fill(int row, int column) {
  const float alpha = Grid::alpha_of(row), cosine = AlphaCell::cosine_of(column, kCount, alpha);
  const Ggx ggx(alpha, alpha);
  const Vector3f o = direction_at(cosine);
  std::array<float, std::tuple_size_v<Quadrature::Facets>> cosines{}, shares{};
  std::size_t count = 0;
  float all = 0;
  kFacets.for_reflections(ggx, o, [&](float c, float share, const Vector3f&) {
    cosines[count] = c;
    shares[count++] = share;
    all += share;
  });
  const auto index = static_cast<std::size_t>(row * kCount + column);
  mirror_.values[index] = std::min(1.0F, all);
  for (int e = 0; e < kEtas; ++e) {
    const float eta = eta_of(e);
    float reflected = 0;
    for (std::size_t k = 0; k < count; ++k) {
      reflected += shares[k] * fresnel_dielectric(cosines[k], eta).reflectance;
    }
    excess_[static_cast<std::size_t>(e)].values[index] =
        reflected / all - fresnel_dielectric(typical_cosine(cosine, alpha), eta).reflectance;
  }
}

void ReflectionTable::take_means() {
  for (int row = 0; row < kCount; ++row) {
    const auto r = static_cast<std::size_t>(row);
    const AlphaCell cell = Grid::cell_of(Grid::alpha_of(row));
    mirror_mean_[r] = diffuse_mean([&](float cosine) { return mirror(cell, cosine); });
    for (int e = 0; e < kEtas; ++e) {
      const float eta = eta_of(e);
      boundary_mean_[static_cast<std::size_t>(e)][r] =
          diffuse_mean([&](float cosine) { return boundary(cell, eta_cell(eta), eta, cosine); });
    }
  }
}

float ReflectionTable::mirror_mean(const AlphaCell& alpha) const {
  const auto row = static_cast<std::size_t>(alpha.node);
  return interpolated(mirror_mean_[row], mirror_mean_[row + 1], alpha.weight);
}

float ReflectionTable::eta_of(int node) {
  const int narrow_steps = std::max(0, node - kWideEtaSteps);
  const float x =
      kLeastEtaX + kEtaStep * (static_cast<float>(node) - 0.5F * static_cast<float>(narrow_steps));
  return (1 + x * x) / (1 - x * x);
}

AxisCell ReflectionTable::eta_cell(float eta) {
  const float x = std::sqrt(std::max(0.0F, eta - 1) / (eta + 1));
  const float steps = (x - kLeastEtaX) / kEtaStep;
  return AxisCell::at(steps + std::max(0.0F, steps - kWideEtaSteps), kEtas);
}

float ReflectionTable::boundary(const AlphaCell& alpha, const AxisCell& eta_cell, float eta,
                                float cosine) const {
  const AxisCell column = alpha.at_cosine(cosine, kCount);
  const auto slice = static_cast<std::size_t>(eta_cell.node);
  const float excess =
      interpolated(excess_[slice].at(alpha, column), excess_[slice + 1].at(alpha, column), eta_cell.weight);
  const float typical =
      fresnel_dielectric(typical_cosine(cosine, alpha.alpha), std::max(1.02F, eta)).reflectance;
  return std::clamp((typical + excess) * mirror_.at(alpha, column), 0.0F, 1.0F);
}

float ReflectionTable::boundary_mean(const AlphaCell& alpha, const AxisCell& eta_cell) const {
  const auto slice = static_cast<std::size_t>(eta_cell.node), row = static_cast<std::size_t>(alpha.node);
  const auto along_alpha = [&](std::size_t e) {
    return interpolated(boundary_mean_[e][row], boundary_mean_[e][row + 1], alpha.weight);
  };
  return interpolated(along_alpha(slice), along_alpha(slice + 1), eta_cell.weight);
}

// --- glass
// --------------------------------------------------------------------------------------------------

const GlassTable& GlassTable::get() {
  static const GlassTable table;
  return table;
}

GlassTable::GlassTable() {
  for (int row = 0; row < kRows; ++row) {
    for (int column = 0; column < kColumns; ++column) fill(row, column);
    const AlphaCell cell = Grid::cell_of(Grid::alpha_of(row));
    const auto mean_of = [&](const Grid& grid) {
      return diffuse_mean([&](float cosine) { return grid.at(cell, cell.at_cosine(cosine, kColumns)); });
    };
    for (std::size_t e = 0; e < kEtas; ++e) {
      mean_with_[e][static_cast<std::size_t>(row)] = mean_of(with_reflection_[e]);
      mean_without_[e][static_cast<std::size_t>(row)] = mean_of(without_[e]);
    }
  }
}

void GlassTable::fill(int row, int column) {
  const float alpha = Grid::alpha_of(row);
  const Ggx ggx(alpha, alpha);
  const Vector3f o = direction_at(AlphaCell::cosine_of(column, kColumns, alpha));
  Quadrature::Facets facets;
  const std::size_t count = kFacets.find_facets(ggx, o, facets);
  for (int e = 0; e < kEtas; ++e) {
    const float eta = eta_of(e);
    Vector2f sum(0);
    for (std::size_t k = 0; k < count; ++k) sum += Quadrature::glass_shares(ggx, o, facets[k], eta);
    const auto index = static_cast<std::size_t>(row * kColumns + column);
    with_reflection_[static_cast<std::size_t>(e)].values[index] = std::min(1.0F, sum.x);
    without_[static_cast<std::size_t>(e)].values[index] = std::min(1.0F, sum.y);
  }
}

float GlassTable::eta_of(int node) {
  const float x = kGlassStep * static_cast<float>(node - kEtas / 2);
  return std::exp(std::copysign(x * x, x));
}

AxisCell GlassTable::eta_cell(float eta) {
  const float log_eta = std::log(eta);
  const float x = std::copysign(std::sqrt(std::abs(log_eta)), log_eta);
  return AxisCell::at(x / kGlassStep + static_cast<float>(kEtas / 2), kEtas);
}

float GlassTable::albedo(const AlphaCell& alpha, const AxisCell& eta, float specular, float cosine) const {
  const AxisCell column = alpha.at_cosine(cosine, kColumns);
  const auto slice = static_cast<std::size_t>(eta.node);
  const auto along_eta = [&](const Grids& grids) {
    return interpolated(grids[slice].at(alpha, column), grids[slice + 1].at(alpha, column), eta.weight);
  };
  const float with = along_eta(with_reflection_);
  return specular < 1 ? interpolated(along_eta(without_), with, specular) : with;
}

float GlassTable::mean(const AlphaCell& alpha, const AxisCell& eta, float specular) const {
  const auto slice = static_cast<std::size_t>(eta.node), row = static_cast<std::size_t>(alpha.node);
  const auto along_eta = [&](const Means& means) {
    return interpolated(interpolated(means[slice][row], means[slice][row + 1], alpha.weight),
                        interpolated(means[slice + 1][row], means[slice + 1][row + 1], alpha.weight),
                        eta.weight);
  };
  return interpolated(along_eta(mean_without_), along_eta(mean_with_), specular);
}

}  // namespace raytracer
