#include "limit_trace.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/parallel.hpp"
#include "sampling/sobol.hpp"

namespace raytracer::limit {
namespace {

constexpr int kTile = 32, kEdge = 4, kPacket = kEdge * kEdge;

/// Sixteen vectors, as Embree lays them out and as loops over them are made into vector instructions.
struct Vectors {
  alignas(64) float x[kPacket], y[kPacket], z[kPacket];

  Vector3f at(int i) const { return {x[i], y[i], z[i]}; }
  void set(int i, const Vector3f& v) { x[i] = v.x, y[i] = v.y, z[i] = v.z; }
  void add(int i, const Vector3f& v) { x[i] += v.x, y[i] += v.y, z[i] += v.z; }
};

Vector3f origin(const RTCRay16& rays, int i) { return {rays.org_x[i], rays.org_y[i], rays.org_z[i]}; }

Vector3f direction(const RTCRay16& rays, int i) { return {rays.dir_x[i], rays.dir_y[i], rays.dir_z[i]}; }

void set(RTCRay16& rays, int i, const Vector3f& origin, const Vector3f& direction, float t_max) {
  rays.org_x[i] = origin.x, rays.org_y[i] = origin.y, rays.org_z[i] = origin.z;
  rays.dir_x[i] = direction.x, rays.dir_y[i] = direction.y, rays.dir_z[i] = direction.z;
  rays.tnear[i] = rays.time[i] = 0;
  rays.tfar[i] = t_max;
  rays.mask[i] = 0xFFFFFFFF;
  rays.id[i] = rays.flags[i] = 0;
}

/// How far a place may be off its surface that was found so far along a ray.
float rounding(const Vector3f& position, float way) {
  return 3e-7f * (std::abs(position.x) + std::abs(position.y) + std::abs(position.z) + way);
}

/// The paths of a block of 4 x 4 pixels, one through each, as far as they have come. So that loops have no
/// branches, paths that have ended are shaded along; what that gives, NaN among it, is never chosen.
class Block {
 public:
  Block(const World& world, const Tree& tree, const Image& image, int x, int y)
      : world_(world), tree_(tree), image_(image), x_(x), y_(y) {}

  /// Adds one sample.
  void trace(int sample) {
    start(sample);
    Coherence coherence = Coherence::kCoherent;
    for (int bounces_left = world_.bounces;; --bounces_left) {
      if (!meet(coherence)) return;
      find_places();
      for (const Lamp& lamp : world_.lamps) light(lamp, coherence);
      if (bounces_left == 0 || !reflect()) return;
      coherence = Coherence::kIncoherent;
    }
  }

  void store(Image& image) const {
    for (int i = 0; i < kPacket; ++i) {
      if (is_inside(i)) image.set(px(i), py(i), sums_.at(i) / static_cast<float>(world_.samples));
    }
  }

  std::uint64_t rays() const { return traced_; }

 private:
  int px(int i) const { return x_ + i % kEdge; }
  int py(int i) const { return y_ + i / kEdge; }
  bool is_inside(int i) const { return px(i) < image_.width && py(i) < image_.height; }

  /// Where in each pixel: its middle, or the point of Sobol's sequence that raytracer takes.
  void choose_points(int sample, float* across, float* down) const {
    for (int i = 0; i < kPacket; ++i) {
      const auto number = static_cast<std::uint32_t>(image_.index(px(i), py(i)));
      const std::uint32_t seed = hash_bits(number ^ hash_bits(0));
      const Vector2f point =
          world_.samples == 1 ? Vector2f(0.5f) : sobol_point(static_cast<std::uint32_t>(sample), seed);
      across[i] = point.x, down[i] = point.y;
    }
  }

  void start(int sample) {
    float across[kPacket], down[kPacket];
    choose_points(sample, across, down);
    const Vector3f eye = world_.camera.position(), forward = world_.camera.forward(),
                   right = world_.camera.right(), up = world_.camera.up();
    for (int i = 0; i < kPacket; ++i) {
      const double x = (px(i) + static_cast<double>(across[i])) / image_.width;
      const double y = (py(i) + static_cast<double>(down[i])) / image_.height;
      const auto to_right = static_cast<float>(2 * x - 1), upwards = static_cast<float>(1 - 2 * y);
      set(query_.ray, i, eye, glm::normalize(forward + to_right * right + upwards * up), kInfinity);
      weights_.set(i, Color3f(1));
      goes_on_[i] = is_inside(i) ? -1 : 0;
    }
  }

  /// Finds what the rays meet; those that meet nothing end in the background. Whether any goes on.
  bool meet(Coherence coherence) {
    for (int i = 0; i < kPacket; ++i) {
      query_.hit.geomID[i] = query_.hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
      query_.hit.Ng_x[i] = query_.hit.Ng_y[i] = query_.hit.Ng_z[i] = 0;
    }
    traced_ += count(goes_on_);
    embree::intersect(goes_on_, tree_.scene, query_, coherence);
    const Color3f background = world_.background;
    for (int i = 0; i < kPacket; ++i) {
      const bool is_hit = query_.hit.geomID[i] != RTC_INVALID_GEOMETRY_ID;
      const float ends = (goes_on_[i] != 0) & !is_hit ? 1.0f : 0.0f;
      sums_.add(i, ends * weights_.at(i) * background);
      goes_on_[i] = is_hit ? goes_on_[i] : 0;
    }
    return count(goes_on_) > 0;
  }

