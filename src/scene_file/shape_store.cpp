#include "scene_file/shape_store.hpp"

#include <utility>

namespace raytracer::scene_file {

void ShapeStore::add(std::unique_ptr<Shape> shape, std::uint32_t material, bool depends_on_time) {
  const bool is_endless = !shape->bounds().is_finite();
  if (is_endless) ++endless_made_;
  const bool is_kept = kept_.has_still && !depends_on_time && !is_endless && recording_ == nullptr;
  if (is_kept) return;  // an earlier moment has it
  ShapeBatch& list = recording_ != nullptr ? *recording_
                     : is_endless          ? endless_
                     : depends_on_time     ? moving_
                                           : still_;
  list.add(std::move(shape), material);
}

void ShapeStore::add_instance(const std::shared_ptr<const SharedShapes>& shared, const Transform& to_world,
                              std::uint32_t material) {
  const auto [known, is_new] =
      shared_index_.try_emplace(shared.get(), static_cast<std::uint32_t>(shared_.size()));
  if (is_new) shared_.push_back(shared);
  instances_.push_back({known->second, glm::mat3(to_world.linear), Vector3f(to_world.translation), material});
}

std::shared_ptr<const SharedShapes> ShapeStore::find_kept(const std::string& key) const {
  const auto found = kept_.by_use.find(key);
  return found == kept_.by_use.end() ? nullptr : found->second;
}

std::shared_ptr<const SharedShapes> ShapeStore::share(ShapeBatch list,
                                                      const std::vector<Material>& materials) {
  std::vector<Material> used;
  std::unordered_map<std::uint32_t, std::uint32_t> new_index;
  for (std::uint32_t& index : list.material_of) {
    const auto [known, is_new] = new_index.try_emplace(index, static_cast<std::uint32_t>(used.size()));
    if (is_new) used.push_back(materials[index]);
    index = known->second;
  }
  return std::make_shared<const SharedShapes>(std::move(list.shapes), std::move(list.material_of),
                                              std::move(used));
}

// In a scene that depends on time what stands still is shared with the other moments; otherwise all shapes
// are the scene's own.
void ShapeStore::move_into(SceneDescription& scene, bool depends_on_time) {
  const auto append = [&](ShapeBatch& list) {
    for (auto& shape : list.shapes) scene.shapes.push_back(std::move(shape));
    scene.material_of.insert(scene.material_of.end(), list.material_of.begin(), list.material_of.end());
  };
  if (!depends_on_time) {
    scene.shapes = std::move(still_.shapes);
    scene.material_of = std::move(still_.material_of);
  } else {
    if (!kept_.has_still) {
      kept_.has_still = true;
      if (!still_.shapes.empty()) kept_.still = share(std::move(still_), scene.materials);
    }
    if (kept_.still != nullptr) add_instance(kept_.still, {});
  }
  append(endless_);
  append(moving_);
  scene.shared = std::move(shared_);
  scene.instances = std::move(instances_);
}

std::string use_key(const void* owner, const std::vector<Value>& arguments, std::uint32_t material) {
  std::string key;
  const auto add = [&](const void* bytes, std::size_t size) {
    key.append(static_cast<const char*>(bytes), size);
  };
  add(&owner, sizeof owner);
  add(&material, sizeof material);
  for (const Value& value : arguments) {
    add(&value.type, sizeof value.type);
    key += value.depends_on_time ? '1' : '0';
    key += value.is_display ? '1' : '0';
    for (int i = 0; i < 3; ++i) add(&value.vector[i], sizeof(double));
    key += value.text;
    key += '\0';
  }
  return key;
}

}  // namespace raytracer::scene_file
