#include "lights/light_tree.hpp"

#include <algorithm>
#include <cmath>

#include "core/numeric.hpp"
#include "core/parallel.hpp"

namespace raytracer {

namespace {

/// Below this share of the strongest item's strength an item counts as if it had that much: what else shines
/// may be out of sight, and numbers stay in the range of float.
constexpr float kLeastShare = 1e-12F;
/// By how much balls and cones are wider than what they hold, relative and in cosines: much more than any
/// rounding, so that nothing is ruled out that can contribute.
constexpr float kWider = 1 + 1e-4F;
constexpr float kCosineSlack = 1e-3F;

double total(const std::array<double, 3>& strength) { return strength[0] + strength[1] + strength[2]; }

/// Cosine of max(0, a - b); all angles from 0 to pi.
float cos_of_difference(float sin_a, float cos_a, float sin_b, float cos_b) {
  return cos_a > cos_b ? 1 : cos_a * cos_b + sin_a * sin_b;
}
float sin_of_difference(float sin_a, float cos_a, float sin_b, float cos_b) {
  return cos_a > cos_b ? 0 : sin_a * cos_b - cos_a * sin_b;
}
float other_of(float cosine) { return std::sqrt(std::max(1 - cosine * cosine, 0.0F)); }

/// How much a light seen under this cosine of its axis may send; the light may be anywhere within the angle u
/// around its middle.
float shine(const LightCone& cone, float sin_spread, float cos_axis, float sin_u, float cos_u) {
  const float sin_axis = other_of(cos_axis);
  const float cosine = cos_of_difference(sin_axis, cos_axis, sin_spread, cone.cos_spread);
  const float sine = sin_of_difference(sin_axis, cos_axis, sin_spread, cone.cos_spread);
  const float least = cos_of_difference(sine, cosine, sin_u, cos_u);  // cosine of the least angle possible
  if (!(least > cone.cos_reach - kCosineSlack)) return 0;
  // What shines to all sides has no cosine, and what shines far around is not known by one.
  constexpr float kFarAround = 0.1F;
  return std::max(least, cone.cos_reach < 0 ? kFarAround : 0.0F) + kCosineSlack;
}

}  // namespace

LightCone LightCone::around(const LightCone& a, const LightCone& b) {
  LightCone all;
  all.cos_reach = std::min(a.cos_reach, b.cos_reach);
  all.back = std::max(a.back, b.back);
  if (a.cos_spread <= -1 || b.cos_spread <= -1) return all;
  Vector3d first(a.axis), second(b.axis);
  // What shines to both sides has no direction, only a line.
  if (a.back > 0 && b.back > 0 && glm::dot(first, second) < 0) second = -second;
  const double spread_a = std::acos(std::clamp(static_cast<double>(a.cos_spread), -1.0, 1.0));
  const double spread_b = std::acos(std::clamp(static_cast<double>(b.cos_spread), -1.0, 1.0));
  const double between = std::acos(std::clamp(glm::dot(first, second), -1.0, 1.0));
  const auto same = [&](const LightCone& wider) {
    all.axis = wider.axis;
    all.cos_spread = wider.cos_spread;
    return all;
  };
  if (std::min(between + spread_b, kPi) <= spread_a) return same(a);
  if (std::min(between + spread_a, kPi) <= spread_b) return same(b);
  constexpr double kSpare = 1e-4;
  const double spread = 0.5 * (spread_a + between + spread_b) + kSpare;
  const Vector3d across = second - glm::dot(first, second) * first;
  const double length = glm::length(across);
  if (spread >= kPi || !(length > 0)) return all;
  const double turn = spread - spread_a;
  all.axis = Vector3f(glm::normalize(std::cos(turn) * first + std::sin(turn) / length * across));
  all.cos_spread = static_cast<float>(std::cos(spread));
  return all;
}

// --- building
// ------------------------------------------------------------------------------------------------

/// Splits where the sum over both halves of strength x surface of the bounds x spread of the axes is least
/// (the surface area orientation heuristic of Conty Estevez and Kulla, with the spread estimated by the
/// length of the mean axis), tried at the borders of a few bins along each axis.
class LightTree::Builder {
 public:
  Builder(LightTree& tree, const std::vector<LightItem>& items) : tree_(tree), items_(items) {
    double strongest = 0;
    for (const LightItem& item : items) strongest = std::max(strongest, total(item.strength));
    tree_.trails_.assign(items.size(), 0);
    tree_.is_in_tree_.assign(items.size(), false);
    entries_.reserve(items.size());
    for (std::uint32_t i = 0; i < items.size(); ++i) {
      const LightItem& item = items[i];
      if (!(total(item.strength) > 0) || item.bounds.is_empty() || !item.bounds.is_finite()) continue;
      Entry entry{
          i, item.bounds, item.cone.cos_spread > -1 ? item.cone.axis : Vector3f(0), {}, item.cone.back > 0};
      for (std::size_t k = 0; k < 3; ++k) {
        const double share = item.strength[k] / strongest;
        entry.strength[k] = share > 0 ? std::max(static_cast<float>(share), kLeastShare) : 0.0F;
      }
      tree_.is_in_tree_[i] = true;
      entries_.push_back(entry);
    }
    if (entries_.empty()) return;
    tree_.nodes_.resize(2 * entries_.size());  // the second stays unused: pairs begin at even places
    build(0, 2, {0, static_cast<std::uint32_t>(entries_.size())}, 0, 0);
  }

