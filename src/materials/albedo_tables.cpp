#include "materials/albedo_tables.hpp"

#include "materials/fresnel.hpp"
#include "materials/ggx.hpp"

namespace raytracer {

namespace {

constexpr float kLeastAlpha = 1e-4F;
constexpr int kAround = 16, kUp = 32;  // points of the quadrature over facets
constexpr int kMeanPoints = 64;        // and of that over cosines

float interpolated(float low, float high, float weight) { return low + weight * (high - low); }

Vector3f direction_at(float cosine) { return {std::sqrt(std::max(0.0F, 1 - cosine * cosine)), 0, cosine}; }

/// Calls use(u, weight) for points of the left half of the unit square (the right one is its mirror image),
/// closer together towards u.y = 1, where facets turn away; the weights' sum is 1.
template <typename Use>
void for_points(const Use& use) {
  for (int j = 0; j < kUp; ++j) {
    const float rest = 1 - (static_cast<float>(j) + 0.5F) / kUp;
    for (int i = 0; i < kAround; ++i) {
      use(Vector2f((static_cast<float>(i) + 0.5F) / (2 * kAround), 1 - rest * rest),
          2 * rest / (kAround * kUp));
    }
  }
}

/// The mean over diffuse light of a function of the cosine.
template <typename Function>
float diffuse_mean(const Function& function) {
  float sum = 0;
  for (int i = 0; i < kMeanPoints; ++i) {
    sum += function(std::sqrt((static_cast<float>(i) + 0.5F) / kMeanPoints));
  }
  return sum / kMeanPoints;
}

AxisCell even_cell(float x, int count) {
  const int node = std::clamp(static_cast<int>(x), 0, count - 2);
  return {node, std::clamp(x - static_cast<float>(node), 0.0F, 1.0F)};
}

/// A cosine that the facets acting at `cosine` typically have; only has to be near it, see excess_.
float typical_cosine(float cosine, float alpha) {
  const float alpha2 = alpha * alpha;
  return std::sqrt((cosine * cosine + alpha2) / (1 + alpha2));
}

// The eta axis of boundaries: even in sqrt((eta - 1) / (eta + 1)), since near 1 the reflectance at grazing
// depends on cosine / sqrt(eta^2 - 1).
constexpr float kLeastEtaX = 0.0995037F, kGreatestEtaX = 0.7745967F;  // of eta 1.02 and 4

float boundary_eta(int node) {
  const float x =
      interpolated(kLeastEtaX, kGreatestEtaX, static_cast<float>(node) / (ReflectionTable::kEtas - 1));
  return (1 + x * x) / (1 - x * x);
}

// The eta axis of glass: 1/3 .. 3, even in the root of the logarithm, so closer together about 1, where total
// reflection begins.
constexpr float kGlassLogRange = 1.0986123F;

float glass_eta(int node) {
  const float x = 2 * static_cast<float>(node) / (GlassTable::kEtas - 1) - 1;
  return std::exp(std::copysign(kGlassLogRange * x * x, x));
}

/// What a facet does that a rough pane shows.
struct Facet {
  Vector3f normal;
  float cosine;            ///< of the direction looked from
  float weight;            ///< the weights' sum is 1
  float reflection_shows;  ///< the share of reflected light that no other facet holds back
};

int find_facets(const Ggx& ggx, const Vector3f& o, std::array<Facet, kAround * kUp>& facets) {
  const Ggx::Eye eye = ggx.eye(o);
  int count = 0;
  for_points([&](const Vector2f& u, float weight) {
    const Vector3f h = ggx.sample_visible(eye, u);
    const float c = std::min(1.0F, glm::dot(o, h));
    if (!(c > 0)) return;
    const Vector3f i = 2 * c * h - o;
    const float shows = i.z > 0 ? 4 * o.z * i.z * ggx.joint_visibility(eye, i) / ggx.visible(eye) : 0.0F;
    facets[static_cast<std::size_t>(count++)] = {h, c, weight, shows};
  });
  return count;
}

/// What such a facet of glass reflects and refracts in all: with Fresnel's reflection, and without any but
/// total reflection.
Vector2f glass_shares(const Ggx& ggx, const Vector3f& o, const Facet& facet, float eta) {
  const Boundary boundary = fresnel_dielectric(facet.cosine, eta);
  if (boundary.is_total) return Vector2f(facet.weight * facet.reflection_shows);
  const Vector3f through = (facet.cosine / eta - boundary.cosine_through) * facet.normal - o / eta;
  const float refraction_shows = through.z < 0 ? ggx.visible(through) : 0.0F;
  const float both = interpolated(refraction_shows, facet.reflection_shows, boundary.reflectance);
  return facet.weight * Vector2f(both, refraction_shows);
}

}  // namespace

template <int Count>
float AlbedoGrid<Count>::alpha_of(int row) {
  constexpr float kStep = 1.0F / (Count - 1);
  const float roughness = static_cast<float>(row) * kStep;
  return std::max(kLeastAlpha, roughness * roughness);
}

template <int Count>
float AlbedoGrid<Count>::cosine_of(int column, float alpha) {
  const float k = 2 * alpha, x = static_cast<float>(column) / (Count - 1), x2 = x * x;
  return std::clamp(x2 * k / (1 + k - x2), 1e-6F, 1.0F);
}

template <int Count>
AlphaCell AlbedoGrid<Count>::cell_of(float alpha) {
  const int row = std::clamp(static_cast<int>(std::sqrt(alpha) * (Count - 1)), 0, Count - 2);
  const float low = alpha_of(row), high = alpha_of(row + 1);
  return {{row, std::clamp((alpha - low) / (high - low), 0.0F, 1.0F)}, std::max(kLeastAlpha, alpha)};
}

template struct AlbedoGrid<ReflectionTable::kCount>;
template struct AlbedoGrid<GlassTable::kCount>;

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
  const float alpha = Grid::alpha_of(row), cosine = Grid::cosine_of(column, alpha);
  const Ggx ggx(alpha, alpha);
  const Vector3f o = direction_at(cosine);
  const Ggx::Eye eye = ggx.eye(o);
  std::array<float, kAround * kUp> cosines{}, shares{};
  std::size_t count = 0;
  float all = 0;
  for_points([&](const Vector2f& u, float weight) {
    const Vector3f h = ggx.sample_bounded(eye, u);
    const float c = std::min(1.0F, glm::dot(o, h));
    const Vector3f i = 2 * c * h - o;
    if (!(i.z > 0)) return;
    const float density = ggx.density(h);
    const float share =
        weight * density * i.z * ggx.joint_visibility(eye, i) / ggx.bounded_reflection_pdf(eye, density);
    cosines[count] = c;
    shares[count++] = share;
    all += share;
  });
  const auto index = static_cast<std::size_t>(row * kCount + column);
  mirror_.values[index] = std::min(1.0F, all);
  for (int e = 0; e < kEtas; ++e) {
    const float eta = boundary_eta(e);
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
      const float eta = boundary_eta(e);
      boundary_mean_[static_cast<std::size_t>(e)][r] =
          diffuse_mean([&](float cosine) { return boundary(cell, eta_cell(eta), eta, cosine); });
    }
  }
}

