// From nodes to a scene: evaluates the blocks in order, checks every property against its row, and hands sound blocks
// to the row's build function.
#pragma once

#include <memory>
#include <set>
#include <string>
#include <unordered_map>
#include <vector>

#include "raytracer/error.hpp"
#include "scene_file/diagnostics.hpp"
#include "scene_file/draft.hpp"
#include "scene_file/files.hpp"
#include "scene_file/schema.hpp"
#include "scene_file/syntax.hpp"

namespace raytracer::scene_file {

class Builder;

/// The transform words of one block, in the order written.
struct PlacingWords {
  glm::dmat3 linear{1.0};  ///< rotates and scales collected
  Vector3d translation{0};
  std::optional<Vector3d> pivot;
  std::optional<Transform> matrix;

  /// Where a thing goes whose own middle is `spot`, in its parent's space.
  Transform about(const Vector3d& spot) const;
};

/// A property that a block was given.
struct Given {
  const PropertyRow* row = nullptr;
  Place place;  ///< name and values
};

/// Names of materials, seen from where they stand to the end of their block.
struct Scope {
  Scope* parent = nullptr;
  std::unordered_map<std::string_view, std::uint32_t> materials;
};

/// What a block takes over from the blocks around it.
struct Surroundings {
  const Source* source = nullptr;
  std::string_view kind;  ///< of the block around; empty at the top
  Transform to_world;
  std::uint32_t material = 0;
  Scope* scope = nullptr;
};

/// One block on its way to become real. The rows' build functions see the builder through it.
class BlockContext {
 public:
  BlockContext(Builder& builder, const KindRow& row, const BlockNode& node, const Surroundings& around,
               std::string_view name)
      : builder_(builder), row_(row), node_(node), around_(around), name_(name) {}

  SceneDraft& draft();
  std::string_view name() const { return name_; }
  Place header() const { return {around_.source, node_.header()}; }

  bool is_given(std::string_view property) const { return given(property) != nullptr; }
  /// An error at a property, or at the block's header where the property was not given.
  void error(std::string_view property, std::string message, std::string suggestion = {});

  /// From the block's own space to the world; `spot` is its own middle.
  Transform placed(const Vector3d& spot) const { return around_.to_world * placing_.about(spot); }

  /// Adds what `make()` returns with the block's material; an Error it throws becomes a message at the block.
  template <class Make>
  void add_shape(const Make& make) {
    try {
      add_shape(make());
    } catch (const Error& problem) {
      error({}, problem.what());
    }
  }
  void build_children();
  std::uint32_t add_material(const Material& material);

 private:
  friend class Builder;
  friend bool fill(BlockContext& context, void* input);

  const Given* given(std::string_view property) const;
  void add_shape(std::unique_ptr<Shape> shape);
  bool fill_item(const PropertyNode& property, void* input);
  bool fill_block(const BlockNode& block, void* input);
  bool accept(const PropertyRow& row, const Place& place);
  bool apply_placing(const PropertyRow& row, const Argument& argument, const Place& place);
  void report_unknown_property(Span name);
  Place place(Span span) const { return {around_.source, span}; }

  Builder& builder_;
  const KindRow& row_;
  const BlockNode& node_;
  const Surroundings& around_;
  std::string_view name_;
  PlacingWords placing_;
  std::optional<std::uint32_t> material_;
  std::vector<Given> given_;
};

class Builder {
 public:
  Builder(Files& files, Diagnostics& diagnostics);

  /// Evaluates a whole scene.
  void build(const SyntaxTree& tree);

  SceneDraft& draft() { return draft_; }
  Diagnostics& diagnostics() { return diagnostics_; }
  void warn_of_unused_materials();

 private:
  friend class BlockContext;
  friend bool fill(BlockContext& context, void* input);

  /// Where a name was first given, for names that must be unique within their kind.
  using NameTable = std::unordered_map<std::string, Place>;
  struct MaterialUse {
    Place place;  // of the name; no source for unnamed ones
    bool used = false;
  };

  void build_item(const ItemNode& item, const Surroundings& around);
  void build_block(const BlockNode& block, const Surroundings& around);
  void build_include(const IncludeNode& include, const Surroundings& around);
  const KindRow* resolve_kind(const BlockNode& block, const Surroundings& around, std::string_view& name);
  void report_unknown_kind(const BlockNode& block, const Surroundings& around);
  bool check_standing(const KindRow& row, const BlockNode& block, const Surroundings& around);
  bool register_name(const KindRow& row, std::string_view name, const Place& place);
  std::optional<std::uint32_t> find_material(std::string_view name, const Place& place, const Surroundings& around);
  const BlockNode* find_later_material(std::string_view name, const Place& place) const;
  std::optional<std::uint32_t> build_inline_material(const BlockNode& block, const Surroundings& around);

  Files& files_;
  Diagnostics& diagnostics_;
  SceneDraft draft_;
  NameTable names_;
  std::vector<MaterialUse> material_uses_;
  std::vector<const Source*> open_includes_;
  std::uint64_t includes_done_ = 0;
  std::optional<std::uint32_t> last_material_;
};

}  // namespace raytracer::scene_file
