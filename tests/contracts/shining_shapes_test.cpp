// What every shape promises of its parts that shine: how a point of them is chosen, with which density, and
// how its uv grows.
#include <cmath>
#include <cstdint>
#include <functional>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "catch.hpp"
#include "raytracer/shapes.hpp"

namespace {

using namespace raytracer;

constexpr double kPi = 3.14159265358979323846;

class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}
  double unit() { return static_cast<double>(engine_() >> 11) * 0x1p-53; }
  double in(double low, double high) { return low + (high - low) * unit(); }
  Vector2f square() {
    const float x = static_cast<float>(engine_() >> 40) * 0x1p-24f;
    return {x, static_cast<float>(engine_() >> 40) * 0x1p-24f};
  }

 private:
  std::mt19937_64 engine_;
};

struct Case {
  std::string name;
  std::function<std::unique_ptr<Shape>(const Transform&)> make;
};

const Vector3d kO(0.0), kY(0, 1, 0);

std::vector<Case> cases() {
  const Vector3d low(0, -0.5, 0), high(0, 0.6, 0);
  return {
      {"sphere", [](const Transform& m) { return make_sphere(kO, 0.8, m); }},
      {"square",
       [](const Transform& m) {
         return make_quad({-0.5, 0, 0.5}, {1, 0, 0}, {0, 0, -1}, m);
       }},
      {"strip",
       [](const Transform& m) {
         return make_quad({-1, 0, 0.02}, {2, 0, 0}, {0, 0, -0.04}, m);
       }},
      {"oblique quad",
       [](const Transform& m) {
         return make_quad({-0.5, 0, 0}, {1, 0.1, 0}, {0.4, 0, -1}, m);
       }},
      {"triangle",
       [](const Transform& m) {
         return make_triangle({-0.5, 0, 0}, {0.7, 0, 0}, {0.1, 0.2, -1}, m);
       }},
      {"cube",
       [](const Transform& m) {
         return make_cube({0, 0.1, 0}, {1, 0.6, 0.3}, m);
       }},
      {"disk",
       [](const Transform& m) {
         return make_disk(kO, {0.2, 1, 0}, 0.7, m);
       }},
      {"cylinder", [=](const Transform& m) { return make_cylinder(low, high, 0.4, false, m); }},
      {"open cylinder", [=](const Transform& m) { return make_cylinder(low, high, 0.4, true, m); }},
      {"cone", [=](const Transform& m) { return make_cone(low, 0.6, high, 0, false, m); }},
      {"stump", [=](const Transform& m) { return make_cone(low, 0.6, high, 0.2, false, m); }},
      {"torus", [](const Transform& m) { return make_torus(kO, kY, 0.6, 0.25, m); }},
      {"spindle", [](const Transform& m) { return make_torus(kO, kY, 0.3, 0.5, m); }},
  };
}

Transform sheared(double scale, const Vector3d& to) {
  return {scale * glm::dmat3(1.2, 0.1, -0.3, 0.4, 0.7, 0.2, -0.2, 0.3, -1.1), to};
}

std::vector<Transform> placements() {
  return {{}, {glm::dmat3(1000.0), {30, -500, 7}}, sheared(1, kO), sheared(0.01, {3, 2, -1})};
}

// In the shape's own space: above, beside, far, inside, close to the surface of most.
std::vector<Vector3d> viewpoints() {
  return {{0.3, 2, 0.5},       {2.5, 0.3, -0.4}, {40, 30, 20},
          {0.05, 0.08, -0.03}, {0.2, 0.75, 0.3}, {-0.1, -0.52, 0.1}};
}

/// Directions within a cone around an axis, uniform over its solid angle, in cells of equal solid angle.
struct Cone {
  glm::dmat3 axes{1.0};
  double height = 2;  ///< 1 - cosine of the half angle
  static constexpr int kRings = 4, kSectors = 6, kCells = kRings * kSectors;

