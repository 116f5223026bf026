#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <bit>
#include <cstring>

#include "meshes/chunks.hpp"
#include "meshes/ply_bodies.hpp"
#include "meshes/ply_rows.hpp"

namespace raytracer::meshes {
namespace {

// Rows that one thread reads at a time.
constexpr std::size_t kSpan = std::size_t{1} << 14U;

template <typename T>
T load(const char* at, bool swap) {
  std::array<char, sizeof(T)> bytes;
  std::memcpy(bytes.data(), at, sizeof(T));
  if (swap) std::reverse(bytes.begin(), bytes.end());
  return std::bit_cast<T>(bytes);
}

// Both are used for few types of few files; the common ones have faster ways.
template <typename Number>
Number load_as(const char* at, PlyType type, bool swap) {
  switch (type) {
    case PlyType::kInt8:
      return static_cast<Number>(load<std::int8_t>(at, swap));
    case PlyType::kUint8:
      return static_cast<Number>(load<std::uint8_t>(at, swap));
    case PlyType::kInt16:
      return static_cast<Number>(load<std::int16_t>(at, swap));
    case PlyType::kUint16:
      return static_cast<Number>(load<std::uint16_t>(at, swap));
    case PlyType::kInt32:
      return static_cast<Number>(load<std::int32_t>(at, swap));
    case PlyType::kUint32:
      return static_cast<Number>(load<std::uint32_t>(at, swap));
    case PlyType::kFloat32:
      return static_cast<Number>(load<float>(at, swap));
    case PlyType::kFloat64:
      return static_cast<Number>(load<double>(at, swap));
  }
  return 0;
}

float load_float(const char* at, PlyType type, bool swap) {
  return type == PlyType::kFloat32 ? load<float>(at, swap)
                                   : static_cast<float>(load_as<double>(at, type, swap));
}
// Only of whole numbers' types.
std::int64_t load_integer(const char* at, PlyType type, bool swap) {
  return load_as<std::int64_t>(at, type, swap);
}

class BinaryReader {
 public:
  BinaryReader(std::string_view file, const PlyHeader& header, PlyResult& result)
      : header_(header),
        result_(result),
        swap_((header.format == PlyFormat::kBigEndian) == (std::endian::native == std::endian::little)),
        at_(file.data() + header.body),
        end_(file.data() + file.size()) {}

  void read() {
    for (const PlyElement& element : header_.elements) {
      check_size(element);
      if (element.name == "vertex") {
        read_vertices(element);
      } else if (element.corner_list() >= 0) {
        read_faces(element);
      } else if (!element.has_lists()) {
        at_ += element.rows * element.least_row_size();
      } else {
        for (std::uint64_t row = 0; row < element.rows; ++row) at_ = skip_row(at_, element, row);
      }
    }
  }

 private:
  std::size_t left(const char* at) const { return static_cast<std::size_t>(end_ - at); }

  // Before memory is taken for what the header promises.
  void check_size(const PlyElement& element) const {
    const std::size_t size = element.least_row_size();
    if (size == 0 || element.rows <= left(at_) / size) return;
    throw Failure{
        at_,
        fmt::format("the header promises {} rows of {}, at least {} bytes each, but only {} {} left",
                    element.rows, in_quotes(element.name), size, left(at_), left(at_) == 1 ? "is" : "are")};
  }

  Failure cut_off(const char* at, const PlyElement& element, std::uint64_t row) const {
    return {at, fmt::format("the file ends within {} {} of {}", in_quotes(element.name), row, element.rows)};
  }

  // Behind a value or a list, which begins at `at`.
  const char* skip(const char* at, const PlyElement& element, const PlyProperty& property,
                   std::uint64_t row) const {
    const std::size_t size = size_of(property.type);
    if (!property.is_list) {
      if (left(at) < size) throw cut_off(at, element, row);
      return at + size;
    }
    const std::uint64_t count = list_length(at, element, property, row);
    return at + size_of(property.count_type) + count * size;
  }

