// What air and haze make of sunlight.
#pragma once

#include <vector>

#include "raytracer/vector3f.hpp"

namespace raytracer {

/// Light scattered by the atmosphere of a planet like the Earth, as seen from its ground. S. Hillaire, "A
/// Scalable and Production Ready Sky and Atmosphere Rendering Technique", EGSR 2020: single scattering along
/// the ray, all further scattering from a table that takes it for the same in all directions. Per channel,
/// with the coefficients given there (table 1) as those of red, green and blue; lengths in kilometres.
///
/// Light from the sun has the irradiance 1 before it meets the air.
class Atmosphere {
 public:
  /// `turbidity` is the optical thickness of air and haze together over that of the air alone, straight up,
  /// in the green channel: A. Preetham, P. Shirley, B. Smits, "A Practical Analytic Model for Daylight",
  /// SIGGRAPH 1999. `ground` is the albedo of the ground.
  Atmosphere(double turbidity, const Vector3d& ground);

  /// The share of light that comes through to the ground from a direction whose sine of elevation is `up`;
  /// below the horizon as at it.
  Vector3d transmittance(double up) const {
    return transmittance(kGroundRadius + kEyeHeight, std::max(up, 0.0));
  }

  /// Radiance from `direction` (unit length, y up, not below the horizon) with the sun in the direction
  /// `sun`.
  Vector3d sky(const Vector3d& direction, const Vector3d& sun) const;

 private:
  static constexpr double kGroundRadius = 6360, kTopRadius = 6460;
  static constexpr double kEyeHeight = 0.002;

  struct Medium {
    Vector3d rayleigh, mie;  // scattered, per kilometre
    Vector3d extinction;     // scattered or absorbed
  };
  Medium medium_at(double height) const;

  Vector3d integrated_transmittance(double radius, double up) const;
  Vector3d transmittance(double radius, double up) const;
  Vector3d sunlight(double radius, double up) const;
  Vector3d multiple_at(double height, double sun_up) const;
  Vector3d multiple_integral(double height, double sun_up) const;

  double haze_;  // extinction by haze at the ground, per kilometre
  Vector3d ground_;
  std::vector<Vector3d> transmittances_, multiples_;
};

}  // namespace raytracer
