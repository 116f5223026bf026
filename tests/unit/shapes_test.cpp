// Every shape against closed forms: where it is hit, its normals, uv, bounds, and what it refuses.
#include "raytracer/shapes.hpp"

#include <cmath>
#include <string>
#include <vector>

#include "catch.hpp"
#include "raytracer/error.hpp"

namespace {

using namespace raytracer;

Ray3f ray(const Vector3f& origin, const Vector3f& direction) {
  Ray3f result;
  result.origin = origin;
  result.direction = direction;
  return result;
}

/// t of the nearest hit, or -1.
float nearest(const Shape& shape, const Ray3f& along) {
  Hit hit;
  return shape.is_hit(along, hit) ? hit.t : -1;
}

bool is_near(const Vector3f& a, const Vector3f& b, float tolerance = 1e-6f) {
  return glm::length(a - b) <= tolerance;
}

SurfacePoint seen(const Shape& shape, const Ray3f& along) {
  Hit hit;
  REQUIRE(shape.is_hit(along, hit));
  return shape.surface_at(along, hit);
}

/// The surface point nearest to `target` as seen from 1.5 units before it along `outwards`.
SurfacePoint point_at(const Shape& shape, const Vector3f& target, const Vector3f& outwards) {
  return seen(shape, ray(target + 1.5f * outwards, -outwards));
}

/// Its uv.
Vector2f uv_at(const Shape& shape, const Vector3f& target, const Vector3f& outwards) {
  const Ray3f along = ray(target + 1.5f * outwards, -outwards);
  Hit hit;
  REQUIRE(shape.is_hit(along, hit));
  return shape.detail_at(along, hit).uv;
}

/// One row of the tables in the shapes' comments: a point, a way to it from outside, its uv.
struct UvRow {
  Vector3f point, outwards;
  Vector2f uv;
};

void check_uv(const Shape& shape, const std::vector<UvRow>& rows) {
  for (const UvRow& row : rows) {
    const Vector2f uv = uv_at(shape, row.point, row.outwards);
    INFO("point " << row.point.x << " " << row.point.y << " " << row.point.z << ": uv " << uv.x << " "
                  << uv.y);
    CHECK(is_near(point_at(shape, row.point, row.outwards).position, row.point));
    CHECK(glm::length(uv - row.uv) < 1e-6f);
  }
}

/// Whether the bounds are these, but for a few units in the last place.
bool is_bounded(const Shape& shape, const Vector3d& lower, const Vector3d& upper) {
  const Box3f box = shape.bounds();
  bool is_good = true;
  for (int i = 0; i < 3; ++i) {
    const double spare = 1e-6 * std::max(std::abs(lower[i]), std::abs(upper[i]));
    const double below = lower[i] - static_cast<double>(box.lower[i]);
    const double above = static_cast<double>(box.upper[i]) - upper[i];
    is_good = is_good && below >= 0 && below <= spare && above >= 0 && above <= spare;
  }
  return is_good;
}

template <class Make>
std::string refusal(const Make& make) {
  try {
    make();
  } catch (const Error& error) {
    CHECK(error.kind() == ErrorKind::kScene);
    return error.what();
  }
  return "";
}

Transform scaled(const Vector3d& s) { return {glm::dmat3(s.x, 0, 0, 0, s.y, 0, 0, 0, s.z), Vector3d(0)}; }

Transform turned_about_z(double degrees) {
  const double a = degrees * 3.14159265358979323846 / 180;
  return {glm::dmat3(std::cos(a), std::sin(a), 0, -std::sin(a), std::cos(a), 0, 0, 0, 1), Vector3d(0)};
}

const Vector3d kO(0.0), kX(1, 0, 0), kY(0, 1, 0), kZ(0, 0, 1);
const Vector3f x(1, 0, 0), y(0, 1, 0), z(0, 0, 1);
const double kNan = std::nan(""), kInf = HUGE_VAL;

}  // namespace

