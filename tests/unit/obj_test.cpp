#include "meshes/obj.hpp"

#include "mesh_files.hpp"
#include "meshes/mtl.hpp"
#include "temporary_folder.hpp"

using namespace raytracer;

namespace {

using Positions = std::vector<Vector3f>;
using Remarks = std::vector<std::string>;

MeshData read(const std::string& text, std::size_t chunk = meshes::kChunkBytes) {
  return meshes::read_obj(text, "", {}, chunk);
}

std::string error_of(const std::string& text) {
  return failure_of([&] { read(text); });
}

const std::string kSquare = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

std::vector<std::array<std::uint32_t, 3>> ranges_of(const MeshData& mesh) {
  std::vector<std::array<std::uint32_t, 3>> result;
  for (const MeshData::Range& range : mesh.ranges) result.push_back({range.begin, range.end, range.material});
  return result;
}

MeshData::NamedMaterial material_of(const std::string& mtl) {
  std::vector<MeshData::NamedMaterial> materials;
  meshes::read_mtl("newmtl a\n" + mtl, "folder", materials);
  REQUIRE(materials.size() == 1);
  return materials[0];
}

}  // namespace

TEST_CASE("OBJ: positions and faces of any size, by numbers from the first or from the last") {
  const Triangles expected = {{0, 1, 2}, {0, 2, 3}};
  for (const std::string faces :
       {"f 1 2 3\nf 1 3 4\n", "f 1 2 3 4", "f -4 -3 -2 -1", "f 1 -3 3 -1\n", "fo 1 2 3 4"}) {
    const MeshData mesh = read(kSquare + faces);
    REQUIRE(mesh.positions == Positions{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}});
    REQUIRE(mesh.triangles == expected);
    REQUIRE((mesh.normals.empty() && mesh.uvs.empty() && mesh.colors.empty() && mesh.remarks.empty()));
  }
}

TEST_CASE("OBJ: relative numbers count from where they stand") {
  const MeshData mesh =
      read("v 0 0 0\nv 1 0 0\nv 0 1 0\nf -3 -2 -1\nv 5 0 0\nv 6 0 0\nv 5 1 0\nf -3 -2 -1\n");
  REQUIRE(mesh.triangles == Triangles{{0, 1, 2}, {3, 4, 5}});
}

TEST_CASE("OBJ: faces may stand before their vertices") {
  REQUIRE(read("f 1 2 3\nv 0 0 0\nv 1 0 0\nv 0 1 0\n").triangles == Triangles{{0, 1, 2}});
}

TEST_CASE("OBJ: a concave face is cut within itself") {
  const MeshData mesh = read("v 4 0 0\nv 1 1 0\nv 0 4 0\nv 0 0 0\nf 1 2 3 4\n");
  REQUIRE(mesh.triangles == Triangles{{1, 2, 3}, {1, 3, 0}});
}

TEST_CASE("OBJ: comments, blanks, carriage returns and hidden line ends") {
  const std::string text =
      "# a comment \\\n  \n\tv 0 0 0 # more\nv  1\t0 0  \nv 1 \\\n 1 0\nv 0 1 0\n"
      "g a \\\nv b\ns off\no name\nf 1 2 \\\n 3 \\\n 4\\\n\n# end";
  const auto check = [](const MeshData& mesh) {
    REQUIRE(mesh.positions == Positions{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}});
    REQUIRE(mesh.triangles == Triangles{{0, 1, 2}, {0, 2, 3}});
    REQUIRE(mesh.remarks.empty());
  };
  check(read(text));
  std::string with_returns;
  for (const char c : text) with_returns += c == '\n' ? "\r\n" : std::string(1, c);
  check(read(with_returns));
  check(read("\xEF\xBB\xBF" + text));
  for (std::size_t chunk = 1; chunk < text.size(); ++chunk) {
    check(read(text, chunk));
    check(read(with_returns, chunk));
  }
}

TEST_CASE("OBJ: corners that name uvs and normals become one vertex for each combination") {
  const MeshData mesh = read(kSquare +
                             "vt 0 0\nvt 1 0.5\nvn 0 0 2\nvn 0 3 4\n"
                             "f 1/1/1 2/2/1 3/1/2\nf 1/1/1 3/1/2 4/-1/-2\nf 1/2/1 2/2/1 3/1/2\n");
  REQUIRE(mesh.triangles == Triangles{{0, 1, 2}, {0, 2, 3}, {4, 1, 2}});
  REQUIRE(mesh.positions == Positions{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 0}});
  REQUIRE(mesh.uvs == std::vector<Vector2f>{{0, 0}, {1, 0.5f}, {0, 0}, {1, 0.5f}, {1, 0.5f}});
  REQUIRE(mesh.normals == std::vector<Vector3f>{{0, 0, 1}, {0, 0, 1}, {0, 0.6f, 0.8f}, {0, 0, 1}, {0, 0, 1}});
}