 private:
  struct Entry {
    std::uint32_t item;
    Box3f bounds;
    Vector3f axis;  // 0: all directions
    std::array<float, 3> strength;
    bool is_two_sided;

    float center(int i) const { return 0.5F * bounds.lower[i] + 0.5F * bounds.upper[i]; }
    float weight() const { return strength[0] + strength[1] + strength[2]; }
  };

  struct Heap {  // what a half would be
    Box3f bounds;
    Vector3f axes{0};
    float weight = 0;

    void add(const Heap& other) {
      bounds.extend(other.bounds);
      axes += other.axes;
      weight += other.weight;
    }
    float cost() const {
      if (!(weight > 0)) return 0;
      const Vector3f d = bounds.diagonal();
      // 1 for one direction; 4, the whole sphere to the half, for all.
      const float spread = 1 + 3 * (1 - std::min(glm::length(axes) / weight, 1.0F));
      return weight * spread * (d.x * d.y + d.y * d.z + d.z * d.x + 1e-3F * glm::dot(d, d));
    }
  };

  struct Range {
    std::uint32_t begin, end;  // of entries_
    std::uint32_t size() const { return end - begin; }
  };

  /// Builds the node at `index`; all below it stands from `first` on, which for n items takes 2 n - 2 places
  /// whatever the splits: so the two halves can be built at the same time.
  Box3f build(std::uint32_t index, std::uint32_t first, const Range& range, int depth, std::uint64_t trail) {
    if (range.size() == 1) return make_leaf(index, entries_[range.begin], trail);
    const std::uint32_t middle = split(range.begin, range.end, depth);
    const std::array<Range, 2> halves = {Range{range.begin, middle}, Range{middle, range.end}};
    const std::array<std::uint32_t, 2> places = {first + 2, first + 2 * halves[0].size()};
    std::array<Box3f, 2> bounds;
    const auto build_half = [&](std::size_t k) {
      bounds[k] = build(first + static_cast<std::uint32_t>(k), places[k], halves[k], depth + 1,
                        trail | static_cast<std::uint64_t>(k) << depth);
    };
    constexpr std::uint32_t kMany = 8192;
    if (range.size() > kMany) {
      parallel_for(2, build_half);
    } else {
      build_half(0);
      build_half(1);
    }
    Node& node = tree_.nodes_[index];
    const Node &a = tree_.nodes_[first], &b = tree_.nodes_[first + 1];
    node.cone = LightCone::around(a.cone, b.cone);
    for (std::size_t k = 0; k < 3; ++k) node.strength[k] = a.strength[k] + b.strength[k];
    node.link = first;
    bounds[0].extend(bounds[1]);
    finish(node, bounds[0]);
    return bounds[0];
  }

