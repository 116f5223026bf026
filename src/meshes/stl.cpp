#include "meshes/stl.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>

#include "meshes/flat_faces.hpp"
#include "meshes/text.hpp"
#include "meshes/weld.hpp"
#include "raytracer/error.hpp"

namespace raytracer::meshes {
namespace {

// --- binary: 80 bytes of anything, the number of facets, and for each a normal, three corners and two bytes
// ---

constexpr std::size_t kNameSize = 80;
constexpr std::size_t kHeaderSize = kNameSize + 4;
constexpr std::size_t kFacetSize = 50;
constexpr std::size_t kNormalSize = 12;
constexpr std::size_t kSpan = std::size_t{1} << 13U;

std::uint32_t load_little_endian(const char* at) {
  std::uint32_t value = 0;
  for (int i = 3; i >= 0; --i) value = value << 8U | static_cast<unsigned char>(at[i]);
  return value;
}

bool is_finite(const Vector3f& p) { return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z); }

std::vector<Vector3f> read_binary(std::string_view file) {
  if (file.size() < kHeaderSize) {
    throw Failure{file.data() + file.size(), "the file ends within the header of a binary STL file"};
  }
  const std::size_t facets = load_little_endian(file.data() + kNameSize);
  const std::size_t left = file.size() - kHeaderSize;
  if (facets > left / kFacetSize) {
    if (file.substr(0, kHeaderSize).find('\0') == std::string_view::npos) {  // a number that large is text
      throw Failure{file.data(), "the file begins neither with 'solid' nor as a binary STL file does"};
    }
    throw Failure{
        file.data() + kNameSize,
        fmt::format("the header promises {} triangles of 50 bytes, but only {} bytes follow", facets, left)};
  }
  std::vector<Vector3f> corners(3 * facets);
  for_each_span(facets, kSpan, [&](std::size_t begin, std::size_t end) {
    for (std::size_t facet = begin; facet < end; ++facet) {
      const char* at = file.data() + kHeaderSize + facet * kFacetSize + kNormalSize;
      for (std::size_t i = 3 * facet; i < 3 * facet + 3; ++i) {
        for (int axis = 0; axis < 3; ++axis, at += 4) {
          corners[i][axis] = std::bit_cast<float>(load_little_endian(at));
        }
        if (!is_finite(corners[i])) {
          throw Failure{at - 12, fmt::format("a coordinate of triangle {} is not finite", facet)};
        }
      }
    }
  });
  return corners;
}

// --- text ---

// Letters in either case.
bool is_word(std::string_view word, std::string_view lower) {
  return std::equal(word.begin(), word.end(), lower.begin(), lower.end(), [](char a, char b) {
    return (a >= 'A' && a <= 'Z' ? static_cast<char>(a - 'A' + 'a') : a) == b;
  });
}

bool begins_with_solid(std::string_view file) {
  Cursor c(file);
  skip_blanks(c);
  return is_word(peek_word(c), "solid");
}

// A binary file may begin with "solid" too.
bool is_text(std::string_view file) {
  constexpr std::size_t kLooked = 512;
  if (!begins_with_solid(file)) return false;
  if (file.size() >= kHeaderSize &&
      file.size() == kHeaderSize + kFacetSize * std::size_t{load_little_endian(file.data() + kNameSize)}) {
    return false;
  }
  return file.substr(0, kLooked).find('\0') == std::string_view::npos;
}

// Reads a piece of the text that begins where a facet does, or at the file's beginning.
class TextReader {
 public:
  TextReader(std::string_view chunk, bool is_first, bool is_last)
      : c_(chunk), in_solid_(!is_first), is_last_(is_last) {}

  std::vector<Vector3f> read() {
    while (true) {
      const std::string_view word = next();
      if (is_word(word, "facet") && in_solid_) {
        read_facet();
      } else if (is_word(word, "endsolid") && in_solid_) {
        skip_line(c_);  // the name
        in_solid_ = false;
      } else if (is_word(word, "solid") && !in_solid_) {
        skip_line(c_);
        in_solid_ = true;
      } else if (word.empty()) {
        if (is_last_ && in_solid_) throw Failure{c_.at, "the file ends before 'endsolid'"};
        return std::move(corners_);
      } else {
        throw Failure{word.data(), fmt::format("{} stands where '{}' is expected", in_quotes(word),
                                               in_solid_ ? "facet' or 'endsolid" : "solid")};
      }
    }
  }