float ReflectionTable::mirror_mean(const AlphaCell& alpha) const {
  const auto row = static_cast<std::size_t>(alpha.node);
  return interpolated(mirror_mean_[row], mirror_mean_[row + 1], alpha.weight);
}

AxisCell ReflectionTable::eta_cell(float eta) {
  const float x = std::sqrt(std::max(0.0F, eta - 1) / (eta + 1));
  return even_cell((x - kLeastEtaX) / (kGreatestEtaX - kLeastEtaX) * (kEtas - 1), kEtas);
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
  for (int row = 0; row < kCount; ++row) {
    for (int column = 0; column < kCount; ++column) fill(row, column);
    const AlphaCell cell = Grid::cell_of(Grid::alpha_of(row));
    const auto mean_of = [&](const Grid& grid) {
      return diffuse_mean([&](float cosine) { return grid.at(cell, cell.at_cosine(cosine, kCount)); });
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
  const Vector3f o = direction_at(Grid::cosine_of(column, alpha));
  std::array<Facet, kAround * kUp> facets;
  const int count = find_facets(ggx, o, facets);
  for (int e = 0; e < kEtas; ++e) {
    const float eta = glass_eta(e);
    Vector2f sum(0);
    for (int k = 0; k < count; ++k) sum += glass_shares(ggx, o, facets[static_cast<std::size_t>(k)], eta);
    const auto index = static_cast<std::size_t>(row * kCount + column);
    with_reflection_[static_cast<std::size_t>(e)].values[index] = std::min(1.0F, sum.x);
    without_[static_cast<std::size_t>(e)].values[index] = std::min(1.0F, sum.y);
  }
}

AxisCell GlassTable::eta_cell(float eta) {
  const float log_eta = std::log(eta);
  const float x = std::copysign(std::sqrt(std::abs(log_eta) / kGlassLogRange), log_eta);
  return even_cell((x + 1) * 0.5F * (kEtas - 1), kEtas);
}

float GlassTable::albedo(const AlphaCell& alpha, const AxisCell& eta, float specular, float cosine) const {
  const AxisCell column = alpha.at_cosine(cosine, kCount);
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
