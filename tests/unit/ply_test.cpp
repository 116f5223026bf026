#include "meshes/ply.hpp"

#include "mesh_files.hpp"

using namespace raytracer;
using meshes::read_ply;

namespace {

using Positions = std::vector<Vector3f>;

enum class Kind { kAscii, kLittle, kBig };
constexpr Kind kKinds[] = {Kind::kAscii, Kind::kLittle, Kind::kBig};

// Writes the same numbers in each of the three ways.
class Ply {
 public:
  explicit Ply(Kind kind) : kind_(kind), bytes_(kind == Kind::kBig) {
    header_ = kind == Kind::kAscii    ? "ply\nformat ascii 1.0\n"
              : kind == Kind::kLittle ? "ply\nformat binary_little_endian 1.0\n"
                                      : "ply\nformat binary_big_endian 1.0\n";
  }
  Ply& header(const std::string& lines) {
    header_ += lines;
    return *this;
  }
  template <typename T>
  Ply& add(std::initializer_list<T> numbers) {
    for (const T number : numbers) add(number);
    return *this;
  }
  template <typename T>
  Ply& add(T number) {
    if (kind_ != Kind::kAscii) {
      bytes_.add(number);
    } else if constexpr (std::is_floating_point_v<T>) {
      char text[40];
      std::snprintf(text, sizeof text, "%.17g ", static_cast<double>(number));
      bytes_.text(text);
    } else {
      bytes_.text(std::to_string(number) + " ");
    }
    return *this;
  }
  Ply& end_row() {
    if (kind_ == Kind::kAscii) bytes_.text("\n");
    return *this;
  }
  std::string str() const { return header_ + "end_header\n" + bytes_.str(); }

 private:
  Kind kind_;
  std::string header_;
  Bytes bytes_;
};

using U8 = std::uint8_t;

const std::string kPositions = "property float x\nproperty float y\nproperty float z\n";
const std::string kFaces = "property list uchar int vertex_indices\n";

Ply& add_square(Ply& ply) {
  for (const Vector3f& p : Positions{{0, 0, 0}, {1, 0, 0}, {1, 1, 0.1f}, {0, 1, 0}})
    ply.add({p.x, p.y, p.z}).end_row();
  return ply;
}

// Four vertices and these faces.
std::string square(Kind kind, const std::vector<std::vector<std::int32_t>>& faces) {
  Ply ply(kind);
  ply.header("element vertex 4\n" + kPositions + "element face " + std::to_string(faces.size()) + "\n" +
             kFaces);
  add_square(ply);
  for (const auto& face : faces) {
    ply.add(static_cast<U8>(face.size()));
    for (const std::int32_t index : face) ply.add(index);
    ply.end_row();
  }
  return ply.str();
}

std::string error_of(const std::string& file) {
  return failure_of([&] { read_ply(file); });
}

std::size_t body_of(const std::string& file) { return file.find("end_header\n") + 11; }

std::string at_byte(std::size_t byte, const std::string& message) {
  return "byte " + std::to_string(byte) + ": " + message;
}

}  // namespace

TEST_CASE("PLY: triangles in text and both binary orders") {
  for (const Kind kind : kKinds) {
    const MeshData mesh = read_ply(square(kind, {{0, 1, 2}, {0, 2, 3}}));
    REQUIRE(mesh.positions == Positions{{0, 0, 0}, {1, 0, 0}, {1, 1, 0.1f}, {0, 1, 0}});
    REQUIRE(mesh.triangles == Triangles{{0, 1, 2}, {0, 2, 3}});
    REQUIRE((mesh.normals.empty() && mesh.uvs.empty() && mesh.colors.empty()));
    REQUIRE((mesh.ranges.empty() && mesh.materials.empty() && mesh.remarks.empty()));
  }
}

