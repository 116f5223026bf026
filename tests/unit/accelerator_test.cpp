// The tree over the shapes against the plain list of them.
#include "scene/accelerator.hpp"

#include <cmath>
#include <cstdint>
#include <numeric>
#include <random>
#include <vector>

#include "catch.hpp"
#include "raytracer/shapes.hpp"
#include "scene/shape_list.hpp"

using namespace raytracer;

namespace {

using Shapes = std::vector<std::unique_ptr<Shape>>;

/// Uniform numbers that are the same with every standard library.
class Random {
 public:
  explicit Random(std::uint32_t seed) : engine_(seed) {}
  double in(double low, double high) { return low + (high - low) * static_cast<double>(engine_()) * 0x1p-32; }
  int below(int count) { return static_cast<int>(engine_() % static_cast<std::uint32_t>(count)); }
  Vector3d vector(double half) { return {in(-half, half), in(-half, half), in(-half, half)}; }
  Vector3d unit() {
    for (;;) {
      const Vector3d v = vector(1);
      if (glm::length(v) > 0.1 && glm::length(v) < 1) return glm::normalize(v);
    }
  }

 private:
  std::mt19937 engine_;
};

constexpr int kKinds = 11;

std::unique_ptr<Shape> make_any(int kind, Random& random, const Transform& placed) {
  const Vector3d at = random.vector(5), a = random.unit(), b = random.unit();
  const double r = random.in(0.2, 1.5);
  switch (kind) {
    case 0:
      return make_sphere(at, r, placed);
    case 1:
      return make_quad(at, r * a, 2.0 * b, placed);
    case 2:
      return make_triangle(at, at + 2.0 * a, at + 2.0 * b, placed);
    case 3:
      return make_cube(at, Vector3d(r, 1, 0.5), placed);
    case 4:
      return make_plane(4.0 * at, a, placed);
    case 5:
      return make_disk(at, a, r, placed);
    case 6:
      return make_cylinder(at, at + 2.0 * a, 0.5 * r, false, placed);
    case 7:
      return make_cylinder(at, at + 2.0 * a, 0.5 * r, true, placed);
    case 8:
      return make_cone(at, r, at + 2.0 * a, 0.2, false, placed);
    case 9:
      return make_cone(at, r, at + 2.0 * a, 0, true, placed);
    default:
      return make_torus(at, a, r, 0.3 * r, placed);
  }
}

/// Shapes of all kinds, some stretched, some mirrored; `copies` of each stand in exactly the same place.
Shapes random_mix(int count, int copies, std::uint32_t seed) {
  Shapes shapes;
  for (int copy = 0; copy < copies; ++copy) {
    Random random(seed);
    for (int i = 0; i < count; ++i) {
      Transform placed;
      if (random.below(2) == 0) {
        for (int k = 0; k < 3; ++k) placed.linear[k] *= random.in(0.5, 1.5) * (random.below(4) == 0 ? -1 : 1);
        placed.translation = random.vector(1);
      }
      // Planes are rare, or nothing else would be seen.
      const int kind = random.below(kKinds);
      shapes.push_back(make_any(kind == 4 && random.below(4) != 0 ? 0 : kind, random, placed));
    }
  }
  return shapes;
}

ShapeList list_of(const Shapes& shapes) {
  std::vector<const Shape*> pointers;
  for (const auto& shape : shapes) pointers.push_back(shape.get());
  std::vector<std::uint32_t> indices(shapes.size());
  std::iota(indices.begin(), indices.end(), 0U);
  return {pointers, indices};
}

/// Any ray, or one that skims the tree's boxes: along an axis, with a short stretch, with a direction of
/// another length.
Ray3f random_ray(Random& random, const std::vector<Vector3f>& starts) {
  Ray3f ray{Vector3f(random.vector(8)), Vector3f(random.unit())};
  if (!starts.empty() && random.below(3) == 0) {
    ray.origin = starts[static_cast<std::size_t>(random.below(static_cast<int>(starts.size())))];
  }
  switch (random.below(6)) {
    case 0:
      ray.direction = {0, random.below(2) == 0 ? 1 : -1, 0};
      break;
    case 1:
      ray.t_max = static_cast<float>(random.in(0.1, 6));
      break;
    case 2:
      ray.direction *= static_cast<float>(std::exp(random.in(-7, 7)));
      break;
    case 3:
      ray.t_min = static_cast<float>(random.in(0, 4));
      break;
    default:
      break;
  }
  return ray;
}

struct Counts {
  int rays = 0, hits = 0, different = 0, differently_occluded = 0;
};

Counts compare(const Shapes& shapes, int rays, std::uint32_t seed) {
  const Accelerator accelerator(shapes);
  const ShapeList list = list_of(shapes);
  Random random(seed);
  std::vector<Vector3f> starts;  // points on surfaces, where reflected and shadow rays start
  Counts counts;
  for (; counts.rays < rays; ++counts.rays) {
    const Ray3f ray = random_ray(random, starts);
    Hit hit, expected;
    const bool is_hit = accelerator.is_hit(ray, hit), is_expected = list.is_hit(ray, expected);
    if (is_expected) {
      ++counts.hits;
      if (starts.size() < 1000) starts.push_back(shapes[expected.shape]->surface_at(ray, expected).position);
    }
    const bool same =
        is_hit == is_expected &&
        (!is_hit || (hit.t == expected.t && hit.shape == expected.shape &&
                     hit.primitive == expected.primitive && hit.u == expected.u && hit.v == expected.v));
    if (!same) {
      ++counts.different;
      UNSCOPED_INFO("ray " << counts.rays << " finds shape " << hit.shape << " at " << hit.t << ", not "
                           << expected.shape << " at " << expected.t);
    }
    if (accelerator.is_occluded(ray) != is_expected || list.is_occluded(ray) != is_expected) {
      ++counts.differently_occluded;
    }
  }
  return counts;
}

void require_same(const Shapes& shapes, int rays, std::uint32_t seed) {
  const Counts counts = compare(shapes, rays, seed);
  CHECK(counts.hits > counts.rays / 10);
  CHECK(counts.hits < counts.rays);
  CHECK(counts.different == 0);
  CHECK(counts.differently_occluded == 0);
}

}  // namespace