TEST_CASE("OBJ: corners may name only a uv, only a normal, or nothing") {
  const MeshData mesh = read(kSquare + "vt 0.5\nvn 0 0 1\nf 1/1 2/1/ 3\nf 1//1 3//1 4//1\n");
  REQUIRE(mesh.triangles == Triangles{{0, 1, 2}, {3, 4, 5}});
  REQUIRE(mesh.positions == Positions{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 0, 0}, {1, 1, 0}, {0, 1, 0}});
  REQUIRE(mesh.uvs == std::vector<Vector2f>{{0.5f, 0}, {0.5f, 0}, {0, 0}, {0, 0}, {0, 0}, {0, 0}});
  const Vector3f none(0), up(0, 0, 1);
  REQUIRE(mesh.normals == std::vector<Vector3f>{none, none, none, up, up, up});
}

TEST_CASE("OBJ: where uvs and normals have their position's number, positions stay as they are") {
  const MeshData mesh =
      read(kSquare +
           "v 9 9 9\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nvn 0 0 1\nvn 0 0 1\nvn 0 0 1\nvn 0 1 0\n"
           "vn 1 0 0\nvn 1 0 0\nf 4/4/4 3/3/3 2/2/2\nf 4/4/4 2/2/2 1/1/1\n");
  REQUIRE(mesh.triangles == Triangles{{3, 2, 1}, {3, 1, 0}});
  REQUIRE(mesh.positions == Positions{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {9, 9, 9}});
  REQUIRE(mesh.uvs == std::vector<Vector2f>{{0, 0}, {1, 0}, {1, 1}, {0, 1}, {0, 0}});
  REQUIRE(mesh.normals.size() == 5);
  REQUIRE(mesh.normals[3] == Vector3f(0, 1, 0));
}

TEST_CASE("OBJ: a position that thousands of combinations share is no trouble") {
  std::string text = kSquare;
  for (int i = 0; i < 30000; ++i) text += "vt " + std::to_string(i) + " 0\n";
  for (int i = 1; i <= 30000; ++i) text += "f 1/" + std::to_string(i) + " 2/1 3/1\n";
  text += "f 1/20000 2/1 3/1\nf 1/3 2/1 3/1\n";
  const MeshData mesh = read(text);
  REQUIRE(mesh.positions.size() == 30002);
  for (const std::size_t i : std::initializer_list<std::size_t>{0, 2, 31, 32, 33, 19999, 29999})
    REQUIRE(mesh.uvs[mesh.triangles[i][0]].x == static_cast<float>(i));
  REQUIRE(mesh.triangles[30000] == mesh.triangles[19999]);
  REQUIRE(mesh.triangles[30001] == mesh.triangles[2]);
}

TEST_CASE("OBJ: colours behind the positions, and weights") {
  const MeshData mesh = read("v 0 0 0\nv 1 0 0 1 0.5 0.25\nv 1 1 0 0.125 -3 7 0.5\nv 0 1 0 2.0\nf 1 2 3 4\n");
  REQUIRE(mesh.positions == Positions{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}});
  REQUIRE(mesh.colors == std::vector<Color3f>{{1, 1, 1}, {1, 0.5f, 0.25f}, {0.125f, 0, 7}, {1, 1, 1}});
  REQUIRE(mesh.has_display_colors);
  const MeshData split = read("v 0 0 0 0 1 0\nv 1 0 0\nvn 0 0 1\nv 0 1 0 0 0 1\nf 3//1 2//1 1//1\n", 16);
  REQUIRE(split.colors == std::vector<Color3f>{{0, 0, 1}, {1, 1, 1}, {0, 1, 0}});
}

TEST_CASE("OBJ: lines, points and other programs' words are skipped") {
  REQUIRE(read(kSquare + "l 1 2\np 3\nvp 1 2\nlod 1\nmg off\nvw 1 2 3\nf 1 2 3\n").remarks.empty());
  REQUIRE(read(kSquare + "f 1 2 3\nmystery 1 2\nfa 1 2 3\n").remarks ==
          Remarks{"line 6: 'mystery' is not known, and lines that begin so are skipped"});
  REQUIRE(read(kSquare + "f 1 2 3\ncstype bezier\ndeg 3 3\nsurf 0 1 0 1 1 2 3 \\\n4\nend\n").remarks ==
          Remarks{"line 6: curves and curved surfaces are skipped"});
}

