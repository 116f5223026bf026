// Small good files, cut at every byte and with every byte changed: each ends in a sound mesh or an Error.
#include <random>

#include "mesh_files.hpp"
#include "meshes/obj.hpp"
#include "meshes/ply.hpp"
#include "meshes/stl.hpp"
#include "temporary_folder.hpp"

using namespace raytracer;

namespace {

using Reader = MeshData (*)(std::string_view);

constexpr std::size_t kChunk = 40;  // several pieces even of small files

MeshData read_obj(std::string_view file) { return meshes::read_obj(file, "", {}, kChunk); }
MeshData read_ply(std::string_view file) { return meshes::read_ply(file, kChunk); }
MeshData read_stl(std::string_view file) { return meshes::read_stl(file, kChunk); }

// "" where the file is read soundly or refused with a sentence. From memory of just that size, so that a
// sanitizer sees what is read beyond it.
std::string outcome(Reader read, const std::string& file) {
  const std::vector<char> bytes(file.begin(), file.end());
  try {
    return inconsistency(read({bytes.data(), bytes.size()}));
  } catch (const Error& error) {
    return error.kind() == ErrorKind::kScene && *error.what() != '\0' ? "" : "a strange error";
  }
}

void abuse(Reader read, const std::string& good) {
  REQUIRE(inconsistency(read(good)).empty());
  std::mt19937 random(5);
  for (std::size_t i = 0; i < good.size(); ++i) {
    INFO("byte " << i);
    REQUIRE(outcome(read, good.substr(0, i)).empty());
    REQUIRE(outcome(read, good.substr(0, i) + good.substr(i + 1)).empty());
    for (const int flip : {0x01, 0x10, 0x80, 0xFF, static_cast<int>(random() % 256)}) {
      std::string changed = good;
      changed[i] = static_cast<char>(changed[i] ^ flip);
      REQUIRE(outcome(read, changed).empty());
    }
    for (const char c : {'\0', '\n', ' ', '9', '-', '\\', '#', '/'}) {
      std::string changed = good;
      changed[i] = c;
      REQUIRE(outcome(read, changed).empty());
    }
  }
  for (int turn = 0; turn < 2000; ++turn) {  // several wounds at once
    std::string changed = good;
    for (int i = 0; i < 4; ++i) {
      const std::size_t from = random() % changed.size(), to = random() % changed.size(),
                        length = random() % 12;
      changed.replace(to, length, changed.substr(from, random() % 12));
    }
    REQUIRE(outcome(read, changed).empty());
  }
}

std::string binary_ply(bool big_endian) {
  Bytes bytes(big_endian);
  bytes.text(
      std::string("ply\nformat binary_") + (big_endian ? "big" : "little") +
      "_endian 1.0\nelement vertex 5\nproperty float x\nproperty float y\nproperty double z\nproperty float "
      "nx\n"
      "property float ny\nproperty float nz\nproperty uchar red\nproperty uchar green\nproperty uchar blue\n"
      "element face 2\nproperty list uchar short vertex_indices\nproperty list uchar uchar skip\n"
      "element tristrips 1\nproperty list uint int vertex_indices\nend_header\n");
  for (int i = 0; i < 5; ++i) {
    const auto f = static_cast<float>(i);
    bytes.add(f).add(f * f).add(0.5 * i).add(1.0f).add(f).add(0.0f).add_all(
        std::vector<std::uint8_t>{1, 2, 3});
  }
  bytes.add(std::uint8_t{3})
      .add_all(std::vector<std::int16_t>{0, 1, 2})
      .add(std::uint8_t{1})
      .add(std::uint8_t{7});
  bytes.add(std::uint8_t{5}).add_all(std::vector<std::int16_t>{0, 1, 2, 3, 4}).add(std::uint8_t{0});
  bytes.add(std::uint32_t{5}).add_all(std::vector<std::int32_t>{0, 1, 3, -1, 2});
  return bytes.str();
}

}  // namespace

TEST_CASE("damaged OBJ files") {
  const TemporaryFolder folder;
  abuse(read_obj,
        "# c\nmtllib none.mtl\nv 0 0 0 1 0 0\nv 1 0 0\nv 1 1.5e0 0\nv 0 1 0\nvt 0 1\nvn 0 0 1\nusemtl a\n"
        "f 1/1/1 2/-1/-1 3//1 4\ng x\nusemtl b\nf -4 -3 \\\n -2\nl 1 2\n");
}

TEST_CASE("damaged MTL files") {
  const std::string mtl =
      "newmtl a\nKd 1 0.5 0\nd -halo 0.5\nmap_Kd -s 1 1 -o 0 a.png\nnewmtl b\nillum 2\nNs 1e2\n";
  const std::string obj = "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nusemtl a\nf 1 2 3\n";
  const TemporaryFolder folder;
  for (std::size_t i = 0; i < mtl.size(); ++i) {
    for (const char c : {'\0', '\n', ' ', '-', '\\', '\xFF'}) {
      std::string changed = mtl.substr(0, i) + c;
      if (c != '\n') changed += mtl.substr(i + 1);
      write(folder / "a.mtl", changed);
      REQUIRE(inconsistency(meshes::read_obj(obj, folder.path(), {})).empty());
    }
  }
}

TEST_CASE("damaged PLY files in text") {
  abuse(read_ply,
        "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
        "property float s\nproperty float t\nproperty uchar red\nproperty uchar green\nproperty uchar "
        "blue\nelement other 1\n"
        "property list uchar int a\nelement face 2\nproperty list uchar int vertex_indices\nproperty int "
        "q\nend_header\n"
        "0 0 0 0 0 1 2 3\n1 0 0 1 0 1 2 3\n1 1 0 1 1 1 2 3\n0 1 0 0 1 1 2 255\n2 4 5\n3 0 1 2 7\n4 0 1 2 3 "
        "7\n");
}

TEST_CASE("damaged binary PLY files") {
  for (const bool big_endian : {false, true}) abuse(read_ply, binary_ply(big_endian));
}

TEST_CASE("damaged plain binary PLY files") {
  Bytes bytes;
  bytes.text(
      "ply\nformat binary_little_endian 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
      "property float z\nelement face 2\nproperty list uchar int vertex_indices\nend_header\n");
  bytes.add_all(std::vector<float>{0, 0, 0, 1, 0, 0, 0, 1, 0});
  for (int i = 0; i < 2; ++i) bytes.add(std::uint8_t{3}).add_all(std::vector<std::int32_t>{0, 1, 2});
  abuse(read_ply, bytes.str());
}

TEST_CASE("damaged STL files in text") {
  std::string text = "solid a\n";
  for (int i = 0; i < 2; ++i) {
    text +=
        "facet normal 0 0 1\n outer loop\n  vertex 0 0 0\n  vertex 1 0 0\n  vertex 1 1 0\n "
        "endloop\nendfacet\n";
  }
  abuse(read_stl, text + "endsolid a\n");
}

TEST_CASE("damaged binary STL files") {
  Bytes bytes;
  bytes.text("solid" + std::string(75, ' ')).add(std::uint32_t{2});
  for (int i = 0; i < 2; ++i) {
    bytes.add_all(std::vector<float>{0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, static_cast<float>(i)})
        .add(std::uint16_t{0});
  }
  abuse(read_stl, bytes.str());
}
