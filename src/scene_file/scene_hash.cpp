#include "scene_file/scene_hash.hpp"

namespace raytracer::scene_file {
namespace {

// What stands between the properties, so that no two scenes make the same sequence.
constexpr std::uint64_t kBegin = 1, kEnd = 2, kProperty = 3, kContent = 4;

// More frames of the same film leave those that are there as they are.
bool goes_into_pixels(const KindRow& kind) { return kind.name != "animation"; }

}  // namespace

void SceneHasher::add_material(std::uint32_t index) {
  material_numbers_[index] = material_numbers_.size() + 1;
}

void SceneHasher::begin_block(const KindRow& kind, std::string_view name, const Transform& to_world,
                              std::uint32_t material) {
  is_seen_ = goes_into_pixels(kind);
  if (!is_seen_) return;
  hasher_.add(kBegin);
  for (const std::string_view word : {kind.name, kind.variant, name}) hasher_.add(word);
  add(to_world);
  add_number_of(material);
}

void SceneHasher::add(const PropertyRow& property, const Argument& argument) {
  if (!is_seen_) return;
  hasher_.add(kProperty);
  hasher_.add(property.name);
  for (const double number : argument.numbers) hasher_.add(number);
  hasher_.add(argument.text);
  for (const double number : argument.list) hasher_.add(number);
  hasher_.add(std::uint64_t{argument.list.size()});
  hasher_.add(std::uint64_t{argument.index} << 1U | (argument.is_display ? 1U : 0U));
}

void SceneHasher::number_texture(const void* texture) {
  texture_numbers_[texture] = texture_numbers_.size() + 1;
}

void SceneHasher::add_texture(std::string_view property, const void* texture) {
  if (!is_seen_) return;
  hasher_.add(kContent);
  hasher_.add(property);
  const auto known = texture_numbers_.find(texture);
  hasher_.add(known == texture_numbers_.end() ? 0 : known->second);
}

void SceneHasher::add_content(const SceneHash& content) {
  for (const std::uint64_t word : content) hasher_.add(word);
}

void SceneHasher::end_block(const std::optional<std::uint32_t>& material) {
  if (is_seen_) {
    hasher_.add(kEnd);
    hasher_.add(std::uint64_t{material.has_value()});
    if (material) add_number_of(*material);
  }
  is_seen_ = true;
}

SceneHash SceneHasher::finish(const RenderSettings& settings, std::string_view camera) {
  for (const int number : {settings.width, settings.height, settings.samples, settings.bounces}) {
    hasher_.add(static_cast<std::uint64_t>(number));
  }
  hasher_.add(std::uint64_t{settings.seed});
  hasher_.add(static_cast<std::uint64_t>(settings.method));
  hasher_.add(static_cast<std::uint64_t>(settings.sampling));
  hasher_.add(double{settings.clamp_indirect});
  const Development& development = settings.development;
  hasher_.add(double{development.exposure});
  hasher_.add(static_cast<std::uint64_t>(development.tone));
  for (int i = 0; i < 3; ++i) hasher_.add(double{development.white[i]});
  hasher_.add(camera);
  return hasher_.value();
}

void SceneHasher::add_number_of(std::uint32_t material) {
  const auto known = material_numbers_.find(material);
  hasher_.add(known == material_numbers_.end() ? 0 : known->second);
}

void SceneHasher::add(const Transform& transform) {
  for (int column = 0; column < 3; ++column) {
    for (int row = 0; row < 3; ++row) hasher_.add(transform.linear[column][row]);
    hasher_.add(transform.translation[column]);
  }
}

}  // namespace raytracer::scene_file
