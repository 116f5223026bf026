#include "meshes/flat_faces.hpp"

#include <fmt/format.h>

#include <atomic>

#include "meshes/chunks.hpp"
#include "raytracer/error.hpp"

namespace raytracer::meshes {
namespace {

constexpr std::size_t kSpan = std::size_t{1} << 15U;

// Differences and products of floats are exact in double but for the last bits, which this tells from an
// area: the sine of the angle between two edges is below it only where the corners lie on one line.
constexpr double kLeastSine = 1e-14;

bool is_flat(const MeshData& mesh, const std::array<std::uint32_t, 3>& triangle) {
  const auto [a, b, c] = triangle;
  if (a == b || b == c || c == a) return true;
  const Vector3d origin(mesh.positions[a]);
  const Vector3d u = Vector3d(mesh.positions[b]) - origin, v = Vector3d(mesh.positions[c]) - origin;
  const Vector3d cross = glm::cross(u, v);
  return !(glm::dot(cross, cross) > kLeastSine * kLeastSine * (glm::dot(u, u) * glm::dot(v, v)));
}

std::uint64_t count_flat(const MeshData& mesh) {
  std::atomic<std::uint64_t> count{0};
  for_each_span(mesh.triangles.size(), kSpan, [&](std::size_t begin, std::size_t end) {
    std::uint64_t flat = 0;
    for (std::size_t i = begin; i < end; ++i) flat += is_flat(mesh, mesh.triangles[i]) ? 1 : 0;
    count += flat;
  });
  return count;
}

// Closes the gaps; the ranges, which are in order, move with what they hold.
void remove_flat(MeshData& mesh) {
  std::size_t kept = 0, range = 0;
  std::vector<MeshData::Range> ranges;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    while (range < mesh.ranges.size() && mesh.ranges[range].end <= i) ++range;
    if (is_flat(mesh, mesh.triangles[i])) continue;
    if (range < mesh.ranges.size() && mesh.ranges[range].begin <= i) {
      const auto place = static_cast<std::uint32_t>(kept);
      const std::uint32_t material = mesh.ranges[range].material;
      if (ranges.empty() || ranges.back().end != place || ranges.back().material != material) {
        ranges.push_back({place, place, material});
      }
      ++ranges.back().end;
    }
    mesh.triangles[kept++] = mesh.triangles[i];
  }
  mesh.triangles.resize(kept);
  mesh.ranges = std::move(ranges);
}

}  // namespace

void leave_out_flat_faces(MeshData& mesh, std::uint64_t faces_left_out) {
  const std::uint64_t flat = count_flat(mesh);
  const std::uint64_t left_out = flat + faces_left_out, all = mesh.triangles.size() + faces_left_out;
  if (all == 0) {
    throw Error(ErrorKind::kScene, mesh.positions.empty()
                                       ? "it has no faces"
                                       : fmt::format("it has no faces, only {} {}", mesh.positions.size(),
                                                     mesh.positions.size() == 1 ? "point" : "points"));
  }
  if (left_out == all) {
    throw Error(ErrorKind::kScene,
                all == 1 ? "its one face has no area" : fmt::format("none of its {} faces has an area", all));
  }
  if (flat > 0) remove_flat(mesh);
  if (left_out > 0) {
    mesh.remarks.push_back(fmt::format("{} of {} triangles {} no area and {} left out", left_out, all,
                                       left_out == 1 ? "has" : "have", left_out == 1 ? "is" : "are"));
  }
}

void tell_not_finite(std::uint64_t count, MeshData& mesh) {
  if (count == 0) return;
  mesh.remarks.push_back(fmt::format(
      "{} {} of normals, texture coordinates or colours {} not finite and {} 0", count,
      count == 1 ? "number" : "numbers", count == 1 ? "is" : "are", count == 1 ? "becomes" : "become"));
}

}  // namespace raytracer::meshes
