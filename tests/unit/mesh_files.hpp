// What the tests of mesh readers share.
#pragma once

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <string>
#include <vector>

#include "catch.hpp"
#include "meshes/mesh_data.hpp"
#include "raytracer/error.hpp"

using Triangles = std::vector<std::array<std::uint32_t, 3>>;

/// The message of the Error (kScene) that read() throws; "" where it does not.
template <typename Read>
std::string failure_of(const Read& read) {
  try {
    read();
  } catch (const raytracer::Error& error) {
    REQUIRE(error.kind() == raytracer::ErrorKind::kScene);
    return error.what();
  }
  return "";
}

inline void write(const std::string& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary) << bytes;
}

/// What every mesh promises, whatever the file: "" or what is wrong.
inline std::string inconsistency(const raytracer::MeshData& mesh) {
  const auto fits = [&](std::size_t size) { return size == 0 || size == mesh.positions.size(); };
  if (mesh.triangles.empty()) return "no triangles";
  if (!fits(mesh.normals.size())) return "normals";
  if (!fits(mesh.uvs.size())) return "uvs";
  if (!fits(mesh.colors.size())) return "colors";
  for (const raytracer::Vector3f& p : mesh.positions) {
    if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z)) return "a position";
  }
  for (const raytracer::Vector3f& n : mesh.normals) {
    const float length = glm::length(n);
    if (length != 0 && !(std::abs(length - 1) < 1e-6f)) return "a normal";
  }
  for (const raytracer::Vector2f& uv : mesh.uvs) {
    if (!std::isfinite(uv.x) || !std::isfinite(uv.y)) return "a uv";
  }
  for (const raytracer::Color3f& c : mesh.colors) {
    if (!(c.x >= 0 && c.y >= 0 && c.z >= 0) || !std::isfinite(c.x + c.y + c.z)) return "a color";
  }
  for (const auto& triangle : mesh.triangles) {
    for (const std::uint32_t corner : triangle) {
      if (corner >= mesh.positions.size()) return "an index";
    }
  }
  std::uint32_t end = 0;
  for (const raytracer::MeshData::Range& range : mesh.ranges) {
    if (range.begin < end || range.end <= range.begin || range.end > mesh.triangles.size()) return "a range";
    if (range.material >= mesh.materials.size()) return "a range's material";
    end = range.end;
  }
  return "";
}

/// The bytes of numbers, one after the other, in little or big endian.
class Bytes {
 public:
  explicit Bytes(bool big_endian = false) : big_endian_(big_endian) {}

  Bytes& text(const std::string& text) {
    bytes_ += text;
    return *this;
  }
  template <typename T>
  Bytes& add(T number) {
    const auto raw = std::bit_cast<std::array<char, sizeof(T)>>(number);
    const bool swap = big_endian_ == (std::endian::native == std::endian::little);
    bytes_ += swap ? std::string(raw.rbegin(), raw.rend()) : std::string(raw.begin(), raw.end());
    return *this;
  }
  template <typename T>
  Bytes& add_all(const std::vector<T>& numbers) {
    for (const T& number : numbers) add(number);
    return *this;
  }
  const std::string& str() const { return bytes_; }

 private:
  bool big_endian_;
  std::string bytes_;
};
