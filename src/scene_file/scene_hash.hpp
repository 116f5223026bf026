// What an evaluated scene says, as one number: two moments with the same number are the same picture.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <unordered_map>

#include "core/hash.hpp"
#include "raytracer/scene_file.hpp"
#include "scene_file/schema.hpp"

namespace raytracer::scene_file {

/// Told of every block and every property that the builder accepts, in order. Whatever else goes into the
/// pixels (the content of a file that is no scene's text, say) has to be told as well.
class SceneHasher {
 public:
  /// A material has been made, which the scene knows by this number.
  void add_material(std::uint32_t index);
  /// `material` is what the block has around it, `to_world` likewise.
  void begin_block(const KindRow& kind, std::string_view name, const Transform& to_world,
                   std::uint32_t material);
  void add(const PropertyRow& property, const Argument& argument);
  /// A texture with a name has been made.
  void number_texture(const void* texture);
  /// A property of the innermost block has a texture: one with a name, or the one whose block has just ended.
  void add_texture(std::string_view property, const void* texture);
  /// What stands in a file that is no scene's text, as a hash.
  void add_content(const SceneHash& content);
  /// `material` is the block's own.
  void end_block(const std::optional<std::uint32_t>& material);

  /// With what the caller decides.
  SceneHash finish(const RenderSettings& settings, std::string_view camera);

 private:
  void add(const Transform& transform);
  void add_number_of(std::uint32_t material);

  Hasher hasher_;
  // The scene's numbers of materials depend on what was built at earlier moments; these do not.
  std::unordered_map<std::uint32_t, std::uint64_t> material_numbers_;
  std::unordered_map<const void*, std::uint64_t> texture_numbers_;
  bool is_seen_ = true;  // whether the block goes into the pixels
};

}  // namespace raytracer::scene_file