  static std::uint64_t count(const int* valid) {
    int sum = 0;
    for (int i = 0; i < kPacket; ++i) sum -= valid[i];
    return static_cast<std::uint64_t>(sum);
  }

  /// Where the rays have met surfaces, on their side of them.
  void find_places() {
    for (int i = 0; i < kPacket; ++i) {
      const Vector3f way = direction(query_.ray, i),
                     across(query_.hit.Ng_x[i], query_.hit.Ng_y[i], query_.hit.Ng_z[i]);
      const float t = query_.ray.tfar[i];
      const Vector3f position = origin(query_.ray, i) + t * way;
      const float side = glm::dot(across, way) > 0 ? -1.0f : 1.0f;
      const Vector3f normal = side * glm::normalize(across);
      positions_.set(i, position);
      normals_.set(i, normal);
      starts_.set(i, position + rounding(position, t) * normal);
    }
    for (int i = 0; i < kPacket; ++i) {
      if (goes_on_[i] == 0) continue;
      const Surface& surface = tree_.surfaces[query_.hit.geomID[i]];
      colors_.set(i, surface.color);
      mirror_shares_[i] = surface.mirror_share;
    }
  }

  /// Adds a lamp where it is seen.
  void light(const Lamp& lamp, Coherence coherence) {
    alignas(64) int is_lit[kPacket];
    alignas(64) float strength[kPacket];
    RTCRay16 shadows;
    const bool fades = lamp.fades;
    const Vector3f there = lamp.position;
    for (int i = 0; i < kPacket; ++i) {
      const Vector3f to_lamp = there - positions_.at(i);
      const float facing = glm::dot(to_lamp, normals_.at(i)), square = glm::dot(to_lamp, to_lamp);
      strength[i] = lamp.lambda * facing / (fades ? square : std::sqrt(square));
      is_lit[i] = facing > 0 ? goes_on_[i] : 0;
      set(shadows, i, starts_.at(i), there - starts_.at(i), 1);
    }
    if (count(is_lit) == 0) return;
    traced_ += count(is_lit);
    find_hidden(is_lit, shadows, coherence);
    for (int i = 0; i < kPacket; ++i) {
      const bool is_seen = (is_lit[i] != 0) & !(shadows.tfar[i] < 0);
      const float share = is_seen ? (1 - mirror_shares_[i]) * strength[i] : 0;
      sums_.add(i, share * weights_.at(i) * colors_.at(i));
    }
  }

  /// Makes tfar negative of those that meet something. Rays that scatter are faster one by one.
  void find_hidden(const int* valid, RTCRay16& rays, Coherence coherence) const {
    if (coherence == Coherence::kCoherent) return embree::occluded(valid, tree_.scene, rays, coherence);
    for (int i = 0; i < kPacket; ++i) {
      if (valid[i] == 0) continue;
      RTCRay one = rtcGetRayFromRayN(reinterpret_cast<RTCRayN*>(&rays), kPacket, static_cast<unsigned>(i));
      embree::occluded(tree_.scene, one);
      rays.tfar[i] = one.tfar;
    }
  }

  /// Lets the rays go on that have met a mirror. Whether there are any.
  bool reflect() {
    for (int i = 0; i < kPacket; ++i) {
      goes_on_[i] = mirror_shares_[i] > 0 ? goes_on_[i] : 0;
      weights_.set(i, mirror_shares_[i] * weights_.at(i) * colors_.at(i));
      set(query_.ray, i, starts_.at(i), glm::reflect(direction(query_.ray, i), normals_.at(i)), kInfinity);
    }
    return count(goes_on_) > 0;
  }

  const World& world_;
  const Tree& tree_;
  const Image& image_;
  int x_, y_;
  std::uint64_t traced_ = 0;
  alignas(64) int goes_on_[kPacket];  // -1: yes
  RTCRayHit16 query_;
  Vectors positions_, normals_, starts_, weights_, colors_{}, sums_{};
  alignas(64) float mirror_shares_[kPacket] = {};
};

std::uint64_t trace_tile(const World& world, const Tree& tree, Image& image, int left, int top) {
  std::uint64_t rays = 0;
  for (int y = top; y < std::min(top + kTile, image.height); y += kEdge) {
    for (int x = left; x < std::min(left + kTile, image.width); x += kEdge) {
      Block block(world, tree, image, x, y);
      for (int sample = 0; sample < world.samples; ++sample) block.trace(sample);
      block.store(image);
      rays += block.rays();
    }
  }
  return rays;
}

}  // namespace

std::uint64_t trace(const World& world, const Tree& tree, Image& image) {
  const int across = (image.width + kTile - 1) / kTile, down = (image.height + kTile - 1) / kTile;
  std::vector<std::uint64_t> rays(static_cast<std::size_t>(across * down));
  parallel_for(rays.size(), [&](std::size_t i) {
    const int tile = static_cast<int>(i);
    rays[i] = trace_tile(world, tree, image, tile % across * kTile, tile / across * kTile);
  });
  return std::accumulate(rays.begin(), rays.end(), std::uint64_t{0});
}

}  // namespace raytracer::limit
