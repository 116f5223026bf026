// How many shapes a text makes at least, told before it is run: what would take too many is refused before it
// takes time and memory.
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <unordered_map>
#include <vector>

#include "scene_file/evaluator.hpp"
#include "scene_file/syntax.hpp"

namespace raytracer::scene_file {

struct Definition;

/// A definition that makes fewer shapes is built at every use: an instance costs as much as a handful of
/// shapes, and a ray pays for entering it.
inline constexpr int kLeastToShare = 16;

/// What the uses of a definition make at least. Branches, files, and loops whose ends are known only inside
/// are left out.
struct LeastMade {
  double at_first = 0;   ///< by its first use, if none of the definitions in it has been used before
  double built_out = 0;  ///< where every use inside it is built out
  /// Whether its second use is sure to build it out, to be shared from then on: it makes nothing but shapes.
  bool is_shared = true;
  std::vector<std::shared_ptr<const Definition>> uses;  ///< the definitions in it, each once
};

class LeastShapes {
 public:
  using FindDefinition = std::function<std::shared_ptr<const Definition>(NameId)>;

  /// In a text that sees these values and those definitions.
  LeastShapes(Evaluator& evaluator, const Source& source, const Visibility& visible, FindDefinition find)
      : evaluator_(evaluator), source_(source), visible_(visible), find_(std::move(find)) {}

  /// In one turn of a loop.
  double in_turn_of(const ForNode& loop);
  LeastMade of(const DefineNode& define);

 private:
  // How often a definition is used: with nothing but a place of its own, and otherwise.
  struct Uses {
    double plain = 0, other = 0;
  };

  void count(std::span<const ItemNode> items, double times, bool is_plain);
  void count(const BlockNode& block, double times, bool is_plain);
  LeastMade sum() const;
  double turns_of(const ForNode& loop);
  double number(const Expression* e);
  bool is_known(const Expression& e) const;
  bool has_only_a_place(const BlockNode& block) const;

  Evaluator& evaluator_;
  const Source& source_;
  const Visibility& visible_;
  FindDefinition find_;
  std::vector<NameId> inner_names_;
  double shapes_ = 0;
  bool makes_shapes_alone_ = true;
  std::unordered_map<std::shared_ptr<const Definition>, Uses> uses_;
};

}  // namespace raytracer::scene_file