TEST_CASE("tree and list find the same among all kinds of shapes", "[accelerator]") {
  for (std::uint32_t seed = 1; seed <= 10; ++seed) {
    DYNAMIC_SECTION("mix " << seed) { require_same(random_mix(60, 1, seed), 10000, 100 + seed); }
  }
}

TEST_CASE("tree and list find the same in a crowd and in a small company", "[accelerator]") {
  SECTION("many") { require_same(random_mix(700, 1, 50), 3000, 51); }
  for (int count = 1; count <= 6; ++count) {
    // The first numbers of the seed make the first shape a plane now and then: then every second ray hits.
    DYNAMIC_SECTION(count << " shapes") {
      const Counts counts = compare(random_mix(count, 1, 60 + static_cast<std::uint32_t>(count)), 3000, 61);
      CHECK(counts.different == 0);
      CHECK(counts.differently_occluded == 0);
    }
  }
}

TEST_CASE("among coincident shapes the first wins", "[accelerator]") {
  for (std::uint32_t seed = 1; seed <= 4; ++seed) {
    const int count = 30;
    const Shapes shapes = random_mix(count, 3, 70 + seed);
    require_same(shapes, 10000, 80 + seed);
    // Two shapes of the first copy hardly ever meet a ray at the same float: the winner is one of the first.
    const Accelerator accelerator(shapes);
    Random random(90 + seed);
    for (int i = 0; i < 2000; ++i) {
      Hit hit;
      if (accelerator.is_hit(random_ray(random, {}), hit))
        REQUIRE(hit.shape < static_cast<std::uint32_t>(count));
    }
  }
}

TEST_CASE("between a plane and a flat shape in it the first wins, whichever it is", "[accelerator]") {
  for (const bool plane_first : {false, true}) {
    Shapes shapes;
    const auto add_plane = [&] { shapes.push_back(make_plane(Vector3d(0), Vector3d(0, 1, 0))); };
    if (plane_first) add_plane();
    shapes.push_back(make_quad(Vector3d(-5, 0, -5), Vector3d(0, 0, 10), Vector3d(10, 0, 0)));
    shapes.push_back(make_disk(Vector3d(0), Vector3d(0, 1, 0), 5));
    if (!plane_first) add_plane();
    const Accelerator accelerator(shapes);
    Random random(3);
    for (int i = 0; i < 1000; ++i) {
      Hit hit;
      const Ray3f ray{Vector3f(random.in(-1, 1), random.in(0.5, 1), random.in(-1, 1)),
                      Vector3f(random.in(-1, 1), -1, random.in(-1, 1))};
      REQUIRE(accelerator.is_hit(ray, hit));
      REQUIRE(hit.shape == 0);
    }
    require_same(shapes, 2000, 4);
  }
}

TEST_CASE("shapes that share their edges leave no gap, and the tree agrees on whose the edge is",
          "[accelerator]") {
  // A chessboard of quads, looked at exactly through its corners and edges.
  Shapes shapes;
  for (int x = -4; x < 4; ++x) {
    for (int z = -4; z < 4; ++z) {
      shapes.push_back(make_quad(Vector3d(x, 0, z), Vector3d(0, 0, 1), Vector3d(1, 0, 0)));
    }
  }
  const Accelerator accelerator(shapes);
  const ShapeList list = list_of(shapes);
  for (int x = -8; x <= 8; ++x) {
    for (int z = -8; z <= 8; ++z) {
      const Ray3f ray{{0.5f * static_cast<float>(x), 2, 0.5f * static_cast<float>(z)}, {0, -1, 0}};
      Hit hit, expected;
      REQUIRE(accelerator.is_hit(ray, hit));
      REQUIRE(list.is_hit(ray, expected));
      REQUIRE(hit.shape == expected.shape);
      REQUIRE(hit.t == expected.t);
    }
  }
}

TEST_CASE("nothing is hit where nothing is", "[accelerator]") {
  const Accelerator empty{Shapes{}};
  Hit hit;
  hit.shape = 77;
  REQUIRE_FALSE(empty.is_hit({Vector3f(0), Vector3f(0, 0, -1)}, hit));
  REQUIRE_FALSE(empty.is_occluded({Vector3f(0), Vector3f(0, 0, -1)}));
  REQUIRE(hit.shape == 77);
}
