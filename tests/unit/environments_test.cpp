// Light from all around: where it comes from, how it is chosen, and how much there is.
#include "lights/environments.hpp"

#include <cmath>
#include <cstdint>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "catch.hpp"
#include "raytracer/error.hpp"
#include "scene/light_set.hpp"

namespace {

using namespace raytracer;

constexpr double kPi = 3.14159265358979323846;

class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}
  float unit() { return static_cast<float>(engine_() >> 40) * 0x1p-24f; }
  Vector2f square() {
    const float x = unit();
    return {x, unit()};
  }

 private:
  std::mt19937_64 engine_;
};

Vector3f direction_of(double u, double v) {
  return Vector3f(Vector3d(std::sin(2 * kPi * u) * std::sin(kPi * v), std::cos(kPi * v),
                           -std::cos(2 * kPi * u) * std::sin(kPi * v)));
}

template <class Color>
EnvironmentPicture picture_of(int width, int height, const Color& color) {
  EnvironmentPicture picture;
  picture.width = width;
  picture.height = height;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const Color3f c = color(x, y);
      picture.rgb.insert(picture.rgb.end(), {c.x, c.y, c.z});
    }
  }
  return picture;
}

EnvironmentPicture patchy(int width, int height) {
  return picture_of(width, height, [&](int x, int y) {
    const bool is_lamp = x > width / 2 && x < width / 2 + 3 && y > height / 4 && y < height / 4 + 3;
    if (is_lamp) return Color3f(300, 200, 100);
    const auto wave = [](int i) { return 1.01f + std::sin(0.7f * static_cast<float>(i)); };
    return y > height / 2 ? Color3f(0) : 0.3f * Color3f(wave(x), wave(y), wave(x + y));
  });
}

struct Named {
  std::string name;
  std::shared_ptr<const Environment> sky;
};

std::vector<Named> skies() {
  SunSky sun, soft;
  soft.elevation = 8;
  soft.azimuth = 200;
  soft.disk_size = 20;
  SunSky dusk;
  dusk.elevation = -3;
  return {
      {"picture", make_image_sky(patchy(64, 32))},
      {"turned picture", make_image_sky(patchy(50, 31), 2, turn_about_y(37))},
      {"one row", make_image_sky(picture_of(4, 1, [](int x, int) { return Color3f(x == 1 ? 5.0f : 0.0f); }))},
      {"one pixel shines",
       make_image_sky(
           picture_of(48, 24, [](int x, int y) { return Color3f(x == 7 && y == 3 ? 1e6f : 0.0f); }))},
      {"gradient", make_gradient_sky(Color3f(0, 0, 3), Color3f(0.5f), Color3f(0))},
      {"constant", make_constant_sky(Color3f(2))},
      {"sun", make_sun_sky(sun)},
      {"low soft sun", make_sun_sky(soft)},
      {"dusk", make_sun_sky(dusk)}};
}

}  // namespace

TEST_CASE("a picture of all directions stands as its table says", "[environments]") {
  const int kWidth = 64, kHeight = 32;
  const auto sky = make_image_sky(picture_of(kWidth, kHeight, [](int x, int y) {
    return Color3f(static_cast<float>(x), static_cast<float>(y), 1);
  }));
  const auto seen = [&](const Vector3f& direction) { return sky->radiance(direction); };
  CHECK(seen({1, 0, 0}).x == Approx(0.25 * kWidth - 0.5));
  CHECK(seen({0, 0, 1}).x == Approx(0.5 * kWidth - 0.5));
  CHECK(seen({-1, 0, 0}).x == Approx(0.75 * kWidth - 0.5));
  CHECK(seen({0, 0, -1}).x == Approx(0.5 * (kWidth - 1)));  // between the last column and the first
  CHECK(seen({1, 0, 0}).y == Approx(0.5 * kHeight - 0.5));
  CHECK(seen({0, 1, 0}).y == Approx(0));
  CHECK(seen({0, -1, 0}).y == Approx(kHeight - 1));
  for (const auto& [x, y] : {std::pair(3, 5), std::pair(40, 20), std::pair(63, 31)}) {
    const Color3f color = seen(direction_of((x + 0.5) / kWidth, (y + 0.5) / kHeight));
    CHECK(color.x == Approx(x).margin(1e-3));
    CHECK(color.y == Approx(y).margin(1e-3));
  }
  // A quarter turn about y takes what was at -z to -x.
  const auto turned =
      make_image_sky(picture_of(64, 32, [](int x, int) { return Color3f(x < 2 || x > 61 ? 1.0f : 0.0f); }), 3,
                     turn_about_y(90));
  CHECK(turned->radiance({-1, 0, 0}).x == Approx(3));
  CHECK(turned->radiance({0, 0, -1}).x == 0);
}

