// The computed textures. All stand in cells or waves of length 1 in their own space; the shares are those of
// the setup's `b`.
#pragma once

#include <cstdint>
#include <vector>

#include "textures/pattern.hpp"

namespace raytracer {

/// Cubes (of uv: squares) of edge 1, in turns; the one from the origin on is `a`.
TexturePointer make_checker(PatternSetup setup);

/// Slabs across x: `a` fills the first `width` of each period.
TexturePointer make_stripes(PatternSetup setup, float width);

struct BrickShape {
  float height = 0.4f;  ///< of a row; a brick is 1 long, both with their mortar
  float mortar = 0.05f;
  float offset = 0.5f;  ///< of each row against the one below
};
/// Bricks of `a` with mortar of `b`, on the plane that lies most along the surface.
TexturePointer make_brick(PatternSetup setup, const BrickShape& shape);

enum class GradientShape : std::uint8_t {
  kLinear,  ///< from y = 0 to 1
  kRadial,  ///< from the origin to the distance 1
  kAngle,   ///< once around y, from x over z
};
TexturePointer make_gradient(PatternSetup setup, GradientShape shape);

enum class NoiseSort : std::uint8_t {
  kFbm,         ///< octaves added up: clouds
  kTurbulence,  ///< their absolute values: billows with sharp valleys
  kRidged,      ///< turned over: sharp crests
};
struct NoiseShape {
  NoiseSort sort = NoiseSort::kFbm;
  int octaves = 6;
  float gain = 0.5f;      ///< the strength of each octave against the one before
  float warp = 0;         ///< how far noise moves the noise
  float contrast = 1.5f;  ///< around the mean
};
TexturePointer make_noise(PatternSetup setup, const NoiseShape& shape);

/// Veins of `b` across x through `a`, bent by noise.
TexturePointer make_marble(PatternSetup setup, float turbulence, float sharpness);

/// Rings of `b` in `a` around y, bent by noise, with fibres along y.
TexturePointer make_wood(PatternSetup setup, float turbulence);

/// Grains of all mixtures of `a` and `b`.
TexturePointer make_granite(PatternSetup setup);

enum class CellSort : std::uint8_t {
  kDistance,  ///< 0 in each cell's point, growing to its borders
  kBorders,   ///< 1 along the borders
  kFlat,      ///< a number for each cell
};
/// Worley 1996, "A cellular texture basis function": what is nearest to one of scattered points is a cell.
TexturePointer make_cells(PatternSetup setup, CellSort sort, float jitter, float border);

/// A disk of `a` in the middle of each square of `b`, on the plane that lies most along the surface.
TexturePointer make_dots(PatternSetup setup, float radius);

struct RampStop {
  float at = 0;
  TextureInput color{Color3f(0)};
};
/// The colour between the stops where `value`, its mean over the channels, is; the first and last go on
/// without end. The stops are in order.
TexturePointer make_ramp(TextureInput value, std::vector<RampStop> stops);

struct Rescaling {
  Color3f around{0};                           ///< stays as it is
  TextureInput factor{Color3f(1)};             ///< a number
  float least = -kInfinity, most = kInfinity;  ///< the factor's range
  Color3f channels{1};                         ///< 1 where the factor counts, 0 where it does not
};
/// Another texture's colours, moved away from one of them by a factor.
TexturePointer make_rescaled(TextureInput texture, Rescaling rescaling);

}  // namespace raytracer
