// Rays and vectors side by side, one array per coordinate, so that a compiler makes vector instructions of
// plain loops over them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>

#include "raytracer/vector3f.hpp"

namespace raytracer {

template <int N>
struct Vector3Lanes {
  static constexpr int kSize = N;

  alignas(4 * N) float x[N], y[N], z[N];

  Vector3f at(int i) const { return {x[i], y[i], z[i]}; }
  void set(int i, const Vector3f& v) {
    x[i] = v.x;
    y[i] = v.y;
    z[i] = v.z;
  }
  /// Sets it if it is chosen; without a branch.
  void choose(int i, bool is_chosen, const Vector3f& v) {
    x[i] = is_chosen ? v.x : x[i];
    y[i] = is_chosen ? v.y : y[i];
    z[i] = is_chosen ? v.z : z[i];
  }
};

template <int N>
struct Vector2Lanes {
  static constexpr int kSize = N;

  alignas(4 * N) float x[N], y[N];

  Vector2f at(int i) const { return {x[i], y[i]}; }
  void set(int i, const Vector2f& v) {
    x[i] = v.x;
    y[i] = v.y;
  }
};

template <int N>
struct RayLanes {
  static constexpr int kSize = N;

  alignas(4 * N) float origin_x[N], origin_y[N], origin_z[N];
  alignas(4 * N) float direction_x[N], direction_y[N], direction_z[N];
  alignas(4 * N) float t_min[N], t_max[N];

  Vector3f origin(int i) const { return {origin_x[i], origin_y[i], origin_z[i]}; }
  Vector3f direction(int i) const { return {direction_x[i], direction_y[i], direction_z[i]}; }
  Ray3f ray(int i) const { return {origin(i), direction(i), t_min[i], t_max[i]}; }
  void set(int i, const Ray3f& ray) {
    origin_x[i] = ray.origin.x;
    origin_y[i] = ray.origin.y;
    origin_z[i] = ray.origin.z;
    direction_x[i] = ray.direction.x;
    direction_y[i] = ray.direction.y;
    direction_z[i] = ray.direction.z;
    t_min[i] = ray.t_min;
    t_max[i] = ray.t_max;
  }
};

/// Copies N numbers that lie side by side.
template <int N, class T>
inline void copy_lanes(T* to, const T* from) {
  std::memcpy(to, from, N * sizeof(T));
}

/// As many as the accelerator takes at once.
inline constexpr int kBlockSize = 16;
struct RayBlock : RayLanes<kBlockSize> {};
using Vector2Block = Vector2Lanes<kBlockSize>;
using Vector3Block = Vector3Lanes<kBlockSize>;
using ColorBlock = Vector3Lanes<kBlockSize>;

/// Which lanes count: all bits of a lane's number are set, or none.
struct alignas(4 * kBlockSize) BlockMask {
  std::int32_t lane[kBlockSize];

  static BlockMask none() { return first(0); }
  static BlockMask first(std::size_t count) {
    BlockMask mask;
    for (int i = 0; i < kBlockSize; ++i) mask.set(i, i < static_cast<int>(count));
    return mask;
  }

  bool has(int i) const { return lane[i] != 0; }
  void set(int i, bool is_set) { lane[i] = -static_cast<std::int32_t>(is_set); }
  int count() const {
    std::int32_t sum = 0;
    for (const std::int32_t one : lane) sum -= one;
    return sum;
  }
  bool is_empty() const { return count() == 0; }
  /// Bit i for lane i.
  std::uint32_t bits() const {
    std::uint32_t sum = 0;
    for (int i = 0; i < kBlockSize; ++i) sum |= static_cast<std::uint32_t>(lane[i]) & (1U << i);
    return sum;
  }
};

/// How many blocks hold that many lanes.
constexpr std::size_t blocks_for(std::size_t lanes) { return (lanes + kBlockSize - 1) / kBlockSize; }

}  // namespace raytracer