TEST_CASE("a picture of one colour is a constant sky, and not chosen", "[environments]") {
  const auto sky = make_image_sky(picture_of(8, 4, [](int, int) { return Color3f(0.1f, 0.2f, 0.3f); }), 2);
  CHECK(sky->is_constant());
  CHECK(sky->radiance(direction_of(0.3, 0.2)) == Color3f(0.2f, 0.4f, 0.6f));
  SceneDescription scene;
  scene.sky = sky;
  CHECK(LightSet(scene).is_empty());
  CHECK(LightSet(scene).sky_pdf(Vector3f(0), {0, 1, 0}, {0, 1, 0}) == 0);
  CHECK(make_gradient_sky(Color3f(1), Color3f(1), Color3f(1))->is_constant());
}

TEST_CASE("directions are chosen with the density that pdf tells", "[environments]") {
  constexpr int kColumns = 24, kRows = 12, kCells = kColumns * kRows, kSamples = 60000, kFine = 24;
  for (const Named& one : skies()) {
    INFO(one.name);
    // Expected counts by the density at many places; the sun is smaller than any grid, and taken as it is.
    std::vector<double> expected(kCells, 0.0), counts(kCells, 0.0);
    double whole = 0;
    for (int y = 0; y < kRows * kFine; ++y) {
      const double high = std::cos(kPi * y / (kRows * kFine)),
                   low = std::cos(kPi * (y + 1) / (kRows * kFine));
      for (int x = 0; x < kColumns * kFine; ++x) {
        const double v = std::acos(0.5 * (high + low)) / kPi, u = (x + 0.5) / (kColumns * kFine);
        const double share = static_cast<double>(one.sky->pdf(direction_of(u, v))) * (high - low) * 2 * kPi /
                             (kColumns * kFine);
        expected[static_cast<std::size_t>(y / kFine * kColumns + x / kFine)] += share * kSamples;
        whole += share;
      }
    }
    const bool has_sun = one.name == "sun";
    if (!has_sun) CHECK(whole == Approx(1).epsilon(0.02));
    Random random(21);
    double light = 0, largest = 0;
    for (int i = 0; i < kSamples; ++i) {
      Vector3f direction;
      float pdf;
      const bool is_good = one.sky->sample(random.square(), direction, pdf) && pdf > 0 &&
                           std::isfinite(pdf) && std::abs(glm::length(direction) - 1) < 1e-5f;
      if (!is_good) FAIL("no choice, or one that is no good");
      if (std::abs(one.sky->pdf(direction) / pdf - 1) > 1e-3f) largest += 1;  // on the border of a cell
      const double u = std::atan2(direction.x, -direction.z) / (2 * kPi), v = std::acos(direction.y) / kPi;
      const int column = static_cast<int>((u < 0 ? u + 1 : u) * kColumns), row = static_cast<int>(v * kRows);
      counts[static_cast<std::size_t>(std::min(row, kRows - 1) * kColumns +
                                      std::min(column, kColumns - 1))] += 1;
      light += static_cast<double>(one.sky->radiance(direction).y / pdf) / kSamples;
    }
    CHECK(largest < 1e-3 * kSamples);
    CHECK(light == Approx(4 * kPi * static_cast<double>(one.sky->mean().y)).epsilon(0.03));
    if (has_sun) continue;
    double sum = 0;
    int cells = 0;
    for (std::size_t i = 0; i < kCells; ++i) {
      if (expected[i] < 5) continue;
      sum += (counts[i] - expected[i]) * (counts[i] - expected[i]) / expected[i];
      ++cells;
    }
    const double k = 2.0 / (9 * cells);
    CHECK((std::cbrt(sum / cells) - (1 - k)) / std::sqrt(k) < 5);  // Wilson and Hilferty
  }
}

TEST_CASE("half a white sky in a picture on a tilted plane", "[environments]") {
  SceneDescription scene;
  scene.sky = make_image_sky(picture_of(512, 256, [](int, int y) { return Color3f(y < 128 ? 1.0f : 0.0f); }));
  const LightSet lights(scene);
  Random random(22);
  for (const double degrees : {0.0, 30.0, 60.0, 90.0, 120.0, 180.0}) {
    const double b = degrees * kPi / 180;
    const Vector3f normal(Vector3d(std::sin(b), std::cos(b), 0));
    double sum = 0;
    const int kSamples = 100000;
    for (int i = 0; i < kSamples; ++i) {
      LightSample sample;
      if (!lights.sample(Vector3f(0), normal, random.unit(), random.square(), sample)) continue;
      CHECK(sample.is_far);
      sum += static_cast<double>(sample.radiance.x * std::max(glm::dot(normal, sample.direction), 0.0f) /
                                 sample.pdf);
    }
    CHECK(sum / kSamples == Approx(kPi * (1 + std::cos(b)) / 2).epsilon(0.02).margin(0.01));
  }
}

