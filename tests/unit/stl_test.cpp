#include "meshes/stl.hpp"

#include "mesh_files.hpp"

using namespace raytracer;
using meshes::read_stl;

namespace {

// Two triangles of a square that share an edge.
const std::vector<Vector3f> kCorners = {{0, 0, 0}, {1, 0, 0},    {1, 1, 0.5f},
                                        {0, 0, 0}, {1, 1, 0.5f}, {0, 1, 0}};

std::string text_of(const std::vector<Vector3f>& corners, const std::string& name = "square") {
  std::string text = "solid " + name + "\n";
  for (std::size_t i = 0; i < corners.size(); i += 3) {
    text += " facet normal 0 0 1\n  outer loop\n";
    for (std::size_t k = i; k < i + 3; ++k) {
      text += "   vertex " + std::to_string(corners[k].x) + " " + std::to_string(corners[k].y) + " " +
              std::to_string(corners[k].z) + "\n";
    }
    text += "  endloop\n endfacet\n";
  }
  return text + "endsolid " + name + "\n";
}

std::string binary_of(const std::vector<Vector3f>& corners, std::string name = "binary") {
  name.resize(80, ' ');
  Bytes bytes;
  bytes.text(name).add(static_cast<std::uint32_t>(corners.size() / 3));
  for (std::size_t i = 0; i < corners.size(); i += 3) {
    bytes.add(std::nanf("")).add(0.0f).add(1.0f);  // a normal that nobody should read
    for (std::size_t k = i; k < i + 3; ++k) bytes.add(corners[k].x).add(corners[k].y).add(corners[k].z);
    bytes.add(std::uint16_t{0xABCD});
  }
  return bytes.str();
}

void require_square(const MeshData& mesh) {
  REQUIRE(mesh.positions == std::vector<Vector3f>{{0, 0, 0}, {1, 0, 0}, {1, 1, 0.5f}, {0, 1, 0}});
  REQUIRE(mesh.triangles == Triangles{{0, 1, 2}, {0, 2, 3}});
  REQUIRE(mesh.normals.empty());
  REQUIRE(mesh.remarks.empty());
}

std::string error_of(const std::string& file) {
  return failure_of([&] { read_stl(file); });
}

}  // namespace

TEST_CASE("STL: text and binary are the same mesh") {
  require_square(read_stl(text_of(kCorners)));
  require_square(read_stl(binary_of(kCorners)));
}

TEST_CASE("STL: a binary file may begin with 'solid', and end with more than its triangles") {
  require_square(read_stl(binary_of(kCorners, "solid square")));
  require_square(read_stl(binary_of(kCorners) + "and a remark"));
}

TEST_CASE("STL: text in capitals, with carriage returns, names of any kind and several solids") {
  std::string text = text_of({kCorners.begin(), kCorners.begin() + 3}, "endsolid facet vertex") + "\n\n" +
                     text_of({}, "") + text_of({kCorners.begin() + 3, kCorners.end()}, "größe");
  require_square(read_stl(text));
  std::string other;
  for (const char c : text) {
    if (c == '\n') other += '\r';
    other += c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
  }
  require_square(read_stl(other));
  require_square(read_stl("  \t" + text));
}

TEST_CASE("STL: what the facet's normal says does not matter") {
  std::string text = text_of(kCorners);
  for (const std::string normal : {"normal nan nan nan", "normal -1.#IND x y", ""}) {
    std::string changed = text;
    for (std::size_t at; (at = changed.find("normal 0 0 1")) != std::string::npos;)
      changed.replace(at, 12, normal);
    require_square(read_stl(changed));
  }
}

TEST_CASE("STL: pieces read by different threads make the same mesh") {
  std::vector<Vector3f> corners;
  for (int i = 0; i < 300; ++i) corners.emplace_back(i % 17, i % 13, i * i % 29);
  const MeshData whole = read_stl(text_of(corners)), binary = read_stl(binary_of(corners));
  REQUIRE(whole.positions == binary.positions);
  REQUIRE(whole.triangles == binary.triangles);
  for (const std::size_t chunk : std::initializer_list<std::size_t>{1, 50, 100, 1000, 5000}) {
    const MeshData pieces = read_stl(text_of(corners), chunk);
    REQUIRE(pieces.positions == whole.positions);
    REQUIRE(pieces.triangles == whole.triangles);
  }
}