 private:
  // The next word, whatever line it stands in; empty at the end.
  std::string_view next() {
    while (c_.at != c_.end && (is_blank(*c_.at) || *c_.at == '\n')) ++c_.at;
    return read_word(c_);
  }

  void expect(std::string_view expected) {
    const std::string_view word = next();
    if (is_word(word, expected)) return;
    throw Failure{word.data(),
                  word.empty() ? fmt::format("the file ends before '{}'", expected)
                               : fmt::format("{} stands where '{}' is expected", in_quotes(word), expected)};
  }

  void read_facet() {
    std::string_view word = next();
    if (is_word(word, "normal")) {
      for (int i = 0; i < 3; ++i) next();
      word = next();
    }
    if (!is_word(word, "outer")) {
      throw Failure{word.data(),
                    word.empty() ? "the file ends before 'outer loop'"
                                 : fmt::format("{} stands where 'outer loop' is expected", in_quotes(word))};
    }
    expect("loop");
    for (int i = 0; i < 3; ++i) {
      expect("vertex");
      corners_.push_back(read_corner());
    }
    expect("endloop");
    expect("endfacet");
  }

  Vector3f read_corner() {
    Vector3f corner(0);
    skip_blanks(c_);
    const char* const begin = c_.at;
    for (int axis = 0; axis < 3; ++axis) {
      skip_blanks(c_);
      double number = 0;
      if (!read_number(c_, number)) {
        const std::string_view word = peek_word(c_);
        throw Failure{c_.at, word.empty() ? "a vertex has 3 coordinates"
                                          : fmt::format("{} is not a number", in_quotes(word))};
      }
      corner[axis] = static_cast<float>(number);
    }
    if (!is_finite(corner)) throw Failure{begin, "a coordinate is not finite"};
    return corner;
  }

  Cursor c_;
  bool in_solid_;
  bool is_last_;
  std::vector<Vector3f> corners_;
};

std::vector<Vector3f> read_text(std::string_view file, std::size_t chunk_bytes) {
  const char* const end = file.data() + file.size();
  const std::vector<std::string_view> chunks = cut_at_lines(file, chunk_bytes, [&](const char* line) {
    Cursor c({line, static_cast<std::size_t>(end - line)});
    skip_blanks(c);
    return is_word(peek_word(c), "facet");
  });
  std::vector<std::vector<Vector3f>> pieces(chunks.size());
  for_each_chunk(chunks.size(), [&](std::size_t i) {
    pieces[i] = TextReader(chunks[i], i == 0, i + 1 == chunks.size()).read();
  });
  std::size_t count = 0;
  for (const auto& piece : pieces) count += piece.size();
  std::vector<Vector3f> corners;
  corners.reserve(count);
  for (auto& piece : pieces) {
    corners.insert(corners.end(), piece.begin(), piece.end());
    piece = {};
  }
  return corners;
}

}  // namespace

bool looks_like_stl(std::string_view file) {
  return begins_with_solid(file) ||
         (file.size() >= kHeaderSize &&
          file.size() == kHeaderSize + kFacetSize * std::size_t{load_little_endian(file.data() + kNameSize)});
}

MeshData read_stl(std::string_view file, std::size_t chunk_bytes) {
  std::vector<Vector3f> corners;
  if (file.empty()) throw Error(ErrorKind::kScene, "it is empty");
  if (is_text(file)) {
    with_lines(file, [&] { corners = read_text(file, chunk_bytes); });
  } else {
    with_bytes(file, [&] { corners = read_binary(file); });
  }
  MeshData mesh;
  weld(corners, mesh);
  leave_out_flat_faces(mesh, 0);
  return mesh;
}

}  // namespace raytracer::meshes
