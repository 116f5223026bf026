#include "meshes/polygons.hpp"

#include <cmath>
#include <random>
#include <set>

#include "mesh_files.hpp"
#include "meshes/flat_faces.hpp"
#include "meshes/weld.hpp"

using namespace raytracer;
using namespace raytracer::meshes;

namespace {

// The triangles of one polygon whose corners are all the positions in order.
MeshData cut(const std::vector<Vector3f>& positions) {
  MeshData mesh;
  mesh.positions = positions;
  std::vector<Polygons> pieces(1);
  for (std::uint32_t i = 0; i < positions.size(); ++i) pieces[0].corners.push_back(i);
  pieces[0].end_face(0);
  append_triangles(pieces, mesh);
  return mesh;
}

Vector3d area_of(const MeshData& mesh, const std::array<std::uint32_t, 3>& t) {
  const Vector3d a(mesh.positions[t[0]]), b(mesh.positions[t[1]]), c(mesh.positions[t[2]]);
  return 0.5 * glm::cross(b - a, c - a);
}

// Every triangle turns the way the polygon does, and together they cover it: their sizes add up to its.
void require_covers(const std::vector<Vector3f>& positions) {
  const MeshData mesh = cut(positions);
  REQUIRE(mesh.triangles.size() == positions.size() - 2);
  Vector3d whole(0);
  for (std::size_t i = 1; i + 1 < positions.size(); ++i) {
    whole += 0.5 * glm::cross(Vector3d(positions[i]) - Vector3d(positions[0]),
                              Vector3d(positions[i + 1]) - Vector3d(positions[0]));
  }
  double sum = 0;
  for (const auto& triangle : mesh.triangles) {
    REQUIRE(glm::dot(area_of(mesh, triangle), whole) >= -1e-9 * glm::dot(whole, whole));
    sum += glm::length(area_of(mesh, triangle));
  }
  REQUIRE(sum == Approx(glm::length(whole)).epsilon(1e-6));
}

std::vector<Vector3f> in_space(const std::vector<Vector2f>& flat, int axis, bool turned) {
  std::vector<Vector3f> points;
  for (const Vector2f& p : flat) {
    Vector3f q(0.1f * p.x + 3);
    q[(axis + 1) % 3] = p.x;
    q[(axis + 2) % 3] = p.y;
    points.push_back(q);
  }
  if (turned) std::reverse(points.begin(), points.end());
  return points;
}

}  // namespace

TEST_CASE("convex polygons become fans") {
  REQUIRE(cut({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}).triangles == Triangles{{0, 1, 2}, {0, 2, 3}});
  REQUIRE(cut({{0, 0, 0}, {2, 0, 0}, {3, 1, 0}, {2, 2, 0}, {0, 2, 0}}).triangles ==
          Triangles{{0, 1, 2}, {0, 2, 3}, {0, 3, 4}});
}

TEST_CASE("a concave quad is cut along the diagonal that lies within it") {
  // The dart's inner corner is the second, then the first.
  REQUIRE(cut({{4, 0, 0}, {1, 1, 0}, {0, 4, 0}, {0, 0, 0}}).triangles == Triangles{{1, 2, 3}, {1, 3, 0}});
  REQUIRE(cut({{1, 1, 0}, {0, 4, 0}, {0, 0, 0}, {4, 0, 0}}).triangles == Triangles{{0, 1, 2}, {0, 2, 3}});
}

TEST_CASE("a corner in the middle of a quad's edge makes no flat triangle") {
  const MeshData mesh = cut({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {1, 2, 0}});
  for (const auto& triangle : mesh.triangles) REQUIRE(glm::length(area_of(mesh, triangle)) > 0.5);
}

TEST_CASE("concave polygons are covered, whichever way they lie") {
  const std::vector<std::vector<Vector2f>> shapes = {
      {{0, 0}, {3, 0}, {3, 3}, {2, 3}, {2, 1}, {1, 1}, {1, 3}, {0, 3}},  // a U
      {{0, 0}, {1, 2}, {2, 0}, {3, 2}, {4, 0}, {4, 5}, {0, 5}},          // a W below
      {{0, 0},
       {9, 0},
       {9, 9},
       {1, 9},
       {1, 3},
       {6, 3},
       {6, 6},
       {3, 6},
       {3, 5},
       {5, 5},
       {5, 4},
       {2, 4},
       {2, 8},
       {8, 8},
       {8, 1},
       {0, 1}},                                                                           // a spiral
      {{0, 0}, {1, 0}, {2, 0}, {3, 0}, {3, 1}, {3, 2}, {2, 2}, {1, 2}, {0, 2}, {0, 1}},   // flat corners
      {{0, 0}, {6, 0}, {6, 6}, {0, 6}, {0, 0}, {2, 2}, {2, 4}, {4, 4}, {4, 2}, {2, 2}}};  // a hole, by a
                                                                                          // bridge
  for (const auto& shape : shapes) {
    for (int axis = 0; axis < 3; ++axis) {
      for (const bool turned : {false, true}) require_covers(in_space(shape, axis, turned));
    }
  }
}

