// The meshes that a scene reads from files: each is read once, whoever names it and however often, and what
// stands in many places is stored once.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <unordered_map>
#include <vector>

#include "meshes/mesh_data.hpp"
#include "meshes/prepare_mesh.hpp"
#include "raytracer/scene_file.hpp"
#include "scene_file/shape_store.hpp"
#include "scene_file/source.hpp"

namespace raytracer::scene_file {

class Diagnostics;
class Files;

/// What a picture that an MTL file names holds.
enum class MtlContent : std::uint8_t {
  kNumber,
  kColor,
  kBumpNormals,  ///< of map_bump: normals if the picture is in colour …
  kBumpHeights,  ///< … and heights if it is grey
};

/// What it stands for.
struct MtlMap {
  MeshData::NamedMaterial::Map map;
  TexturePointer MaterialTextures::*texture;
  MtlContent content = MtlContent::kNumber;
};
/// One row for each. Where two stand for the same the first counts that is there.
std::span<const MtlMap> mtl_maps();

/// A mesh in a file, with the options that it is taken with.
struct MeshFile {
  std::string path;  ///< canonical
  std::string name;  ///< as the scene names it
  MeshOptions options;
  std::shared_ptr<MeshData> data;     ///< as read; null before, and once a scene has taken it
  std::string problem;                ///< why it can't be read; empty if it can
  std::vector<Material> materials;    ///< that the file gives
  std::optional<SceneHash> hash;      ///< of what was read
  std::vector<std::string> pictures;  ///< that the materials show
  /// With its options, in its own space; made when it stands in more than one place, or moves.
  std::shared_ptr<const MeshData> own;
  /// The same as shapes. The first of their materials
  /// gives way to the instance's; of [1] it is the material of all.
  std::array<std::shared_ptr<const SharedShapes>, 2> shared;
};

/// A place where a mesh stands.
struct MeshUse {
  MeshFile* mesh = nullptr;
  Transform to_world;
  std::uint32_t material = 0;  ///< of the scene's, for what the file gives none
  bool takes_all = false;      ///< that material is for all of the mesh, whatever the file says
  bool depends_on_time = false;
  Place place;  ///< where it is written
};

/// All meshes of one evaluation of a scene.
class MeshStore {
 public:
  MeshStore(KeptShapes& kept, Files& files, Diagnostics& diagnostics)
      : kept_(kept), files_(files), diagnostics_(diagnostics) {}

  /// The mesh in the file at `path`, read when first asked for; null where it can't be, which is then
  /// reported at `place`. `needs_hash`: its hash is there afterwards.
  MeshFile* read(const std::string& path, const std::string& name, const MeshOptions& options,
                 const Place& place, bool needs_hash);

  void add(const MeshUse& use) { uses_.push_back(use); }
  /// Adds a copy of a mesh to a list of shapes.
  void add_copy(const MeshUse& use, std::vector<Material>& materials, ShapeBatch& list);
  /// Hands all that was added to the store of shapes. What is wrong is reported at the uses.
  void place_all(std::vector<Material>& materials, ShapeStore& store);

 private:
  void load(MeshFile& mesh, const Place& place);
  std::shared_ptr<const MaterialTextures> textures_of(const MeshData::NamedMaterial& said, MeshFile& mesh,
                                                      const Place& place);
  TexturePointer texture_of(const MeshData::NamedMaterial& said, const MtlMap& row, MeshFile& mesh,
                            const Place& place);
  bool need_data(MeshFile& mesh, const Place& place);
  const std::vector<std::uint32_t>& materials_of(const MeshFile& mesh, std::vector<Material>& materials);
  static std::shared_ptr<const SharedShapes> share(const MeshFile& mesh, bool takes_all);
  bool add_instance(const MeshUse& use, bool keeps_data, ShapeStore& store);
  void place(MeshFile& mesh, const std::vector<const MeshUse*>& uses, std::vector<Material>& materials,
             ShapeStore& store);

  KeptShapes& kept_;
  Files& files_;
  Diagnostics& diagnostics_;
  std::vector<MeshUse> uses_;
  // Of each mesh the scene's numbers of its materials.
  std::unordered_map<const MeshFile*, std::vector<std::uint32_t>> materials_;
};

/// What an MTL file's words mean for a material, but for its pictures.
Material material_from_mtl(const MeshData::NamedMaterial& said);

}  // namespace raytracer::scene_file