TEST_CASE("PLY: polygons of several sizes are cut into triangles") {
  for (const Kind kind : kKinds) {
    REQUIRE(read_ply(square(kind, {{0, 1, 2, 3}})).triangles == Triangles{{0, 1, 2}, {0, 2, 3}});
    const MeshData mesh = read_ply(square(kind, {{0, 1, 2}, {3, 2, 1, 0}, {0, 1, 3}, {}, {1, 2}}));
    REQUIRE(mesh.triangles == Triangles{{0, 1, 2}, {3, 2, 1}, {3, 1, 0}, {0, 1, 3}});
    REQUIRE(mesh.remarks == std::vector<std::string>{"2 of 6 triangles have no area and are left out"});
  }
}

TEST_CASE("PLY: normals, uvs and colours as bytes, in any order and among others") {
  for (const Kind kind : kKinds) {
    for (const std::string names : {"s t", "u v", "texture_u texture_v"}) {
      Ply ply(kind);
      const std::size_t blank = names.find(' ');
      ply.header(
          "comment anything\nobj_info more\nelement vertex 3\nproperty uchar red\nproperty float nx\n"
          "property double z\nproperty short unknown\nproperty float ny\nproperty float " +
          names.substr(blank + 1) +
          "\nproperty uchar green\nproperty float nz\nproperty float x\n"
          "property float y\nproperty float " +
          names.substr(0, blank) +
          "\nproperty uchar blue\nproperty uchar alpha\nelement face 1\nproperty uchar flags\n"
          "property list uint8 uint32 vertex_index\nproperty float quality\n");
      for (int i = 0; i < 3; ++i) {
        const auto f = static_cast<float>(i);
        ply.add(U8{255}).add(3 * f).add(10.5 + i).add(std::int16_t{-7}).add(4 * f).add(0.25f * f).add(U8{0});
        ply.add(0.0f).add(f).add(f * f).add(0.5f).add(static_cast<U8>(51 * i)).add(U8{9}).end_row();
      }
      ply.add(U8{77}).add(U8{3}).add({0U, 1U, 2U}).add(0.5f).end_row();
      const MeshData mesh = read_ply(ply.str());
      REQUIRE(mesh.positions == Positions{{0, 0, 10.5f}, {1, 1, 11.5f}, {2, 4, 12.5f}});
      REQUIRE(mesh.normals[0] == Vector3f(0));
      for (const int i : {1, 2})
        REQUIRE(glm::length(mesh.normals[static_cast<std::size_t>(i)] - Vector3f(0.6f, 0.8f, 0)) < 1e-7f);
      REQUIRE(mesh.uvs == std::vector<Vector2f>{{0.5f, 0}, {0.5f, 0.25f}, {0.5f, 0.5f}});
      REQUIRE(mesh.colors == std::vector<Color3f>{{1, 0, 0}, {1, 0, 0.2f}, {1, 0, 0.4f}});
      REQUIRE(mesh.has_display_colors);
      REQUIRE(mesh.triangles == Triangles{{0, 1, 2}});
      REQUIRE(mesh.remarks.empty());
    }
  }
}

TEST_CASE("PLY: colours as floats are linear") {
  for (const Kind kind : kKinds) {
    Ply ply(kind);
    ply.header("element vertex 3\n" + kPositions +
               "property float red\nproperty float green\nproperty float blue\nelement face 1\n" + kFaces);
    ply.add({0.0f, 0.0f, 0.0f, 0.25f, 0.5f, 2.0f}).end_row();
    ply.add({1.0f, 0.0f, 0.0f, -1.0f, 0.0f, 0.0f}).end_row();
    ply.add({0.0f, 1.0f, 0.0f, 1.0f, 1.0f, 1.0f}).end_row();
    ply.add(U8{3}).add({0, 1, 2}).end_row();
    const MeshData mesh = read_ply(ply.str());
    REQUIRE(mesh.colors == std::vector<Color3f>{{0.25f, 0.5f, 2}, {0, 0, 0}, {1, 1, 1}});
    REQUIRE_FALSE(mesh.has_display_colors);
  }
}

