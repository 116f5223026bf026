#include "meshes/weld.hpp"

#include <bit>
#include <limits>
#include <utility>

#include "meshes/chunks.hpp"
#include "raytracer/error.hpp"

namespace raytracer::meshes {
namespace {

constexpr std::size_t kSpan = std::size_t{1} << 16U;
// Corners are shared out by their hash to as many tables, each of which one thread fills.
constexpr unsigned kTableBits = 6;
constexpr std::size_t kTables = std::size_t{1} << kTableBits;
constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

std::uint64_t hash(const Vector3f& p) {
  std::uint64_t h = 0x9E3779B97F4A7C15U;
  for (int i = 0; i < 3; ++i) {
    h ^= std::bit_cast<std::uint32_t>(p[i] == 0 ? 0.0f : p[i]);  // -0 equals 0
    h *= 0xBF58476D1CE4E5B9U;
    h ^= h >> 29U;
  }
  return h * 0x94D049BB133111EBU;
}

std::size_t table_of(std::uint64_t h) { return static_cast<std::size_t>(h >> (64U - kTableBits)); }

// For every corner the first that equals it.
class FirstEqual {
 public:
  explicit FirstEqual(const std::vector<Vector3f>& corners) : corners_(corners), first_(corners.size()) {
    share_out();
    for_each_chunk(kTables, [&](std::size_t table) { fill(table); });
  }
  std::vector<std::uint32_t> take() { return std::move(first_); }

 private:
  // Sorts the corners by table, stably: counts, then places.
  void share_out() {
    const std::size_t spans = (corners_.size() + kSpan - 1) / kSpan;
    std::vector<std::array<std::uint32_t, kTables>> places(spans);
    for_each_span(corners_.size(), kSpan, [&](std::size_t begin, std::size_t end) {
      std::array<std::uint32_t, kTables>& counts = places[begin / kSpan];
      for (std::size_t i = begin; i < end; ++i) ++counts[table_of(hash(corners_[i]))];
    });
    std::uint32_t place = 0;
    for (std::size_t table = 0; table < kTables; ++table) {
      begins_[table] = place;
      for (auto& counts : places) place += std::exchange(counts[table], place);
    }
    begins_[kTables] = place;
    sorted_.resize(corners_.size());
    for_each_span(corners_.size(), kSpan, [&](std::size_t begin, std::size_t end) {
      std::array<std::uint32_t, kTables>& next = places[begin / kSpan];
      for (std::size_t i = begin; i < end; ++i) {
        sorted_[next[table_of(hash(corners_[i]))]++] = static_cast<std::uint32_t>(i);
      }
    });
  }

  // A hash table with linear probing; at most half full.
  void fill(std::size_t table) {
    const std::size_t count = begins_[table + 1] - begins_[table];
    if (count == 0) return;
    const std::size_t slots = std::bit_ceil(2 * count);
    std::vector<std::uint32_t> found(slots, kNone);
    for (std::uint32_t k = begins_[table]; k < begins_[table + 1]; ++k) {
      const std::uint32_t corner = sorted_[k];
      std::size_t slot = static_cast<std::size_t>(hash(corners_[corner]) >> 8U) & (slots - 1);
      while (found[slot] != kNone && corners_[found[slot]] != corners_[corner]) {
        slot = (slot + 1) & (slots - 1);
      }
      if (found[slot] == kNone) found[slot] = corner;
      first_[corner] = found[slot];
    }
  }

  const std::vector<Vector3f>& corners_;
  std::vector<std::uint32_t> first_, sorted_;
  std::array<std::uint32_t, kTables + 1> begins_{};
};

}  // namespace

void weld(std::vector<Vector3f>& corners, MeshData& mesh) {
  if (corners.size() >= kNone) throw Error(ErrorKind::kScene, "it has more than 1,431,655,764 triangles");
  std::vector<std::uint32_t> index = FirstEqual(corners).take();
  std::size_t count = 0;
  for (std::size_t i = 0; i < index.size(); ++i) count += index[i] == i ? 1 : 0;
  mesh.positions.reserve(count);
  // The first of equal corners stands before the others: its place is known when theirs is asked for.
  for (std::size_t i = 0; i < index.size(); ++i) {
    if (index[i] == i) {
      index[i] = static_cast<std::uint32_t>(mesh.positions.size());
      mesh.positions.push_back(corners[i]);
    } else {
      index[i] = index[index[i]];
    }
  }
  corners = {};
  mesh.triangles.resize(index.size() / 3);
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    mesh.triangles[i] = {index[3 * i], index[3 * i + 1], index[3 * i + 2]};
  }
}

}  // namespace raytracer::meshes