  Cone(const Box3f& box, const Vector3d& from) {
    const Vector3d middle = 0.5 * (Vector3d(box.lower) + Vector3d(box.upper));
    const Vector3d way = middle - from;
    const double radius = 0.5 * glm::length(Vector3d(box.diagonal())) * 1.001, distance = glm::length(way);
    if (distance <= radius) return;
    const double sine = radius / distance;
    height = sine * sine / (1 + std::sqrt(1 - sine * sine));
    const Vector3d z = way / distance;
    const Vector3d x = glm::normalize(glm::cross(z, std::abs(z.x) < 0.6 ? Vector3d(1, 0, 0) : kY));
    axes = {x, glm::cross(z, x), z};
  }
  double solid_angle() const { return 2 * kPi * height; }
  Vector3d direction(const Vector2f& u) const {
    const double h = height * static_cast<double>(u.x), a = 2 * kPi * static_cast<double>(u.y),
                 r = std::sqrt(h * (2 - h));
    return axes * Vector3d(r * std::cos(a), r * std::sin(a), 1 - h);
  }
  int cell(const Vector3d& direction) const {
    const Vector3d d = glm::transpose(axes) * direction;
    const double squared_sine = d.x * d.x + d.y * d.y;
    const double h = d.z > 0 ? squared_sine / (1 + d.z) : 1 - d.z;
    const int ring = std::min(static_cast<int>(h / height * kRings), kRings - 1);
    const double a = std::atan2(d.y, d.x) / (2 * kPi);
    return ring * kSectors + std::min(static_cast<int>((a < 0 ? a + 1 : a) * kSectors), kSectors - 1);
  }
};

Ray3f ray_to(const Vector3f& from, const Vector3f& to) { return {from, to - from}; }

/// Compares the solid angle of what is seen of the part in each cell, once by the samples' densities and once
/// by rays that ask; the sum of the squared differences over their variances follows a chi-square
/// distribution. Returns how many standard deviations it is too large, and adds to `whole` by how many the
/// solid angle of all cells together is off.
double deviation(const Shape& shape, std::uint32_t part, const Vector3f& from, Random& random, double& whole,
                 std::string& complaint) {
  constexpr int kSamples = 6000;
  const Cone cone(shape.bounds(), Vector3d(from));
  double sampled[Cone::kCells] = {}, squares[Cone::kCells] = {}, asked[Cone::kCells] = {},
         expected[Cone::kCells] = {};
  for (int i = 0; i < kSamples; ++i) {
    ShapeSample sample;
    if (shape.sample_part(part, from, random.square(), sample)) {
      if (!(sample.pdf > 0 && sample.pdf < 1e31f)) complaint = "pdf " + std::to_string(sample.pdf);
      const Ray3f ray = ray_to(from, sample.position);
      Hit hit;
      if (shape.is_hit(ray, hit) && hit.primitive == part && std::abs(hit.t - 1) < 1e-3f) {
        const float pdf = shape.part_pdf(part, from, shape.surface_at(ray, hit));
        // What the rounding of the ray may change: the place on the surface, and with it the cosine.
        const float cosine = std::abs(glm::dot(glm::normalize(ray.direction), sample.normal));
        const float magnitude = glm::length(from) + glm::length(ray.direction);
        const float size = glm::length(shape.bounds().diagonal());
        const float tolerance =
            1e-3f + 1e-5f * magnitude / (std::min(size, glm::length(ray.direction)) * cosine * cosine);
        if (cosine > 0.03f && std::abs(pdf / sample.pdf - 1) > tolerance) {
          complaint = "pdf " + std::to_string(sample.pdf) + " is " + std::to_string(pdf) + " at the hit";
        }
        const auto cell = static_cast<std::size_t>(cone.cell(glm::normalize(Vector3d(ray.direction))));
        const double weight = 1 / static_cast<double>(sample.pdf);
        sampled[cell] += weight;
        squares[cell] += weight * weight;
      }
    }
    const Ray3f ray = {from, Vector3f(cone.direction(random.square()))};
    Hit hit;
    if (shape.is_hit(ray, hit) && hit.primitive == part) {
      const auto cell = static_cast<std::size_t>(cone.cell(glm::normalize(Vector3d(ray.direction))));
      asked[cell] += 1;
      expected[cell] +=
          cone.solid_angle() * static_cast<double>(shape.part_pdf(part, from, shape.surface_at(ray, hit)));
    }
  }
  double sum = 0, difference = 0, variance = 0;
  int cells = 0;
  for (int i = 0; i < Cone::kCells; ++i) {
    if (asked[i] < 25 || expected[i] < 50) continue;
    const double by_samples = sampled[i] / kSamples;
    const double sample_variance = (squares[i] / kSamples - by_samples * by_samples) / kSamples;
    const double share = asked[i] / kSamples;
    const double by_rays = share * cone.solid_angle();
    const double ray_variance = share * (1 - share) / kSamples * cone.solid_angle() * cone.solid_angle();
    sum += (by_samples - by_rays) * (by_samples - by_rays) / (sample_variance + ray_variance);
    difference += by_samples - by_rays;
    variance += sample_variance + ray_variance;
    ++cells;
  }
  if (cells == 0) return 0;
  whole += difference / std::sqrt(variance);
  // Wilson and Hilferty: the cube root of chi-square is almost normal.
  const double k = 2.0 / (9 * cells);
  return (std::cbrt(sum / cells) - (1 - k)) / std::sqrt(k);
}

}  // namespace