TEST_CASE("OBJ: pieces read by different threads make the same mesh") {
  std::string text = "mtllib none.mtl\n";
  for (int i = 0; i < 400; ++i) {
    const std::string n = std::to_string(i);
    text += "v " + n + " " + std::to_string(i * i % 97) + " 1 0.5 0.5 " + std::to_string(i % 2) + "\nvt 0." +
            n + " 0\nvn 0 1 " + n + "\n";
    if (i % 7 == 0) text += "usemtl m" + n + "\n";
    if (i > 4) text += "f -1/-1/-1 -2/-3/-4 -3//-1 " + n + "/1/-2\nf 1 3 " + n + "\nf 1 2\n";
  }
  const MeshData whole = read(text);
  REQUIRE(inconsistency(whole).empty());
  for (const std::size_t chunk : std::initializer_list<std::size_t>{1, 50, 77, 1000, 10000}) {
    const MeshData pieces = read(text, chunk);
    REQUIRE(pieces.positions == whole.positions);
    REQUIRE(pieces.normals == whole.normals);
    REQUIRE(pieces.uvs == whole.uvs);
    REQUIRE(pieces.colors == whole.colors);
    REQUIRE(pieces.triangles == whole.triangles);
    REQUIRE(pieces.remarks == whole.remarks);
  }
}

TEST_CASE("OBJ: what is wrong is told with its line") {
  const auto square = [](const std::string& lines) { return error_of(kSquare + lines); };
  REQUIRE(square("f 1 2 5\n") == "line 5: there is no vertex 5: the file has 4");
  REQUIRE(square("\n\nf 1 2 -5\n") == "line 7: there is no vertex -5: 4 came before");
  REQUIRE(square("f 0 1 2\n") == "line 5: there is no vertex 0: they count from 1");
  REQUIRE(square("f 1 2 99999999999\n") == "line 5: there is no vertex 99999999999: the file has 4");
  REQUIRE(square("f 1 2 9999999999999999999\n") ==
          "line 5: '9999999999999999999' is not a corner of a face, like 1, 1/2 or 1/2/3");
  REQUIRE(square("vt 0 0\nf 1/1 2/2 3/1\n") == "line 6: there is no texture coordinate 2: the file has 1");
  REQUIRE(square("vn 0 0 1\nf 1//1 2//-2 3//1\n") == "line 6: there is no normal -2: 1 came before");
  REQUIRE(square("f 1 2 x\n") == "line 5: 'x' is not a corner of a face, like 1, 1/2 or 1/2/3");
  REQUIRE(square("f 1 2 3/1/1/1\n") == "line 5: '3/1/1/1' is not a corner of a face, like 1, 1/2 or 1/2/3");
  REQUIRE(square("f 1.5 2 3\n") == "line 5: '1.5' is not a corner of a face, like 1, 1/2 or 1/2/3");
  REQUIRE(square("v 1 2\n") == "line 5: a vertex has 3 coordinates, not 2");
  REQUIRE(square("v 1 2 3x\n") == "line 5: '3x' is not a number");
  REQUIRE(square("v 1 nan 3\n") == "line 5: a coordinate is not finite");
  REQUIRE(square("v 1 1e39 3\n") == "line 5: a coordinate is not finite");
  REQUIRE(square("vn 1 2\n") == "line 5: a normal has 3 numbers, not 2");
  REQUIRE(square("vt\n") == "line 5: a texture coordinate has at least 1 number");
  REQUIRE(square("<html>\n") == "line 5: '<html>' does not begin a statement of an OBJ file");
  REQUIRE(error_of(std::string("\x89PNG\r\n\x1A\n\0\0", 10)) ==
          "line 1: '\xEF\xBF\xBDPNG' does not begin a statement of an OBJ file");
  REQUIRE_THAT(error_of("\xFE\xFF"), Catch::StartsWith("line 1: the text is UTF-16"));
}

TEST_CASE("OBJ: files without faces are refused, and those whose faces have no area") {
  REQUIRE(error_of("") == "it has no faces");
  REQUIRE(error_of("# nothing\n") == "it has no faces");
  REQUIRE(error_of(kSquare) == "it has no faces, only 4 points");
  REQUIRE(error_of(kSquare + "f 1 1 2\nf 1 2\nf\n") == "none of its 3 faces has an area");
  REQUIRE(read(kSquare + "f 1 1 2\nf 1 2 3\nf 4\n").remarks ==
          Remarks{"2 of 3 triangles have no area and are left out"});
}

