#include "meshes/smooth_normals.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <span>

#include "core/hash.hpp"
#include "core/numeric.hpp"

namespace raytracer {
namespace {

Vector3d position_of(const MeshData& mesh, std::uint32_t vertex) { return Vector3d(mesh.positions[vertex]); }

// Unit length; 0 of a triangle without area.
Vector3d normal_of(const MeshData& mesh, const std::array<std::uint32_t, 3>& t) {
  const Vector3d a = position_of(mesh, t[0]);
  const Vector3d across = glm::cross(position_of(mesh, t[1]) - a, position_of(mesh, t[2]) - a);
  const double length = glm::length(across);
  return length > 0 ? across / length : Vector3d(0.0);
}

double angle_at(const MeshData& mesh, const std::array<std::uint32_t, 3>& t, std::size_t corner) {
  const Vector3d here = position_of(mesh, t[corner]);
  const Vector3d p = position_of(mesh, t[(corner + 1) % 3]) - here;
  const Vector3d q = position_of(mesh, t[(corner + 2) % 3]) - here;
  return std::atan2(glm::length(glm::cross(p, q)), glm::dot(p, q));
}

// For every vertex the first one at the same place.
std::vector<std::uint32_t> first_at_same_place(const std::vector<Vector3f>& positions) {
  constexpr std::uint32_t kEmpty = 0xFFFFFFFF;
  const std::size_t slots = std::bit_ceil(2 * positions.size() + 1);
  std::vector<std::uint32_t> table(slots, kEmpty), first(positions.size());
  for (std::uint32_t i = 0; i < positions.size(); ++i) {
    const Vector3f p = positions[i] + Vector3f(0);  // -0 becomes 0
    std::uint64_t hash = 0;
    for (int axis = 0; axis < 3; ++axis) hash = mix_bits(hash ^ std::bit_cast<std::uint32_t>(p[axis]));
    std::size_t slot = hash & (slots - 1);
    while (table[slot] != kEmpty && positions[table[slot]] != positions[i]) slot = (slot + 1) & (slots - 1);
    if (table[slot] == kEmpty) table[slot] = i;
    first[i] = table[slot];
  }
  return first;
}

// The triangles around each place: corner 3 t + k of triangle t, place by place.
struct Incidence {
  std::vector<std::uint32_t> begin, corners;

  Incidence(const MeshData& mesh, const std::vector<std::uint32_t>& first) : begin(first.size() + 1, 0) {
    for (const auto& t : mesh.triangles) {
      for (const std::uint32_t vertex : t) ++begin[first[vertex] + 1];
    }
    std::partial_sum(begin.begin(), begin.end(), begin.begin());
    corners.resize(3 * mesh.triangles.size());
    std::vector<std::uint32_t> next(begin.begin(), begin.end() - 1);
    for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
      for (std::uint32_t k = 0; k < 3; ++k) corners[next[first[mesh.triangles[i][k]]]++] = 3 * i + k;
    }
  }
};

// One place: which of its triangles belong to the same smooth piece of surface, and what that makes of its
// vertices.
class Place {
 public:
  Place(MeshData& mesh, std::vector<std::uint32_t>& first, const std::vector<Vector3f>& face_normals,
        double least_cosine)
      : mesh_(mesh), first_(first), face_normals_(face_normals), least_cosine_(least_cosine) {}

  void smooth(std::span<const std::uint32_t> corners) {
    corners_ = corners;
    join_neighbours();
    sum_normals();
    assign();
  }

 private:
  // A triangle's edge from here to another place.
  struct Edge {
    std::uint32_t other, corner;
  };

  std::uint32_t root(std::uint32_t i) {
    while (group_[i] != i) i = group_[i] = group_[group_[i]];
    return i;
  }
  const Vector3f& face_normal(std::uint32_t i) const { return face_normals_[corners_[i] / 3]; }

  void join_neighbours() {
    group_.resize(corners_.size());
    std::iota(group_.begin(), group_.end(), 0U);
    edges_.clear();
    for (std::uint32_t i = 0; i < corners_.size(); ++i) {
      const auto& t = mesh_.triangles[corners_[i] / 3];
      const std::uint32_t k = corners_[i] % 3;
      edges_.push_back({first_[t[(k + 1) % 3]], i});
      edges_.push_back({first_[t[(k + 2) % 3]], i});
    }
    std::ranges::sort(edges_, [](const Edge& p, const Edge& q) {
      return p.other != q.other ? p.other < q.other : p.corner < q.corner;
    });
    for (std::size_t i = 1; i < edges_.size(); ++i) {
      const Edge &p = edges_[i - 1], &q = edges_[i];
      const bool is_smooth =
          p.other == q.other &&
          static_cast<double>(glm::dot(face_normal(p.corner), face_normal(q.corner))) >= least_cosine_;
      if (is_smooth) group_[root(q.corner)] = root(p.corner);
    }
  }