  Box3f make_leaf(std::uint32_t index, const Entry& entry, std::uint64_t trail) {
    Node& node = tree_.nodes_[index];
    node.cone = items_[entry.item].cone;
    node.strength = entry.strength;
    node.link = entry.item | Node::kLeaf;
    finish(node, entry.bounds);
    tree_.trails_[entry.item] = trail;
    return entry.bounds;
  }

  static void finish(Node& node, const Box3f& bounds) {
    node.center = bounds.center();
    node.radius = 0.5F * kWider * glm::length(bounds.diagonal());
    node.sin_spread = other_of(node.cone.cos_spread);
  }

  std::uint32_t split(std::uint32_t begin, std::uint32_t end, int depth) {
    // So deep only where strengths or places differ by many orders of magnitude; halves end it in time for
    // the 64 bits of a trail.
    constexpr int kDeep = 30;
    constexpr std::uint32_t kFew = 4;
    Box3f centers;
    for (std::uint32_t i = begin; i < end; ++i) centers.extend(entries_[i].bounds.center());
    if (end - begin > kFew && depth < kDeep) {
      const std::uint32_t middle = split_by_cost(begin, end, centers);
      if (middle > begin && middle < end) return middle;
    }
    const Vector3f d = centers.diagonal();
    const int axis = d.x > d.y ? (d.x > d.z ? 0 : 2) : (d.y > d.z ? 1 : 2);
    const std::uint32_t middle = begin + (end - begin) / 2;
    std::nth_element(entries_.begin() + begin, entries_.begin() + middle, entries_.begin() + end,
                     [axis](const Entry& a, const Entry& b) {
                       const float at_a = a.center(axis), at_b = b.center(axis);
                       return at_a != at_b ? at_a < at_b : a.item < b.item;
                     });
    return middle;
  }

  static constexpr int kBins = 12;

  static int bin_of(const Entry& entry, const Box3f& centers, int axis) {
    const float width = centers.upper[axis] - centers.lower[axis];
    const float place = (entry.center(axis) - centers.lower[axis]) / width * kBins;
    return std::clamp(static_cast<int>(place), 0, kBins - 1);
  }

  /// begin where no border of bins separates anything.
  std::uint32_t split_by_cost(std::uint32_t begin, std::uint32_t end, const Box3f& centers) {
    const Vector3f width = centers.diagonal();
    const float widest = std::max({width.x, width.y, width.z});
    float best = kInfinity;
    int best_axis = -1, best_bin = 0;
    const Vector3f up = entries_[begin].axis;  // both sides of a sheet count as one direction
    for (int axis = 0; axis < 3; ++axis) {
      if (!(width[axis] > 1e-3F * widest)) continue;
      std::array<Heap, kBins> bins;
      for (std::uint32_t i = begin; i < end; ++i) {
        const Entry& entry = entries_[i];
        Heap& bin = bins[static_cast<std::size_t>(bin_of(entry, centers, axis))];
        bin.bounds.extend(entry.bounds);
        const bool is_flipped = entry.is_two_sided && glm::dot(entry.axis, up) < 0;
        bin.axes += (is_flipped ? -entry.weight() : entry.weight()) * entry.axis;
        bin.weight += entry.weight();
      }
      std::array<float, kBins> cost_above{}, weight_above{};
      Heap heap;
      for (int k = kBins - 1; k > 0; --k) {
        heap.add(bins[static_cast<std::size_t>(k)]);
        cost_above[static_cast<std::size_t>(k)] = heap.cost();
        weight_above[static_cast<std::size_t>(k)] = heap.weight;
      }
      heap = {};
      for (int k = 1; k < kBins; ++k) {
        heap.add(bins[static_cast<std::size_t>(k - 1)]);
        const float above = cost_above[static_cast<std::size_t>(k)];
        // Thin slices are worse than they look: stretched by how much shorter this axis is.
        const float cost = (heap.cost() + above) * (widest / width[axis]);
        if (heap.weight > 0 && weight_above[static_cast<std::size_t>(k)] > 0 && cost < best) {
          best = cost;
          best_axis = axis;
          best_bin = k;
        }
      }
    }
    if (best_axis < 0) return begin;
    const auto middle = std::partition(entries_.begin() + begin, entries_.begin() + end, [&](const Entry& e) {
      return bin_of(e, centers, best_axis) < best_bin;
    });
    return static_cast<std::uint32_t>(middle - entries_.begin());
  }