TEST_CASE("PLY: a property that the mesh has only half of is none") {
  for (const Kind kind : kKinds) {
    Ply ply(kind);
    ply.header("element vertex 3\n" + kPositions +
               "property float u\nproperty float nx\nproperty uchar red\n"
               "element face 1\n" +
               kFaces);
    for (int i = 0; i < 3; ++i) {
      ply.add({static_cast<float>(i), static_cast<float>(i * i), 0.0f, 1.0f, 1.0f}).add(U8{1}).end_row();
    }
    ply.add(U8{3}).add({0, 1, 2}).end_row();
    const MeshData mesh = read_ply(ply.str());
    REQUIRE((mesh.uvs.empty() && mesh.normals.empty() && mesh.colors.empty() && !mesh.has_display_colors));
  }
}

TEST_CASE("PLY: every type of number, for counts, indices and coordinates") {
  const auto check = [](const std::string& type, auto zero) {
    using T = decltype(zero);
    const auto n = [](int value) { return static_cast<T>(value); };
    for (const Kind kind : kKinds) {
      Ply ply(kind);
      const std::string list = std::is_integral_v<T> ? type + " " + type : "short ushort";
      ply.header("element face 2\nproperty list " + list + " vertex_indices\nelement vertex 4\nproperty " +
                 type + " x\nproperty " + type + " y\nproperty " + type + " z\n");
      for (const auto& face : std::vector<std::vector<int>>{{0, 1, 2}, {0, 2, 3}}) {
        if constexpr (std::is_integral_v<T>) {
          ply.add(n(3));
          for (const int i : face) ply.add(n(i));
        } else {
          ply.add(std::int16_t{3});
          for (const int i : face) ply.add(static_cast<std::uint16_t>(i));
        }
        ply.end_row();
      }
      for (const auto& p :
           {Vector3f(0, 0, 7), Vector3f(100, 0, 7), Vector3f(100, 100, 7), Vector3f(0, 100, 7)}) {
        for (int axis = 0; axis < 3; ++axis) ply.add(n(static_cast<int>(p[axis])));
        ply.end_row();
      }
      const MeshData mesh = read_ply(ply.str());
      REQUIRE(mesh.positions == Positions{{0, 0, 7}, {100, 0, 7}, {100, 100, 7}, {0, 100, 7}});
      REQUIRE(mesh.triangles == Triangles{{0, 1, 2}, {0, 2, 3}});
    }
  };
  for (const std::string name : {"char", "int8"}) check(name, std::int8_t{});
  for (const std::string name : {"uchar", "uint8"}) check(name, std::uint8_t{});
  for (const std::string name : {"short", "int16"}) check(name, std::int16_t{});
  for (const std::string name : {"ushort", "uint16"}) check(name, std::uint16_t{});
  for (const std::string name : {"int", "int32"}) check(name, std::int32_t{});
  for (const std::string name : {"uint", "uint32"}) check(name, std::uint32_t{});
  for (const std::string name : {"float", "float32"}) check(name, float{});
  for (const std::string name : {"double", "float64"}) check(name, double{});
}

