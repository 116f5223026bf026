// What an evaluated scene says, written down as a scene in JSON: loops unrolled, computed values as numbers,
// definitions and their uses as they are.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "scene_file/schema.hpp"
#include "scene_file/value.hpp"

namespace raytracer::scene_file {

/// Told by the builder of every block, every property and every definition, in the order of evaluation. A
/// definition with parameters becomes one definition without for each set of arguments. Names that are local
/// to a turn of a loop, or to a use, get a number where they would collide.
class SceneRecorder {
 public:
  /// A block, while it is being built.
  class Block {
   public:
    /// `recorder` may be null: nobody wants to know.
    Block(SceneRecorder* recorder, const KindRow& kind, std::string_view name) : recorder_(recorder) {
      if (recorder_ != nullptr) recorder_->begin_block(kind, name);
    }
    ~Block() {
      if (recorder_ != nullptr) recorder_->end_block();
    }
    Block(const Block&) = delete;
    Block& operator=(const Block&) = delete;

   private:
    SceneRecorder* recorder_;
  };

  /// The body of a definition, while it is run: written down once for each set of arguments.
  class Body {
   public:
    Body(SceneRecorder* recorder, const void* definition, const std::vector<Value>& arguments)
        : recorder_(recorder) {
      if (recorder_ != nullptr) recorder_->begin_body(definition, arguments);
    }
    ~Body() {
      if (recorder_ != nullptr) recorder_->end_body();
    }
    Body(const Body&) = delete;
    Body& operator=(const Body&) = delete;

   private:
    SceneRecorder* recorder_;
  };

  /// While one lives, blocks go in front of the whole scene, whatever is open.
  class InFront {
   public:
    explicit InFront(SceneRecorder* recorder) : recorder_(recorder) {
      if (recorder_ != nullptr) recorder_->open_.emplace_back();
    }
    ~InFront() {
      if (recorder_ != nullptr) recorder_->end_in_front();
    }
    InFront(const InFront&) = delete;
    InFront& operator=(const InFront&) = delete;

   private:
    SceneRecorder* recorder_;
  };

  /// Names of files are written as seen from this folder; empty: from the scene's own.
  explicit SceneRecorder(std::string folder = {}) : folder_(std::move(folder)) {}
  const std::string& folder() const { return folder_; }

  /// False inside of a body that has been written down; nothing may be told then.
  bool is_listening() const { return !muted_; }
  /// A property of the innermost block.
  void add(const PropertyRow& property, const Argument& argument);
  /// A property of the innermost block whose value is a texture, as take_texture() gave it.
  void add(const PropertyRow& property, std::string_view texture);
  /// The texture whose block has just ended.
  std::string take_texture() { return std::move(texture_); }
  /// The innermost block refers to a material with a name.
  void use_material(std::uint32_t index);
  /// The innermost block is a material with a name, which the scene knows by this number.
  void name_material(std::uint32_t index);
  /// Here stands a definition; `definition` tells it from all others.
  void define(const void* definition, std::string_view name);
  /// The innermost block is a use of this definition.
  void use(const void* definition, const std::vector<Value>& arguments);

  /// The whole scene.
  std::string text() const;

 private:
  // One block or definition as text, with what stands inside it.
  struct Node {
    std::string kind, name;
    std::string properties;  ///< `, "center": [0, 1, 0]`
    std::string transforms;  ///< `, {"rotate": [0, 30, 0]}`
    std::vector<Node> children;
    std::shared_ptr<std::vector<Node>>
        definitions;          ///< where a definition stands: one for each set of arguments
    bool is_value = false;    ///< a material in place, the value of a property
    bool is_texture = false;  ///< likewise
  };
  struct Definition {
    std::string name;
    std::shared_ptr<std::vector<Node>> place;
    std::unordered_map<std::string, std::string> names;  ///< by the arguments
    std::unordered_set<std::string> begun;               ///< the names of those whose body has been begun
  };

  void begin_block(const KindRow& kind, std::string_view name);
  void end_block();
  void end_in_front();
  void begin_body(const void* definition, const std::vector<Value>& arguments);
  void end_body();
  const std::string& name_of(const void* definition, const std::vector<Value>& arguments);
  std::string unique(std::string_view kind, std::string_view name);
  static std::string line_of(const Node& node);
  static std::string transforms_text(const Node& node);
  static void append(std::span<const Node> nodes, std::size_t level, bool& is_first, std::string& out);

  std::string folder_;
  std::vector<Node> front_;                                 // what stands in front of the scene
  std::vector<Node> open_{Node{}};                          // from the scene to the innermost block
  std::vector<std::shared_ptr<std::vector<Node>>> bodies_;  // where the open bodies go
  std::unordered_map<const void*, Definition> definitions_;
  std::unordered_map<std::uint32_t, std::string> materials_;
  std::unordered_map<std::string, std::size_t> numbers_;  // the last ones given to names
  std::unordered_set<std::string> taken_;
  std::string texture_;
  bool muted_ = false;
};

}  // namespace raytracer::scene_file