  LightTree& tree_;
  const std::vector<LightItem>& items_;
  std::vector<Entry> entries_;
};

LightTree::LightTree(const std::vector<LightItem>& items) { Builder(*this, items); }

// --- choosing
// ------------------------------------------------------------------------------------------------

/// An upper estimate of the light that the node may send to the point: strength over distance squared, times
/// the cosines of the least angles possible on both sides. 0 only where nothing can arrive.
double LightTree::importance(const Node& node, const Vector3f& position, const Vector3f& normal) {
  const Vector3f way = node.center - position;
  const float distance = glm::length(way);
  float factor = 1;
  if (distance > node.radius) {
    const Vector3f direction = way / distance;
    const float sin_u = node.radius / distance, cos_u = other_of(sin_u);
    if (normal != Vector3f(0)) {
      const float facing = std::clamp(glm::dot(normal, direction), -1.0F, 1.0F);
      factor = cos_of_difference(other_of(facing), facing, sin_u, cos_u) + 1e-5F;
      if (!(factor > 0)) return 0;
    }
    if (node.cone.cos_spread > -1) {
      const float cos_axis = std::clamp(-glm::dot(node.cone.axis, direction), -1.0F, 1.0F);
      float sent = shine(node.cone, node.sin_spread, cos_axis, sin_u, cos_u);
      if (node.cone.back > 0) {
        sent = std::max(sent, node.cone.back * shine(node.cone, node.sin_spread, -cos_axis, sin_u, cos_u));
      }
      factor *= sent;
    }
  }
  const auto d = static_cast<double>(std::max(distance, node.radius));
  const double fading =
      d > 0 ? static_cast<double>(node.strength[1]) / d + static_cast<double>(node.strength[2]) / (d * d)
            : static_cast<double>(node.strength[1] + node.strength[2]);
  return static_cast<double>(factor) * (static_cast<double>(node.strength[0]) + fading);
}

bool LightTree::choose(const Vector3f& position, const Vector3f& normal, double& u, std::uint32_t& item,
                       double& probability) const {
  if (nodes_.empty()) return false;
  probability = 1;
  const Node* node = nodes_.data();
  while (!node->is_leaf()) {
    const Node* children = nodes_.data() + node->link;
    const double a = importance(children[0], position, normal);
    const double b = importance(children[1], position, normal);
    if (!(a + b > 0)) return false;
    const double share = a / (a + b);
    const bool is_first = u < share;
    const double width = is_first ? share : 1 - share;
    constexpr double kBelowOne = 1 - 0x1p-53;
    u = std::min((is_first ? u : u - share) / width, kBelowOne);
    probability *= width;
    node = is_first ? children : children + 1;
  }
  item = node->link & ~Node::kLeaf;
  return true;
}

double LightTree::probability(const Vector3f& position, const Vector3f& normal, std::uint32_t item) const {
  if (!is_in_tree_[item]) return 0;
  double probability = 1;
  std::uint64_t trail = trails_[item];
  for (const Node* node = nodes_.data(); !node->is_leaf(); trail >>= 1) {
    const Node* children = nodes_.data() + node->link;
    const double a = importance(children[0], position, normal);
    const double b = importance(children[1], position, normal);
    if (!(a + b > 0)) return 0;
    const double share = a / (a + b);
    probability *= (trail & 1) != 0 ? 1 - share : share;
    node = (trail & 1) != 0 ? children + 1 : children;
  }
  return probability;
}

}  // namespace raytracer