TEST_CASE("points of shining parts are chosen with the density that part_pdf tells", "[shapes][contract]") {
  Random random(1);
  int index = 0;
  for (const Case& one : cases()) {
    double whole = 0;
    for (const Transform& placement : placements()) {
      const auto shape = one.make(placement);
      for (const Vector3d& viewpoint : viewpoints()) {
        const Vector3f from(placement.point(viewpoint));
        const std::uint32_t parts = shape->part_count();
        REQUIRE(parts > 0);
        // Every part is tried from somewhere.
        const auto part = static_cast<std::uint32_t>(index++) % parts;
        std::string complaint;
        const double sigmas = deviation(*shape, part, from, random, whole, complaint);
        INFO(one.name << ", part " << part << ", from " << viewpoint.x << " " << viewpoint.y << " "
                      << viewpoint.z << " size " << placement.linear[0][0]);
        CHECK(complaint == "");
        CHECK(sigmas < 6);
      }
    }
    INFO(one.name);
    CHECK(std::abs(whole) < 4.5 * std::sqrt(static_cast<double>(placements().size() * viewpoints().size())));
  }
}

TEST_CASE("extents hold their parts", "[shapes][contract]") {
  Random random(2);
  for (const Case& one : cases()) {
    for (const Transform& placement : placements()) {
      const auto shape = one.make(placement);
      for (std::uint32_t part = 0; part < shape->part_count(); ++part) {
        const PartExtent extent = shape->part_extent(part);
        INFO(one.name << " " << part);
        // The area by the samples' densities from a place far outside: 1 / (density per area).
        const Vector3f from(placement.point({3, 4, 5}));
        double sum = 0;
        const int kSamples = one.name == "sphere" ? 0 : 4000;
        for (int i = 0; i < kSamples; ++i) {
          ShapeSample sample;
          if (!shape->sample_part(part, from, random.square(), sample)) continue;
          const Vector3f inside = sample.position;
          CHECK(glm::all(glm::lessThanEqual(extent.bounds.lower, inside)));
          CHECK(glm::all(glm::lessThanEqual(inside, extent.bounds.upper)));
          if (extent.cos_spread > -1) CHECK(glm::dot(extent.axis, sample.normal) > extent.cos_spread - 1e-5f);
          const Vector3d way = Vector3d(sample.position) - Vector3d(from);
          const double squared = glm::dot(way, way);
          const double cosine = std::abs(glm::dot(way, Vector3d(sample.normal))) / std::sqrt(squared);
          sum += squared / cosine / static_cast<double>(sample.pdf);
        }
        if (kSamples > 0 && extent.area > 0) {
          CHECK(sum / kSamples == Approx(static_cast<double>(extent.area)).epsilon(0.02));
        }
      }
    }
  }
  CHECK(make_plane(kO, kY)->part_count() == 0);
  CHECK(make_sphere(kO, 2)->part_extent(0).area == Approx(16 * kPi));
  const Transform stretch = {glm::dmat3(2, 0, 0, 0, 1, 0, 0, 0, 1), kO};
  CHECK(make_sphere(kO, 1, stretch)->part_extent(0).area == Approx(21.4784).epsilon(1e-3));
}

