// Shared shapes in many places against the same shapes built in each.
#include <bit>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include "catch.hpp"
#include "raytracer/error.hpp"
#include "raytracer/scene.hpp"
#include "raytracer/shapes.hpp"

namespace {

using namespace raytracer;

class Random {
 public:
  double in(double low, double high) {
    return low + (high - low) * static_cast<double>(engine_() >> 11) * 0x1p-53;
  }
  Vector3d in_box(double half) { return {in(-half, half), in(-half, half), in(-half, half)}; }
  Vector3d unit() {
    for (;;) {
      const Vector3d v = in_box(1);
      if (glm::length(v) > 0.1 && glm::length(v) < 1) return glm::normalize(v);
    }
  }
  glm::dmat3 rotation() {
    const Vector3d x = unit(), y = glm::normalize(glm::cross(x, unit()));
    return {x, y, glm::cross(x, y)};
  }

 private:
  std::mt19937_64 engine_{11};
};

constexpr std::uint32_t kKinds = 4;

// All convex: outside of them nothing shadows itself.
std::unique_ptr<Shape> make_kind(std::uint32_t kind, const Transform& placed = {}) {
  switch (kind) {
    case 0:
      return make_sphere({0.2, -0.3, 0.1}, 0.7, placed);
    case 1:
      return make_cube({-0.2, 0.1, 0}, {1, 0.6, 0.8}, placed);
    case 2:
      return make_quad({-0.5, -0.2, -0.5}, {1, 0.1, 0}, {0, 0.3, 1}, placed);
    default:
      return make_cylinder({0, -0.5, 0}, {0.1, 0.5, 0}, 0.4, false, placed);
  }
}

std::shared_ptr<const SharedShapes> share(std::vector<std::unique_ptr<Shape>> shapes) {
  std::vector<std::uint32_t> material_of(shapes.size(), 0);
  return std::make_shared<const SharedShapes>(std::move(shapes), std::move(material_of),
                                              std::vector<Material>(1));
}

std::shared_ptr<const SharedShapes> share_kind(std::uint32_t kind) {
  std::vector<std::unique_ptr<Shape>> shapes;
  shapes.push_back(make_kind(kind));
  return share(std::move(shapes));
}

void add_own(SceneDescription& scene, std::unique_ptr<Shape> shape) {
  scene.shapes.push_back(std::move(shape));
  scene.material_of.push_back(0);
}

Instance instance_of(std::uint32_t shared, const Transform& to_world) {
  return {shared, glm::mat3(to_world.linear), Vector3f(to_world.translation)};
}

// What an instance holds is single precision; so that the expanded shapes stand at the very same places.
Transform rounded(const glm::dmat3& linear, const Vector3d& translation) {
  Transform result;
  result.linear = glm::dmat3(glm::mat3(linear));
  result.translation = Vector3d(Vector3f(translation));
  return result;
}

// Turned, stretched unevenly, every other one mirrored.
Transform any_place(Random& random, double scale, double distance) {
  const glm::dmat3 turn = random.rotation();
  const Vector3d sides(random.in(0.3, 1), random.in(0.3, 1), random.in(-1, 1) < 0 ? -0.7 : 0.7);
  const glm::dmat3 sized = {scale * sides.x * turn[0], scale * sides.y * turn[1], scale * sides.z * turn[2]};
  return rounded(sized, distance * random.unit());
}

void require_same(const Hit& a, const Hit& b) {
  REQUIRE(std::bit_cast<std::uint32_t>(a.t) == std::bit_cast<std::uint32_t>(b.t));
  REQUIRE(a.shape == b.shape);
  REQUIRE(a.instance == b.instance);
  REQUIRE(a.primitive == b.primitive);
  REQUIRE(std::bit_cast<std::uint32_t>(a.u) == std::bit_cast<std::uint32_t>(b.u));
  REQUIRE(std::bit_cast<std::uint32_t>(a.v) == std::bit_cast<std::uint32_t>(b.v));
}

struct Pair {
  SceneDescription instanced, expanded;
};

constexpr std::uint32_t kPlaces = 12;

// The same shapes twice. The shape of an instance i and shared shape j is number i * kKinds + j where all are
// expanded.
Pair some_places(Random& random) {
  Pair pair;
  std::vector<std::unique_ptr<Shape>> kinds;
  for (std::uint32_t kind = 0; kind < kKinds; ++kind) kinds.push_back(make_kind(kind));
  pair.instanced.shared.push_back(share(std::move(kinds)));
  pair.instanced.materials.resize(1);
  pair.expanded.materials.resize(1);
  for (std::uint32_t i = 0; i < kPlaces; ++i) {
    const Transform place = any_place(random, 1.5, 3);
    pair.instanced.instances.push_back(instance_of(0, place));
    for (std::uint32_t kind = 0; kind < kKinds; ++kind) add_own(pair.expanded, make_kind(kind, place));
  }
  return pair;
}

Ray3f ray_at_middle(Random& random) {
  const Vector3d origin = 6.0 * random.unit();
  return {Vector3f(origin), Vector3f(random.in_box(3) - origin)};
}

// The normal turned towards where the ray comes from.
Vector3f facing(const Vector3f& normal, const Ray3f& ray) {
  return glm::dot(normal, ray.direction) > 0 ? -normal : normal;
}

TEST_CASE("instances are where the same shapes would be") {
  Random random;
  Pair pair = some_places(random);
  const Scene instanced(std::move(pair.instanced)), expanded(std::move(pair.expanded));
  int hits = 0, apart = 0;
  for (int i = 0; i < 20000; ++i) {
    const Ray3f ray = ray_at_middle(random);
    Hit one, other;
    const bool is_hit = instanced.is_hit(ray, one), is_other_hit = expanded.is_hit(ray, other);
    REQUIRE(instanced.is_occluded(ray) == is_hit);
    const bool is_same =
        is_hit == is_other_hit && (!is_hit || one.instance * kKinds + one.shape == other.shape);
    if (!is_same) ++apart;  // past an edge by rounding
    if (!is_same || !is_hit) continue;
    ++hits;
    REQUIRE(std::abs(one.t - other.t) < 1e-4F);
    const SurfacePoint here = instanced.surface_at(ray, one), there = expanded.surface_at(ray, other);
    REQUIRE(glm::length(here.position - there.position) < 2e-4F);
    const Vector3f normal = facing(here.normal, ray);  // a mirror turns over the normal of what has no inside
    REQUIRE(glm::length(normal - facing(there.normal, ray)) < 2e-3F);
    REQUIRE(std::abs(glm::length(here.normal) - 1) < 1e-6F);
  }
  REQUIRE(hits > 5000);
  REQUIRE(apart < 20);
}

TEST_CASE("packets of rays meet instances as rays one by one do") {
  Random random;
  Pair pair = some_places(random);
  add_own(pair.instanced, make_plane({0, -1, 0}, {0, 1, 0}));
  add_own(pair.instanced, make_sphere({0, 0, 1}, 1));
  const Scene scene(std::move(pair.instanced));
  // Outside of the loop: what an earlier packet has left in them must not matter.
  std::vector<Hit> hits(kMostRays);
  std::size_t own = 0, shared = 0;
  for (std::size_t turn = 0; turn < 3000; ++turn) {
    const std::size_t count = 1 + turn % kMostRays;
    const Coherence coherence = turn / 16 % 2 == 0 ? Coherence::kCoherent : Coherence::kIncoherent;
    std::vector<Ray3f> rays(count);
    const Ray3f first = ray_at_middle(random);
    for (Ray3f& ray : rays) {
      ray = ray_at_middle(random);
      if (turn % 3 != 0) ray = {first.origin, first.direction + 0.02F * ray.direction};
      if (random.in(0, 1) < 0.3) ray.t_max = static_cast<float>(random.in(0.2, 1));
    }
    const std::span<Hit> answers = std::span(hits).first(count);
    const std::uint32_t found = scene.is_hit(rays, answers, coherence);
    const std::uint32_t hidden = scene.is_occluded(rays, coherence);
    for (std::size_t i = 0; i < count; ++i) {
      Hit hit;
      const bool is_hit = scene.is_hit(rays[i], hit);
      REQUIRE((found >> i & 1U) == is_hit);
      REQUIRE((hidden >> i & 1U) == is_hit);
      if (!is_hit) continue;
      require_same(answers[i], hit);
      ++(hit.instance == kNoInstance ? own : shared);
    }
  }
  REQUIRE(own > 1000);
  REQUIRE(shared > 1000);
}

TEST_CASE("among equally near hits the scene's own shapes come first, then the lower instance") {
  Random random;
  for (const bool has_own : {false, true}) {
    SceneDescription description;
    description.materials.resize(1);
    description.shared = {share_kind(0), share_kind(0)};
    const Transform place = rounded(glm::dmat3(1), {0.5, 0.25, 0});
    for (const std::uint32_t shared : {1U, 0U, 1U}) description.instances.push_back(instance_of(shared, {}));
    for (const std::uint32_t shared : {0U, 1U}) description.instances.push_back(instance_of(shared, place));
    if (has_own) add_own(description, make_kind(0));
    const Scene scene(std::move(description));
    bool seen[2] = {false, false};
    for (int turn = 0; turn < 500; ++turn) {
      std::vector<Ray3f> rays(kMostRays);
      for (Ray3f& ray : rays) ray = ray_at_middle(random);
      std::vector<Hit> hits(kMostRays);
      const std::uint32_t found = scene.is_hit(rays, hits, Coherence::kCoherent);
      for (std::size_t i = 0; i < kMostRays; ++i) {
        Hit hit;
        REQUIRE((found >> i & 1U) == scene.is_hit(rays[i], hit));
        if ((found >> i & 1U) == 0) continue;
        require_same(hits[i], hit);
        const bool is_first_place = hit.instance == (has_own ? kNoInstance : 0U);
        REQUIRE((is_first_place || hit.instance == 3));
        seen[is_first_place ? 0 : 1] = true;
      }
    }
    REQUIRE(seen[0]);
    REQUIRE(seen[1]);
  }
}

TEST_CASE("the box of an instance contains it") {
  Random random;
  for (int turn = 0; turn < 200; ++turn) {
    const Transform place = any_place(random, std::pow(10, random.in(-3, 3)), 100);
    const auto shape = make_kind(static_cast<std::uint32_t>(turn) % kKinds);
    const auto placed = make_kind(static_cast<std::uint32_t>(turn) % kKinds, place);
    const Box3f box = instance_of(0, place).bounds(shape->bounds()), tight = placed->bounds();
    const Vector3f slack = 1e-5F * (tight.upper - tight.lower + glm::abs(tight.lower));
    for (int axis = 0; axis < 3; ++axis) {
      REQUIRE(box.lower[axis] <= tight.lower[axis] + slack[axis]);
      REQUIRE(box.upper[axis] >= tight.upper[axis] - slack[axis]);
    }
  }
}

// A ray that leaves a convex shape from the offset point, away from the surface, must not meet it again.
TEST_CASE("no instance shadows itself") {
  Random random;
  for (const double scale : {1e-3, 1.0, 50.0, 1e6}) {
    for (const double distance : {0.0, 1.0, 30.0, 3000.0}) {
      int hits = 0;
      for (int turn = 0; turn < 40; ++turn) {
        const Transform place = any_place(random, scale, distance * scale);
        SceneDescription description;
        description.materials.resize(1);
        description.shared.push_back(share_kind(static_cast<std::uint32_t>(turn) % kKinds));
        description.instances.push_back(instance_of(0, place));
        const Scene scene(std::move(description));
        for (int i = 0; i < 50; ++i) {
          const Vector3d origin = place.translation + 4 * scale * random.unit();
          const Ray3f ray = {Vector3f(origin),
                             Vector3f(place.translation + random.in_box(0.2 * scale) - origin)};
          Hit hit;
          if (!scene.is_hit(ray, hit)) continue;
          ++hits;
          const SurfacePoint point = scene.surface_at(ray, hit);
          const Vector3f normal = facing(point.normal, ray);
          REQUIRE(point.position_error < 4e-6 * (distance + 2) * scale);
          for (int k = 0; k < 8; ++k) {
            Vector3f away(random.unit());
            if (k >= 4) away -= 0.999F * glm::dot(away, normal) * normal;  // almost along the surface
            if (glm::dot(away, normal) < 0) away = glm::reflect(away, normal);
            const Ray3f leaving = {point.position + point.position_error * normal, away};
            INFO("scale " << scale << " distance " << distance << " kind "
                          << turn % static_cast<int>(kKinds));
            REQUIRE_FALSE(scene.is_occluded(leaving));
          }
        }
      }
      REQUIRE(hits > 300);
    }
  }
}

TEST_CASE("a description whose instances lack their shapes is refused") {
  SceneDescription description;
  description.instances.push_back(instance_of(0, {}));
  REQUIRE_THROWS_AS(Scene(std::move(description)), Error);
}

TEST_CASE("endless shapes and materials that are not there can't be shared") {
  std::vector<std::unique_ptr<Shape>> endless, lacking;
  endless.push_back(make_plane({0, 0, 0}, {0, 1, 0}));
  REQUIRE_THROWS_AS(share(std::move(endless)), Error);
  lacking.push_back(make_kind(0));
  REQUIRE_THROWS_AS(SharedShapes(std::move(lacking), {1}, std::vector<Material>(1)), Error);
}

}  // namespace
