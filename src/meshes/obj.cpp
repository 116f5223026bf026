#include "meshes/obj.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <span>
#include <utility>

#include "meshes/flat_faces.hpp"
#include "meshes/obj_lines.hpp"
#include "meshes/obj_materials.hpp"
#include "meshes/obj_vertices.hpp"
#include "raytracer/error.hpp"

namespace raytracer::meshes {
namespace {

// How many statements of each kind, or how many came before.
struct Counts {
  std::size_t positions = 0, uvs = 0, normals = 0;

  Counts& operator+=(const Counts& other) {
    positions += other.positions;
    uvs += other.uvs;
    normals += other.normals;
    return *this;
  }
};

// What one piece of the text says besides the numbers that it writes to their places.
struct Piece {
  ObjFaces faces;
  std::vector<Color3f> colors;  // none, or one per position of this piece
  std::vector<MaterialUse> uses;
  std::vector<std::string_view> libraries;
  std::size_t not_finite = 0;           // uvs, normals and colours made 0
  const char* nothing_named = nullptr;  // the first uv or normal named where the file has none
  const char* unknown_word = nullptr;   // the first
  const char* surface = nullptr;        // the first statement of a curve or surface
};

Counts count_statements(std::string_view text) {
  Counts counts;
  Cursor c(text);
  while (find_statement(c)) {
    const std::string_view word = peek_word(c);
    if (word == "v") ++counts.positions;
    if (word == "vt") ++counts.uvs;
    if (word == "vn") ++counts.normals;
    skip_statement(c);
  }
  return counts;
}

// Groups, names, display settings, lines, points, skinning weights: nothing that a picture needs.
constexpr std::string_view kSkipped[] = {
    "g",        "o",        "s",          "mg",        "l",  "p",  "usemap", "maplib", "lod", "bevel",
    "c_interp", "d_interp", "shadow_obj", "trace_obj", "vp", "vw", "t",      "call",   "csh"};
constexpr std::string_view kSurfaces[] = {"cstype", "deg",  "bmat",  "step", "curv", "curv2",
                                          "surf",   "parm", "trim",  "hole", "scrv", "sp",
                                          "end",    "con",  "ctech", "stech"};

// What an index names, in messages.
constexpr std::string_view kVertex = "vertex", kUv = "texture coordinate", kNormal = "normal";

class PieceReader {
 public:
  PieceReader(std::string_view text, const Counts& before, const Counts& all, ObjAttributes& attributes)
      : c_(text), seen_(before), first_position_(before.positions), all_(all), attributes_(attributes) {}

  Piece read() {
    while (find_statement(c_)) {
      const char* const begin = c_.at;
      const std::string_view word = read_word(c_);
      if (word == "v") {
        read_position();
      } else if (word == "vt") {
        read_uv();
      } else if (word == "vn") {
        read_normal();
      } else if (word == "f" || word == "fo") {  // "fo": an old name
        read_face();
      } else {
        read_other(begin, word);
        continue;  // which has gone behind the statement
      }
      skip_statement(c_);
    }
    return std::move(piece_);
  }

 private:
  // The numbers of a statement, up to a comment; as many as `numbers` holds. Returns how many.
  std::size_t read_numbers(std::span<double> numbers) {
    for (std::size_t count = 0; count < numbers.size(); ++count) {
      skip_obj_blanks(c_);
      if (at_line_end(c_) || *c_.at == '#') return count;
      if (!read_number(c_, numbers[count])) {
        throw Failure{c_.at, fmt::format("{} is not a number", in_quotes(peek_word(c_)))};
      }
    }
    return numbers.size();
  }

  float finite_or_0(double number) {
    const auto value = static_cast<float>(number);
    if (std::isfinite(value)) return value;
    ++piece_.not_finite;
    return 0;
  }

