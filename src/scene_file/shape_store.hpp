// Where the shapes of a scene gather while it is built: those that stand still, those that move, and those
// that are stored once for many places.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <unordered_map>
#include <vector>

#include "raytracer/scene.hpp"
#include "scene_file/value.hpp"

namespace raytracer::scene_file {

struct MeshFile;

/// What one moment of a scene leaves to the next: the shapes that do not depend on time, built once for all.
struct KeptShapes {
  bool has_still = false;
  std::shared_ptr<const SharedShapes> still;                          ///< null where there are none
  std::map<std::string, std::shared_ptr<const SharedShapes>> by_use;  ///< of definitions
  std::map<std::string, std::shared_ptr<MeshFile>> meshes;            ///< by file and options
};

/// A list of shapes with their materials.
struct ShapeBatch {
  std::vector<std::unique_ptr<Shape>> shapes;
  std::vector<std::uint32_t> material_of;

  void add(std::unique_ptr<Shape> shape, std::uint32_t material) {
    shapes.push_back(std::move(shape));
    material_of.push_back(material);
  }
};

class ShapeStore {
 public:
  explicit ShapeStore(KeptShapes& kept) : kept_(kept) {}

  void add(std::unique_ptr<Shape> shape, std::uint32_t material, bool depends_on_time);
  /// `material`, if any, stands for the first of the shared ones.
  void add_instance(const std::shared_ptr<const SharedShapes>& shared, const Transform& to_world,
                    std::uint32_t material = Instance::kOwnMaterials);
  /// Whether an earlier moment has built what stands still.
  bool has_still() const { return kept_.has_still; }

  /// From here to stop_recording() all shapes go into a list of their own.
  void record(ShapeBatch& list) { recording_ = &list; }
  void stop_recording() { recording_ = nullptr; }
  bool is_recording() const { return recording_ != nullptr; }
  ShapeBatch& recorded() { return *recording_; }
  std::uint64_t endless_made() const { return endless_made_; }

  std::shared_ptr<const SharedShapes> find_kept(const std::string& key) const;
  void keep(const std::string& key, const std::shared_ptr<const SharedShapes>& shared) {
    kept_.by_use[key] = shared;
  }

  /// A list with copies of just the materials that it uses.
  static std::shared_ptr<const SharedShapes> share(ShapeBatch list, const std::vector<Material>& materials);

  void move_into(SceneDescription& scene, bool depends_on_time);

 private:
  KeptShapes& kept_;
  ShapeBatch still_, endless_, moving_;
  ShapeBatch* recording_ = nullptr;
  std::uint64_t endless_made_ = 0;
  std::vector<std::shared_ptr<const SharedShapes>> shared_;
  std::unordered_map<const SharedShapes*, std::uint32_t> shared_index_;
  std::vector<Instance> instances_;
};

/// What is known about one way to use a definition: with these arguments, and this material for what names
/// none.
struct UseRecord {
  std::uint64_t count = 0;
  std::uint64_t shapes = 0;                    ///< that one use makes, all uses in it built out
  bool can_be_shared = false;                  ///< nothing but finite shapes, and enough of them
  std::shared_ptr<const SharedShapes> shared;  ///< from the second use on
};

class UseCounter {
 public:
  UseRecord& operator[](const std::string& key) { return records_[key]; }

 private:
  std::unordered_map<std::string, UseRecord> records_;
};

/// The bytes that tell one way to use a definition from another. `owner` stands for the definition.
std::string use_key(const void* owner, const std::vector<Value>& arguments, std::uint32_t material);

}  // namespace raytracer::scene_file