TEST_CASE("OBJ: names of uvs and normals in a file that has none are told and forgotten") {
  const MeshData mesh = read(kSquare + "f 1//1 2//1 3//1\n");
  REQUIRE(mesh.normals.empty());
  REQUIRE(mesh.remarks ==
          Remarks{"line 5: faces name normals or texture coordinates, but the file has none"});
}

TEST_CASE("OBJ: materials come with their triangles") {
  const TemporaryFolder folder;
  write(folder / "one.mtl", "# first\nnewmtl red\nKd 1 0 0\nnewmtl green\nKd 0 1 0\n");
  write(folder / "two three.mtl", "newmtl blue paint\nKd 0 0 1\nnewmtl red\nKd 0.5 0 0\n");
  const std::string text =
      kSquare +
      "mtllib one.mtl\nmtllib two three.mtl\nf 1 2 3\nusemtl red\nf 1 2 3 4\nusemtl  blue paint \n"
      "f 1 2 3\nusemtl green\nusemtl red\nf 1 1 1\nusemtl unheard\nf 2 3 4\nusemtl red\nf 2 3 4\n";
  std::vector<std::string> asked;
  const MayRead may_read = [&](const std::string& path) { asked.push_back(path); };
  for (const std::size_t chunk : std::initializer_list<std::size_t>{16, 1000}) {
    const MeshData mesh = meshes::read_obj(text, folder.path(), may_read, chunk);
    REQUIRE(mesh.triangles.size() == 6);
    REQUIRE(ranges_of(mesh) == Triangles{{1, 3, 0}, {3, 4, 2}, {5, 6, 0}});
    REQUIRE(mesh.materials.size() == 4);
    REQUIRE(mesh.materials[0].name == "red");
    REQUIRE(mesh.materials[0].color == Color3f(1, 0, 0));
    REQUIRE(mesh.materials[2].name == "blue paint");
    REQUIRE(mesh.materials[2].folder == folder.path());
    REQUIRE(mesh.files_read == std::vector<std::string>{folder / "one.mtl", folder / "two three.mtl"});
    REQUIRE(mesh.remarks == Remarks{"no material file says what the material 'unheard' looks like",
                                    "1 of 7 triangles has no area and is left out"});
  }
  REQUIRE(asked == std::vector<std::string>{folder / "one.mtl", folder / "two three.mtl", folder / "one.mtl",
                                            folder / "two three.mtl"});
}

TEST_CASE("OBJ: several material files in a line, with escaped blanks, in folders, or not there") {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder / "sub");
  write(folder / "sub/a.mtl", "newmtl a\nKd 1 1 0\n");
  write(folder / "b b.mtl", "newmtl b\nKd 1 0 1\n");
  const std::string faces = "usemtl a\nf 1 2 3\nusemtl b\nf 1 2 3\n";
  const MeshData mesh =
      meshes::read_obj(kSquare + "mtllib sub\\a.mtl b\\ b.mtl missing.mtl\n" + faces, folder.path(), {});
  REQUIRE(ranges_of(mesh) == Triangles{{0, 1, 0}, {1, 2, 1}});
  REQUIRE(mesh.materials[0].folder == folder / "sub");
  REQUIRE(mesh.remarks == Remarks{"the material file 'missing.mtl' is not there"});
  REQUIRE(meshes::read_obj(kSquare + "mtllib x.mtl\nmtllib y.mtl\n" + faces, folder.path(), {}).remarks ==
          Remarks{"the material files 'x.mtl', 'y.mtl' are not there"});
  REQUIRE(read(kSquare + faces).remarks ==
          Remarks{"no material file says what the materials 'a', 'b' look like"});
}

TEST_CASE("OBJ: a material file that may not be read, is a folder, or one of too many is refused") {
  const TemporaryFolder folder;
  write(folder / "a.mtl", "newmtl a\n");
  const MayRead never = [](const std::string&) { throw Error(ErrorKind::kScene, "not allowed"); };
  const auto error = [&](const std::string& libraries, const MayRead& may_read) {
    return failure_of([&] { meshes::read_obj(kSquare + libraries + "f 1 2 3\n", folder.path(), may_read); });
  };
  REQUIRE(error("mtllib a.mtl\n", never) == "not allowed");
  REQUIRE(error("mtllib ../../../etc/passwd\n", never) == "not allowed");
  REQUIRE(error("mtllib .\n", {}).empty());  // not there
  std::string many;
  for (int i = 0; i < 300; ++i)
    many += "mtllib ./" + std::string(static_cast<std::size_t>(2 * i), '/') + "a.mtl\n";
  REQUIRE(error(many, {}) == "it names more than 256 material files");
  std::string large;
  for (int i = 0; i < 70000; ++i) large += "newmtl a\n";
  write(folder / "b.mtl", large);
  REQUIRE(error("mtllib b.mtl\n", {}) ==
          "its material file 'b.mtl': its material files have more than 65,536 materials");
}

