// From nodes to a scene: runs the statements in order, checks every block's properties against the rows of
// its kind, and hands sound blocks to the row's build function.
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <string>
#include <unordered_map>
#include <vector>

#include "raytracer/error.hpp"
#include "scene_file/diagnostics.hpp"
#include "scene_file/draft.hpp"
#include "scene_file/evaluator.hpp"
#include "scene_file/files.hpp"
#include "scene_file/least_shapes.hpp"
#include "scene_file/limits.hpp"
#include "scene_file/mesh_store.hpp"
#include "scene_file/scene_hash.hpp"
#include "scene_file/scene_recorder.hpp"
#include "scene_file/schema.hpp"
#include "scene_file/shape_store.hpp"
#include "scene_file/syntax.hpp"
#include "textures/texel_pyramid.hpp"

namespace raytracer::scene_file {

/// Blocks, loops, uses … inside each other, at most, all counted.
inline constexpr std::size_t kDeepestStatements = 4000;

class Builder;
struct Definition;

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
  Place place;   ///< name and values
  Place values;  ///< the values alone
};

/// What a piece of text sees of each stack of names.
struct Frame {
  Visibility values, definitions, materials;
};

/// Where the names of blocks were first given; they are unique within their kind.
using NameTable = std::unordered_map<std::string, Place>;

/// What a statement takes over from the text around it.
struct Surroundings {
  const Source* source = nullptr;
  std::string_view kind;  ///< of the block around; empty at the top
  Transform to_world;
  std::uint32_t material = 0;
  const Frame* frame = nullptr;
  NameTable* names = nullptr;
  bool is_top = false;              ///< at the top of the scene, outside of all braces
  std::size_t let_base = 0;         ///< bindings from here on belong to this block
  std::size_t definition_base = 0;  ///< likewise definitions
  std::size_t material_base = 0;    ///< likewise materials, to this turn of a loop or use of a definition
  bool depends_on_time = false;     ///< whether any of it does
  bool is_unclosed = false;  ///< the block around lacks its '}': what stands in it may belong elsewhere
};

/// A texture of the scene.
struct BuiltTexture {
  TexturePointer texture;
  bool depends_on_time = false;
  std::string json;  ///< as the recorder writes it; empty unless it listens
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
  /// Likewise, at the values of a property that was given.
  void value_error(std::string_view property, std::string message, std::string suggestion = {});
  /// Likewise, at a part of the block's text.
  void error_at(Span span, std::string message, std::string suggestion = {});
  void warning(std::string_view property, std::string message, std::string suggestion = {});
  /// Of a property, or of the block's header where the property was not given.
  Place place_of(std::string_view property) const;
  /// How the scene's light is computed, which decides what display colours mean.
  Method method() const;

  /// From the block's own space to the world; `spot` is its own middle.
  Transform placed(const Vector3d& spot) const { return around_.to_world * placing_.about(spot); }

  /// Likewise, whatever stands around it: textures lie in the world.
  Transform own_placing() const { return placing_.about(Vector3d(0)); }

  /// Adds what `make()` returns with the block's material; an Error it throws becomes a message at the block.
  template <class Make>
  void add_shape(const Make& make) {
    try {
      add_shape(make());
    } catch (const Error& problem) {
      report_bad_shape(problem.what());
    }
  }
  void add_light(const Light& light);
  /// What add_shape() makes from here on is made of it, whatever the block says.
  void use_material(std::uint32_t index) { material_ = index; }
  /// Adds the mesh in a file that `property` names.
  void add_mesh_file(std::string_view property, const std::string& file, MeshOptions options);
  void build_children();
  std::uint32_t add_material(const Material& material);

  /// The block is a texture: this one.
  void set_texture(TexturePointer texture);
  /// What the values of the picture in the file mean where this block stands.
  TextureMeaning texture_meaning() const;
  /// The picture in a file that the block names, made ready for a use. Null where it can't be had, which has
  /// then been reported at `property`.
  std::shared_ptr<const TexelPyramid> pyramid(std::string_view property, const std::string& file,
                                              const TexelUse& use);
  /// Likewise as the file has it.
  std::shared_ptr<const Picture> picture(std::string_view property, const std::string& file);

 private:
  friend class Builder;
  friend bool fill(BlockContext& context, void* input);

