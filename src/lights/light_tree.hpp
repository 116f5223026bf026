// Which of many lights to look at from a point.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "raytracer/vector3f.hpp"

namespace raytracer {

/// The directions in which something shines: within `spread` of the axis lie the normals (or axes) of all of
/// it, and each of them shines up to `reach` away from itself.
struct LightCone {
  Vector3f axis{0, 1, 0};  ///< unit length
  float cos_spread = -1;   ///< -1: all directions
  float cos_reach = 0;     ///< 0 for surfaces
  /// How the side away from the axis counts: 0 for what shines to one side only, 1 for both alike. In between
  /// where that side is there but is likely hidden: of closed bodies.
  float back = 0;

  /// The smallest cone around both.
  static LightCone around(const LightCone& a, const LightCone& b);
};

/// What a tree must know of a light.
struct LightItem {
  Box3f bounds;
  LightCone cone;
  /// How strong it is at the distance 1, of the part that does not fade with the distance, that fades by 1/d
  /// and by 1/d^2; in any unit, only ratios count. Nothing at all: the item is never chosen.
  std::array<double, 3> strength{0, 0, 0};
};

/// Chooses one of its items by what each may contribute at a point: a binary tree whose nodes bound position,
/// orientation and strength, walked down by chance. A. Conty Estevez, C. Kulla, "Importance Sampling of Many
/// Lights with Adaptive Tree Splitting", PACMCGIT 1(2), 2018; one item per leaf, without splitting; the
/// cosines of differences of angles after pbrt-v4, section 12.6.3. Immutable.
class LightTree {
 public:
  LightTree() = default;
  explicit LightTree(const std::vector<LightItem>& items);

  bool is_empty() const { return nodes_.empty(); }
  const LightCone& cone() const { return nodes_.front().cone; }  ///< of all items; there must be one

  /// Chooses an item for a surface at `position` with the unit normal `normal`, on whose side alone light
  /// counts; 0: any light counts. `u` in [0, 1) is made a new number of that kind out of the digits that are
  /// left over. False where no item can contribute.
  bool choose(const Vector3f& position, const Vector3f& normal, double& u, std::uint32_t& item,
              double& probability) const;
  /// The probability with which choose() takes this item. Greater than 0 wherever it can contribute.
  double probability(const Vector3f& position, const Vector3f& normal, std::uint32_t item) const;

 private:
  /// A cache line each; the two children of a node stand side by side.
  struct alignas(64) Node {
    Vector3f center{0};  // of a ball around it all
    float radius = 0;
    LightCone cone;
    float sin_spread = 0;
    std::array<float, 3> strength{0, 0, 0};  // as LightItem, in units of the strongest item
    std::uint32_t link = 0;                  // of a leaf its item, else its first child

    static constexpr std::uint32_t kLeaf = 0x80000000;  // marks the link of a leaf
    bool is_leaf() const { return (link & kLeaf) != 0; }
  };
  class Builder;

  static double importance(const Node& node, const Vector3f& position, const Vector3f& normal);

  std::vector<Node> nodes_;            // the root first
  std::vector<std::uint64_t> trails_;  // per item, bit k: the child taken on floor k of the way down
  std::vector<bool> is_in_tree_;       // per item
};

}  // namespace raytracer
