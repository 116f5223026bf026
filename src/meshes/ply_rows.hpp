// What both kinds of PLY bodies, text and binary, do with the numbers of a row.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <span>
#include <vector>

#include "meshes/mesh_data.hpp"
#include "meshes/ply_header.hpp"
#include "meshes/polygons.hpp"

namespace raytracer::meshes {

/// Takes the vertices of a file in any order, from several threads.
class PlyVertices {
 public:
  using Values = std::array<float, kSlots>;

  /// The mesh's arrays become as long as the element says: what the file holds must have been compared.
  PlyVertices(const PlyElement& element, MeshData& mesh);

  /// Which slot a property of the element fills; kNoSlot where the mesh does not want it.
  PlySlot slot(std::size_t property) const { return slots_[property]; }

  /// False where a coordinate is not finite.
  bool store(std::size_t row, const Values& values) {
    const Vector3f position(values[kX], values[kY], values[kZ]);
    mesh_.positions[row] = position;
    if (has_more_) store_more(row, values);
    const Vector3f zero = position * 0.0f;  // NaN where a part is not finite
    return zero.x + zero.y + zero.z == 0;
  }

  /// How many numbers that are not finite became 0.
  std::uint64_t not_finite() const { return not_finite_; }

 private:
  void store_more(std::size_t row, const Values& values);
  float finite_or_0(float value);

  MeshData& mesh_;
  std::vector<PlySlot> slots_;
  Color3f white_{1};  // what the file writes for 1
  bool has_more_ = false;
  std::atomic<std::uint64_t> not_finite_{0};
};

/// Takes the corner lists of a piece of a file's faces or strips.
class PlyFaces {
 public:
  PlyFaces(bool strips, std::uint64_t vertices) : strips_(strips), vertices_(vertices) {}

  /// The list's values one by one, then end_list. False where there is no such vertex.
  bool add(std::int64_t corner) {
    if (static_cast<std::uint64_t>(corner) >= vertices_ && !(strips_ && corner == -1)) return false;
    if (strips_) {
      add_to_strip(corner);
    } else {
      polygons_.corners.push_back(static_cast<std::uint32_t>(corner));
    }
    return true;
  }
  void end_list() {
    if (!strips_) polygons_.end_face(begin_);
    begin_ = polygons_.corners.size();
    strip_length_ = 0;
  }

  Polygons take() { return std::move(polygons_); }

 private:
  void add_to_strip(std::int64_t corner);

  bool strips_;
  std::uint64_t vertices_;
  Polygons polygons_;
  std::size_t begin_ = 0;                // of the face's corners
  std::uint64_t strip_length_ = 0;       // corners since the strip began
  std::array<std::uint32_t, 2> last_{};  // the strip's last two corners
};

}  // namespace raytracer::meshes