TEST_CASE("sphere: hits from outside and inside, tangents", "[shapes]") {
  const auto sphere = make_sphere(kO, 1);
  REQUIRE(nearest(*sphere, ray({0, 0, 5}, {0, 0, -1})) == 4);
  REQUIRE(nearest(*sphere, ray({0, 0, 5}, {0, 0, -2})) == 2);
  REQUIRE(nearest(*sphere, ray({0, 0, 0}, {0, 1, 0})) == 1);
  REQUIRE(nearest(*sphere, ray({0, 0, 5}, {0, 0, 1})) == -1);
  REQUIRE(nearest(*sphere, ray({0, 1.001f, 5}, {0, 0, -1})) == -1);
  REQUIRE(is_near(seen(*sphere, ray({0.6f, 0, 5}, {0, 0, -1})).normal, {0.6f, 0, 0.8f}));
  REQUIRE(is_near(seen(*sphere, ray({0, 0, 0}, {0, 0, -1})).normal,
                  {0, 0, -1}));  // outwards seen from inside too
  const float tangent = nearest(*sphere, ray({0, 1, 5}, {0, 0, -1}));
  REQUIRE((tangent == -1 || std::abs(tangent - 5) < 1e-3f));
  const float from_touch = nearest(*sphere, ray({0, 1, 0}, {0, 0, -1}));
  REQUIRE((from_touch == -1 || from_touch < 1e-6f));
}

TEST_CASE("sphere: far away, huge and small", "[shapes]") {
  for (const double scale : {1e-3, 1.0, 1e3, 1e6}) {
    const auto far = make_sphere(Vector3d(0, 0, -1e5 * scale), scale);
    const float s = static_cast<float>(scale);
    REQUIRE(nearest(*far, ray({0, 0.999f * s, 0}, {0, 0, -s})) > 0.99998e5f);
    REQUIRE(nearest(*far, ray({0, 1.001f * s, 0}, {0, 0, -s})) == -1);
  }
  // A planet under one's feet: the ground is where it should be, and the bound follows the place, not the
  // radius.
  const auto planet = make_sphere(Vector3d(0, -1e6, 0), 1e6);
  const Ray3f down = ray({3, 1, 4}, {0, -1, 0});
  const SurfacePoint ground = seen(*planet, down);
  REQUIRE(std::abs(ground.position.y + 25.0f / 2e6f) < 1e-9f);
  REQUIRE(ground.position_error < 1e-8f);
}

TEST_CASE("sphere: uv", "[shapes]") {
  check_uv(*make_sphere(kO, 1), {{x, x, {0, 0.5f}},
                                 {-z, -z, {0.25f, 0.5f}},
                                 {-x, -x, {0.5f, 0.5f}},
                                 {z, z, {0.75f, 0.5f}},
                                 {-y, -y, {0, 0}},
                                 {y, y, {0, 1}}});
}

TEST_CASE("ellipsoid: hits, normal, bounds; mirrored and turned", "[shapes]") {
  const auto ellipsoid = make_sphere(kO, 1, scaled({2, 1, -0.5}));
  REQUIRE(nearest(*ellipsoid, ray({5, 0, 0}, {-1, 0, 0})) == 3);
  REQUIRE(nearest(*ellipsoid, ray({0, 0, 5}, {0, 0, -1})) == 4.5f);
  REQUIRE(is_near(point_at(*ellipsoid, 0.5f * z, z).normal, z));
  const float h = std::sqrt(0.5f);
  const SurfacePoint slanted = seen(*ellipsoid, ray({2 * h, 5, 0}, -y));
  REQUIRE(is_near(slanted.position, {2 * h, h, 0}));
  REQUIRE(is_near(slanted.normal, glm::normalize(Vector3f(0.5f, 1, 0))));
  REQUIRE(is_bounded(*ellipsoid, {-2, -1, -0.5}, {2, 1, 0.5}));
  const auto turned = make_sphere(kO, 1, turned_about_z(45) * scaled({2, 1, 1}));
  const double reach = std::sqrt(2.5);
  REQUIRE(is_bounded(*turned, {-reach, -reach, -1}, {reach, reach, 1}));
  REQUIRE(is_bounded(*make_sphere(kX, 2), {-1, -2, -2}, {3, 2, 2}));
}

