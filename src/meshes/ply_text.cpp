#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <optional>

#include "meshes/chunks.hpp"
#include "meshes/ply_bodies.hpp"
#include "meshes/ply_rows.hpp"
#include "meshes/text.hpp"

namespace raytracer::meshes {
namespace {

// To the first word of the next line that has one; false at the end of the text.
bool find_row(Cursor& c) {
  while (c.at != c.end && (is_blank(*c.at) || *c.at == '\n')) ++c.at;
  return c.at != c.end;
}

std::uint64_t count_rows(std::string_view text) {
  std::uint64_t rows = 0;
  for (Cursor c(text); find_row(c); skip_line(c)) ++rows;
  return rows;
}

// Every row of an element is a line, so that the text can be cut anywhere between lines.
class TextReader {
 public:
  TextReader(std::string_view file, const PlyHeader& header, std::size_t chunk_bytes, PlyResult& result)
      : header_(header),
        result_(result),
        end_(file.data() + file.size()),
        chunks_(cut_at_lines(file.substr(header.body), chunk_bytes, [](const char*) { return true; })) {}

  void read() {
    place_elements();
    count();
    vertices_.emplace(*header_.find("vertex"), result_.mesh);
    result_.faces.resize(chunks_.size() * header_.elements.size());
    for_each_chunk(chunks_.size(), [&](std::size_t i) { read_chunk(i); });
    result_.not_finite += vertices_->not_finite();
  }

 private:
  // An element and the row that it begins with, counted over the whole body.
  struct Placed {
    const PlyElement* element;
    std::uint64_t begin, end;
  };

  void place_elements() {
    std::uint64_t row = 0;
    for (const PlyElement& element : header_.elements) {
      if (element.properties.empty()) continue;  // takes no line
      const std::uint64_t rows = std::min(element.rows, std::numeric_limits<std::uint64_t>::max() - row);
      placed_.push_back({&element, row, row + rows});
      row += rows;
    }
  }

  // Before memory is taken for what the header promises.
  void count() {
    std::vector<std::uint64_t> counts(chunks_.size());
    for_each_chunk(chunks_.size(), [&](std::size_t i) { counts[i] = count_rows(chunks_[i]); });
    std::uint64_t row = 0;
    for (const std::uint64_t rows : counts) {
      first_rows_.push_back(row);
      row += rows;
    }
    for (const Placed& placed : placed_) {
      if (placed.end <= row) continue;
      throw Failure{end_,
                    fmt::format("the file ends after {} of {} lines of {}", row - std::min(row, placed.begin),
                                placed.element->rows, in_quotes(placed.element->name))};
    }
  }

  void read_chunk(std::size_t chunk) {
    Cursor c(chunks_[chunk]);
    std::uint64_t row = first_rows_[chunk];
    for (std::size_t i = 0; i < placed_.size(); ++i) {
      const Placed& placed = placed_[i];
      if (row >= placed.end) continue;
      if (placed.element->name == "vertex") {
        row = read_vertices(c, row, placed);
      } else if (placed.element->corner_list() >= 0) {
        // Piece after piece of each element in its turn, as the triangles are to be.
        row = read_faces(c, row, placed, result_.faces[i * chunks_.size() + chunk]);
      } else {
        for (; row < placed.end && find_row(c); ++row) skip_line(c);
      }
    }
  }

  std::uint64_t read_vertices(Cursor& c, std::uint64_t row, const Placed& placed) {
    PlyVertices::Values values{};
    for (; row < placed.end && find_row(c); ++row) {
      const char* const begin = c.at;
      for (std::size_t i = 0; i < placed.element->properties.size(); ++i) {
        const PlyProperty& property = placed.element->properties[i];
        if (property.is_list) {
          skip_list(c, placed);
          continue;
        }
        const double number = read_value(c, placed);
        const PlySlot slot = vertices_->slot(i);
        if (slot != kNoSlot) values[static_cast<std::size_t>(slot)] = static_cast<float>(number);
      }
      end_row(c, placed);
      if (!vertices_->store(static_cast<std::size_t>(row - placed.begin), values)) {
        throw Failure{begin, fmt::format("a coordinate of vertex {} is not finite", row - placed.begin)};
      }
    }
    return row;
  }

