#include "limit_trace.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/parallel.hpp"
#include "sampling/sobol.hpp"

namespace raytracer::limit {
namespace {

constexpr int kTile = 32, kEdge = 4, kPacket = kEdge * kEdge;

void set(RTCRay16& rays, int i, const Ray3f& ray) {
  rays.org_x[i] = ray.origin.x, rays.org_y[i] = ray.origin.y, rays.org_z[i] = ray.origin.z;
  rays.dir_x[i] = ray.direction.x, rays.dir_y[i] = ray.direction.y, rays.dir_z[i] = ray.direction.z;
  rays.tnear[i] = rays.time[i] = 0;
  rays.tfar[i] = ray.t_max;
  rays.mask[i] = 0xFFFFFFFF;
  rays.id[i] = rays.flags[i] = 0;
}

/// How far a place may be off its surface that was found so far along a ray.
float rounding(const Vector3f& position, float way) {
  return 3e-7f * (std::abs(position.x) + std::abs(position.y) + std::abs(position.z) + way);
}

/// Where a ray has met a surface.
struct Place {
  Vector3f position, normal, start;  // `normal` on the side of the ray; rays go on from `start`
  const Surface* surface;
};

/// The paths of a block of 4 x 4 pixels, one through each, as far as they have come.
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
      for (const Lamp& lamp : world_.lamps) light(lamp, coherence);
      if (bounces_left == 0 || !reflect()) return;
      coherence = Coherence::kIncoherent;
    }
  }

  void store(Image& image) const {
    for (int i = 0; i < kPacket; ++i) {
      if (is_inside(i)) image.set(px(i), py(i), sums_[i] / static_cast<float>(world_.samples));
    }
  }

  std::uint64_t rays() const { return traced_; }

 private:
  int px(int i) const { return x_ + i % kEdge; }
  int py(int i) const { return y_ + i / kEdge; }
  bool is_inside(int i) const { return px(i) < image_.width && py(i) < image_.height; }

  void start(int sample) {
    for (int i = 0; i < kPacket; ++i) {
      const auto number = static_cast<std::uint32_t>(image_.index(px(i), py(i)));
      const auto seed = hash_bits(number ^ hash_bits(0));
      const Vector2f within =
          world_.samples == 1 ? Vector2f(0.5f) : sobol_point(static_cast<std::uint32_t>(sample), seed);
      rays_[i] = world_.camera.ray_through((px(i) + static_cast<double>(within.x)) / image_.width,
                                           (py(i) + static_cast<double>(within.y)) / image_.height);
      weights_[i] = Color3f(1);
      goes_on_[i] = is_inside(i) ? -1 : 0;
    }
  }

  /// Finds what the rays meet; those that meet nothing end in the background. Whether any goes on.
  bool meet(Coherence coherence) {
    RTCRayHit16 query;
    for (int i = 0; i < kPacket; ++i) {
      set(query.ray, i, rays_[i]);
      query.hit.geomID[i] = query.hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
    }
    embree::intersect(goes_on_, tree_.scene, query, coherence);
    bool any = false;
    for (int i = 0; i < kPacket; ++i) {
      if (goes_on_[i] == 0) continue;
      ++traced_;
      if (query.hit.geomID[i] == RTC_INVALID_GEOMETRY_ID) {
        sums_[i] += weights_[i] * world_.background;
        goes_on_[i] = 0;
        continue;
      }
      any = true;
      Place& place = places_[i];
      place.position = rays_[i].at(query.ray.tfar[i]);
      place.normal = glm::normalize(Vector3f(query.hit.Ng_x[i], query.hit.Ng_y[i], query.hit.Ng_z[i]));
      if (glm::dot(place.normal, rays_[i].direction) > 0) place.normal = -place.normal;
      place.start = place.position + rounding(place.position, query.ray.tfar[i]) * place.normal;
      place.surface = &tree_.surfaces[query.hit.geomID[i]];
    }
    return any;
  }

  /// Adds a lamp where it is seen.
  void light(const Lamp& lamp, Coherence coherence) {
    alignas(64) int is_lit[kPacket] = {};
    Ray3f shadow_rays[kPacket];
    float strength[kPacket];
    for (int i = 0; i < kPacket; ++i) {
      if (goes_on_[i] == 0) continue;
      const Place& place = places_[i];
      const Vector3f to_lamp = lamp.position - place.position;
      const float facing = glm::dot(to_lamp, place.normal), square = glm::dot(to_lamp, to_lamp);
      if (!(facing > 0)) continue;
      strength[i] = lamp.lambda * facing / (lamp.fades ? square : std::sqrt(square));
      shadow_rays[i] = {place.start, lamp.position - place.start, 0, 1};
      is_lit[i] = -1;
    }
    drop_hidden(is_lit, shadow_rays, coherence);
    for (int i = 0; i < kPacket; ++i) {
      if (is_lit[i] == 0) continue;
      const Surface& surface = *places_[i].surface;
      sums_[i] += weights_[i] * ((1 - surface.mirror_share) * strength[i] * surface.color);
    }
  }

  /// Clears `is_lit` where a shadow ray meets something. Those that scatter are faster one by one.
  void drop_hidden(int* is_lit, const Ray3f* shadow_rays, Coherence coherence) {
    const auto count = std::count(is_lit, is_lit + kPacket, -1);
    traced_ += static_cast<std::uint64_t>(count);
    if (count == 0) return;
    if (coherence == Coherence::kIncoherent) {
      for (int i = 0; i < kPacket; ++i) {
        if (is_lit[i] != 0 && is_hidden(shadow_rays[i])) is_lit[i] = 0;
      }
      return;
    }
    RTCRay16 packet;
    for (int i = 0; i < kPacket; ++i) set(packet, i, shadow_rays[i]);
    embree::occluded(is_lit, tree_.scene, packet, coherence);
    for (int i = 0; i < kPacket; ++i) {
      if (packet.tfar[i] < 0) is_lit[i] = 0;
    }
  }

  bool is_hidden(const Ray3f& ray) const {
    RTCRay query{ray.origin.x,
                 ray.origin.y,
                 ray.origin.z,
                 0,
                 ray.direction.x,
                 ray.direction.y,
                 ray.direction.z,
                 0,
                 ray.t_max,
                 0xFFFFFFFF,
                 0,
                 0};
    embree::occluded(tree_.scene, query);
    return query.tfar < 0;
  }

  /// Lets the rays go on that have met a mirror. Whether there are any.
  bool reflect() {
    bool any = false;
    for (int i = 0; i < kPacket; ++i) {
      if (goes_on_[i] == 0) continue;
      const Surface& surface = *places_[i].surface;
      if (!(surface.mirror_share > 0)) {
        goes_on_[i] = 0;
        continue;
      }
      any = true;
      weights_[i] *= surface.mirror_share * surface.color;
      rays_[i] = {places_[i].start, glm::reflect(rays_[i].direction, places_[i].normal)};
    }
    return any;
  }

  const World& world_;
  const Tree& tree_;
  const Image& image_;
  int x_, y_;
  std::uint64_t traced_ = 0;
  alignas(64) int goes_on_[kPacket];
  Ray3f rays_[kPacket];
  Color3f weights_[kPacket];
  Place places_[kPacket];
  Color3f sums_[kPacket] = {};
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
