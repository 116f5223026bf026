#include "meshes/obj_materials.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <set>
#include <unordered_map>

#include "core/mapped_file.hpp"
#include "meshes/chunks.hpp"
#include "meshes/mtl.hpp"
#include "meshes/obj_lines.hpp"
#include "raytracer/error.hpp"

namespace raytracer::meshes {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostLibraries = 256;
constexpr std::size_t kMostTold = 5;  // names in a remark

// "'a', 'b' and 3 more".
std::string listed(const std::vector<std::string>& names) {
  std::string text;
  for (std::size_t i = 0; i < std::min(names.size(), kMostTold); ++i) {
    text += (i == 0 ? "" : ", ") + in_quotes(names[i]);
  }
  if (names.size() > kMostTold) text += fmt::format(" and {} more", names.size() - kMostTold);
  return text;
}

// The words of a name list; "\ " is a blank within one.
std::vector<std::string> split(std::string_view list) {
  std::vector<std::string> names;
  bool in_name = false;
  for (std::size_t i = 0; i < list.size() && names.size() <= kMostLibraries; ++i) {
    const bool escaped = list[i] == '\\' && i + 1 < list.size() && list[i + 1] == ' ';
    if (!escaped && (is_blank(list[i]) || list[i] == '\n')) {
      in_name = false;
      continue;
    }
    if (!in_name) names.emplace_back();
    in_name = true;
    names.back() += escaped ? list[++i] : list[i];
  }
  return names;
}

class Libraries {
 public:
  Libraries(std::string folder, const MayRead& may_read, MeshData& mesh)
      : folder_(std::move(folder)), may_read_(may_read), mesh_(mesh) {}

  /// What stands behind one "mtllib": a name with blanks in it, or several names.
  void read(std::string_view list) {
    const std::string whole(list);
    if (is_there(path_of(whole))) return read_file(whole);
    for (const std::string& name : split(list)) read_file(name);
  }

  bool all_there() const { return missing_.empty(); }
  void tell_missing() {
    if (missing_.empty()) return;
    mesh_.remarks.push_back(fmt::format("the material {} {} {} not there",
                                        missing_.size() == 1 ? "file" : "files", listed(missing_),
                                        missing_.size() == 1 ? "is" : "are"));
  }

 private:
  std::string path_of(const std::string& name) const { return (fs::path(folder_) / name).string(); }

  static bool is_there(const std::string& path) {
    std::error_code error;
    return fs::is_regular_file(path, error);
  }

  void read_file(const std::string& name) {
    if (!known_.insert(name).second) return;
    if (name.find('\0') != std::string::npos) return missing_.push_back(name);  // the system would cut it off
    if (known_.size() > kMostLibraries) {
      throw Error(ErrorKind::kScene, "it names more than 256 material files");
    }
    std::string path = path_of(name);
    if (!is_there(path)) {
      std::string slashes = name;  // as Windows writes folders
      std::replace(slashes.begin(), slashes.end(), '\\', '/');
      path = path_of(slashes);
    }
    if (may_read_) may_read_(path);
    if (!is_there(path)) return missing_.push_back(name);
    read_existing(name, path);
  }

  void read_existing(const std::string& name, const std::string& path) {
    try {
      const MappedFile file(path);
      read_mtl(file.bytes(), fs::path(path).parent_path().string(), mesh_.materials);
    } catch (const Error& error) {
      throw Error(error.kind(), fmt::format("its material file {}: {}", in_quotes(name), error.what()));
    }
    mesh_.files_read.push_back(path);
  }

  std::string folder_;
  const MayRead& may_read_;
  MeshData& mesh_;
  std::set<std::string> known_;
  std::vector<std::string> missing_;
};

// Fills the ranges; returns the names that no material has.
std::vector<std::string> add_ranges(const std::vector<MaterialUse>& uses, MeshData& mesh) {
  std::unordered_map<std::string_view, std::uint32_t> materials;
  for (std::size_t i = 0; i < mesh.materials.size(); ++i) {
    materials.emplace(mesh.materials[i].name, static_cast<std::uint32_t>(i));  // the first of a name counts
  }
  std::set<std::string_view> unknown;
  for (std::size_t i = 0; i < uses.size(); ++i) {
    const auto material = materials.find(uses[i].name);
    const std::size_t end = i + 1 < uses.size() ? uses[i + 1].triangle : mesh.triangles.size();
    if (material == materials.end()) {
      unknown.insert(uses[i].name);
    } else if (uses[i].triangle < end) {
      const MeshData::Range range{static_cast<std::uint32_t>(uses[i].triangle),
                                  static_cast<std::uint32_t>(end), material->second};
      MeshData::Range* const last = mesh.ranges.empty() ? nullptr : &mesh.ranges.back();
      if (last != nullptr && last->end == range.begin && last->material == range.material) {
        last->end = range.end;
      } else {
        mesh.ranges.push_back(range);
      }
    }
  }
  return {unknown.begin(), unknown.end()};
}

}  // namespace

void add_materials(const std::vector<std::string_view>& libraries, const std::vector<MaterialUse>& uses,
                   const std::string& folder, const MayRead& may_read, MeshData& mesh) {
  Libraries files(folder, may_read, mesh);
  for (const std::string_view list : libraries) files.read(list);
  files.tell_missing();
  const std::vector<std::string> unknown = add_ranges(uses, mesh);
  if (unknown.empty() || !files.all_there()) return;  // a file that is not there tells enough
  mesh.remarks.push_back(fmt::format("no material file says what the {} {} {} like",
                                     unknown.size() == 1 ? "material" : "materials", listed(unknown),
                                     unknown.size() == 1 ? "looks" : "look"));
}

std::vector<std::string> files_named_in_obj(std::string_view text, const std::string& folder) {
  MeshData mesh;
  const MayRead any;
  Libraries files(folder, any, mesh);
  for (Cursor c(text); find_statement(c);) {
    if (read_word(c) == "mtllib") {
      files.read(read_rest(c));
    } else {
      skip_statement(c);
    }
  }
  std::vector<std::string> named = mesh.files_read;
  for (const MeshData::NamedMaterial& material : mesh.materials) {
    for (const std::string& map : material.maps) {
      if (!map.empty()) named.push_back((fs::path(material.folder) / map).string());
    }
  }
  return named;
}

}  // namespace raytracer::meshes