TEST_CASE("values that are no radiance count as none", "[environments]") {
  auto picture = picture_of(16, 8, [](int x, int y) { return Color3f(x == 3 && y == 3 ? 1.0f : 0.5f); });
  picture.rgb[0] = NAN;
  picture.rgb[4] = -5;
  picture.rgb[8] = INFINITY;
  const auto sky = make_image_sky(std::move(picture));
  Random random(23);
  for (int i = 0; i < 2000; ++i) {
    Vector3f direction;
    float pdf;
    REQUIRE(sky->sample(random.square(), direction, pdf));
    const Color3f color = sky->radiance(direction);
    CHECK((color.x >= 0 && color.x <= 1 && color.y >= 0 && color.z >= 0 && color.z <= 1));
  }
}

TEST_CASE("black skies choose nothing", "[environments]") {
  const auto black = make_image_sky(picture_of(4, 2, [](int, int) { return Color3f(0); }));
  Vector3f direction;
  float pdf;
  CHECK_FALSE(black->sample({0.5f, 0.5f}, direction, pdf));
  SunSky night;
  night.elevation = -60;
  const auto sky = make_sun_sky(night);
  CHECK(sky->mean().y < 1e-6f);
  CHECK(std::isfinite(sky->pdf({0, 1, 0})));
}

TEST_CASE("the sun through air without haze, and the sky around it", "[environments]") {
  SunSky high;
  high.elevation = 90;
  high.turbidity = 1;
  const auto disk = [](const SunSky& with) {
    SunSky without = with;
    without.has_disk = false;
    const double e = with.elevation * kPi / 180, a = with.azimuth * kPi / 180;
    const Vector3f sun(Vector3d(std::cos(e) * std::sin(a), std::sin(e), -std::cos(e) * std::cos(a)));
    return Vector3d(make_sun_sky(with)->radiance(sun) - make_sun_sky(without)->radiance(sun));
  };
  // Straight up the optical thickness is that of 8 km of air as dense as at the ground, and of the ozone.
  const Vector3d thickness =
      8.0 * Vector3d(5.802e-3, 13.558e-3, 33.1e-3) + 15.0 * Vector3d(0.650e-3, 1.881e-3, 0.085e-3);
  const double solid_angle = kPi * std::pow(0.5 * 0.533 * kPi / 180, 2);
  const Vector3d expected = glm::exp(-thickness) * kPi / solid_angle;
  for (int i = 0; i < 3; ++i) CHECK(disk(high)[i] == Approx(expected[i]).epsilon(0.01));
  SunSky large = high;
  large.disk_size = 10;
  CHECK(disk(large).y == Approx(0.01 * disk(high).y).epsilon(0.01));

  SunSky low = high;
  low.elevation = 5;
  low.azimuth = 90;
  const auto sky = make_sun_sky(low);
  CHECK(disk(low).x > 1.5 * disk(low).z);  // red
  const Color3f zenith = sky->radiance({0, 1, 0});
  CHECK(zenith.z > 1.5f * zenith.x);  // blue
  CHECK(sky->radiance({0, -1, 0}).y < zenith.y * 10);
  SunSky hazy = low;
  hazy.turbidity = 6;
  CHECK(disk(hazy).y < 0.2 * disk(low).y);
  const auto haze = make_sun_sky(hazy);
  const auto at = [&](float x) { return haze->radiance(glm::normalize(Vector3f(x, 0.3f, 0))).y; };
  CHECK(at(1) > 1.2f * at(-1));  // brighter where the sun is
  SunSky twice = low;
  twice.strength = 2;
  CHECK(make_sun_sky(twice)->radiance({0, 1, 0}).y == Approx(2 * zenith.y));
}

TEST_CASE("numbers that make no sky are refused", "[environments]") {
  const auto is_refused = [](const auto& make) {
    try {
      make();
    } catch (const Error& error) {
      return error.kind() == ErrorKind::kScene;
    }
    return false;
  };
  for (const double wrong : {-91.0, 91.0, std::nan("")}) {
    SunSky sky;
    sky.elevation = wrong;
    CHECK(is_refused([&] { make_sun_sky(sky); }));
  }
  for (const double wrong : {0.5, 21.0, std::nan("")}) {
    SunSky sky;
    sky.turbidity = wrong;
    CHECK(is_refused([&] { make_sun_sky(sky); }));
  }
  CHECK(is_refused([] { make_image_sky({}); }));
  CHECK(is_refused([] { make_image_sky({4, 4, std::vector<float>(47)}); }));
  CHECK(is_refused([] { make_constant_sky(Color3f(NAN)); }));
  CHECK(is_refused([] { make_gradient_sky(Color3f(-1), Color3f(0), Color3f(0)); }));
}