  // The length of the list that begins at `at`; all of it is there.
  std::uint64_t list_length(const char* at, const PlyElement& element, const PlyProperty& property,
                            std::uint64_t row) const {
    const std::size_t head = size_of(property.count_type);
    if (left(at) < head) throw cut_off(at, element, row);
    const std::int64_t count = load_integer(at, property.count_type, swap_);
    if (count < 0) throw Failure{at, fmt::format("a list has {} values", count)};
    if (static_cast<std::uint64_t>(count) > (left(at) - head) / size_of(property.type)) {
      throw Failure{at, fmt::format("a list of {} values goes beyond the end of the file", count)};
    }
    return static_cast<std::uint64_t>(count);
  }

  const char* skip_row(const char* at, const PlyElement& element, std::uint64_t row) const {
    for (const PlyProperty& property : element.properties) at = skip(at, element, property, row);
    return at;
  }

  // --- vertices ---

  struct Field {
    PlySlot slot;
    PlyType type;
    std::size_t offset;
  };

  void read_vertices(const PlyElement& element) {
    PlyVertices vertices(element, result_.mesh);
    if (element.has_lists()) {
      read_ragged_vertices(element, vertices);
    } else {
      read_even_vertices(element, vertices);
    }
    result_.not_finite += vertices.not_finite();
  }

  // All rows have the same size.
  void read_even_vertices(const PlyElement& element, PlyVertices& vertices) {
    std::vector<Field> fields;
    std::size_t size = 0;
    for (std::size_t i = 0; i < element.properties.size(); ++i) {
      const PlyType type = element.properties[i].type;
      if (vertices.slot(i) != kNoSlot) fields.push_back({vertices.slot(i), type, size});
      size += size_of(type);
    }
    const char* const begin = at_;
    for_each_span(static_cast<std::size_t>(element.rows), kSpan, [&](std::size_t first, std::size_t last) {
      PlyVertices::Values values{};
      for (std::size_t row = first; row < last; ++row) {
        const char* const at = begin + row * size;
        for (const Field& field : fields) {
          values[static_cast<std::size_t>(field.slot)] = load_float(at + field.offset, field.type, swap_);
        }
        if (!vertices.store(row, values)) throw not_finite(at, row);
      }
    });
    at_ += element.rows * size;
  }

  void read_ragged_vertices(const PlyElement& element, PlyVertices& vertices) {
    PlyVertices::Values values{};
    for (std::size_t row = 0; row < element.rows; ++row) {
      const char* const begin = at_;
      for (std::size_t i = 0; i < element.properties.size(); ++i) {
        const PlyProperty& property = element.properties[i];
        const char* const next = skip(at_, element, property, row);
        if (vertices.slot(i) != kNoSlot) {
          values[static_cast<std::size_t>(vertices.slot(i))] = load_float(at_, property.type, swap_);
        }
        at_ = next;
      }
      if (!vertices.store(row, values)) throw not_finite(begin, row);
    }
  }

  static Failure not_finite(const char* at, std::size_t row) {
    return {at, fmt::format("a coordinate of vertex {} is not finite", row)};
  }

  // --- faces ---

  std::uint64_t vertices() const { return header_.find("vertex")->rows; }

  Failure no_such_vertex(const char* at, std::int64_t index) const {
    return {at, fmt::format("there is no vertex {}: they are numbered from 0 to {}", index,
                            static_cast<std::int64_t>(vertices()) - 1)};
  }

  void read_faces(const PlyElement& element) {
    if (element.name == "face" && read_triangles(element)) return;
    // Where rows begin is known only by walking over them; what they hold is then read in parallel.
    std::vector<const char*> begins;
    for (std::uint64_t row = 0; row < element.rows; ++row) {
      if (row % kSpan == 0) begins.push_back(at_);
      at_ = skip_row(at_, element, row);
    }
    const std::size_t before = result_.faces.size();
    result_.faces.resize(before + begins.size());
    for_each_chunk(begins.size(), [&](std::size_t i) {
      const std::uint64_t rows = std::min<std::uint64_t>(kSpan, element.rows - i * kSpan);
      result_.faces[before + i] = read_lists(element, begins[i], rows);
    });
  }

