#include "meshes/read_mesh.hpp"

#include <sys/stat.h>

#include "mesh_files.hpp"
#include "temporary_folder.hpp"

using namespace raytracer;

namespace {

const std::string kObj = "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
const std::string kPly =
    "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\nelement "
    "face 1\n"
    "property list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
const std::string kStl =
    "solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 "
    "0\nendloop\nendfacet\nendsolid\n";

std::string binary_stl() {
  Bytes bytes;
  bytes.text(std::string(80, '\0')).add(std::uint32_t{1});
  return bytes.add_all(std::vector<float>{0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0}).add(std::uint16_t{0}).str();
}

}  // namespace

TEST_CASE("the format is told by the name's ending, or else by the content") {
  const TemporaryFolder folder;
  for (const auto& [content, endings] :
       std::vector<std::pair<std::string, std::vector<std::string>>>{{kObj, {".obj", ".OBJ", ".txt", ""}},
                                                                     {kPly, {".ply", ".Ply", ".mesh", ""}},
                                                                     {kStl, {".stl", ".STL", ".mesh", ""}},
                                                                     {binary_stl(), {".stl", ".bin"}}}) {
    for (const std::string& ending : endings) {
      write(folder / ("mesh" + ending), content);
      const MeshData mesh = read_mesh(folder / ("mesh" + ending));
      REQUIRE(mesh.positions == std::vector<Vector3f>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
      REQUIRE(mesh.triangles == Triangles{{0, 1, 2}});
    }
  }
}

TEST_CASE("an OBJ file's materials are looked for in its folder") {
  const TemporaryFolder folder;
  write(folder / "m.mtl", "newmtl a\n");
  write(folder / "a.obj", kObj);
  const MeshData mesh = read_mesh(folder / "a.obj");
  REQUIRE(mesh.materials.size() == 1);
  REQUIRE(mesh.files_read == std::vector<std::string>{folder / "m.mtl"});
}

TEST_CASE("what is no file to read is refused") {
  const TemporaryFolder folder;
  const auto error = [&](const std::string& name) { return failure_of([&] { read_mesh(folder / name); }); };
  REQUIRE(error("missing.obj") == "it can't be read: No such file or directory");
  std::filesystem::create_directory(folder / "folder.obj");
  REQUIRE(error("folder.obj") == "it can't be read: it is a folder");
  REQUIRE(mkfifo((folder / "pipe.obj").c_str(), 0600) == 0);
  REQUIRE(error("pipe.obj") == "it can't be read: it is a device or a pipe");
  write(folder / "empty.ply", "");
  REQUIRE(error("empty.ply") == "it is empty");
}
