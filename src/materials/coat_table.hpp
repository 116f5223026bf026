// What a rough mirror loses below a coat. Its reflections pass the coat with the lesser of two shares, on the
// way in and on the way out, so that they are reversible; spread by roughness, they lose what the coat lets
// in but not out.
#pragma once

#include <array>

#include "materials/albedo_tables.hpp"

namespace raytracer {

class CoatTable {
 public:
  static constexpr int kCount = 16, kCoats = 4;
  using Grid = AlbedoGrid<kCount>;

  /// Made by the first call; any thread may call.
  static const CoatTable& get();

  /// Coats even in roughness.
  static AxisCell coat_cell(float coat_alpha);
  /// Under a full coat of index 1.5, of a mirror that loses nothing.
  float loss(const AlphaCell& alpha, const AxisCell& coat, float cosine) const;
  /// Its mean over diffuse light.
  float mean(const AlphaCell& alpha, const AxisCell& coat) const;

 private:
  CoatTable();

  std::array<Grid, kCoats> losses_;
  std::array<std::array<float, kCount>, kCoats> means_{};
};

}  // namespace raytracer