  const Given* given(std::string_view property) const;
  bool depends_on_time() const { return around_.depends_on_time || depends_on_time_; }
  void add_shape(std::unique_ptr<Shape> shape);
  void warn_of_solid_sheet(const Material& material);
  void report_bad_shape(std::string_view problem);
  bool fill_items(void* input);
  bool fill_item(const PropertyNode& property, void* input);
  bool fill_block(const BlockNode& block, void* input);
  bool misses_texture(const PropertyRow& row, const PropertyNode& property);
  void report_no_texture(const PropertyRow& row, Span span);
  bool report_bad_texture(const PropertyRow& row, const PropertyNode& property);
  /// Nothing where the property has no texture but a value like any other.
  std::optional<bool> fill_texture_item(const PropertyRow& row, const PropertyNode& property, void* input);
  bool fill_texture_block(const PropertyRow& row, const BlockNode& block, void* input);
  bool fill_texture_file(const PropertyRow& row, const PropertyNode& property, void* input);
  bool fill_expression(const PropertyRow& row, const PropertyNode& property, void* input);
  const Expression* expression_at_point(const PropertyNode& property);
  bool store_texture(const PropertyRow& row, const BuiltTexture& texture, void* input);
  const KindRow* texture_named(const PropertyNode& property);
  const KindRow* find_texture_row(Span word);
  template <class Read>
  auto read_picture_file(std::string_view property, const std::string& file, const Read& read)
      -> decltype(read(file));
  void note_material();
  bool check_required();
  bool accept(const PropertyRow& row, const Place& place, const Place& values);
  bool apply_placing(const PropertyRow& row, const Argument& argument, const Place& place);
  void store(const PropertyRow& row, const Argument& argument, void* input);
  void report_unknown_property(Span name);
  void cut_items();
  void report_statement(const ItemNode& item);
  Place place(Span span) const { return {around_.source, span}; }

  Builder& builder_;
  const KindRow& row_;
  const BlockNode& node_;
  const Surroundings& around_;
  std::string_view name_;
  PlacingWords placing_;
  std::optional<std::uint32_t> material_;
  bool depends_on_time_ = false;
  std::size_t let_base_ = 0;
  std::vector<Given> given_;
  std::span<const ItemNode> items_;           // of the node, as they are meant
  std::vector<Value>* parameters_ = nullptr;  // of a use of a definition
};

/// `define`, with what its body sees.
struct Definition {
  const DefineNode* node = nullptr;
  const Source* source = nullptr;
  std::string name;
  KindRow row;  ///< its parameters as properties, so that a use is checked like a built-in block
  std::vector<PropertyRow> parameters;
  std::vector<Value> defaults;
  bool is_top = false;  ///< defined at the top of the scene, where all moments find the same
  Frame frame;          ///< around it
  std::array<std::size_t, 3>
      heights{};  ///< of the stacks of values, definitions and materials where it stands
  LeastMade least;
};

class Builder {
 public:
  /// `kept` holds what earlier moments of the same scene have built, and gets what this one builds for later
  /// ones.
  Builder(Files& files, const Limits& limits, const Moment& moment, KeptShapes& kept,
          Diagnostics& diagnostics);

  /// Top-level lets that the caller replaces: by name, as values.
  /// A string keeps the text as it was given, whatever else it could be read as.
  void replace_let(NameId name, const Value& value, std::string_view text) {
    replaced_lets_[name] = {value, text};
  }

  /// Display colours become linear in `path`. By default the method is `classic`.
  void set_method(Method method) { method_ = method; }

  /// The hasher is told what the scene says; it outlives build().
  void hash_into(SceneHasher& hasher) { hasher_ = &hasher; }
  /// Likewise the recorder.
  void record_into(SceneRecorder& recorder) { recorder_ = &recorder; }

  /// Evaluates a whole scene.
  void build(const SyntaxTree& tree);

  /// Moves the shapes that were made into the draft's scene.
  void store_shapes() { store_.move_into(draft_.scene, evaluator_.uses_time()); }

  SceneDraft& draft() { return draft_; }
  std::uint64_t shapes_made() const { return shapes_made_ - lights_made_; }
  Diagnostics& diagnostics() { return diagnostics_; }
  Evaluator& evaluator() { return evaluator_; }
  /// About materials, lets and definitions of `main` that nothing uses.
  void warn_of_unused_names(const SyntaxTree& main);
  /// Top-level lets in the order in which they were met.
  struct TopLevelLet {
    std::string name;
    Value value;
    bool is_replaced = false;
  };
  const std::vector<TopLevelLet>& top_level_lets() const { return top_level_lets_; }

 private:
  friend class BlockContext;
  friend bool fill(BlockContext& context, void* input);

  /// Null where nobody asked, and while a body is built once more to be stored: its first use has said all of
  /// it.
  SceneHasher* hasher() { return store_.is_recording() ? nullptr : hasher_; }

  SceneRecorder* recorder() {
    const bool is_listening = recorder_ != nullptr && recorder_->is_listening() && !store_.is_recording();
    return is_listening ? recorder_ : nullptr;
  }

  struct Replacement {
    Value value;
    std::string_view text;
  };
  struct MaterialUse {
    Place place;  // of the name; no source for unnamed ones
    bool used = false;
    bool depends_on_time = false;
    NameId name = 0;
  };