  // "x y z", "x y z w", "x y z r g b" or "x y z r g b a".
  void read_position() {
    const char* const begin = c_.at;
    double numbers[7];
    const std::size_t count = read_numbers(numbers);
    if (count < 3) throw Failure{begin, fmt::format("a vertex has 3 coordinates, not {}", count)};
    const Vector3f position(static_cast<float>(numbers[0]), static_cast<float>(numbers[1]),
                            static_cast<float>(numbers[2]));
    if (!std::isfinite(position.x) || !std::isfinite(position.y) || !std::isfinite(position.z)) {
      throw Failure{begin, "a coordinate is not finite"};
    }
    const std::size_t index = seen_.positions++;
    attributes_.positions[index] = position;
    const std::size_t local = index - first_position_;
    if (count >= 6) {
      piece_.colors.resize(local, Color3f(1));  // those before without a colour
      piece_.colors.push_back(glm::max(
          Color3f(finite_or_0(numbers[3]), finite_or_0(numbers[4]), finite_or_0(numbers[5])), Color3f(0)));
    } else if (!piece_.colors.empty()) {
      piece_.colors.emplace_back(1);
    }
  }

  void read_uv() {
    const char* const begin = c_.at;
    double numbers[2] = {0, 0};
    if (read_numbers(numbers) == 0) throw Failure{begin, "a texture coordinate has at least 1 number"};
    attributes_.uvs[seen_.uvs++] = {finite_or_0(numbers[0]), finite_or_0(numbers[1])};
  }

  void read_normal() {
    const char* const begin = c_.at;
    double numbers[3];
    const std::size_t count = read_numbers(numbers);
    if (count < 3) throw Failure{begin, fmt::format("a normal has 3 numbers, not {}", count)};
    const Vector3d normal(finite_or_0(numbers[0]), finite_or_0(numbers[1]), finite_or_0(numbers[2]));
    const double length = glm::length(normal);
    attributes_.normals[seen_.normals++] = length > 0 ? Vector3f(normal / length) : Vector3f(0);
  }

  void read_face() {
    std::vector<std::uint32_t>& corners = piece_.faces.polygons.corners;
    const std::size_t begin = corners.size();
    while (true) {
      skip_obj_blanks(c_);
      if (at_line_end(c_) || *c_.at == '#') break;
      read_corner();
    }
    if (piece_.faces.polygons.end_face(begin)) return;
    for (auto* indices : {&piece_.faces.uvs, &piece_.faces.normals}) {
      if (!indices->empty()) indices->resize(begin);
    }
  }

  // "p", "p/t", "p//n" or "p/t/n".
  void read_corner() {
    const char* const begin = c_.at;
    const auto is_slash = [&] { return c_.at != c_.end && *c_.at == '/'; };
    piece_.faces.polygons.corners.push_back(read_index(kVertex, seen_.positions, all_.positions));
    std::uint32_t uv = kUnnamed, normal = kUnnamed;
    if (is_slash()) {
      ++c_.at;
      if (!ends_word(c_) && !is_slash()) uv = read_index(kUv, seen_.uvs, all_.uvs);
      if (is_slash()) {
        ++c_.at;
        if (!ends_word(c_)) normal = read_index(kNormal, seen_.normals, all_.normals);
      }
    }
    if (!ends_word(c_)) throw not_a_corner(begin);
    add_index(piece_.faces.uvs, uv);
    add_index(piece_.faces.normals, normal);
  }

  Failure not_a_corner(const char* begin) {
    c_.at = begin;
    return {begin,
            fmt::format("{} is not a corner of a face, like 1, 1/2 or 1/2/3", in_quotes(peek_word(c_)))};
  }

  void add_index(std::vector<std::uint32_t>& indices, std::uint32_t index) const {
    if (index == kUnnamed && indices.empty()) return;
    indices.resize(piece_.faces.polygons.corners.size() - 1, kUnnamed);  // corners before that name none
    indices.push_back(index);
  }

