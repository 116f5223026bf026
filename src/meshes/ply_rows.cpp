#include "meshes/ply_rows.hpp"

#include <algorithm>
#include <cmath>

namespace raytracer::meshes {

PlyVertices::PlyVertices(const PlyElement& element, MeshData& mesh) : mesh_(mesh) {
  std::array<bool, kSlots> has{};
  for (const PlyProperty& property : element.properties) {
    const PlySlot slot = slot_of(property);
    const bool twice = slot != kNoSlot && has[static_cast<std::size_t>(slot)];  // the first one counts
    slots_.push_back(twice ? kNoSlot : slot);
    if (slot == kNoSlot || twice) continue;
    has[static_cast<std::size_t>(slot)] = true;
    if (slot >= kRed) white_[slot - kRed] = static_cast<float>(white_of(property.type));
    if (slot == kRed) mesh.has_display_colors = is_integer(property.type);
  }
  const auto rows = static_cast<std::size_t>(element.rows);
  mesh.positions.resize(rows);
  if (has[kNormalX] && has[kNormalY] && has[kNormalZ]) mesh.normals.resize(rows);
  if (has[kU] && has[kV]) mesh.uvs.resize(rows);
  if (has[kRed] && has[kGreen] && has[kBlue]) mesh.colors.resize(rows);
  has_more_ = !mesh.normals.empty() || !mesh.uvs.empty() || !mesh.colors.empty();
  mesh.has_display_colors = mesh.has_display_colors && !mesh.colors.empty();
}

float PlyVertices::finite_or_0(float value) {
  if (std::isfinite(value)) return value;
  not_finite_.fetch_add(1, std::memory_order_relaxed);
  return 0;
}

void PlyVertices::store_more(std::size_t row, const Values& values) {
  if (!mesh_.normals.empty()) {
    const Vector3d normal(finite_or_0(values[kNormalX]), finite_or_0(values[kNormalY]),
                          finite_or_0(values[kNormalZ]));
    const double length = std::sqrt(glm::dot(normal, normal));
    mesh_.normals[row] = length > 0 ? Vector3f(normal / length) : Vector3f(0);
  }
  if (!mesh_.uvs.empty()) mesh_.uvs[row] = {finite_or_0(values[kU]), finite_or_0(values[kV])};
  if (!mesh_.colors.empty()) {
    const Color3f color(finite_or_0(values[kRed]), finite_or_0(values[kGreen]), finite_or_0(values[kBlue]));
    mesh_.colors[row] = glm::max(color / white_, Color3f(0));
  }
}

// Every corner after the second makes a triangle with the two before it, whose order changes each time; -1
// begins a new strip.
void PlyFaces::add_to_strip(std::int64_t corner) {
  if (corner < 0) {
    strip_length_ = 0;
    return;
  }
  const auto index = static_cast<std::uint32_t>(corner);
  if (strip_length_ >= 2) {
    const bool turned = strip_length_ % 2 == 1;
    const std::size_t begin = polygons_.corners.size();
    polygons_.corners.insert(polygons_.corners.end(), {last_[turned ? 1 : 0], last_[turned ? 0 : 1], index});
    polygons_.end_face(begin);
  }
  last_ = {last_[1], index};
  ++strip_length_;
}

}  // namespace raytracer::meshes
