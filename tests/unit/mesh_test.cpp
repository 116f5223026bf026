// Triangles by the million: their buffers, normals, surfaces, and the tree over them.
#include "shapes/mesh.hpp"

#include <array>
#include <cmath>
#include <cstdlib>
#include <random>
#include <vector>

#include "catch.hpp"
#include "core/numeric.hpp"
#include "make_meshes.hpp"
#include "raytracer/error.hpp"
#include "raytracer/shapes.hpp"
#include "scene/accelerator.hpp"
#include "scene/shape_list.hpp"

using namespace raytracer;

namespace {

using Shapes = std::vector<std::unique_ptr<Shape>>;

class Random {
 public:
  explicit Random(std::uint32_t seed) : engine_(seed) {}
  double in(double low, double high) { return low + (high - low) * static_cast<double>(engine_()) * 0x1p-32; }
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

bool is_near(double found, double wanted, double relative = 1e-5) {
  return std::abs(found - wanted) <= relative * std::abs(wanted);
}

Transform random_place(Random& random) {
  Transform place;
  const Vector3d x = random.unit(), y = glm::normalize(glm::cross(x, random.unit()));
  place.linear = {random.in(0.5, 2) * x, random.in(0.5, 2) * y, random.in(-2, -0.5) * glm::cross(x, y)};
  place.translation = random.vector(3);
  return place;
}

/// Both sides of a triangle's hit in one number: how far t may differ.
bool agrees(const Hit& p, const Hit& q) { return std::abs(p.t - q.t) <= 2e-5f * std::abs(p.t); }

struct Counts {
  int hits = 0, differences = 0;
};

/// How often list, single rays and packets disagree by more than the last bits.
Counts compare(const Shapes& shapes, int count, std::uint32_t seed) {
  std::vector<const Shape*> pointers;
  std::vector<std::uint32_t> indices;
  for (std::uint32_t i = 0; i < shapes.size(); ++i) {
    pointers.push_back(shapes[i].get());
    indices.push_back(i);
  }
  const ShapeList list(pointers, indices);
  const Accelerator tree(shapes);
  Random random(seed);
  Counts counts;
  for (int i = 0; i < count; i += static_cast<int>(kMostRays)) {
    RayBlock rays;
    HitBlock packet;
    for (int k = 0; k < kBlockSize; ++k) {
      const Vector3f origin(random.vector(6));
      rays.set(k, {origin, Vector3f(random.vector(3)) - origin});
    }
    const Coherence coherence = i % 32 == 0 ? Coherence::kCoherent : Coherence::kIncoherent;
    const BlockMask all = BlockMask::first(kBlockSize);
    const BlockMask found = tree.is_hit(rays, all, packet, coherence);
    const BlockMask hidden = tree.is_occluded(rays, all, coherence);
    for (int k = 0; k < kBlockSize; ++k) {
      const Ray3f ray = rays.ray(k);
      Hit by_list, by_tree;
      const bool in_list = list.is_hit(ray, by_list), in_tree = tree.is_hit(ray, by_tree);
      const Hit in_lane = found.has(k) ? packet.at(k) : Hit{};
      counts.hits += in_list;
      const bool same =
          in_list == in_tree && in_list == found.has(k) && in_list == hidden.has(k) &&
          in_list == tree.is_occluded(ray) &&
          (!in_list || (agrees(by_list, by_tree) && agrees(by_list, in_lane) &&
                        by_list.shape == by_tree.shape && by_list.shape == in_lane.shape &&
                        by_list.primitive == by_tree.primitive && by_list.primitive == in_lane.primitive));
      counts.differences += !same;
    }
  }
  return counts;
}

/// How many rays from inside of the closed mesh leave it.
int escaping(const MeshData& mesh, double scale, const Vector3d& away, int count) {
  Shapes shapes;
  shapes.push_back(make_mesh(mesh, {glm::dmat3(scale), scale * away}));
  const Accelerator tree(shapes);
  Random random(3);
  int escaped = 0;
  RayBlock rays;
  HitBlock hits;
  Hit ignored;
  const auto& data = shapes[0]->as_mesh()->data();
  for (int i = 0; i < count; i += static_cast<int>(kMostRays)) {
    for (int k = 0; k < kBlockSize; ++k) {
      Vector3d direction = random.unit();
      const Vector3f origin(scale * (random.vector(0.2) + away));
      // Half of them at edges.
      const std::size_t corner = static_cast<std::size_t>(random.in(0, 3 * double(data.triangles.size())));
      const auto& t = data.triangles[corner / 3];
      const Vector3d p(data.positions[t[corner % 3]]), q(data.positions[t[(corner + 1) % 3]]);
      if (k % 2 == 0) direction = p + random.in(0, 1) * (q - p) - Vector3d(origin);
      rays.set(k, {origin, Vector3f(direction)});
    }
    if (i % 32 == 0) {
      for (int k = 0; k < kBlockSize; ++k) escaped += !tree.is_hit(rays.ray(k), ignored);
    } else {
      const BlockMask all = BlockMask::first(kBlockSize);
      escaped += kBlockSize - tree.is_hit(rays, all, hits, Coherence::kIncoherent).count();
    }
  }
  return escaped;
}

}  // namespace

TEST_CASE("list, single rays and packets see the same of meshes", "[mesh]") {
  Shapes shapes;
  Random random(1);
  shapes.push_back(make_mesh(rugged_mesh(3), random_place(random)));
  shapes.push_back(make_sphere(Vector3d(2, 0, 0), 0.7));
  shapes.push_back(make_mesh(cube_mesh(), random_place(random)));
  shapes.push_back(make_mesh(ball_mesh(2), random_place(random)));
  shapes.push_back(make_cube(Vector3d(0, -4, 0), Vector3d(3, 0.2, 3)));
  const Counts counts = compare(shapes, 20000, 2);
  CHECK(counts.hits > 8000);
  // Two triangles that meet at an edge may each be the one that is hit there.
  CHECK(counts.differences <= counts.hits / 2000);
}

TEST_CASE("meshes in instances are found with their own numbers", "[mesh]") {
  Shapes inside;
  inside.push_back(make_sphere(Vector3d(0, 0, 0), 0.5));
  inside.push_back(make_mesh(cube_mesh()));
  inside.push_back(make_sphere(Vector3d(0, 3, 0), 0.5));
  SceneDescription scene;
  scene.materials.resize(3);
  scene.materials[2].color = Color3f(1, 0, 0);
  scene.shared.push_back(std::make_shared<const SharedShapes>(
      std::move(inside), std::vector<std::uint32_t>{0, 1, 0}, std::vector<Material>(2)));
  scene.shapes.push_back(make_mesh(cube_mesh(), {glm::dmat3(1.0), Vector3d(0, 0, -40)}));
  scene.material_of.push_back(0);
  glm::mat3 mirrored(2.0f);
  mirrored[0] = -mirrored[0];
  scene.instances = {{0, glm::mat3(1), Vector3f(10, 0, 0)}, {0, mirrored, Vector3f(-10, 0, 0)}};
  const Scene made(std::move(scene));

  const auto first_hit = [&](const Ray3f& ray) {
    Hit hit;
    REQUIRE(made.is_hit(ray, hit));
    return hit;
  };
  const Hit own = first_hit({{0.5f, 0.2f, 0}, {0, 0, -1}});
  CHECK(own.instance == kNoInstance);
  CHECK(own.shape == 0);
  CHECK(own.t == 39);
  const Ray3f ray{{-20, 0.5f, 0.25f}, {1, 0, 0}};
  const Hit hit = first_hit(ray);
  CHECK(hit.instance == 1);
  CHECK(hit.shape == 1);
  CHECK((hit.primitive == 10 || hit.primitive == 11));  // the mirrored +x face
  CHECK(is_near(hit.t, 8));
  const SurfacePoint point = made.surface_at(ray, hit);
  CHECK(point.normal == Vector3f(-1, 0, 0));
  CHECK(glm::length(point.position - Vector3f(-12, 0.5f, 0.25f)) < 1e-5f);
  const Hit ball = first_hit({{10, 20, 0.1f}, {0, -1, 0}});
  CHECK(ball.instance == 0);
  CHECK(ball.shape == 2);
}

TEST_CASE("no ray leaves a closed mesh from inside", "[mesh]") {
  // RAYTRACER_RAYS asks for more of them: this many at each scale.
  const char* wanted = std::getenv("RAYTRACER_RAYS");
  const int count = wanted != nullptr ? std::atoi(wanted) : 20000;
  const MeshData mesh = rugged_mesh(wanted != nullptr ? 7 : 5);
  for (const double scale : {1e-3, 1.0, 1e3, 1e6}) {
    for (const double away : {0.0, 30.0, 1000.0}) {
      INFO("scale " << scale << ", " << away << " sizes away");
      CHECK(escaping(mesh, scale, away * glm::normalize(Vector3d(1, -2, 0.5)), count) == 0);
    }
  }
}

TEST_CASE("a ray that leaves a mesh does not meet the triangle it comes from", "[mesh]") {
  Random random(11);
  for (const double away : {0.0, 100.0}) {
    Shapes shapes;
    shapes.push_back(make_mesh(ball_mesh(4), {glm::dmat3(1.0), Vector3d(away, 0, away)}));
    const Accelerator tree(shapes);
    int met = 0, hits = 0;
    for (int i = 0; i < 50000; ++i) {
      Ray3f ray;
      ray.origin = Vector3f(3.0 * random.unit() + Vector3d(away, 0, away));
      ray.direction = Vector3f(random.vector(1) + Vector3d(away, 0, away)) - ray.origin;
      Hit hit, again;
      if (!tree.is_hit(ray, hit)) continue;
      ++hits;
      const SurfacePoint point = shapes[0]->surface_at(ray, hit);
      const Vector3d n(point.normal), across = glm::normalize(glm::cross(n, random.unit()));
      const Vector3f direction(across + std::pow(10.0, random.in(-7, 0)) * n);
      met += tree.is_hit({point.position + point.position_error * point.normal, direction}, again);
    }
    CHECK(hits > 10000);
    CHECK(met == 0);
  }
}

TEST_CASE("a mirror leaves the outside of a mesh outside", "[mesh]") {
  glm::dmat3 mirror(1.0);
  mirror[1] = -mirror[1];
  for (const bool flip : {false, true}) {
    MeshOptions options;
    options.flip = flip;
    options.smooth = 80;
    const auto mesh = make_mesh(cube_mesh(), {mirror, Vector3d(0)}, options);
    const Ray3f ray{{0.2f, 0.3f, 5}, {0, 0, -1}};
    Hit hit;
    REQUIRE(mesh->is_hit(ray, hit));
    const SurfacePoint point = mesh->surface_at(ray, hit);
    CHECK(point.normal == Vector3f(0, 0, flip ? -1 : 1));
    CHECK(point.shading_normal == point.normal);
  }
}

TEST_CASE("recenter and fit", "[mesh]") {
  MeshData data = cube_mesh();
  for (Vector3f& p : data.positions) p = p * Vector3f(2, 1, 0.5f) + Vector3f(10, 0, 0);
  MeshOptions options;
  options.fit = 8;
  CHECK(is_near(make_mesh(data, {}, options)->bounds().lower.x, 16));
  options.recenter = true;
  const Box3f box = make_mesh(data, {glm::dmat3(1.0), Vector3d(0, 1, 0)}, options)->bounds();
  CHECK(is_near(box.lower.x, -4));
  CHECK(is_near(box.upper.x, 4));
  CHECK(is_near(box.lower.y, -1));
  CHECK(is_near(box.upper.z, 1));
}

TEST_CASE("smooth normals split at creases", "[mesh]") {
  MeshData cube = cube_mesh();
  MeshOptions options;
  options.smooth = 80;
  prepare_mesh(cube, options);
  CHECK(cube.positions.size() == 24);  // each corner once per face
  for (const auto& t : cube.triangles) {
    const Vector3f across = glm::normalize(
        glm::cross(cube.positions[t[1]] - cube.positions[t[0]], cube.positions[t[2]] - cube.positions[t[0]]));
    for (const std::uint32_t vertex : t) CHECK(glm::length(cube.normals[vertex] - across) < 1e-6f);
  }
  MeshData round = cube_mesh();
  options.smooth = 100;
  prepare_mesh(round, options);
  CHECK(round.positions.size() == 8);
  // Weighted by angle, a corner of the cube looks along its diagonal however its faces are cut.
  for (std::size_t i = 0; i < 8; ++i)
    CHECK(glm::length(round.normals[i] - glm::normalize(round.positions[i])) < 1e-6f);

  MeshData ball = ball_mesh(4);
  options.smooth = 30;
  prepare_mesh(ball, options);
  CHECK(ball.positions.size() == ball_mesh(4).positions.size());
  for (std::size_t i = 0; i < ball.positions.size(); ++i)
    CHECK(glm::length(ball.normals[i] - glm::normalize(ball.positions[i])) < 0.02f);
}

TEST_CASE("vertices at the same place share their normal", "[mesh]") {
  MeshData soup;
  const MeshData ball = ball_mesh(2);
  for (const auto& t : ball.triangles) {
    const auto first = static_cast<std::uint32_t>(soup.positions.size());
    for (const std::uint32_t vertex : t) soup.positions.push_back(ball.positions[vertex]);
    soup.triangles.push_back({first, first + 1, first + 2});
  }
  MeshOptions options;
  options.smooth = 40;
  prepare_mesh(soup, options);
  for (std::size_t i = 0; i < soup.positions.size(); ++i)
    CHECK(glm::length(soup.normals[i] - glm::normalize(soup.positions[i])) < 0.05f);
}

TEST_CASE("many equal triangles take no quadratic time", "[mesh]") {
  MeshData pile;
  pile.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  pile.triangles.assign(100000, {0, 1, 2});
  MeshOptions options;
  options.smooth = 60;
  prepare_mesh(pile, options);
  CHECK(pile.positions.size() == 3);
  CHECK(glm::length(pile.normals[0] - Vector3f(0, 0, 1)) < 1e-5f);
}

TEST_CASE("what a mesh says of a point", "[mesh]") {
  MeshData data;
  data.positions = {{0, 0, 0}, {2, 0, 0}, {0, 4, 0}};
  data.uvs = {{0, 0}, {1, 0}, {0, 1}};
  data.colors = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  data.triangles = {{0, 1, 2}};
  const auto mesh = make_mesh(data);
  const Ray3f ray{{0.5f, 1, 3}, {0, 0, -1}};
  Hit hit;
  REQUIRE(mesh->is_hit(ray, hit));
  CHECK(hit.t == 3);
  const SurfaceDetail detail = mesh->detail_at(ray, hit);
  CHECK(detail.uv == Vector2f(0.25f, 0.25f));
  CHECK(detail.along_u == Vector3f(2, 0, 0));
  CHECK(detail.along_v == Vector3f(0, 4, 0));
  CHECK(detail.color == Color3f(0.5f, 0.25f, 0.25f));
  const SurfacePoint point = mesh->surface_at(ray, hit);
  CHECK(point.shading_normal == point.normal);
  CHECK(point.shadow_offset == Vector3f(0));
}

TEST_CASE("a smooth mesh is not shadowed by its own facets", "[mesh]") {
  // The ball of n segments: inside of the smooth terminator its facets may only shade a band of 180 / n
  // degrees.
  MeshOptions options;
  options.smooth = 180;
  Shapes shapes;
  shapes.push_back(make_mesh(ball_mesh(3), {}, options));  // 32 segments around
  const Accelerator tree(shapes);
  Random random(5);
  const double band = std::sin(kPi / 32);
  int lit = 0, dark = 0, dark_without = 0;
  for (int i = 0; i < 40000; ++i) {
    const Vector3d from = random.unit();
    const Ray3f ray{Vector3f(4.0 * from), Vector3f(random.vector(0.7) - 4.0 * from)};
    Hit hit, ignored;
    if (!tree.is_hit(ray, hit)) continue;
    const SurfacePoint point = shapes[0]->surface_at(ray, hit);
    const Vector3d light = random.unit();
    if (glm::dot(light, Vector3d(point.shading_normal)) < band) continue;
    ++lit;
    const Vector3f start = point.position + point.position_error * point.normal;
    dark_without += tree.is_hit({start, Vector3f(light)}, ignored);
    dark += tree.is_hit({start + point.shadow_offset, Vector3f(light)}, ignored);
  }
  CHECK(lit > 5000);
  CHECK(dark_without > 5);
  CHECK(dark == 0);
}

TEST_CASE("triangles that shine are sampled as they say", "[mesh]") {
  MeshData data;
  data.positions = {{0, 0, 0}, {2, 0, 0}, {0, 1, 0.5f}};
  data.triangles = {{0, 1, 2}};
  const auto mesh = make_mesh(data);
  REQUIRE(mesh->part_count() == 1);
  Random random(9);
  for (const Vector3f& from : {Vector3f(0.5f, 0.3f, 1), Vector3f(1, 1, -0.2f), Vector3f(90, 20, 80)}) {
    // The mean of 1/pdf is the solid angle; that of any function / pdf its integral, here cosine / distance²
    // over the area.
    double angle = 0, by_area = 0;
    constexpr int kCount = 20000;
    const Vector3d a(data.positions[0]), ab = Vector3d(data.positions[1]) - a,
                                         ac = Vector3d(data.positions[2]) - a,
                                         n = glm::normalize(glm::cross(ab, ac));
    const double area = 0.5 * glm::length(glm::cross(ab, ac));
    int off = 0;
    for (int i = 0; i < kCount; ++i) {
      const Vector2f u(random.in(0, 1), random.in(0, 1));
      ShapeSample sample;
      REQUIRE(mesh->sample_part(0, from, u, sample));
      angle += 1 / static_cast<double>(sample.pdf) / kCount;
      SurfacePoint point;
      point.position = sample.position;
      off += std::abs(mesh->part_pdf(0, from, point) / sample.pdf - 1) > 1e-4f;
      const double root = std::sqrt(random.in(0, 1)), v = random.in(0, 1);
      const Vector3d d = a + root * (1 - v) * ab + root * v * ac - Vector3d(from);
      by_area += area * std::abs(glm::dot(n, d)) / std::pow(glm::dot(d, d), 1.5) / kCount;
      const Vector3d off_plane = Vector3d(sample.position) - a;
      off += std::abs(glm::dot(off_plane, n)) > 1e-6;
    }
    CHECK(off == 0);
    CHECK(is_near(angle, by_area, 0.02));
  }
  ShapeSample sample;
  CHECK_FALSE(mesh->sample_part(0, Vector3f(5, 0, 0), Vector2f(0.5f), sample));
}

TEST_CASE("the directions to a shining triangle are spread evenly", "[mesh]") {
  MeshData data;
  data.positions = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  data.triangles = {{0, 1, 2}};
  const auto mesh = make_mesh(data);
  // Seen from the origin it is an eighth of the sphere: each axis' mean is 1/2 (of a unit vector over an
  // octant).
  Vector3d mean(0.0);
  for (int i = 0; i < 64; ++i) {
    for (int k = 0; k < 64; ++k) {
      ShapeSample sample;
      REQUIRE(mesh->sample_part(0, Vector3f(0), {(float(i) + 0.5f) / 64, (float(k) + 0.5f) / 64}, sample));
      CHECK(is_near(sample.pdf, 2 / kPi, 1e-5));
      mean += glm::normalize(Vector3d(sample.position)) / 4096.0;
    }
  }
  for (int axis = 0; axis < 3; ++axis) CHECK(is_near(mean[axis], 0.5, 1e-3));
}

TEST_CASE("display colours become linear where they are asked to", "[mesh]") {
  MeshData data = cube_mesh();
  data.colors.assign(8, Color3f(0.5f));
  MeshOptions options;
  options.linear_colors = true;
  MeshData linear = data, display = data;
  prepare_mesh(linear, options);
  CHECK(linear.colors[0] == Color3f(0.5f));  // they were linear before
  display.has_display_colors = true;
  prepare_mesh(display, options);
  CHECK(is_near(display.colors[0].x, 0.21404, 1e-4));
}

TEST_CASE("numbers that make no mesh are refused", "[mesh]") {
  MeshData data = cube_mesh();
  data.triangles.push_back({0, 1, 8});
  CHECK_THROWS_AS(make_mesh(data), Error);
  data = cube_mesh();
  data.positions[3].y = NAN;
  CHECK_THROWS_AS(make_mesh(data), Error);
  CHECK(make_mesh(MeshData{})->bounds().is_empty());
}