TEST_CASE("quad: edges, both sides, uv, mirror", "[shapes]") {
  const auto quad = make_quad(Vector3d(-1, -1, 0), 2.0 * kX, 2.0 * kY);
  REQUIRE(nearest(*quad, ray({0.5f, 0.5f, 3}, -z)) == 3);
  REQUIRE(nearest(*quad, ray({0.5f, 0.5f, -3}, z)) == 3);
  REQUIRE(nearest(*quad, ray({1, 1, 3}, -z)) == 3);
  REQUIRE(nearest(*quad, ray({1.0001f, 0, 3}, -z)) == -1);
  REQUIRE(nearest(*quad, ray({0, 0, 3}, x)) == -1);
  REQUIRE(nearest(*quad, ray({-3, 0, 0}, x)) == -1);  // in its own plane
  REQUIRE(point_at(*quad, Vector3f(0), z).normal == z);
  REQUIRE(point_at(*quad, Vector3f(0), -z).normal == z);
  REQUIRE(is_bounded(*quad, {-1, -1, 0}, {1, 1, 0}));
  check_uv(*quad, {{{-1, -1, 0}, z, {0, 0}},
                   {{1, -1, 0}, z, {1, 0}},
                   {{-1, 1, 0}, z, {0, 1}},
                   {{0, 0, 0}, z, {0.5f, 0.5f}}});
  const auto mirrored = make_quad(Vector3d(-1, -1, 0), 2.0 * kX, 2.0 * kY, scaled({-1, 1, 1}));
  REQUIRE(point_at(*mirrored, Vector3f(0), z).normal == z);  // it faces where its mirror image would
  const auto turned_away = make_quad(Vector3d(-1, -1, 0), 2.0 * kX, 2.0 * kY, scaled({1, 1, -1}));
  REQUIRE(point_at(*turned_away, Vector3f(0), z).normal == -z);
}

TEST_CASE("triangle: corners, uv, normal", "[shapes]") {
  const auto triangle = make_triangle(kO, kX, kY);
  check_uv(*triangle, {{{0, 0, 0}, z, {0, 0}},
                       {x, z, {1, 0}},
                       {y, z, {0, 1}},
                       {{1.0f / 3, 1.0f / 3, 0}, z, {1.0f / 3, 1.0f / 3}}});
  REQUIRE(point_at(*triangle, {0.25f, 0.25f, 0}, z).normal == z);
  REQUIRE(nearest(*triangle, ray({0.51f, 0.51f, 1}, -z)) == -1);
  REQUIRE(nearest(*triangle, ray({-1, 0.25f, 0}, x)) == -1);
  REQUIRE(is_bounded(*triangle, {0, 0, 0}, {1, 1, 0}));
}

TEST_CASE("triangle: no ray slips through the edges of a fan", "[shapes]") {
  const int kSides = 7;
  const Vector3d hub(0.1, 0.2, 0.3);
  for (const double scale : {1e-3, 1.0, 1e6}) {
    std::vector<Vector3d> rim;
    for (int i = 0; i < kSides; ++i) {
      rim.push_back(scale * Vector3d(std::cos(0.9 * i), std::sin(0.9 * i), 0.2 * std::sin(5.0 * i)));
    }
    std::vector<std::unique_ptr<Shape>> fan;
    for (int i = 0; i < kSides; ++i) {
      const Vector3d a = rim[static_cast<std::size_t>(i)],
                     b = rim[static_cast<std::size_t>((i + 1) % kSides)];
      fan.push_back(i % 2 == 0 ? make_triangle(scale * hub, a, b) : make_triangle(b, scale * hub, a));
    }
    int lost = 0;
    for (int i = 0; i < 20000; ++i) {  // rays at points of the inner edges
      const Vector3d end = rim[static_cast<std::size_t>(i % kSides)];
      const double along = (i / kSides) * (0.9 * kSides / 20000);
      const Vector3f target(glm::mix(scale * hub, end, along));
      const Vector3f eye =
          static_cast<float>(scale) * Vector3f(std::sin(0.37f * static_cast<float>(i)), 0.4f, 3.3f);
      bool is_any = false;
      for (const auto& triangle : fan) is_any = is_any || nearest(*triangle, ray(eye, target - eye)) > 0;
      lost += is_any ? 0 : 1;
    }
    REQUIRE(lost == 0);
  }
}