TEST_CASE("PLY: unknown elements and lists are skipped wherever they stand") {
  for (const Kind kind : kKinds) {
    Ply ply(kind);
    ply.header(
        "element camera 1\nproperty float view_px\nproperty list uchar double more\nelement nothing 5\n"
        "element material 2\nproperty int a\nproperty short b\nelement vertex 4\nproperty list char short "
        "refs\n" +
        kPositions +
        "element edge 1\nproperty int vertex1\nproperty int vertex2\nelement face 2\n"
        "property list uchar float texcoord\n" +
        kFaces +
        "property list int uchar tags\n"
        "element end 1\nproperty list uchar uchar c\n");
    ply.add(1.5f).add(U8{2}).add({1.0, 2.0}).end_row();
    for (int i = 0; i < 2; ++i) ply.add(i).add(std::int16_t{3}).end_row();
    for (const Vector3f& p : Positions{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}) {
      ply.add(std::int8_t{1}).add(std::int16_t{12}).add({p.x, p.y, p.z}).end_row();
    }
    ply.add({0, 1}).end_row();
    ply.add(U8{0}).add(U8{3}).add({0, 1, 2}).add(1).add(U8{8}).end_row();
    ply.add(U8{1}).add(0.5f).add(U8{3}).add({0, 2, 3}).add(0).end_row();
    ply.add(U8{1}).add(U8{1}).end_row();
    const MeshData mesh = read_ply(ply.str());
    REQUIRE(mesh.positions == Positions{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}});
    REQUIRE(mesh.triangles == Triangles{{0, 1, 2}, {0, 2, 3}});
  }
}

TEST_CASE("PLY: strips turn every other triangle, and -1 begins a new one") {
  for (const Kind kind : kKinds) {
    Ply ply(kind);
    ply.header("element vertex 4\n" + kPositions + "element tristrips 2\n" + kFaces);
    add_square(ply);
    ply.add(U8{9}).add({0, 1, 3, 2, -1, 2, 1, 0, -1}).end_row();
    ply.add(U8{3}).add({1, 2, 3}).end_row();
    REQUIRE(read_ply(ply.str()).triangles == Triangles{{0, 1, 3}, {3, 1, 2}, {2, 1, 0}, {1, 2, 3}});
  }
}