TEST_CASE("MTL: every word that we know") {
  using Map = MeshData::NamedMaterial::Map;
  const MeshData::NamedMaterial a = material_of(
      "Ka 1 1 1\n Kd 0.1 0.2 0.3\nKs 0.4\nKe 5 6 7\nNs 96.5\nNi 1.45\nd 0.75\nillum 2\nPr 0.25\nPm 1\n"
      "map_Kd wood.png\nmap_d -imfchan m leaf.png\nmap_bump -bm 0.3 bump map.png\nnorm textures\\n.png\n"
      "map_Ke glow.png\nmap_Pr rough.png\nmap_Pm metal.png\n");
  REQUIRE(a.name == "a");
  REQUIRE(a.folder == "folder");
  REQUIRE(a.color == Color3f(0.1f, 0.2f, 0.3f));
  REQUIRE(a.specular == Color3f(0.4f));
  REQUIRE(a.emission == Color3f(5, 6, 7));
  REQUIRE(a.exponent == 96.5f);
  REQUIRE(a.ior == 1.45f);
  REQUIRE(a.alpha == 0.75f);
  REQUIRE(a.illumination == 2);
  REQUIRE(a.roughness == 0.25f);
  REQUIRE(a.metallic == 1);
  REQUIRE(a.map(Map::kColor) == "wood.png");
  REQUIRE(a.map(Map::kAlpha) == "leaf.png");
  REQUIRE(a.map(Map::kBump) == "bump map.png");
  REQUIRE(a.bump_scale == 0.3f);
  REQUIRE(a.map(Map::kNormal) == "textures/n.png");
  REQUIRE(a.map(Map::kEmission) == "glow.png");
  REQUIRE(a.map(Map::kRoughness) == "rough.png");
  REQUIRE(a.map(Map::kMetallic) == "metal.png");
}

TEST_CASE("MTL: transparency is what opacity is not, unless both are said") {
  REQUIRE(material_of("Tr 0.25\n").alpha == 0.75f);
  REQUIRE(material_of("d -halo 0.25\n").alpha == 0.25f);
  REQUIRE(material_of("d 1\nTr 1\n").alpha == 1);
  REQUIRE(material_of("Tr 1\nd 1\n").alpha == 1);
}

TEST_CASE("MTL: options of maps are skipped, whatever the number of their values") {
  REQUIRE(material_of("map_Kd -s 1 1 1 -o 0.5 a.png\n").map(MeshData::NamedMaterial::Map::kColor) == "a.png");
  REQUIRE(
      material_of("map_Kd -s 2 2 -clamp on -texres 64 64.png\n").map(MeshData::NamedMaterial::Map::kColor) ==
      "64.png");
  REQUIRE(material_of("map_Kd -colorspace sRGB -mm 0 1 -blendu off -type sphere my file.jpg \r\n")
              .map(MeshData::NamedMaterial::Map::kColor) == "my file.jpg");
  REQUIRE_FALSE(material_of("bump a.png\n").bump_scale);
  REQUIRE(material_of("bump -bm -2 -o 1 2 a.png\n").bump_scale == -2.0f);
  REQUIRE(material_of("bump -bm\n").map(MeshData::NamedMaterial::Map::kBump).empty());
}

TEST_CASE("MTL: what makes no sense leaves things as they are") {
  const MeshData::NamedMaterial a = material_of(
      "Kd red\nKd spectral file.rfl\nKs xyz 1 1 1\nKd 1 2\nKe nan 0 0\nNs\nd x\nNi 1e99\nillum -4\nillum "
      "1.5.2 7\nfoo bar\n\n\\\n");
  REQUIRE(a.color == Color3f(0.8f));
  REQUIRE(a.specular == Color3f(0));
  REQUIRE(a.emission == Color3f(0));
  REQUIRE(a.alpha == 1);
  REQUIRE(a.ior == 1.5f);
  std::vector<MeshData::NamedMaterial> none;
  meshes::read_mtl("Kd 1 0 0\nmap_Kd a.png\n", "", none);
  REQUIRE(none.empty());
}
