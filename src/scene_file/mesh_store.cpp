#include "scene_file/mesh_store.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <utility>

#include "core/hash.hpp"
#include "meshes/read_mesh.hpp"
#include "raytracer/error.hpp"
#include "scene_file/diagnostics.hpp"
#include "scene_file/files.hpp"
#include "shapes/mesh.hpp"
#include "textures/image_texture.hpp"
#include "textures/patterns.hpp"

namespace raytracer::scene_file {
namespace {

std::string key_of(const std::string& path, const MeshOptions& options) {
  const double smooth = options.smooth.value_or(-1);
  return fmt::format("{} {} {} {} {} {}", smooth, options.flip, options.recenter, options.linear_colors,
                     options.fit, path);
}

template <class T>
void add_bytes(Hasher& hasher, const std::vector<T>& values) {
  hasher.add(std::string_view(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)));
}

SceneHash hash_of(const MeshData& mesh) {
  Hasher hasher;
  add_bytes(hasher, mesh.positions);
  add_bytes(hasher, mesh.normals);
  add_bytes(hasher, mesh.uvs);
  add_bytes(hasher, mesh.colors);
  add_bytes(hasher, mesh.triangles);
  add_bytes(hasher, mesh.ranges);
  for (const MeshData::NamedMaterial& m : mesh.materials) {
    for (const Color3f& color : {m.color, m.emission, m.specular}) {
      for (int i = 0; i < 3; ++i) hasher.add(static_cast<double>(color[i]));
    }
    for (const float x : {m.exponent, m.alpha, m.ior, m.roughness, m.metallic, m.bump_scale.value_or(0)})
      hasher.add(static_cast<double>(x));
    for (const std::string& map : m.maps) hasher.add(std::string_view(map));
  }
  return hasher.value();
}

// Puts the triangles of each material side by side, those without one first.
void sort_by_material(MeshData& mesh) {
  using Range = MeshData::Range;
  std::ranges::stable_sort(mesh.ranges, {}, &Range::begin);
  if (mesh.ranges.size() <= mesh.materials.size()) return;  // few enough as they are
  std::vector<std::vector<std::array<std::uint32_t, 3>>> by_material(mesh.materials.size() + 1);
  std::size_t at = 0;
  const auto take = [&](std::size_t end, std::size_t group) {
    for (; at < end; ++at) by_material[group].push_back(mesh.triangles[at]);
  };
  for (const Range& range : mesh.ranges) {
    take(range.begin, 0);
    take(range.end, range.material + 1);
  }
  take(mesh.triangles.size(), 0);
  mesh.triangles.clear();
  mesh.ranges.clear();
  for (std::size_t group = 0; group < by_material.size(); ++group) {
    const auto begin = static_cast<std::uint32_t>(mesh.triangles.size());
    mesh.triangles.insert(mesh.triangles.end(), by_material[group].begin(), by_material[group].end());
    const auto end = static_cast<std::uint32_t>(mesh.triangles.size());
    if (group > 0 && end > begin) mesh.ranges.push_back({begin, end, static_cast<std::uint32_t>(group - 1)});
  }
}

// The mesh's parts, each of one material: `own` where the file names none, or throughout.
void add_parts(const std::shared_ptr<const MeshData>& data, std::uint32_t own,
               const std::vector<std::uint32_t>& of_file, bool takes_all, ShapeBatch& list) {
  const auto add = [&](std::uint32_t begin, std::uint32_t end, std::uint32_t material) {
    if (begin < end) list.add(std::make_unique<TriangleMesh>(data, begin, end), material);
  };
  std::uint32_t at = 0;
  if (!takes_all) {
    for (const MeshData::Range& range : data->ranges) {
      add(at, range.begin, own);
      add(range.begin, range.end, of_file[range.material]);
      at = range.end;
    }
  }
  add(at, static_cast<std::uint32_t>(data->triangles.size()), own);
}

// By the factor that -bm says: heights are scene units then, and normals lean as much more.
TexturePointer bumps_times(float factor, TexturePointer texture, MtlContent content) {
  Rescaling rescaling;
  rescaling.factor = Color3f(factor);
  if (content == MtlContent::kBumpNormals) {
    rescaling.around = Color3f(0.5F);
    rescaling.channels = {1, 1, 0};
  }
  return make_rescaled(std::move(texture), std::move(rescaling));
}

}  // namespace

