#include "lights/atmosphere.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "core/numeric.hpp"
#include "core/parallel.hpp"

namespace raytracer {

namespace {

const Vector3d kRayleigh(5.802e-3, 13.558e-3, 33.1e-3);   // scattering at the ground, per kilometre
const Vector3d kOzone(0.650e-3, 1.881e-3, 0.085e-3);      // absorption where it is thickest
constexpr double kRayleighHeight = 8, kHazeHeight = 1.2;  // where they are 1/e of that
constexpr double kOzoneMiddle = 25, kOzoneReach = 15;
constexpr double kHazeScattered = 3.996 / 4.440;  // of what haze takes out of a ray
constexpr double kHazeAsymmetry = 0.8;

constexpr std::size_t kTransmittanceUps = 128, kTransmittanceHeights = 32;
constexpr std::size_t kMultipleUps = 32, kMultipleHeights = 16;

double rayleigh_phase(double cosine) { return 3 / (16 * kPi) * (1 + cosine * cosine); }

/// Cornette and Shanks.
double haze_phase(double cosine) {
  constexpr double g = kHazeAsymmetry;
  const double around = 1 + g * g - 2 * g * cosine;
  return 3 / (8 * kPi) * (1 - g * g) * (1 + cosine * cosine) / ((2 + g * g) * around * std::sqrt(around));
}

/// To the sphere around the planet's centre, from inside it.
double way_out(double radius, double up, double sphere) {
  return -radius * up + std::sqrt(std::max(radius * radius * (up * up - 1) + sphere * sphere, 0.0));
}

/// Whether the ray meets the ground, and after which way.
bool meets_ground(double radius, double up, double ground, double& way) {
  const double under_root = radius * radius * (up * up - 1) + ground * ground;
  if (up >= 0 || under_root < 0) return false;
  way = -radius * up - std::sqrt(under_root);
  return true;
}

/// A table over the unit square, bilinear between its points, of which the first and last stand at 0 and 1.
Vector3d looked_up(const std::vector<Vector3d>& table, std::size_t columns, std::size_t rows, double x,
                   double y) {
  x = std::clamp(x, 0.0, 1.0) * static_cast<double>(columns - 1);
  y = std::clamp(y, 0.0, 1.0) * static_cast<double>(rows - 1);
  const auto column = std::min(static_cast<std::size_t>(x), columns - 2);
  const auto row = std::min(static_cast<std::size_t>(y), rows - 2);
  const double fx = x - static_cast<double>(column), fy = y - static_cast<double>(row);
  const Vector3d* at = table.data() + row * columns + column;
  return glm::mix(glm::mix(at[0], at[1], fx), glm::mix(at[columns], at[columns + 1], fx), fy);
}

}  // namespace

Atmosphere::Atmosphere(double turbidity, const Vector3d& ground)
    : haze_((turbidity - 1) * kRayleigh.y * kRayleighHeight / kHazeHeight), ground_(ground) {
  // Tables over the height, as a root since most happens close to the ground, and over the way to the top of
  // the atmosphere (E. Bruneton, F. Neyret, "Precomputed Atmospheric Scattering", EGSR 2008, section 4).
  const double horizon = std::sqrt(kTopRadius * kTopRadius - kGroundRadius * kGroundRadius);
  transmittances_.resize(kTransmittanceUps * kTransmittanceHeights);
  parallel_for(kTransmittanceHeights, [&](std::size_t row) {
    const double rho = horizon * static_cast<double>(row) / (kTransmittanceHeights - 1);
    const double radius = std::sqrt(rho * rho + kGroundRadius * kGroundRadius);
    for (std::size_t i = 0; i < kTransmittanceUps; ++i) {
      const double least = kTopRadius - radius, most = rho + horizon;
      const double way = least + (most - least) * static_cast<double>(i) / (kTransmittanceUps - 1);
      const double up = way > 0 ? (horizon * horizon - rho * rho - way * way) / (2 * radius * way) : 1.0;
      transmittances_[row * kTransmittanceUps + i] =
          integrated_transmittance(radius, std::clamp(up, -1.0, 1.0));
    }
  });
  multiples_.resize(kMultipleUps * kMultipleHeights);
  parallel_for(kMultipleHeights, [&](std::size_t row) {
    const double share = static_cast<double>(row) / (kMultipleHeights - 1);
    for (std::size_t i = 0; i < kMultipleUps; ++i) {
      const double up = 2 * static_cast<double>(i) / (kMultipleUps - 1) - 1;
      multiples_[row * kMultipleUps + i] =
          multiple_integral(share * share * (kTopRadius - kGroundRadius), up);
    }
  });
}

Atmosphere::Medium Atmosphere::medium_at(double height) const {
  Medium medium;
  const double haze = haze_ * std::exp(-height / kHazeHeight);
  medium.rayleigh = std::exp(-height / kRayleighHeight) * kRayleigh;
  medium.mie = Vector3d(kHazeScattered * haze);
  const double ozone = std::max(1 - std::abs(height - kOzoneMiddle) / kOzoneReach, 0.0);
  medium.extinction = medium.rayleigh + haze + ozone * kOzone;
  return medium;
}

Vector3d Atmosphere::integrated_transmittance(double radius, double up) const {
  constexpr int kSteps = 40;
  const double way = way_out(radius, up, kTopRadius);
  Vector3d thickness(0.0);
  for (int i = 0; i < kSteps; ++i) {
    // Shorter steps close to where it begins.
    const double a = static_cast<double>(i) / kSteps, b = (i + 1.0) / kSteps;
    const double step = way * (b * b - a * a), t = way * 0.5 * (a * a + b * b);
    const double there = std::sqrt(radius * radius + t * t + 2 * radius * up * t);
    thickness += step * medium_at(std::max(there - kGroundRadius, 0.0)).extinction;
  }
  return glm::exp(-thickness);
}

Vector3d Atmosphere::transmittance(double radius, double up) const {
  const double horizon = std::sqrt(kTopRadius * kTopRadius - kGroundRadius * kGroundRadius);
  const double rho = std::sqrt(std::max(radius * radius - kGroundRadius * kGroundRadius, 0.0));
  const double way = way_out(radius, up, kTopRadius);
  const double least = kTopRadius - radius, most = rho + horizon;
  const double x = most > least ? (way - least) / (most - least) : 0;
  return looked_up(transmittances_, kTransmittanceUps, kTransmittanceHeights, x, rho / horizon);
}

/// What arrives of the sun's light, whose disk sinks below the planet's edge bit by bit.
Vector3d Atmosphere::sunlight(double radius, double up) const {
  constexpr double kSunRadius = 0.00465;
  const double ground = kGroundRadius / radius;
  const double edge = -std::sqrt(std::max(1 - ground * ground, 0.0));
  const double share = std::clamp(0.5 + 0.5 * (up - edge) / kSunRadius, 0.0, 1.0);
  return share > 0 ? share * transmittance(radius, std::max(up, edge)) : Vector3d(0.0);
}

Vector3d Atmosphere::multiple_at(double height, double sun_up) const {
  const double share = std::sqrt(std::max(height, 0.0) / (kTopRadius - kGroundRadius));
  return looked_up(multiples_, kMultipleUps, kMultipleHeights, 0.5 + 0.5 * sun_up, share);
}

/// Equations 5 to 10: light that was scattered once, and how much of any light is scattered once more, each
/// averaged over all directions; from there a geometric series.
Vector3d Atmosphere::multiple_integral(double height, double sun_up) const {
  constexpr int kDirections = 64, kSteps = 20;
  constexpr double kGoldenAngle = 2.399963229728653;
  const double radius = kGroundRadius + std::clamp(height, 1e-3, kTopRadius - kGroundRadius - 1e-3);
  const Vector3d sun(std::sqrt(std::max(1 - sun_up * sun_up, 0.0)), sun_up, 0);
  Vector3d second(0.0), again(0.0);
  for (int k = 0; k < kDirections; ++k) {
    const double y = (2 * k + 1.0) / kDirections - 1, across = std::sqrt(1 - y * y);
    const Vector3d direction(across * std::cos(kGoldenAngle * k), y, across * std::sin(kGoldenAngle * k));
    double way;
    const bool is_ground = meets_ground(radius, y, kGroundRadius, way);
    if (!is_ground) way = way_out(radius, y, kTopRadius);
    Vector3d through(1.0);
    for (int i = 0; i < kSteps; ++i) {
      const double step = way / kSteps;
      const Vector3d place = Vector3d(0, radius, 0) + (i + 0.5) * step * direction;
      const double there = glm::length(place);
      const Medium medium = medium_at(std::max(there - kGroundRadius, 0.0));
      const Vector3d seen = glm::exp(-step * medium.extinction);
      const Vector3d scattered = (medium.rayleigh + medium.mie) * through * (1.0 - seen) / medium.extinction;
      again += scattered;
      second += scattered * sunlight(there, glm::dot(place, sun) / there) / (4 * kPi);
      through *= seen;
    }
    if (is_ground) {
      const Vector3d place = glm::normalize(Vector3d(0, radius, 0) + way * direction);
      const double facing = glm::dot(place, sun);
      second += through * sunlight(kGroundRadius, facing) * std::max(facing, 0.0) * ground_ / kPi;
    }
  }
  return (second / static_cast<double>(kDirections)) / (1.0 - again / static_cast<double>(kDirections));
}

Vector3d Atmosphere::sky(const Vector3d& direction, const Vector3d& sun) const {
  constexpr int kSteps = 40;
  constexpr double kRadius = kGroundRadius + kEyeHeight;
  const double way = way_out(kRadius, direction.y, kTopRadius);
  const double cosine = glm::dot(direction, sun);
  const double rayleigh = rayleigh_phase(cosine), haze = haze_phase(cosine);
  Vector3d light(0.0), through(1.0);
  for (int i = 0; i < kSteps; ++i) {
    const double a = static_cast<double>(i) / kSteps, b = (i + 1.0) / kSteps;
    const double step = way * (b * b - a * a);
    const Vector3d place = Vector3d(0, kRadius, 0) + way * 0.5 * (a * a + b * b) * direction;
    const double there = glm::length(place), sun_up = glm::dot(place, sun) / there;
    const double height = std::max(there - kGroundRadius, 0.0);
    const Medium medium = medium_at(height);
    const Vector3d source = sunlight(there, sun_up) * (rayleigh * medium.rayleigh + haze * medium.mie) +
                            multiple_at(height, sun_up) * (medium.rayleigh + medium.mie);
    const Vector3d seen = glm::exp(-step * medium.extinction);
    light += through * source * (1.0 - seen) / medium.extinction;
    through *= seen;
  }
  return light;
}

}  // namespace raytracer