  Polygons read_lists(const PlyElement& element, const char* at, std::uint64_t rows) const {
    PlyFaces faces(element.name == "tristrips", vertices());
    const auto corner_list = static_cast<std::size_t>(element.corner_list());
    for (std::uint64_t row = 0; row < rows; ++row) {
      for (std::size_t i = 0; i < element.properties.size(); ++i) {
        const PlyProperty& property = element.properties[i];
        const char* const next = skip(at, element, property, row);
        if (i == corner_list) {
          for (at += size_of(property.count_type); at != next; at += size_of(property.type)) {
            const std::int64_t index = load_integer(at, property.type, swap_);
            if (!faces.add(index)) throw no_such_vertex(at, index);
          }
          faces.end_list();
        }
        at = next;
      }
    }
    return faces.take();
  }

  // What nearly all files hold: one list a row, of three corners. All rows then have the same size, and
  // their triangles go straight to their places. False, with nothing read, where a row is different.
  bool read_triangles(const PlyElement& element) {
    const auto corner_list = static_cast<std::size_t>(element.corner_list());
    const PlyProperty& list = element.properties[corner_list];
    std::size_t size = 3 * size_of(list.type), offset = 0;
    for (std::size_t i = 0; i < element.properties.size(); ++i) {
      const PlyProperty& property = element.properties[i];
      if (property.is_list && i != corner_list) return false;
      if (i == corner_list) offset = size - 3 * size_of(list.type);
      size += size_of(property.is_list ? property.count_type : property.type);
    }
    if (element.rows > left(at_) / size) return false;

    std::vector<std::array<std::uint32_t, 3>>& triangles = result_.mesh.triangles;
    const std::size_t before = triangles.size();
    triangles.resize(before + static_cast<std::size_t>(element.rows));
    std::atomic<bool> all = true;
    const char* const begin = at_ + offset;
    for_each_span(static_cast<std::size_t>(element.rows), kSpan, [&](std::size_t first, std::size_t last) {
      if (!all || read_triangle_rows(list, begin + first * size, size, triangles.data() + before + first,
                                     triangles.data() + before + last)) {
        return;
      }
      all = false;
    });
    if (all) {
      at_ += element.rows * size;
    } else {
      triangles.resize(before);
    }
    return all;
  }

  // False where a list is not of three, or names no vertex: the slower way tells which.
  bool read_triangle_rows(const PlyProperty& list, const char* at, std::size_t size,
                          std::array<std::uint32_t, 3>* out, const std::array<std::uint32_t, 3>* end) const {
    const std::size_t head = size_of(list.count_type), step = size_of(list.type);
    const bool plain = head == 1 && step == 4 && !swap_;
    const std::uint64_t count = vertices();
    for (; out != end; ++out, at += size) {
      std::uint32_t a = 0, b = 0, c = 0;  // what is negative becomes too large
      if (plain) {
        if (*at != 3) return false;
        a = load<std::uint32_t>(at + 1, false);
        b = load<std::uint32_t>(at + 5, false);
        c = load<std::uint32_t>(at + 9, false);
      } else {
        if (load_integer(at, list.count_type, swap_) != 3) return false;
        const char* const corners = at + head;
        a = static_cast<std::uint32_t>(load_integer(corners, list.type, swap_));
        b = static_cast<std::uint32_t>(load_integer(corners + step, list.type, swap_));
        c = static_cast<std::uint32_t>(load_integer(corners + 2 * step, list.type, swap_));
      }
      if (a >= count || b >= count || c >= count) return false;
      *out = {a, b, c};
    }
    return true;
  }

  const PlyHeader& header_;
  PlyResult& result_;
  bool swap_;
  const char* at_;
  const char* end_;
};

}  // namespace

void read_ply_binary(std::string_view file, const PlyHeader& header, PlyResult& result) {
  BinaryReader(file, header, result).read();
}

}  // namespace raytracer::meshes