TEST_CASE("cube: faces, inside, along a face", "[shapes]") {
  const auto cube = make_cube(kO, Vector3d(2, 4, 6));
  const Vector3f reach[] = {-x, x, -2.0f * y, 2.0f * y, -3.0f * z, 3.0f * z};
  for (std::uint32_t face = 0; face < 6; ++face) {
    const Vector3f outwards = glm::normalize(reach[face]);
    const Ray3f towards = ray(10.0f * outwards, -outwards);
    Hit hit;
    REQUIRE(cube->is_hit(towards, hit));
    REQUIRE(hit.primitive == face);
    REQUIRE(cube->surface_at(towards, hit).position == reach[face]);
    REQUIRE(cube->surface_at(towards, hit).normal == outwards);
    const Ray3f away = ray(Vector3f(0), outwards);
    REQUIRE(cube->is_hit(away, hit));
    REQUIRE(hit.primitive == face);
    REQUIRE(cube->surface_at(away, hit).normal == outwards);
  }
  REQUIRE(nearest(*cube, ray({2, 0, 10}, -z)) == -1);
  REQUIRE(nearest(*cube, ray({0, 5, 10}, -z)) == -1);
  const float along_face = nearest(*cube, ray({1, 0, 10}, -z));
  REQUIRE((along_face == -1 || along_face == 7));
  REQUIRE(is_bounded(*cube, {-1, -2, -3}, {1, 2, 3}));
}

TEST_CASE("cube: turned, mirrored", "[shapes]") {
  const auto turned = make_cube(kO, Vector3d(2), turned_about_z(45));
  const float r = std::sqrt(2.0f);
  REQUIRE(std::abs(nearest(*turned, ray({5, 0, 0.5f}, -x)) - (5 - r)) < 1e-6f);
  REQUIRE(is_near(seen(*turned, ray({5, 0.1f, 0}, -x)).normal, Vector3f(1, 1, 0) / r));
  REQUIRE(is_bounded(*turned, {-std::sqrt(2.0), -std::sqrt(2.0), -1}, {std::sqrt(2.0), std::sqrt(2.0), 1}));
  const auto mirrored = make_cube(kX, Vector3d(2), scaled({-1, 1, 1}));
  REQUIRE(point_at(*mirrored, {-2, 0.1f, 0}, -x).normal == -x);
  REQUIRE(is_bounded(*mirrored, {-2, -1, -1}, {0, 1, 1}));
}

TEST_CASE("cube: uv, in place and in a frame", "[shapes]") {
  const auto rows = [](const Vector3f& at) {
    std::vector<UvRow> all;
    const auto face = [&](const Vector3f& n, const Vector3f& u, const Vector3f& v) {
      all.push_back({at + n - 0.5f * u - 0.5f * v, n, {0.25f, 0.25f}});
      all.push_back({at + n + 0.5f * u, n, {0.75f, 0.5f}});
    };
    face(-x, z, y);
    face(x, -z, y);
    face(-y, x, z);
    face(y, x, -z);
    face(-z, -x, y);
    face(z, x, y);
    return all;
  };
  check_uv(*make_cube(kX, Vector3d(2)), rows(x));
  // The smallest shear there is makes a frame of it.
  check_uv(*make_cube(kX, Vector3d(2), {glm::dmat3(1, 1e-15, 0, 0, 1, 0, 0, 0, 1), kO}), rows(x));
}

TEST_CASE("plane: both sides, parallel, endless, uv", "[shapes]") {
  const auto plane = make_plane(kY, 7.0 * kY);
  REQUIRE(nearest(*plane, ray({0, 3, 0}, -y)) == 2);
  REQUIRE(nearest(*plane, ray({0, -3, 0}, 2.0f * y)) == 2);
  REQUIRE(nearest(*plane, ray({0, 3, 0}, x)) == -1);
  REQUIRE(nearest(*plane, ray({0, 1, 0}, x)) == -1);  // in the plane
  REQUIRE(nearest(*plane, ray({0, 3, 0}, {1, -1e-6f, 0})) > 1e6f);
  REQUIRE(point_at(*plane, y, -y).normal == y);
  REQUIRE_FALSE(plane->bounds().is_finite());
  check_uv(*make_plane(kO, kY), {{x, y, {1, 0}}, {-z, y, {0, 1}}});
  check_uv(*make_plane(kO, kZ), {{x, z, {1, 0}}, {y, z, {0, 1}}});
  const auto stretched = make_plane(kO, Vector3d(1, 1, 0), scaled({1, 2, 1}));
  REQUIRE(is_near(seen(*stretched, ray({1, 1, 0}, {-1, 0, 0})).normal, glm::normalize(Vector3f(2, 1, 0))));
}