TEST_CASE("random stars are covered") {
  std::mt19937 random(7);
  std::uniform_real_distribution<float> uniform(0, 1);
  for (int turn = 0; turn < 200; ++turn) {
    const int corners = 5 + turn;
    std::vector<Vector2f> star;
    for (int i = 0; i < corners; ++i) {
      const float angle = 6.2831853f * static_cast<float>(i) / static_cast<float>(corners);
      star.push_back((0.1f + uniform(random)) * Vector2f(std::cos(angle), std::sin(angle)));
    }
    require_covers(in_space(star, turn % 3, turn % 2 == 0));
  }
}

TEST_CASE("polygons that are hard to cut take no long time and give all their triangles") {
  std::vector<Vector3f> comb, tangle, line;
  std::mt19937 random(3);
  for (int i = 0; i < 20000; ++i) {
    const auto x = static_cast<float>(i);
    comb.emplace_back(x, i % 2 == 0 ? 0.0f : 1000 + x, 0);
    tangle.emplace_back(random() % 1000, random() % 1000, random() % 1000);
    line.emplace_back(x, x, x);
  }
  comb.emplace_back(20000, -5, 0);
  comb.emplace_back(-1, -5, 0);
  for (const auto& polygon : {comb, tangle, line})
    REQUIRE(cut(polygon).triangles.size() == polygon.size() - 2);
}

TEST_CASE("faces of less than three corners are not kept") {
  Polygons polygons;
  polygons.corners = {1, 2};
  REQUIRE_FALSE(polygons.end_face(0));
  REQUIRE(polygons.corners.empty());
  polygons.corners = {1, 2, 3};
  REQUIRE(polygons.end_face(0));
  polygons.corners.insert(polygons.corners.end(), {4, 5, 6, 7});
  REQUIRE(polygons.end_face(3));
  REQUIRE(polygons.left_out() == 1);
  REQUIRE(polygons.faces() == 2);
  REQUIRE(polygons.triangles() == 3);
  REQUIRE(polygons.size_of(0) == 3);
  REQUIRE(polygons.size_of(1) == 4);
}

TEST_CASE("flat triangles are left out, and material ranges follow") {
  MeshData mesh;
  mesh.positions = {{0, 0, 0},          {1, 0, 0},          {0, 1, 0},
                    {0.1f, 0.1f, 0.1f}, {0.2f, 0.2f, 0.2f}, {0.4f, 0.4f, 0.4f}};
  mesh.materials.resize(3);
  const std::array<std::uint32_t, 3> good = {0, 1, 2}, other = {0, 2, 1}, line = {3, 4, 5}, same = {1, 1, 2};
  mesh.triangles = {good, line, other, same, line, good, other};
  mesh.ranges = {{0, 2, 2}, {2, 5, 1}, {6, 7, 0}};
  leave_out_flat_faces(mesh, 1);
  REQUIRE(mesh.triangles == Triangles{good, other, good, other});
  REQUIRE(mesh.ranges.size() == 3);
  REQUIRE((mesh.ranges[0].begin == 0 && mesh.ranges[0].end == 1 && mesh.ranges[0].material == 2));
  REQUIRE((mesh.ranges[1].begin == 1 && mesh.ranges[1].end == 2 && mesh.ranges[1].material == 1));
  REQUIRE((mesh.ranges[2].begin == 3 && mesh.ranges[2].end == 4 && mesh.ranges[2].material == 0));
  REQUIRE(mesh.remarks == std::vector<std::string>{"4 of 8 triangles have no area and are left out"});
}

TEST_CASE("small and thin triangles are not flat") {
  MeshData mesh;
  mesh.positions = {{0, 0, 0},        {1e-30f, 0, 0}, {0, 1e-30f, 0}, {1e6f, 0, 0},
                    {2e6f, 1e-3f, 0}, {1e30f, 0, 0},  {0, 1e30f, 0}};
  mesh.triangles = {{0, 1, 2}, {0, 3, 4}, {0, 5, 6}};
  leave_out_flat_faces(mesh, 0);
  REQUIRE(mesh.triangles.size() == 3);
  REQUIRE(mesh.remarks.empty());
}

TEST_CASE("welding keeps the order of first appearance") {
  std::vector<Vector3f> corners = {{1, 0, 0}, {0, 0, 0}, {0, 1, 0},     {0, 1, 0}, {0, 0, 0},
                                   {5, 5, 5}, {1, 0, 0}, {-0.0f, 0, 0}, {5, 5, 5}};
  MeshData mesh;
  weld(corners, mesh);
  REQUIRE(mesh.positions == std::vector<Vector3f>{{1, 0, 0}, {0, 0, 0}, {0, 1, 0}, {5, 5, 5}});
  REQUIRE(mesh.triangles == Triangles{{0, 1, 2}, {2, 1, 3}, {0, 1, 3}});
}

TEST_CASE("welding many corners finds what a search through all finds") {
  std::mt19937 random(11);
  std::vector<Vector3f> corners;
  std::set<std::array<float, 3>> different;
  for (int i = 0; i < 150000; ++i) {
    corners.emplace_back(random() % 40, random() % 40, random() % 40);
    different.insert({corners.back().x, corners.back().y, corners.back().z});
  }
  const std::vector<Vector3f> before = corners;
  MeshData mesh;
  weld(corners, mesh);
  REQUIRE(mesh.positions.size() == different.size());
  std::size_t wrong = 0;
  for (std::size_t i = 0; i < before.size(); ++i) {
    wrong += mesh.positions[mesh.triangles[i / 3][i % 3]] == before[i] ? 0 : 1;
  }
  REQUIRE(wrong == 0);
}
