// The clear sky with its sun.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "core/numeric.hpp"
#include "core/parallel.hpp"
#include "lights/atmosphere.hpp"
#include "lights/environments.hpp"
#include "lights/sphere_distribution.hpp"
#include "raytracer/error.hpp"

namespace raytracer {

namespace {

constexpr double kSunDiameter = 0.533 * kPi / 180;  // as seen from the Earth, on average
/// Of the sun alone before any air, so that a white surface across its rays has the radiance 1.
constexpr double kIrradiance = kPi;

float largest(const Color3f& c) { return std::max({c.x, c.y, c.z}); }

/// Radiance of the upper half, symmetric about the plane through sun and zenith: columns from the sun's side
/// to the other, rows from the horizon up, closer together where the sky changes faster.
class SkyTable {
 public:
  SkyTable() = default;
  SkyTable(const Atmosphere& air, double elevation, double scale) : values_(kColumns * kRows) {
    const Vector3d sun(std::cos(elevation), std::sin(elevation), 0);
    parallel_for(kRows, [&](std::size_t row) {
      const double share = static_cast<double>(row) / (kRows - 1);
      const double height = 0.5 * kPi * share * share;
      for (std::size_t i = 0; i < kColumns; ++i) {
        const double turn = turn_of(static_cast<double>(i) / (kColumns - 1));
        const Vector3d direction(std::cos(height) * std::cos(turn), std::sin(height),
                                 std::cos(height) * std::sin(turn));
        values_[row * kColumns + i] = Color3f(scale * air.sky(direction, sun));
      }
    });
  }

  /// `turn`: from the sun, 0..pi; `height` over the horizon, 0..pi/2.
  Color3f at(float turn, float height) const {
    const float share = std::sqrt(std::clamp(turn / static_cast<float>(kPi), 0.0F, 1.0F));
    const float x = share * (kColumns - 1);
    const float y = std::sqrt(std::clamp(height / static_cast<float>(0.5 * kPi), 0.0F, 1.0F)) * (kRows - 1);
    const auto column = std::min(static_cast<std::size_t>(x), kColumns - 2);
    const auto row = std::min(static_cast<std::size_t>(y), kRows - 2);
    const float fx = x - static_cast<float>(column), fy = y - static_cast<float>(row);
    const Color3f* v = values_.data() + row * kColumns + column;
    return glm::mix(glm::mix(v[0], v[1], fx), glm::mix(v[kColumns], v[kColumns + 1], fx), fy);
  }

 private:
  static constexpr std::size_t kColumns = 96, kRows = 96;

  static double turn_of(double share) { return kPi * share * share; }

  std::vector<Color3f> values_;
};

class SunSkyEnvironment final : public Environment {
 public:
  explicit SunSkyEnvironment(const SunSky& sky) {
    const double elevation = sky.elevation * kPi / 180, azimuth = sky.azimuth * kPi / 180;
    const Atmosphere air(sky.turbidity, Vector3d(sky.ground));
    const Vector3d sun(std::cos(elevation) * std::sin(azimuth), std::sin(elevation),
                       -std::cos(elevation) * std::cos(azimuth));
    sun_ = Vector3f(sun);
    azimuth_ = static_cast<float>(azimuth);
    const double scale = kIrradiance * sky.strength;
    table_ = SkyTable(air, elevation, scale);

    const double radius = 0.5 * kSunDiameter * sky.disk_size;
    const Vector3d arriving = elevation > -radius ? scale * air.transmittance(sun.y) : Vector3d(0.0);
    if (sky.has_disk) set_disk(arriving, radius);
    set_ground(sky.ground, Color3f(arriving * std::max(sun.y, 0.0)));
    set_choice(arriving);
  }

  Color3f radiance(const Vector3f& direction) const override {
    if (!(direction.y >= 0)) return ground_;
    const Color3f sky = sky_at(direction);
    return is_disk(direction) ? sky + disk_ : sky;
  }

  bool sample(const Vector2f& u, Vector3f& direction, float& pdf_there) const override {
    if (u.x < disk_share_) {
      const float height = u.y * disk_height_;  // 1 - cosine
      const float across = std::sqrt(height * (2 - height));
      const float angle = static_cast<float>(2 * kPi) * (u.x / disk_share_);
      const Vector3f beside = glm::normalize(std::abs(sun_.y) < 0.9F ? Vector3f(sun_.z, 0, -sun_.x)
                                                                     : Vector3f(0, sun_.z, -sun_.y));
      direction = glm::normalize((1 - height) * sun_ + across * std::cos(angle) * beside +
                                 across * std::sin(angle) * glm::cross(sun_, beside));
    } else {
      if (distribution_.is_empty()) return false;
      distribution_.sample({(u.x - disk_share_) / (1 - disk_share_), u.y}, direction, pdf_there);
    }
    pdf_there = pdf(direction);
    return pdf_there > 0;
  }

  float pdf(const Vector3f& direction) const override {
    const float of_sky = (1 - disk_share_) * distribution_.pdf(direction);
    return is_disk(direction) ? of_sky + disk_share_ / disk_solid_angle_ : of_sky;
  }