TEST_CASE("disk: rim, centre, uv, bounds", "[shapes]") {
  const auto disk = make_disk(kO, 3.0 * kY, 1);
  REQUIRE(nearest(*disk, ray({0, 2, 0}, -y)) == 2);
  REQUIRE(nearest(*disk, ray({0.999f, -2, 0}, y)) == 2);
  REQUIRE(nearest(*disk, ray({0.8f, 2, 0.8f}, -y)) == -1);
  REQUIRE(nearest(*disk, ray({-2, 0, 0}, x)) == -1);
  REQUIRE(point_at(*disk, Vector3f(0), y).normal == y);
  REQUIRE(uv_at(*disk, Vector3f(0), y).y == 0);
  check_uv(*disk,
           {{0.999f * x, y, {0, 0.999f}}, {-0.999f * z, y, {0.25f, 0.999f}}, {-0.5f * x, y, {0.5f, 0.5f}}});
  REQUIRE(is_bounded(*disk, {-1, 0, -1}, {1, 0, 1}));
  const double h = std::sqrt(0.5);
  REQUIRE(is_bounded(*make_disk(kO, Vector3d(1, 1, 0), 1), {-h, -h, -1}, {h, h, 1}));
}

TEST_CASE("cylinder: side, caps, seam, along the axis", "[shapes]") {
  const auto cylinder = make_cylinder(kO, kY, 1, false);
  REQUIRE(nearest(*cylinder, ray({5, 0.5f, 0}, -x)) == 4);
  REQUIRE(nearest(*cylinder, ray({0.5f, 5, 0}, -y)) == 4);
  REQUIRE(nearest(*cylinder, ray({0, 0.5f, 0}, y)) == 0.5f);
  REQUIRE(nearest(*cylinder, ray({1.5f, 5, 0}, -y)) == -1);
  REQUIRE(nearest(*cylinder, ray({5, 1.5f, 0}, -x)) == -1);
  REQUIRE(point_at(*cylinder, x + 0.5f * y, x).normal == x);
  REQUIRE(point_at(*cylinder, y, y).normal == y);
  REQUIRE(point_at(*cylinder, Vector3f(0), -y).normal == -y);
  const float seam = nearest(*cylinder, ray({6, 6, 0}, {-1, -1, 0}));  // at the edge of the top cap
  REQUIRE(std::abs(seam - 5) < 1e-6f);
  REQUIRE(is_bounded(*cylinder, {-1, 0, -1}, {1, 1, 1}));
  check_uv(*cylinder, {{x + 0.01f * y, x, {0, 0.01f}},
                       {0.5f * y - z, -z, {0.25f, 0.5f}},
                       {0.99f * y - x, -x, {0.5f, 0.99f}},
                       {0.5f * z, -y, {0.75f, 0.5f}},
                       {y - 0.99f * z, y, {0.25f, 0.99f}}});
  const double h = std::sqrt(0.5);
  REQUIRE(is_bounded(*make_cylinder(kO, Vector3d(1, 1, 0), 1, false), {-h, -h, -1}, {1 + h, 1 + h, 1}));
}

TEST_CASE("cylinder: open", "[shapes]") {
  const auto open = make_cylinder(kO, kY, 1, true);
  REQUIRE(nearest(*open, ray({0.5f, 5, 0}, -y)) == -1);
  REQUIRE(nearest(*open, ray({5, 0.5f, 0}, -x)) == 4);
  const Ray3f through_top = ray({0, 2, 0}, {1, -1.5f, 0});
  REQUIRE(nearest(*open, through_top) == 1);
  REQUIRE(is_near(seen(*open, through_top).normal, x));
}