  // Counted from 1, or from what was last back from -1.
  std::uint32_t read_index(std::string_view what, std::size_t seen, std::size_t all) {
    const char* const begin = c_.at;
    std::int64_t index = 0;
    if (!read_integer(c_, index)) throw not_a_corner(begin);
    if (index == 0) throw Failure{begin, fmt::format("there is no {} 0: they count from 1", what)};
    if (all == 0 && what != kVertex) {  // some programs write a number that stands for none
      if (piece_.nothing_named == nullptr) piece_.nothing_named = begin;
      return kUnnamed;
    }
    if (index < 0) {
      if (index < -static_cast<std::int64_t>(seen)) {
        throw Failure{begin, fmt::format("there is no {} {}: {} came before", what, index, seen)};
      }
      return static_cast<std::uint32_t>(static_cast<std::int64_t>(seen) + index);
    }
    if (static_cast<std::uint64_t>(index) > all) {
      throw Failure{begin, fmt::format("there is no {} {}: the file has {}", what, index, all)};
    }
    return static_cast<std::uint32_t>(index - 1);
  }

  void read_other(const char* begin, std::string_view word) {
    const auto is_in = [&](const auto& words) {
      return std::find(std::begin(words), std::end(words), word) != std::end(words);
    };
    if (word == "usemtl") {
      piece_.uses.push_back({piece_.faces.polygons.triangles(), read_rest(c_)});
    } else if (word == "mtllib") {
      const std::string_view list = read_rest(c_);
      if (!list.empty()) piece_.libraries.push_back(list);
    } else {
      if (is_in(kSurfaces)) {
        if (piece_.surface == nullptr) piece_.surface = begin;
      } else if (!is_in(kSkipped)) {
        check_unknown(begin, word);
      }
      skip_statement(c_);
    }
  }

  // Words of other programs' extensions are skipped; what is no word tells that this is no OBJ file.
  void check_unknown(const char* begin, std::string_view word) {
    const bool is_word = std::all_of(word.begin(), word.end(), [](char c) {
      return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_' || is_digit(c);
    });
    if (!is_word || is_digit(word[0])) {
      throw Failure{begin, fmt::format("{} does not begin a statement of an OBJ file", in_quotes(word))};
    }
    if (piece_.unknown_word == nullptr) piece_.unknown_word = begin;
  }

  Cursor c_;
  Counts seen_;  // statements before this place
  std::size_t first_position_;
  const Counts& all_;
  ObjAttributes& attributes_;
  Piece piece_;
};

// The whole file: counts first, so that every piece knows what its numbers' places are.
class ObjReader {
 public:
  ObjReader(std::string_view text, std::size_t chunk_bytes)
      : text_(text),
        chunks_(cut_at_lines(text, chunk_bytes, [](const char* line) { return !continues_line(line); })) {}

  MeshData read(const std::string& folder, const MayRead& may_read) {
    count();
    read_pieces();
    gather_colors();
    MeshData mesh;
    mesh.has_display_colors = !attributes_.colors.empty();  // what programs write here is meant for a display
    build(folder, may_read, mesh);
    return mesh;
  }

 private:
  void count() {
    before_.resize(chunks_.size());
    for_each_chunk(chunks_.size(), [&](std::size_t i) { before_[i] = count_statements(chunks_[i]); });
    for (Counts& counts : before_) {
      const Counts here = std::exchange(counts, all_);
      all_ += here;
    }
    if (std::max({all_.positions, all_.uvs, all_.normals}) >= kUnnamed) {
      throw Error(ErrorKind::kScene, "it has more than 4,294,967,294 vertices");
    }
  }

  void read_pieces() {
    attributes_.positions.resize(all_.positions);
    attributes_.uvs.resize(all_.uvs);
    attributes_.normals.resize(all_.normals);
    pieces_.resize(chunks_.size());
    for_each_chunk(chunks_.size(), [&](std::size_t i) {
      pieces_[i] = PieceReader(chunks_[i], before_[i], all_, attributes_).read();
    });
  }

