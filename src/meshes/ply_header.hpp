// What a PLY file says about itself before its numbers begin.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace raytracer::meshes {

enum class PlyFormat { kAscii, kLittleEndian, kBigEndian };

enum class PlyType : std::uint8_t { kInt8, kUint8, kInt16, kUint16, kInt32, kUint32, kFloat32, kFloat64 };

/// Bytes of a number.
std::size_t size_of(PlyType type);
inline bool is_integer(PlyType type) { return type < PlyType::kFloat32; }
/// What a colour's largest value is: that of the type, or 1.
double white_of(PlyType type);

/// What a mesh wants of a vertex.
enum PlySlot : std::int8_t {
  kNoSlot = -1,
  kX,
  kY,
  kZ,
  kNormalX,
  kNormalY,
  kNormalZ,
  kU,
  kV,
  kRed,
  kGreen,
  kBlue,
  kSlots
};

struct PlyProperty {
  std::string name;
  PlyType type = PlyType::kFloat32;  ///< of the value, or of each of the list's
  bool is_list = false;
  PlyType count_type = PlyType::kUint8;  ///< of the number before a list's values
};

struct PlyElement {
  std::string name;
  std::uint64_t rows = 0;
  std::vector<PlyProperty> properties;

  bool has_lists() const;
  /// Bytes of a row in binary, with lists as short as can be.
  std::size_t least_row_size() const;
  /// The number of the property that lists a face's corners, or -1.
  int corner_list() const;
};

struct PlyHeader {
  PlyFormat format = PlyFormat::kAscii;
  std::vector<PlyElement> elements;
  std::size_t body = 0;  ///< where the numbers begin

  /// The element "vertex" or another; null where there is none.
  const PlyElement* find(std::string_view name) const;
};

/// The slot of a vertex's property, by the names in use.
PlySlot slot_of(const PlyProperty& property);

/// Throws Failure where the header is wrong, or no vertices are announced.
PlyHeader read_ply_header(std::string_view file);

}  // namespace raytracer::meshes