TEST_CASE("cone: side, tip, base, stump", "[shapes]") {
  const auto cone = make_cone(kO, 1, kY, 0, false);
  REQUIRE(std::abs(nearest(*cone, ray({5, 0.5f, 0}, -x)) - 4.5f) < 1e-6f);
  REQUIRE(nearest(*cone, ray({0.5f, -5, 0}, y)) == 5);
  REQUIRE(is_near(point_at(*cone, {0.5f, 0.5f, 0}, x).normal, glm::normalize(Vector3f(1, 1, 0))));
  REQUIRE(point_at(*cone, Vector3f(0), -y).normal == -y);
  REQUIRE(nearest(*cone, ray({0, 1.5f, 0}, x)) == -1);  // the other half of the double cone
  REQUIRE(nearest(*cone, ray({-5, 1.5f, 0}, x)) == -1);
  REQUIRE(nearest(*cone, ray({-0.5f, 1.5f, 0}, {1, -1, 0})) == 0.5f);  // along the side, to the tip
  REQUIRE(std::abs(glm::length(seen(*cone, ray({0, 5, 0}, -y)).normal) - 1) < 1e-6f);
  REQUIRE(is_near(seen(*cone, ray({0, 5, 0}, -y)).position, y));
  REQUIRE(is_bounded(*cone, {-1, 0, -1}, {1, 1, 1}));

  const auto stump = make_cone(kO, 1, kY, 2, false, scaled({1, -1, 1}));
  REQUIRE(is_bounded(*stump, {-2, -1, -2}, {2, 0, 2}));
  REQUIRE(std::abs(nearest(*stump, ray({5, -0.5f, 0}, -x)) - 3.5f) < 1e-6f);
  REQUIRE(point_at(*stump, -y, -y).normal == -y);
  Hit hit;
  REQUIRE(stump->is_hit(ray({1.9f, -5, 0}, y), hit));
  REQUIRE(hit.primitive == 2);
}

TEST_CASE("torus: four crossings, hole, normal, uv, bounds", "[shapes]") {
  const auto torus = make_torus(kO, kY, 2, 1);
  Ray3f across = ray({5, 0, 0}, -x);
  Hit hit;
  for (const float expected : {2.0f, 4.0f, 6.0f, 8.0f}) {
    REQUIRE(torus->is_hit(across, hit));
    REQUIRE(std::abs(hit.t - expected) < 1e-5f);
    across.t_min = hit.t;
  }
  REQUIRE_FALSE(torus->is_hit(across, hit));
  REQUIRE(nearest(*torus, ray({0, 5, 0}, -y)) == -1);
  REQUIRE(std::abs(nearest(*torus, ray({2, 5, 0}, -y)) - 4) < 1e-5f);
  REQUIRE(is_near(point_at(*torus, {-1, 0, 0}, x).normal, x));  // outwards from the tube is towards the axis
  check_uv(*torus, {{3.0f * x, x, {0, 0}},
                    {-3.0f * z, -z, {0.25f, 0}},
                    {2.0f * x + y, y, {0, 0.25f}},
                    {-x, x, {0.5f, 0.5f}},
                    {2.0f * x - y, -y, {0, 0.75f}}});
  REQUIRE(is_bounded(*torus, {-3, -1, -3}, {3, 1, 3}));
  const auto standing = make_torus(kX, kZ, 2, 1, turned_about_z(30));
  REQUIRE(is_bounded(*standing, {std::cos(0.5235987755982988) - 3, -2.5, -1},
                     {std::cos(0.5235987755982988) + 3, 3.5, 1}));
}