  Color3f mean() const override { return mean_; }

 private:
  Color3f sky_at(const Vector3f& direction) const {
    float turn = std::abs(std::atan2(direction.x, -direction.z) - azimuth_);
    turn = std::fmod(turn, static_cast<float>(2 * kPi));
    turn = std::min(turn, static_cast<float>(2 * kPi) - turn);
    return table_.at(turn, std::atan2(direction.y, std::hypot(direction.x, direction.z)));
  }

  /// By the distance of the tips: the cosine of so small an angle is 1 but for the last digits.
  bool is_disk(const Vector3f& direction) const {
    const Vector3f apart = direction - sun_;
    return disk_share_ > 0 && glm::dot(apart, apart) <= 2 * disk_height_;
  }

  void set_disk(const Vector3d& arriving, double radius) {
    const double half = std::sin(0.5 * radius);
    disk_height_ = static_cast<float>(2 * half * half);
    disk_solid_angle_ = static_cast<float>(2 * kPi) * disk_height_;
    disk_ = Color3f(arriving / static_cast<double>(disk_solid_angle_));
  }

  void set_ground(const Color3f& albedo, const Color3f& from_sun) {
    constexpr int kTurns = 32, kHeights = 32;
    Color3f arriving = from_sun, sum(0);
    for (int i = 0; i < kTurns * kHeights; ++i) {
      // Evenly over the sine of the height.
      const float up = (static_cast<float>(i / kTurns) + 0.5F) / kHeights;
      const float turn = static_cast<float>(kPi) * (static_cast<float>(i % kTurns) + 0.5F) / kTurns;
      const Color3f sky = table_.at(turn, std::asin(up));
      arriving += sky * up * static_cast<float>(2 * kPi / (kTurns * kHeights));
      sum += sky * (1.0F / (kTurns * kHeights));
    }
    ground_ = albedo * arriving * static_cast<float>(1 / kPi);
    mean_ = 0.5F * sum + 0.5F * ground_ + disk_ * (disk_solid_angle_ / static_cast<float>(4 * kPi));
  }

  void set_choice(const Vector3d& arriving) {
    constexpr int kColumns = 128, kRows = 64, kWithin = 2;
    std::vector<float> weights(kColumns * kRows);
    parallel_for(kRows, [&](std::size_t row) {
      for (std::size_t column = 0; column < kColumns; ++column) {
        float sum = 0;
        for (int i = 0; i < kWithin * kWithin; ++i) {
          const float down =
              (static_cast<float>(row) + (static_cast<float>(i / kWithin) + 0.5F) / kWithin) / kRows;
          const float around =
              (static_cast<float>(column) + (static_cast<float>(i % kWithin) + 0.5F) / kWithin) / kColumns;
          const float a = static_cast<float>(kPi) * down, b = static_cast<float>(2 * kPi) * around;
          const Vector3f direction(std::sin(a) * std::sin(b), std::cos(a), -std::sin(a) * std::cos(b));
          sum += largest(direction.y >= 0 ? sky_at(direction) : ground_);
        }
        weights[row * kColumns + column] = sum / (kWithin * kWithin);
      }
    });
    distribution_ = SphereDistribution(kColumns, kRows, std::move(weights));
    if (!(largest(disk_) > 0)) return;
    const float of_disk = largest(Color3f(arriving));
    const float of_all = static_cast<float>(4 * kPi) * largest(mean_);
    disk_share_ = distribution_.is_empty() ? 1.0F : std::clamp(of_disk / of_all, 0.1F, 0.9F);
  }

  Vector3f sun_{0, 1, 0};
  float azimuth_ = 0;
  SkyTable table_;
  Color3f ground_{0}, mean_{0};
  Color3f disk_{0};
  float disk_height_ = 0;  // 1 - cosine of its radius
  float disk_solid_angle_ = 1;
  float disk_share_ = 0;  // of the choices
  SphereDistribution distribution_;
};

void require(bool is_good, const char* what) {
  if (!is_good) throw Error(ErrorKind::kScene, what);
}

}  // namespace

std::shared_ptr<const Environment> make_sun_sky(const SunSky& sky) {
  require(sky.elevation >= -90 && sky.elevation <= 90, "a sun's elevation must be from -90 to 90");
  require(std::isfinite(sky.azimuth), "a sun's azimuth is not a finite number");
  require(sky.turbidity >= 1 && sky.turbidity <= 20, "a sky's turbidity must be from 1 to 20");
  require(sky.disk_size > 0 && sky.disk_size <= 100, "a sun's size must be above 0, and at most 100");
  require(sky.strength >= 0 && std::isfinite(sky.strength), "a sky's strength must not be below 0");
  for (int i = 0; i < 3; ++i) {
    require(sky.ground[i] >= 0 && sky.ground[i] <= 1, "the ground's color must be from 0 to 1");
  }
  if (sky.strength == 0) return make_constant_sky(Color3f(0));
  return std::make_shared<SunSkyEnvironment>(sky);
}

}  // namespace raytracer