  std::uint64_t read_faces(Cursor& c, std::uint64_t row, const Placed& placed, Polygons& result) {
    const std::uint64_t vertices = header_.find("vertex")->rows;
    PlyFaces faces(placed.element->name == "tristrips", vertices);
    const auto corner_list = static_cast<std::size_t>(placed.element->corner_list());
    for (; row < placed.end && find_row(c); ++row) {
      for (std::size_t i = 0; i < placed.element->properties.size(); ++i) {
        if (i == corner_list) {
          read_corners(c, placed, faces, vertices);
        } else if (placed.element->properties[i].is_list) {
          skip_list(c, placed);
        } else {
          skip_value(c, placed);
        }
      }
      end_row(c, placed);
    }
    result = faces.take();
    return row;
  }

  static void read_corners(Cursor& c, const Placed& placed, PlyFaces& faces, std::uint64_t vertices) {
    for (std::int64_t count = read_length(c, placed); count > 0; --count) {
      skip_blanks(c);
      const char* const begin = c.at;
      const std::int64_t corner = read_whole(c, placed);
      if (faces.add(corner)) continue;
      throw Failure{begin, fmt::format("there is no vertex {}: they are numbered from 0 to {}", corner,
                                       static_cast<std::int64_t>(vertices) - 1)};
    }
    faces.end_list();
  }

  static void expect_value(Cursor& c, const Placed& placed) {
    skip_blanks(c);
    if (at_line_end(c)) {
      throw Failure{
          c.at, fmt::format("the line ends before {} has all its values", in_quotes(placed.element->name))};
    }
  }

  static double read_value(Cursor& c, const Placed& placed) {
    expect_value(c, placed);
    double number = 0;
    if (!read_number(c, number)) {
      throw Failure{c.at, fmt::format("{} is not a number", in_quotes(peek_word(c)))};
    }
    return number;
  }

  static std::int64_t read_whole(Cursor& c, const Placed& placed) {
    expect_value(c, placed);
    const Cursor begin = c;
    std::int64_t number = 0;
    if (!read_integer(c, number) || !ends_word(c)) {
      throw Failure{begin.at, fmt::format("{} is not a whole number", in_quotes(peek_word(begin)))};
    }
    return number;
  }

  static std::int64_t read_length(Cursor& c, const Placed& placed) {
    skip_blanks(c);
    const char* const begin = c.at;
    const std::int64_t length = read_whole(c, placed);
    if (length < 0) throw Failure{begin, fmt::format("a list has {} values", length)};
    return length;
  }

  static void skip_value(Cursor& c, const Placed& placed) {
    expect_value(c, placed);
    read_word(c);
  }

  static void skip_list(Cursor& c, const Placed& placed) {
    for (std::int64_t count = read_length(c, placed); count > 0; --count) skip_value(c, placed);
  }

  static void end_row(Cursor& c, const Placed& placed) {
    skip_blanks(c);
    if (!at_line_end(c)) {
      throw Failure{c.at, fmt::format("{} has all its values before {}", in_quotes(placed.element->name),
                                      in_quotes(peek_word(c)))};
    }
  }

  const PlyHeader& header_;
  PlyResult& result_;
  const char* end_;
  std::vector<std::string_view> chunks_;
  std::vector<std::uint64_t> first_rows_;  // the number of the first row that begins in each chunk
  std::vector<Placed> placed_;
  std::optional<PlyVertices> vertices_;
};

}  // namespace

void read_ply_text(std::string_view file, const PlyHeader& header, std::size_t chunk_bytes,
                   PlyResult& result) {
  TextReader(file, header, chunk_bytes, result).read();
}

}  // namespace raytracer::meshes