TEST_CASE("torus: spindle and tangents", "[shapes]") {
  const auto spindle = make_torus(kO, kY, 1, 2);
  const float tip = std::sqrt(3.0f);
  REQUIRE(std::abs(nearest(*spindle, ray({0, 5, 0}, -y)) - (5 - tip)) < 1e-5f);
  Ray3f across = ray({5, 0, 0}, -x);
  Hit hit;
  for (const float expected : {2.0f, 4.0f, 6.0f, 8.0f}) {
    REQUIRE(spindle->is_hit(across, hit));
    REQUIRE(std::abs(hit.t - expected) < 1e-5f);
    across.t_min = hit.t;
  }
  const auto torus = make_torus(kO, kY, 2, 1);
  for (const Ray3f& touching :
       {ray({3, 5, 0}, -y), ray({0, 1, 5}, -z), ray({5, 1, 2}, -x), ray({-1, 0, 5}, -z)}) {
    const float t = nearest(*torus, touching);
    REQUIRE((t == -1 || t > 0));
  }
}

TEST_CASE("shapes refuse parameters that span no surface", "[shapes]") {
  REQUIRE(refusal([] { make_sphere(kO, -1); }) == "'radius' must be greater than 0, not -1");
  REQUIRE(refusal([] { make_sphere(kO, 0); }) == "'radius' must be greater than 0, not 0");
  REQUIRE(refusal([] { make_sphere(kO, kNan); }) == "'radius' is not a finite number");
  REQUIRE(refusal([] { make_sphere({0, kInf, 0}, 1); }) == "'center' has a part that is not a finite number");
  REQUIRE(refusal([] { make_quad(kO, kX, -2.0 * kX); }) ==
          "'width' and 'height' are parallel: they span no surface");
  REQUIRE(refusal([] { make_quad(kO, kO, kX); }) == "'width' is 0 0 0: it has no direction");
  REQUIRE(refusal([] { make_triangle(kO, kX, 3.0 * kX); }) ==
          "'a', 'b' and 'c' lie on one line: the triangle has no area");
  REQUIRE(refusal([] { make_triangle(kO, kO, kX); }) ==
          "'a', 'b' and 'c' lie on one line: the triangle has no area");
  REQUIRE(refusal([] { make_cube(kO, {1, 0, 1}); }) == "'size' must be greater than 0, not 0");
  REQUIRE(refusal([] { make_plane(kO, kO); }) == "'normal' is 0 0 0: it has no direction");
  REQUIRE(refusal([] { make_disk(kO, kY, -0.5); }) == "'radius' must be greater than 0, not -0.5");
  REQUIRE(refusal([] { make_cylinder(kY, kY, 1, false); }) ==
          "'base' and 'top' are the same point: there is no axis");
  REQUIRE(refusal([] { make_cone(kO, 0, kY, 0, false); }) ==
          "'radius' and 'top_radius' are both 0: one of them must be greater");
  REQUIRE(refusal([] { make_cone(kO, 1, kY, -1, false); }) ==
          "'top_radius' must not be less than 0, as -1 is");
  REQUIRE(refusal([] { make_torus(kO, kO, 1, 1); }) == "'axis' is 0 0 0: it has no direction");
  REQUIRE(refusal([] { make_torus(kO, kY, 1, 0); }) == "'tube_radius' must be greater than 0, not 0");
}

TEST_CASE("shapes refuse flat transforms and coordinates out of range", "[shapes]") {
  const Transform flat = scaled({1, 0, 1}), broken = scaled({1, kNan, 1});
  const std::string kFlat = "the transform squeezes the shape flat";
  REQUIRE(refusal([&] { make_sphere(kO, 1, flat); }) == kFlat);
  REQUIRE(refusal([&] { make_quad(kO, kX, kZ, flat); }) == kFlat);
  REQUIRE(refusal([&] { make_torus(kO, kY, 1, 0.5, flat); }) == kFlat);
  REQUIRE(refusal([&] { make_cube(kO, kX + kY + kZ, broken); }) ==
          "the transform has a part that is not a finite number");
  const std::string kRange = "the shape lies outside the range of coordinates, 1e18";
  REQUIRE(refusal([] { make_sphere(kO, 2e18); }) == kRange);
  REQUIRE(refusal([] { make_plane({0, -3e18, 0}, kY); }) == kRange);
  REQUIRE(refusal([] { make_triangle(kO, kX, 1e20 * kY); }) == kRange);
  REQUIRE(refusal([] { make_sphere(kO, 1e-9, scaled({1e-9, 1e-9, 1e-9})); }).empty());
  REQUIRE(refusal([] { make_sphere(kO, 9e17); }).empty());
}
