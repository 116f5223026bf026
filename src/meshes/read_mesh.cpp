#include "meshes/read_mesh.hpp"

#include <algorithm>
#include <filesystem>

#include "core/mapped_file.hpp"
#include "meshes/obj.hpp"
#include "meshes/obj_materials.hpp"
#include "meshes/ply.hpp"
#include "meshes/stl.hpp"
#include "raytracer/error.hpp"

namespace raytracer {
namespace {

std::string ending_of(const std::string& path) {
  std::string ending = std::filesystem::path(path).extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
  return ending;
}

}  // namespace

MeshData read_mesh(const std::string& path, const MayRead& may_read) {
  const MappedFile file(path);
  const std::string_view bytes = file.bytes();
  if (bytes.empty()) throw Error(ErrorKind::kScene, "it is empty");
  const std::string ending = ending_of(path);
  const bool is_known = ending == ".obj" || ending == ".ply" || ending == ".stl";
  const auto is = [&](const char* known, bool looks_so) {
    return ending == known || (!is_known && looks_so);
  };
  if (is(".ply", bytes.substr(0, 3) == "ply")) return meshes::read_ply(bytes);
  if (is(".stl", meshes::looks_like_stl(bytes))) return meshes::read_stl(bytes);
  return meshes::read_obj(bytes, std::filesystem::path(path).parent_path().string(), may_read);
}

std::vector<std::string> files_named_by_mesh(const std::string& path) {
  try {
    const MappedFile file(path);
    return meshes::files_named_in_obj(file.bytes(), std::filesystem::path(path).parent_path().string());
  } catch (const Error&) {
    return {};
  }
}

}  // namespace raytracer