TEST_CASE("PLY: lines may end with carriage returns and hold blanks; comments stand anywhere in the header") {
  std::string text = "ply \nformat ascii 1.0  \nWritten by somebody\nelement vertex 3 \ncomment c\n" +
                     kPositions + "element face 1\n" + kFaces +
                     "comment\nend_header\n\n0 0 0  \n\t1 0 0\n\n \n0 1 0\n3 0 1 2\n\n";
  const auto check = [](const std::string& file) {
    REQUIRE(read_ply(file).positions == Positions{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
  };
  check(text);
  check(text.substr(0, text.find_last_of('2') + 1));
  std::string with_returns;
  for (const char c : text) with_returns += c == '\n' ? "\r\n" : std::string(1, c);
  check(with_returns);
  std::string binary = square(Kind::kLittle, {{0, 1, 2}});
  binary.insert(body_of(binary) - 1, "\r");
  REQUIRE(read_ply(binary).triangles == Triangles{{0, 1, 2}});
}

TEST_CASE("PLY: pieces read by different threads make the same mesh") {
  for (const Kind kind : kKinds) {
    Ply ply(kind);
    const int vertices = 40000, faces = 50000;
    ply.header("element vertex " + std::to_string(vertices) + "\n" + kPositions + "element face " +
               std::to_string(faces) + "\n" + kFaces);
    for (int i = 0; i < vertices; ++i) {
      ply.add({static_cast<float>(i % 200), static_cast<float>(i / 200), static_cast<float>(i % 7)})
          .end_row();
    }
    std::size_t triangles = 0;
    for (int i = 0; i < faces; ++i) {
      const int size = 3 + (i > 30000 ? i % 3 : 0), first = i * 7 % (vertices - 1000);
      ply.add(static_cast<U8>(size)).add({first, first + 1, first + 201});
      if (size > 3) ply.add(first + 200);
      if (size > 4) ply.add(first + 199);
      ply.end_row();
      triangles += static_cast<std::size_t>(size) - 2;
    }
    const MeshData mesh = read_ply(ply.str());
    REQUIRE(inconsistency(mesh).empty());
    REQUIRE(mesh.positions[39999] == Vector3f(199, 199, 39999 % 7));
    REQUIRE(mesh.triangles.size() > triangles - 2000);  // a few have no area
    REQUIRE(mesh.triangles[5] == std::array<std::uint32_t, 3>{35, 36, 236});
    if (kind == Kind::kAscii) {
      const MeshData other = read_ply(ply.str(), 1000);
      REQUIRE(other.positions == mesh.positions);
      REQUIRE(other.triangles == mesh.triangles);
    } else {
      REQUIRE(read_ply(ply.str()).triangles == mesh.triangles);
    }
  }
}

TEST_CASE("PLY: what is wrong with the header is told with its line") {
  const auto header = [](const std::string& lines) { return error_of("ply\n" + lines); };
  const std::string format = "format ascii 1.0\n";
  REQUIRE(error_of("plywood\n") == "line 1: a PLY file begins with the line 'ply'");
  REQUIRE(error_of("obj\n") == "line 1: a PLY file begins with the line 'ply'");
  REQUIRE(error_of("ply\n") == "line 2: the file ends within the header");
  REQUIRE(header("end_header\n") == "line 2: the header does not say the format");
  REQUIRE(header(format + "end_header\n") == "line 3: the header announces no element 'vertex'");
  REQUIRE(header("format utf8 1.0\n") ==
          "line 2: the format 'utf8' is none of 'ascii', 'binary_little_endian' and 'binary_big_endian'");
  REQUIRE(header(format + "element vertex -3\n") == "line 3: '-3' is not a number of elements");
  REQUIRE(header(format + "element vertex 99999999999999999999\n") ==
          "line 3: '99999999999999999999' is not a number of elements");
  REQUIRE(header(format + "property float x\n") == "line 3: a property stands before any element");
  REQUIRE(header(format + "element vertex 3\nproperty real x\n") ==
          "line 4: 'real' is not a type of numbers");
  REQUIRE(header(format + "element vertex 3\nproperty float\n") == "line 4: the property has no name");
  REQUIRE(header(format + "element face 3\nproperty list float int a\n") ==
          "line 4: a list's length is a whole number");
  REQUIRE(header(format + "element vertex 3\nelement vertex 4\n") ==
          "line 4: the element 'vertex' stands twice in the header");
  REQUIRE(header(format + "element vertex 3\nproperty float x\nproperty float y\nend_header\n") ==
          "line 6: a vertex has not all of the properties 'x', 'y' and 'z'");
  REQUIRE(header(format + "element vertex 3\nproperty float x\n" + kPositions + "end_header\n") ==
          "line 8: a vertex has two properties 'x'");
  REQUIRE(header(format + "element vertex 5000000000\n" + kPositions + "end_header\n") ==
          "line 7: 5000000000 vertices are more than can be numbered");
  REQUIRE(header(format + "element vertex 1\n" + std::string("\x01\x02") + "\n") ==
          "line 4: '\xEF\xBF\xBD\xEF\xBF\xBD' does not belong into a header");
}

TEST_CASE("PLY: what is wrong with a text is told with its line") {
  const std::string header =
      "ply\nformat ascii 1.0\nelement vertex 3\n" + kPositions + "element face 1\n" + kFaces + "end_header\n";
  const auto body = [&](const std::string& lines) { return error_of(header + lines); };
  const std::string vertices = "0 0 0\n1 0 0\n0 1 0\n";
  REQUIRE(body("") == "line 10: the file ends after 0 of 3 lines of 'vertex'");
  REQUIRE(body("0 0 0\n1 0 0") == "line 11: the file ends after 2 of 3 lines of 'vertex'");
  REQUIRE(body(vertices) == "line 13: the file ends after 0 of 1 lines of 'face'");
  REQUIRE(body("0 0 0\n1 0\n0 1 0\n3 0 1 2\n") ==
          "line 11: the line ends before 'vertex' has all its values");
  REQUIRE(body("0 0 0\n1 0 0 5\n0 1 0\n3 0 1 2\n") == "line 11: 'vertex' has all its values before '5'");
  REQUIRE(body("0 0 0\n1 x0 0\n0 1 0\n3 0 1 2\n") == "line 11: 'x0' is not a number");
  REQUIRE(body("0 0 0\n1 nan 0\n0 1 0\n3 0 1 2\n") == "line 11: a coordinate of vertex 1 is not finite");
  REQUIRE(body("0 0 0\n1 1e39 0\n0 1 0\n3 0 1 2\n") == "line 11: a coordinate of vertex 1 is not finite");
  REQUIRE(body(vertices + "3 0 1\n") == "line 13: the line ends before 'face' has all its values");
  REQUIRE(body(vertices + "99999999 0 1 2\n") == "line 13: the line ends before 'face' has all its values");
  REQUIRE(body(vertices + "3 0 1 2 2\n") == "line 13: 'face' has all its values before '2'");
  REQUIRE(body(vertices + "3 0 1 3\n") == "line 13: there is no vertex 3: they are numbered from 0 to 2");
  REQUIRE(body(vertices + "3 0 -1 2\n") == "line 13: there is no vertex -1: they are numbered from 0 to 2");
  REQUIRE(body(vertices + "-3 0 1 2\n") == "line 13: a list has -3 values");
  REQUIRE(body(vertices + "3 0 1.5 2\n") == "line 13: '1.5' is not a whole number");
  REQUIRE(body(vertices + "3 0 0 1\n") == "its one face has no area");
}

TEST_CASE("PLY: a text that promises more than it holds takes no memory for it") {
  for (const std::string name : {"vertex", "face", "other"}) {
    std::string text = "ply\nformat ascii 1.0\nelement vertex 3\n" + kPositions + "element face 1\n" +
                       kFaces +
                       "element other 1\nproperty int a\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n1\n";
    const std::size_t count = text.find("element " + name) + 9 + name.size();
    text.replace(count, 1, "4000000000");
    REQUIRE_THAT(error_of(text), Catch::Contains("the file ends after"));
    text.replace(count, 10, "900000000000000000");
    REQUIRE_FALSE(error_of(text).empty());
  }
}

TEST_CASE("PLY: what is wrong with a binary file is told with its byte") {
  for (const Kind kind : {Kind::kLittle, Kind::kBig}) {
    const std::string file = square(kind, {{0, 1, 2}, {0, 2, 3}});
    const std::size_t body = body_of(file), faces = body + 48;
    REQUIRE(error_of(file.substr(0, body + 47)) ==
            at_byte(body,
                    "the header promises 4 rows of 'vertex', at least 12 bytes each, but only 47 are left"));
    REQUIRE(
        error_of(file.substr(0, body)) ==
        at_byte(body, "the header promises 4 rows of 'vertex', at least 12 bytes each, but only 0 are left"));
    REQUIRE(
        error_of(file.substr(0, faces + 1)) ==
        at_byte(faces, "the header promises 2 rows of 'face', at least 1 bytes each, but only 1 is left"));
    REQUIRE(error_of(file.substr(0, faces + 13)) ==
            at_byte(faces + 13, "the file ends within 'face' 1 of 2"));
    REQUIRE(error_of(file.substr(0, file.size() - 1)) ==
            at_byte(faces + 13, "a list of 3 values goes beyond the end of the file"));

    REQUIRE(error_of(square(kind, {{0, 1, 2}, {0, 4, 3}})) ==
            at_byte(faces + 18, "there is no vertex 4: they are numbered from 0 to 3"));
    REQUIRE(error_of(square(kind, {{0, 1, 2}, {0, 2, -1}})) ==
            at_byte(faces + 22, "there is no vertex -1: they are numbered from 0 to 3"));
    REQUIRE(error_of(square(kind, {{0, 1, 2, 3}, {0, 2, 3}, {0, 1, 2147483647}})) ==
            at_byte(faces + 39, "there is no vertex 2147483647: they are numbered from 0 to 3"));

    std::string broken = file;
    broken.replace(body + 16, 4, std::string(4, '\xFF'));
    REQUIRE(error_of(broken) == at_byte(body + 12, "a coordinate of vertex 1 is not finite"));
  }
}

TEST_CASE("PLY: a binary file that promises more than it holds takes no memory for it") {
  const std::string file = square(Kind::kLittle, {{0, 1, 2}, {0, 2, 3}});
  for (const std::string count : {"4294967294", "900000000000000000"}) {
    std::string vertices = file, faces = file;
    vertices.replace(vertices.find("vertex 4") + 7, 1, count);
    faces.replace(faces.find("face 2") + 5, 1, count);
    REQUIRE_FALSE(error_of(vertices).empty());
    REQUIRE_THAT(error_of(faces), Catch::Contains("the header promises " + count + " rows of 'face'"));
  }
  std::string list = file;
  list.replace(list.find("list uchar"), 10, "list  uint");
  REQUIRE_THAT(error_of(list), Catch::Contains("goes beyond the end of the file"));
  std::string empty = file;
  empty.replace(empty.find("element vertex"), 0, "element nothing 900000000000000000\n");
  REQUIRE(read_ply(empty).triangles.size() == 2);
}

TEST_CASE("PLY: a text where a binary file should be, and the other way round, are refused") {
  std::string text = square(Kind::kAscii, {{0, 1, 2}, {0, 2, 3}}),
              binary = square(Kind::kLittle, {{0, 1, 2}, {0, 2, 3}});
  text.replace(text.find("ascii"), 5, "binary_little_endian");
  REQUIRE_THAT(error_of(text), Catch::StartsWith("byte "));
  binary.replace(binary.find("binary_little_endian"), 20, "ascii");
  REQUIRE_THAT(error_of(binary), Catch::StartsWith("line "));
  std::string turned = square(Kind::kBig, {{0, 1, 2}, {0, 2, 3}});
  turned.replace(turned.find("big"), 3, "little");
  REQUIRE_THAT(error_of(turned), Catch::StartsWith("byte "));
}

TEST_CASE("PLY: files without faces are refused") {
  REQUIRE(error_of("ply\nformat ascii 1.0\nelement vertex 2\n" + kPositions + "end_header\n0 0 0\n1 1 1\n") ==
          "it has no faces, only 2 points");
  REQUIRE(error_of("ply\nformat ascii 1.0\nelement vertex 1\n" + kPositions + "element face 0\n" + kFaces +
                   "end_header\n0 0 0\n") == "it has no faces, only 1 point");
  REQUIRE(error_of("ply\nformat ascii 1.0\nelement vertex 0\n" + kPositions + "end_header\n") ==
          "it has no faces");
}

TEST_CASE("PLY: normals, uvs and colours that are no numbers become 0, with a remark") {
  for (const Kind kind : kKinds) {
    Ply ply(kind);
    ply.header("element vertex 3\n" + kPositions +
               "property float nx\nproperty float ny\nproperty float nz\n"
               "property float u\nproperty float v\nelement face 1\n" +
               kFaces);
    ply.add({0.0f, 0.0f, 0.0f, std::nanf(""), 0.0f, 0.0f, 1.0f, 2.0f}).end_row();
    ply.add({1.0f, 0.0f, 0.0f, 0.0f, 0.0f, 1e30f, HUGE_VALF, 2.0f}).end_row();
    ply.add({0.0f, 1.0f, 0.0f, 0.0f, 1e-30f, 0.0f, 1.0f, 2.0f}).end_row();
    ply.add(U8{3}).add({0, 1, 2}).end_row();
    const MeshData mesh = read_ply(ply.str());
    REQUIRE(mesh.normals == std::vector<Vector3f>{{0, 0, 0}, {0, 0, 1}, {0, 1, 0}});
    REQUIRE(mesh.uvs == std::vector<Vector2f>{{1, 2}, {0, 2}, {1, 2}});
    REQUIRE(mesh.remarks ==
            std::vector<std::string>{
                "2 numbers of normals, texture coordinates or colours are not finite and become 0"});
  }
}
