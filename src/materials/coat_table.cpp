#include "materials/coat_table.hpp"

#include "materials/facet_quadrature.hpp"

namespace raytracer {

namespace {

constexpr float kCoatIor = 1.5F;
constexpr FacetQuadrature<16, 32> kFacets{0.5F};  // alike all around, so half of them

float coat_alpha_of(std::size_t coat) {
  const float roughness = static_cast<float>(coat) / (CoatTable::kCoats - 1);
  return roughness * roughness;
}

/// The integral of a mirror's value times by how much the coat reflects more of `i` than of `o`.
float loss_of(float alpha, float coat_alpha, float cosine) {
  const ReflectionTable& table = ReflectionTable::get();
  const AlphaCell coat = ReflectionTable::Grid::cell_of(coat_alpha);
  const AxisCell eta_cell = ReflectionTable::eta_cell(kCoatIor);
  const auto reflects = [&](float c) {
    return coat_alpha > 0 ? table.boundary(coat, eta_cell, kCoatIor, c)
                          : fresnel_dielectric(c, kCoatIor).reflectance;
  };
  const Vector3f o(std::sqrt(std::max(0.0F, 1 - cosine * cosine)), 0, cosine);
  const float of_o = reflects(cosine);
  float sum = 0;
  kFacets.for_reflections(Ggx(alpha, alpha), o, [&](float, float share, const Vector3f& i) {
    sum += share * std::max(0.0F, reflects(std::min(1.0F, i.z)) - of_o);
  });
  return sum;
}

}  // namespace

const CoatTable& CoatTable::get() {
  static const CoatTable table;
  return table;
}

CoatTable::CoatTable() {
  for (std::size_t coat = 0; coat < kCoats; ++coat) {
    for (int row = 0; row < kCount; ++row) {
      const float alpha = Grid::alpha_of(row);
      for (int column = 0; column < kCount; ++column) {
        losses_[coat].values[static_cast<std::size_t>(row * kCount + column)] =
            loss_of(alpha, coat_alpha_of(coat), AlphaCell::cosine_of(column, kCount, alpha));
      }
      const AlphaCell cell = Grid::cell_of(alpha);
      means_[coat][static_cast<std::size_t>(row)] =
          diffuse_mean([&](float cosine) { return losses_[coat].at(cell, cell.at_cosine(cosine, kCount)); });
    }
  }
}

AxisCell CoatTable::coat_cell(float coat_alpha) {
  return AxisCell::at(std::sqrt(coat_alpha) * (kCoats - 1), kCoats);
}

float CoatTable::loss(const AlphaCell& alpha, const AxisCell& coat, float cosine) const {
  const AxisCell column = alpha.at_cosine(cosine, kCount);
  const auto node = static_cast<std::size_t>(coat.node);
  return interpolated(losses_[node].at(alpha, column), losses_[node + 1].at(alpha, column), coat.weight);
}

float CoatTable::mean(const AlphaCell& alpha, const AxisCell& coat) const {
  const auto node = static_cast<std::size_t>(coat.node), row = static_cast<std::size_t>(alpha.node);
  const auto along_alpha = [&](std::size_t c) {
    return interpolated(means_[c][row], means_[c][row + 1], alpha.weight);
  };
  return interpolated(along_alpha(node), along_alpha(node + 1), coat.weight);
}

}  // namespace raytracer