TEST_CASE("nothing breaks where a part is seen from on it, from within its plane or from very far",
          "[shapes][contract]") {
  Random random(3);
  for (const Case& one : cases()) {
    for (const Transform& placement : placements()) {
      const auto shape = one.make(placement);
      for (std::uint32_t part = 0; part < shape->part_count(); ++part) {
        for (int i = 0; i < 200; ++i) {
          ShapeSample on;
          if (!shape->sample_part(part, Vector3f(placement.point({1, 2, 3})), random.square(), on)) continue;
          const float size = glm::length(shape->bounds().diagonal());
          const Vector3f across = glm::normalize(glm::cross(on.normal, Vector3f(0.3f, 0.5f, -0.8f)));
          const Vector3f places[] = {on.position, on.position + 1e-6f * size * on.normal,
                                     on.position + 2 * size * across, on.position + 1e6f * size * on.normal,
                                     on.position + 1e6f * size * across};
          for (const Vector3f& from : places) {
            ShapeSample sample;
            if (!shape->sample_part(part, from, random.square(), sample)) continue;
            INFO(one.name << " " << part);
            CHECK((sample.pdf > 0 && sample.pdf < 1e31f));
            CHECK(std::isfinite(glm::length(sample.position)));
            CHECK(std::abs(glm::length(sample.normal) - 1) < 1e-5f);
            CHECK((sample.position_error >= 0 && sample.position_error < 1e-3f * size + 1e-6f));
          }
        }
      }
    }
  }
}

TEST_CASE("along_u and along_v are how the position changes with uv", "[shapes][contract]") {
  Random random(4);
  std::vector<Case> all = cases();
  all.push_back({"plane", [](const Transform& m) { return make_plane({0.1, 0, 0}, {0.3, 1, 0.2}, m); }});
  for (const Case& one : all) {
    for (const Transform& placement : {Transform{}, sheared(1, {0.3, 0, 0})}) {
      const auto shape = one.make(placement);
      for (int i = 0; i < 300; ++i) {
        const auto local = [&] { return Vector3d(random.in(-2, 2), random.in(-2, 2), random.in(-2, 2)); };
        const Vector3f from(placement.point(local()));
        const Ray3f ray = ray_to(from, Vector3f(placement.point(0.25 * local())));
        Hit hit, other;
        if (!shape->is_hit(ray, hit)) continue;
        const SurfacePoint point = shape->surface_at(ray, hit);
        const SurfaceDetail detail = shape->detail_at(ray, hit);
        Ray3f beside = ray;
        beside.direction += 1e-3f * Vector3f(0.5 * local());
        if (!shape->is_hit(beside, other) || other.primitive != hit.primitive) continue;
        const Vector3f moved = shape->surface_at(beside, other).position - point.position;
        const Vector2f grown = shape->detail_at(beside, other).uv - detail.uv;
        if (glm::length(grown) > 0.02f || glm::length(moved) > 0.02f) continue;  // over the seam, an edge
        const Vector3f told = grown.x * detail.along_u + grown.y * detail.along_v;
        INFO(one.name << " " << hit.primitive);
        CHECK(glm::length(told - moved) < 0.1f * glm::length(moved) + 1e-5f);
      }
    }
  }
}