void MeshStore::load(MeshFile& mesh, const Place& place) {
  try {
    auto data = std::make_shared<MeshData>(
        read_mesh(mesh.path, [this](const std::string& path) { files_.require_allowed(path); }));
    sort_by_material(*data);
    for (const std::string& file : data->files_read) files_.note_read(file);
    for (const std::string& remark : data->remarks)
      diagnostics_.warning(place, fmt::format("'{}': {}", mesh.name, remark));
    if (data->triangles.empty() && data->remarks.empty())
      diagnostics_.warning(place, fmt::format("'{}' has no triangles", mesh.name));
    mesh.materials.clear();
    mesh.pictures.clear();
    for (const MeshData::NamedMaterial& said : data->materials) {
      Material material = material_from_mtl(said);
      material.textures = textures_of(said, mesh, place);
      mesh.materials.push_back(std::move(material));
    }
    mesh.data = std::move(data);
  } catch (const Error& error) {
    mesh.problem = error.what();
  } catch (const std::bad_alloc&) {
    mesh.problem = "there is too little memory for it";
  }
}

// The pictures of a material; null where it has none.
std::shared_ptr<const MaterialTextures> MeshStore::textures_of(const MeshData::NamedMaterial& said,
                                                               MeshFile& mesh, const Place& place) {
  auto textures = std::make_shared<MaterialTextures>();
  for (const MtlMap& row : mtl_maps()) {
    TexturePointer& texture = (*textures).*row.texture;
    if (texture == nullptr && !said.map(row.map).empty()) texture = texture_of(said, row, mesh, place);
  }
  return *textures == MaterialTextures{} ? nullptr : std::move(textures);
}

// Null where it can't be shown, which is then told.
TexturePointer MeshStore::texture_of(const MeshData::NamedMaterial& said, const MtlMap& row, MeshFile& mesh,
                                     const Place& place) {
  const std::string& name = said.map(row.map);
  const auto leave_out = [&](std::string_view reason) {
    diagnostics_.warning(place, fmt::format("'{}': the picture '{}' {}", mesh.name, name, reason));
    return nullptr;
  };
  try {
    const std::string path = (std::filesystem::path(said.folder) / name).string();
    files_.require_allowed(path);
    files_.note_read(path);  // also where it turns out to be of no use
    const std::shared_ptr<const Picture> picture = files_.pictures().picture(path);
    const bool is_grey = picture->channels < 3, has_scale = said.bump_scale.has_value();
    if (row.content == MtlContent::kBumpNormals && is_grey) return nullptr;
    if (row.content == MtlContent::kBumpHeights && !is_grey) return nullptr;
    if (row.content == MtlContent::kBumpHeights && !has_scale) {
      return leave_out("is left out: its file does not say with -bm how high its bumps are");
    }
    const TextureMeaning color =
        mesh.options.linear_colors ? TextureMeaning::kLight : TextureMeaning::kDisplay;
    TexelUse use{row.content == MtlContent::kColor ? color : TextureMeaning::kNumber};
    const bool is_alpha = row.map == MeshData::NamedMaterial::Map::kAlpha;
    if (is_alpha) use.channel = picture->has_alpha() ? TextureChannel::kAlpha : TextureChannel::kMean;
    auto pyramid = files_.pictures().pyramid(path, use);
    mesh.pictures.push_back(path);
    TexturePointer texture = make_image_texture(std::move(pyramid), TexturePlacement{});
    const bool is_bump = row.map == MeshData::NamedMaterial::Map::kBump;
    return is_bump && has_scale ? bumps_times(*said.bump_scale, std::move(texture), row.content) : texture;
  } catch (const Error& error) {
    return leave_out(fmt::format("can't be shown: {}", error.what()));
  }
}

bool MeshStore::need_data(MeshFile& mesh, const Place& place) {
  if (mesh.data == nullptr && mesh.problem.empty()) load(mesh, place);
  if (mesh.problem.empty()) return true;
  diagnostics_.error(place, fmt::format("'{}': {}", mesh.name, mesh.problem));
  return false;
}

MeshFile* MeshStore::read(const std::string& path, const std::string& name, const MeshOptions& options,
                          const Place& place, bool needs_hash) {
  std::shared_ptr<MeshFile>& mesh = kept_.meshes[key_of(path, options)];
  const bool is_new = mesh == nullptr;
  if (is_new) {
    mesh = std::make_shared<MeshFile>();
    mesh->path = path;
    mesh->name = name;
    mesh->options = options;
  }
  files_.note_read(path);
  const bool lacks_hash = needs_hash && !mesh->hash;
  if ((is_new || lacks_hash || !mesh->problem.empty()) && !need_data(*mesh, place)) return nullptr;
  if (lacks_hash) {
    Hasher hasher;
    for (const std::uint64_t word : hash_of(*mesh->data)) hasher.add(word);
    for (const std::string& picture : mesh->pictures) {
      for (const std::uint64_t word : files_.content_hash(picture)) hasher.add(word);
    }
    mesh->hash = hasher.value();
  }
  return mesh.get();
}