  void build_items(std::span<const ItemNode> items, const Surroundings& around);
  void try_unused_definitions(const Surroundings& top);
  void build_item(const ItemNode& item, const Surroundings& around);
  void build_stray_property(const PropertyNode& property, const Surroundings& around);
  void build_block(const BlockNode& block, const Surroundings& around);
  void build_material(const KindRow& row, const BlockNode& block, std::string_view name,
                      const Surroundings& around);
  void build_include(const IncludeNode& include, const Surroundings& around);
  void build_let(const LetNode& let, const Surroundings& around, std::size_t let_base, bool is_top);
  void build_for(const ForNode& loop, const Surroundings& around);
  Value replaced(const Replacement& replacement, const Value& original, const Place& place) const;
  void build_if(const IfNode& choice, const Surroundings& around);
  void build_define(const DefineNode& define, const Surroundings& around);
  void build_use(const std::shared_ptr<const Definition>& definition, const BlockNode& block,
                 const Surroundings& around);
  void build_body(const Definition& definition, const std::vector<Value>& arguments, Surroundings inside,
                  const Place& used_at);
  std::shared_ptr<const SharedShapes> share_body(const Definition& definition,
                                                 const std::vector<Value>& arguments, Surroundings inside,
                                                 const std::string& key, const Place& used_at);
  Value parameter_default(const ParameterNode& parameter, const Surroundings& around);
  LeastShapes least_shapes(const Surroundings& around);
  bool is_fresh(const Definition& definition) const;
  std::shared_ptr<const Definition> find_definition(NameId name, const Surroundings& around) const;

  const KindRow* resolve_kind(const BlockNode& block, const Surroundings& around, std::string_view& name);
  void report_unknown_kind(const BlockNode& block, const Surroundings& around);
  void report_unknown_variant(const BlockNode& block, const Surroundings& around);
  bool check_standing(const KindRow& row, const BlockNode& block, const Surroundings& around);
  bool register_name(const KindRow& row, std::string_view name, const Place& place,
                     const Surroundings& around);
  std::optional<std::uint32_t> find_material(std::string_view name, const Place& place,
                                             const Surroundings& around);
  TextureMeaning color_meaning() const;
  std::optional<BuiltTexture> build_texture(const KindRow& row, const BlockNode& block, std::string_view name,
                                            const Surroundings& around);
  void build_named_texture(const KindRow& row, const BlockNode& block, std::string_view name,
                           const Surroundings& around);
  const BuiltTexture* find_texture(std::string_view name, const Surroundings& around);
  std::optional<std::uint32_t> find_library_material(std::string_view name);
  const BlockNode* find_later_material(std::string_view name, const Place& place) const;
  std::optional<std::uint32_t> build_inline_material(const BlockNode& block, const Surroundings& around,
                                                     std::string_view name = {});

  /// Takes the work; reports once and stops all evaluation when there was too much of it.
  bool spend(std::uint64_t steps, const Place& place);
  void halt(const Place& place, std::string message, std::string suggestion = {});
  void note_shape(const Place& place);
  bool has_room_for(double shapes, const Place& place);

  Files& files_;
  Limits limits_;
  Diagnostics& diagnostics_;
  Budget budget_;
  Evaluator evaluator_;
  Bindings<std::shared_ptr<const Definition>> definitions_;
  Bindings<std::uint32_t> materials_;
  SceneDraft draft_;
  SceneHasher* hasher_ = nullptr;
  SceneRecorder* recorder_ = nullptr;
  Method method_ = Method::kClassic;
  ShapeStore store_;
  MeshStore meshes_;
  bool is_trying_ = false;  // a definition that nothing uses
  UseCounter uses_;
  std::vector<MaterialUse> material_uses_;
  std::unordered_map<NameId, Replacement> replaced_lets_;
  std::vector<TopLevelLet> top_level_lets_;
  std::unordered_map<const SyntaxTree*, int> bad_includes_;      // turns in which a file had mistakes
  std::unordered_map<const IncludeNode*, int> failed_includes_;  // turns in which there was no file to read
  NameTable setting_names_;                                      // a loop makes no second camera
  std::vector<std::shared_ptr<const Definition>> top_definitions_;
  std::unordered_map<const DefineNode*, bool> used_definitions_;
  std::size_t depth_ = 0;  // of statements in statements, all kinds counted
  std::size_t include_depth_ = 0, use_depth_ = 0;
  std::uint64_t shapes_made_ = 0, lights_made_ = 0;
  std::uint64_t built_out_ = 0;  // shapes made, were there no instances
  bool halted_ = false;
  std::optional<std::uint32_t> last_material_;
  TexturePointer last_texture_;
  std::vector<BuiltTexture> named_textures_;  // their names are among the materials': "texture oak"
  bool texture_is_opacity_ = false;
  TextureMeaning texture_meaning_ = TextureMeaning::kDisplay;

  // Materials of the library that the scene has named.
  struct LibraryText {
    std::unique_ptr<Source> source;
    std::unique_ptr<SyntaxTree> tree;
    std::optional<std::uint32_t> material;
    bool is_told = false;       // to the recorder
    std::uint32_t told_as = 0;  // its number there
  };
  std::unordered_map<std::string, LibraryText> library_;
};

}  // namespace raytracer::scene_file
