// Files that other programs wrote, good and broken, where they lie beside this project.
#include <algorithm>
#include <filesystem>
#include <map>

#include "mesh_files.hpp"
#include "meshes/read_mesh.hpp"
#include "temporary_folder.hpp"

using namespace raytracer;
namespace fs = std::filesystem;

namespace {

// TEST_DATA is tests/data of the checkout.
fs::path corpora() {
  return fs::path(TEST_DATA).parent_path().parent_path().parent_path() / "shared" / "corpora";
}

std::vector<fs::path> mesh_files() {
  std::vector<fs::path> files;
  if (!fs::is_directory(corpora())) return files;
  for (const auto& entry :
       fs::recursive_directory_iterator(corpora(), fs::directory_options::follow_directory_symlink)) {
    std::string ending = entry.path().extension().string();
    std::transform(ending.begin(), ending.end(), ending.begin(),
                   [](unsigned char c) { return std::tolower(c); });
    const std::string name = entry.path().filename().string();
    const bool unnamed =
        name.starts_with("clusterfuzz") || name == "payload_JVN42386607" || name == "formatDetection";
    if (ending == ".obj" || ending == ".ply" || ending == ".stl" || unnamed) files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

// Those that are refused, and by what words. All others are read.
const std::map<std::string, std::string> kRefused = {
    {"box_UTF16BE.obj", "UTF-16"},
    {"number_formats.obj", "line 11: '3.1+e2' is not a number"},
    {"point_cloud.obj", "no faces, only 3 points"},
    {"testline.obj", "no faces, only 8 points"},
    {"testpoints.obj", "no faces, only 8 points"},
    {"empty.obj", "it is empty"},
    {"malformed.obj", "line 23: there is no vertex 12"},
    {"clusterfuzz-testcase-minimized-fuzz_ParseFromString-4877060179886080", "line 1: '3E4570711268"},
    {"invalid-face-definition.obj", "none of its 2 faces has an area"},
    {"invalid-relative-texture-index.obj", "line 2: there is no vertex 1"},
    {"invalid-relative-vertex-index.obj", "line 1: there is no vertex -4"},
    {"issue-140-zero-face-idx.obj", "line 16: there is no vertex 0"},
    {"issue-356-leading-spaces-newmtl.obj", "no faces"},
    {"line-prim.obj", "no faces, only 8 points"},
    {"points-prim.obj", "no faces, only 8 points"},
    {"test-nan.obj", "line 12: a coordinate is not finite"},
    {"ant-half.ply", "line 755: the file ends after 259 of 912 lines of 'face'"},
    {"issue623.ply",
     "line 14: the line ends before 'vertex' has all its values"},  // it announces lists that are not there
    {"payload_JVN42386607", "line 6: the element 'vertex' stands twice"},
    {"points.ply", "no faces, only 4 points"},
    {"pond.0.ply", "no faces, only 70051 points"},
    {"crash-30d6d0f7c529b3b66b4131700b7a4580cd7082df.ply", "line 7: "},
    {"empty.ply", "it is empty"},
};

}  // namespace

TEST_CASE("every mesh of the corpora is read soundly, or refused as it should be") {
  for (const fs::path& path : mesh_files()) {
    INFO(path.string());
    const auto refused = kRefused.find(path.filename().string());
    std::string wrong;
    const std::string error = failure_of([&] { wrong = inconsistency(read_mesh(path.string())); });
    REQUIRE(wrong.empty());
    if (refused == kRefused.end()) {
      REQUIRE(error.empty());
    } else {
      REQUIRE_THAT(error, Catch::Contains(refused->second));
    }
  }
}

TEST_CASE("the same shape in several formats of the corpora is the same mesh") {
  const auto count = [](const std::string& name) {
    return read_mesh((corpora() / name).string()).triangles.size();
  };
  if (mesh_files().empty()) return;
  const std::string spider = "stl/assimp/test/models/STL/Spider_",
                    shelf = "ply/happly/test/sampledata/platonic_shelf";
  REQUIRE(count(spider + "ascii.stl") == count(spider + "binary.stl"));
  REQUIRE(count("stl/assimp/test/models/STL/Wuson.stl") == count("obj/assimp/test/models/OBJ/WusonOBJ.obj"));
  const MeshData little = read_mesh((corpora() / (shelf + ".ply")).string());
  for (const std::string name : {"_ascii.ply", "_big_endian.ply"}) {
    const MeshData other = read_mesh((corpora() / (shelf + name)).string());
    REQUIRE(other.triangles == little.triangles);
    REQUIRE(other.positions.size() == little.positions.size());
    for (std::size_t i = 0; i < other.positions.size(); ++i) {
      REQUIRE(glm::length(other.positions[i] - little.positions[i]) < 1e-5f);
    }
  }
}

TEST_CASE("meshes of the corpora cut off anywhere end soundly too") {
  const TemporaryFolder folder;
  for (const fs::path& path : mesh_files()) {
    const std::vector<std::uint8_t> bytes = contents(path.string());
    const std::string all(bytes.begin(), bytes.end()), name = folder / ("cut" + path.extension().string());
    for (int part = 1; part < 8; ++part) {
      INFO(path.string() << ", " << part << " of 8 parts");
      write(name, all.substr(0, all.size() * static_cast<std::size_t>(part) / 8));
      std::string wrong;
      failure_of([&] { wrong = inconsistency(read_mesh(name)); });
      REQUIRE(wrong.empty());
    }
  }
}