  void gather_colors() {
    const bool any =
        std::any_of(pieces_.begin(), pieces_.end(), [](const Piece& p) { return !p.colors.empty(); });
    if (!any) return;
    attributes_.colors.assign(all_.positions, Color3f(1));
    for (std::size_t i = 0; i < pieces_.size(); ++i) {
      std::copy(pieces_[i].colors.begin(), pieces_[i].colors.end(),
                attributes_.colors.begin() + static_cast<std::ptrdiff_t>(before_[i].positions));
      pieces_[i].colors = {};
    }
  }

  void build(const std::string& folder, const MayRead& may_read, MeshData& mesh) {
    std::vector<ObjFaces> faces;
    std::vector<Polygons> polygons;
    std::vector<MaterialUse> uses;
    std::vector<std::string_view> libraries;
    std::size_t triangles = 0;
    std::uint64_t left_out = 0;
    for (Piece& piece : pieces_) {
      for (const MaterialUse& use : piece.uses) uses.push_back({triangles + use.triangle, use.name});
      libraries.insert(libraries.end(), piece.libraries.begin(), piece.libraries.end());
      triangles += piece.faces.polygons.triangles();
      left_out += piece.faces.polygons.left_out();
      faces.push_back(std::move(piece.faces));
    }
    tell_remarks(mesh);
    unify_corners(faces, std::move(attributes_), mesh);
    for (ObjFaces& piece : faces) polygons.push_back(std::move(piece.polygons));
    append_triangles(polygons, mesh);
    add_materials(libraries, uses, folder, may_read, mesh);
    leave_out_flat_faces(mesh, left_out);
  }

  std::ptrdiff_t line_of(const char* at) const { return std::count(text_.data(), at, '\n') + 1; }

  void tell_remarks(MeshData& mesh) const {
    std::size_t not_finite = 0;
    const char *nothing = nullptr, *unknown = nullptr, *surface = nullptr;
    for (const Piece& piece : pieces_) {
      not_finite += piece.not_finite;
      if (nothing == nullptr) nothing = piece.nothing_named;
      if (unknown == nullptr) unknown = piece.unknown_word;
      if (surface == nullptr) surface = piece.surface;
    }
    if (nothing != nullptr) {
      mesh.remarks.push_back(fmt::format(
          "line {}: faces name normals or texture coordinates, but the file has none", line_of(nothing)));
    }
    if (unknown != nullptr) {
      const Cursor word({unknown, static_cast<std::size_t>(text_.data() + text_.size() - unknown)});
      mesh.remarks.push_back(fmt::format("line {}: {} is not known, and lines that begin so are skipped",
                                         line_of(unknown), in_quotes(peek_word(word))));
    }
    if (surface != nullptr) {
      mesh.remarks.push_back(
          fmt::format("line {}: curves and curved surfaces are skipped", line_of(surface)));
    }
    tell_not_finite(not_finite, mesh);
  }

  std::string_view text_;
  std::vector<std::string_view> chunks_;
  std::vector<Counts> before_;
  Counts all_;
  ObjAttributes attributes_;
  std::vector<Piece> pieces_;
};

}  // namespace

MeshData read_obj(std::string_view text, const std::string& folder, const MayRead& may_read,
                  std::size_t chunk_bytes) {
  const std::string_view mark = text.substr(0, 2);
  if (mark == "\xFE\xFF" || mark == "\xFF\xFE") {
    throw Error(ErrorKind::kScene, "line 1: the text is UTF-16; an OBJ file's is ASCII or UTF-8");
  }
  std::string_view body = text;
  if (body.substr(0, 3) == "\xEF\xBB\xBF") body.remove_prefix(3);
  MeshData mesh;
  with_lines(text, [&] { mesh = ObjReader(body, chunk_bytes).read(folder, may_read); });
  return mesh;
}

}  // namespace raytracer::meshes