TEST_CASE("STL: triangles without area are left out and counted") {
  std::vector<Vector3f> corners = kCorners;
  corners.insert(corners.end(), {{0, 0, 0}, {1, 1, 1}, {2, 2, 2}, {0, 0, 0}, {0, 0, 0}, {1, 0, 0}});
  for (const std::string& file : {text_of(corners), binary_of(corners)}) {
    const MeshData mesh = read_stl(file);
    REQUIRE(mesh.triangles == Triangles{{0, 1, 2}, {0, 2, 3}});
    REQUIRE(mesh.remarks == std::vector<std::string>{"2 of 4 triangles have no area and are left out"});
  }
}

TEST_CASE("STL: 100,000 equal triangles are as good as others") {
  std::vector<Vector3f> corners;
  for (int i = 0; i < 100000; ++i) corners.insert(corners.end(), kCorners.begin(), kCorners.begin() + 3);
  const MeshData mesh = read_stl(binary_of(corners));
  REQUIRE(mesh.positions.size() == 3);
  REQUIRE(mesh.triangles.size() == 100000);
}

TEST_CASE("STL: what is wrong with a text is told with its line") {
  REQUIRE(error_of("solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 zero 0\n") ==
          "line 5: 'zero' is not a number");
  REQUIRE(error_of("solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0\nvertex 1 0 0\n") ==
          "line 4: a vertex has 3 coordinates");
  REQUIRE(error_of("solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 inf\n") ==
          "line 4: a coordinate is not finite");
  REQUIRE(error_of("solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nendloop") ==
          "line 6: 'endloop' stands where 'vertex' is expected");
  REQUIRE(error_of("solid a\nfacet normal 0 0 1\ninner loop") ==
          "line 3: 'inner' stands where 'outer loop' is expected");
  REQUIRE(error_of("solid a\n\nsurface") ==
          "line 3: 'surface' stands where 'facet' or 'endsolid' is expected");
  REQUIRE(error_of("solid a\nendsolid\nfacet") == "line 3: 'facet' stands where 'solid' is expected");
  const std::string text = text_of(kCorners);
  REQUIRE(error_of(text.substr(0, text.find("endsolid"))) == "line 16: the file ends before 'endsolid'");
  REQUIRE(error_of("solid a\nendsolid\n") == "it has no faces");
}

TEST_CASE("STL: what is wrong with a binary file is told with its byte") {
  const std::string file = binary_of(kCorners);
  REQUIRE(error_of(file.substr(0, 60)) == "byte 60: the file ends within the header of a binary STL file");
  REQUIRE(error_of(file.substr(0, file.size() - 1)) ==
          "byte 80: the header promises 2 triangles of 50 bytes, but only 99 bytes follow");
  REQUIRE(error_of(binary_of(kCorners, "solid x" + std::string(1, '\0')).substr(0, 100)) ==
          "byte 80: the header promises 2 triangles of 50 bytes, but only 16 bytes follow");
  std::string huge = file;
  huge.replace(80, 4, std::string("\xFF\xFF\xFF\x00", 4));
  REQUIRE(error_of(huge) ==
          "byte 80: the header promises 16777215 triangles of 50 bytes, but only 100 bytes follow");
  std::vector<Vector3f> corners = kCorners;
  corners[4].y = std::nanf("");
  REQUIRE(error_of(binary_of(corners)) == "byte 158: a coordinate of triangle 1 is not finite");
  REQUIRE(
      error_of(
          "This is a text and no mesh, though long enough for the header of an STL file: words, words.") ==
      "byte 0: the file begins neither with 'solid' nor as a binary STL file does");
  REQUIRE(error_of(binary_of({})) == "it has no faces");
  REQUIRE(error_of("") == "it is empty");
}