const std::vector<std::uint32_t>& MeshStore::materials_of(const MeshFile& mesh,
                                                          std::vector<Material>& materials) {
  const auto [known, is_new] = materials_.try_emplace(&mesh);
  if (is_new) {
    for (const Material& material : mesh.materials) {
      known->second.push_back(static_cast<std::uint32_t>(materials.size()));
      materials.push_back(material);
    }
  }
  return known->second;
}

void MeshStore::add_copy(const MeshUse& use, std::vector<Material>& materials, ShapeBatch& list) {
  if (!need_data(*use.mesh, use.place)) return;
  const auto data = std::make_shared<MeshData>(*use.mesh->data);
  prepare_mesh(*data, use.mesh->options, use.to_world);
  add_parts(data, use.material, materials_of(*use.mesh, materials), use.takes_all, list);
}

std::shared_ptr<const SharedShapes> MeshStore::share(const MeshFile& mesh, bool takes_all) {
  std::vector<Material> materials(1);
  std::vector<std::uint32_t> of_file;
  for (const Material& material : mesh.materials) {
    of_file.push_back(static_cast<std::uint32_t>(materials.size()));
    materials.push_back(material);
  }
  ShapeBatch list;
  add_parts(mesh.own, 0, of_file, takes_all, list);
  return std::make_shared<const SharedShapes>(std::move(list.shapes), std::move(list.material_of),
                                              std::move(materials));
}

bool MeshStore::add_instance(const MeshUse& use, bool keeps_data, ShapeStore& store) {
  MeshFile& mesh = *use.mesh;
  if (mesh.own == nullptr) {
    if (!need_data(mesh, use.place)) return false;
    const auto own = keeps_data ? std::make_shared<MeshData>(*mesh.data) : std::move(mesh.data);
    prepare_mesh(*own, mesh.options);
    mesh.own = own;
  }
  const bool takes_all = use.takes_all && !mesh.materials.empty();
  auto& shared = mesh.shared[takes_all];
  if (shared == nullptr) shared = share(mesh, takes_all);
  store.add_instance(shared, use.to_world, use.material);
  return true;
}

// A mesh that stands in one place for all times is put there, point by point; one that stands in more, or
// moves, is stored once in its own space.
void MeshStore::place(MeshFile& mesh, const std::vector<const MeshUse*>& uses,
                      std::vector<Material>& materials, ShapeStore& store) {
  const auto is_still = [](const MeshUse* use) { return !use->depends_on_time; };
  const MeshUse* alone =
      std::ranges::count_if(uses, is_still) == 1 ? *std::ranges::find_if(uses, is_still) : nullptr;
  for (const MeshUse* use : uses) {
    if (use == alone) continue;
    if (!add_instance(*use, alone != nullptr, store)) return;
  }
  if (alone != nullptr && !store.has_still()) {
    if (!need_data(mesh, alone->place)) return;
    const std::shared_ptr<MeshData> data = std::move(mesh.data);
    prepare_mesh(*data, mesh.options, alone->to_world);
    ShapeBatch list;
    add_parts(data, alone->material, materials_of(mesh, materials), alone->takes_all, list);
    for (std::size_t i = 0; i < list.shapes.size(); ++i)
      store.add(std::move(list.shapes[i]), list.material_of[i], false);
  }
  mesh.data = nullptr;  // whoever needs it has it
}

void MeshStore::place_all(std::vector<Material>& materials, ShapeStore& store) {
  std::vector<MeshFile*> meshes;
  std::unordered_map<const MeshFile*, std::vector<const MeshUse*>> uses;
  for (const MeshUse& use : uses_) {
    if (uses[use.mesh].empty()) meshes.push_back(use.mesh);
    uses[use.mesh].push_back(&use);
  }
  for (MeshFile* mesh : meshes) {
    const Place& first = uses[mesh].front()->place;
    try {
      place(*mesh, uses[mesh], materials, store);
    } catch (const Error& error) {
      diagnostics_.error(first, fmt::format("'{}': {}", mesh->name, error.what()));
    }
  }
  uses_.clear();
}

}  // namespace raytracer::scene_file