  void sum_normals() {
    sums_.assign(corners_.size(), Vector3d(0.0));
    for (std::uint32_t i = 0; i < corners_.size(); ++i) {
      const auto& t = mesh_.triangles[corners_[i] / 3];
      sums_[root(i)] += angle_at(mesh_, t, corners_[i] % 3) * Vector3d(face_normal(i));
    }
  }

  // The first piece of surface that uses a vertex keeps it, the others get copies.
  void assign() {
    order_.resize(corners_.size());
    std::iota(order_.begin(), order_.end(), 0U);
    for (std::uint32_t i = 0; i < group_.size(); ++i) group_[i] = root(i);
    const auto vertex_of = [&](std::uint32_t i) { return mesh_.triangles[corners_[i] / 3][corners_[i] % 3]; };
    std::ranges::sort(order_, [&](std::uint32_t p, std::uint32_t q) {
      const std::uint32_t a = vertex_of(p), b = vertex_of(q);
      return a != b ? a < b : group_[p] != group_[q] ? group_[p] < group_[q] : p < q;
    });
    std::uint32_t vertex = 0, group = 0, target = 0;
    for (std::size_t n = 0; n < order_.size(); ++n) {
      const std::uint32_t i = order_[n], wanted = vertex_of(i);
      if (n == 0 || wanted != vertex) {
        target = wanted;
        set_normal(target, group_[i]);
      } else if (group_[i] != group) {
        target = copy_of(wanted);
        set_normal(target, group_[i]);
      }
      vertex = wanted;
      group = group_[i];
      mesh_.triangles[corners_[i] / 3][corners_[i] % 3] = target;
    }
  }

  void set_normal(std::uint32_t vertex, std::uint32_t group) {
    const double length = glm::length(sums_[group]);
    mesh_.normals[vertex] = length > 0 ? Vector3f(sums_[group] / length) : Vector3f(0);
  }

  std::uint32_t copy_of(std::uint32_t vertex) {
    const auto copy = static_cast<std::uint32_t>(mesh_.positions.size());
    mesh_.positions.push_back(Vector3f(mesh_.positions[vertex]));
    mesh_.normals.emplace_back(0.0F);
    first_.push_back(std::uint32_t{first_[vertex]});
    if (!mesh_.uvs.empty()) mesh_.uvs.push_back(Vector2f(mesh_.uvs[vertex]));
    if (!mesh_.colors.empty()) mesh_.colors.push_back(Color3f(mesh_.colors[vertex]));
    return copy;
  }

  MeshData& mesh_;
  std::vector<std::uint32_t>& first_;  // grows with the copies
  const std::vector<Vector3f>& face_normals_;
  double least_cosine_;
  std::span<const std::uint32_t> corners_;
  std::vector<std::uint32_t> group_, order_;  // per corner: its group; the corners sorted by vertex
  std::vector<Edge> edges_;
  std::vector<Vector3d> sums_;  // per group
};

}  // namespace

void smooth_normals(MeshData& mesh, double crease) {
  std::vector<std::uint32_t> first = first_at_same_place(mesh.positions);
  const Incidence around(mesh, first);
  std::vector<Vector3f> face_normals(mesh.triangles.size());
  for (std::size_t i = 0; i < face_normals.size(); ++i)
    face_normals[i] = Vector3f(normal_of(mesh, mesh.triangles[i]));
  mesh.normals.assign(mesh.positions.size(), Vector3f(0));
  // Rounding must not make an edge where the angle is just allowed.
  constexpr double kSlack = 1e-6;
  Place place(mesh, first, face_normals, std::cos(crease * kPi / 180) - kSlack);
  const std::size_t places = first.size();
  for (std::size_t i = 0; i < places; ++i) {
    const std::span<const std::uint32_t> corners(around.corners.data() + around.begin[i],
                                                 around.begin[i + 1] - around.begin[i]);
    if (!corners.empty()) place.smooth(corners);
  }
}

}  // namespace raytracer
