#include "scene/pixel_color.hpp"

#include <algorithm>

#include "lights/illuminate.hpp"
#include "scene/recursion.hpp"
#include "scene/shining_parts.hpp"

namespace raytracer {

Color3f get_pixel_color(const Scene& scene, const Ray3f& ray, int bounces_left, std::uint64_t& rays) {
  return Recursion(scene, nullptr, rays).look({ray, bounces_left}).color;
}

// --- levels --------------------------------------------------------------------------------------------

struct PixelColors::Task {
  std::size_t depth;
  int bounces_left;
  Level& level;
  Level* next;  // null: nothing is reflected any more
  std::size_t block;
  Coherence coherence;

  const RayBlock& rays() const { return level.rays[block]; }
  ColorBlock& colors() const { return level.colors[block]; }
  std::uint32_t ray(int lane) const {
    return static_cast<std::uint32_t>(block * kBlockSize) + static_cast<std::uint32_t>(lane);
  }
  BlockMask asked() const { return BlockMask::first(level.count - block * kBlockSize); }
};

void PixelColors::Level::clear() {
  count = 0;
  parent.clear();
  cones.clear();
  origin.clear();
}

void PixelColors::Level::add(const Ray3f& ray, const Color3f& share_of_parent, std::uint32_t from) {
  const std::size_t block = count / kBlockSize;
  const int lane = static_cast<int>(count % kBlockSize);
  if (block == rays.size()) {
    rays.emplace_back();
    share.emplace_back();
  }
  rays[block].set(lane, ray);
  share[block].set(lane, share_of_parent);
  parent.push_back(from);
  ++count;
}

void PixelColors::trace(const RaysToTrace& rays, int bounces, std::span<ColorBlock> colors) {
  if (rays.count == 0) return;
  light_points_ = rays.light_points;
  if (levels_.empty()) levels_.resize(1);
  levels_[0].count = rays.count;
  levels_[0].rays.assign(rays.blocks.begin(), rays.blocks.end());
  levels_[0].cones.assign(rays.cones.begin(), rays.cones.end());
  std::size_t depth = 0;
  for (; static_cast<int>(depth) <= bounces && levels_[depth].count > 0; ++depth) {
    shade(depth, bounces - static_cast<int>(depth));
  }
  while (--depth > 0) add_to_parents(depth);
  std::ranges::copy(levels_[0].colors, colors.begin());
}

// What a level's rays see but for reflections, which become the next level.
void PixelColors::shade(std::size_t depth, int bounces_left) {
  if (bounces_left > 0 && levels_.size() == depth + 1) levels_.emplace_back();
  Level& level = levels_[depth];
  Level* next = bounces_left > 0 ? &levels_[depth + 1] : nullptr;
  if (next != nullptr) next->clear();
  const std::size_t blocks = blocks_for(level.count);
  level.colors.resize(blocks);
  const Coherence coherence = depth == 0 ? Coherence::kCoherent : Coherence::kIncoherent;
  for (std::size_t block = 0; block < blocks; ++block) {
    shade_block({depth, bounces_left, level, next, block, coherence});
  }
}

void PixelColors::add_to_parents(std::size_t depth) {
  const Level& level = levels_[depth];
  std::vector<ColorBlock>& parents = levels_[depth - 1].colors;
  for (std::size_t i = 0; i < level.count; ++i) {
    const std::size_t block = i / kBlockSize;
    const int lane = static_cast<int>(i % kBlockSize);
    ColorBlock& seen = parents[level.parent[i] / kBlockSize];
    const int to = static_cast<int>(level.parent[i] % kBlockSize);
    seen.set(to, seen.at(to) + level.share[block].at(lane) * level.colors[block].at(lane));
  }
}

// The place on what shines that belongs to a ray; null: its middle.
const Vector2f* PixelColors::light_point(const Level& level, std::uint32_t ray) const {
  if (light_points_.empty()) return nullptr;
  return &light_points_[level.origin.empty() ? ray : level.origin[ray]];
}

// --- a block -------------------------------------------------------------------------------------------

void PixelColors::shade_block(const Task& task) {
  find_hits(task);
  add_background(task);
  gather(task);
  if (points_.is_used.is_empty()) return;
  place(scene_.description().epsilon, task.rays(), hits_.t, points_);
  add_lights(task);
  if (task.next != nullptr) reflect(task);
}

// In packets throughout: rays that neighbours reflect still go much the same way.
void PixelColors::find_hits(const Task& task) {
  const BlockMask asked = task.asked();
  rays_ += static_cast<std::uint64_t>(asked.count());
  is_hit_ = scene_.is_hit(task.rays(), asked, hits_, task.coherence);
}

void PixelColors::add_background(const Task& task) {
  const SceneDescription& scene = scene_.description();
  if (scene.sky == nullptr) {
    const Color3f background = 255.0f * scene.background;
    for (int i = 0; i < kBlockSize; ++i) task.colors().set(i, background);
    return;
  }
  for (int i = 0; i < kBlockSize; ++i) {
    if (!is_hit_.has(i)) task.colors().set(i, color_beyond(scene, task.rays().ray(i), task.depth == 0));
  }
}

// Lays the surfaces that were hit side by side, all lanes of a shape at once.
void PixelColors::gather(const Task& task) {
  points_.is_used = is_hit_;
  BlockMask rest = is_hit_;
  for (int first = 0; first < kBlockSize; ++first) {
    if (!rest.has(first)) continue;
    BlockMask same;
    const std::uint32_t shape = hits_.shape[first], instance = hits_.instance[first];
    for (int i = 0; i < kBlockSize; ++i) {
      const bool is_same = (hits_.shape[i] == shape) & (hits_.instance[i] == instance);
      same.lane[i] = is_same ? rest.lane[i] : 0;
      rest.lane[i] = is_same ? 0 : rest.lane[i];
    }
    gather(task, first, same);
  }
}

// `lanes` are of the shape that lane `first` has met.
void PixelColors::gather(const Task& task, int first, const BlockMask& lanes) {
  const Material& material = scene_.material_of(hits_.at(first));
  if (!is_of_paper(material)) return look_at_layers(task, lanes);
  scene_.surfaces_at(task.rays(), hits_, lanes, points_.surface);
  const float share = mirror_share(material);
  const Color3f color = material.color;
  for (int i = 0; i < kBlockSize; ++i) {
    const bool is_set = lanes.has(i);
    points_.color.choose(i, is_set, color);
    points_.mirror_share[i] = is_set ? share : points_.mirror_share[i];
  }
  if (!scene_.has_vertex_colors()) return;
  for (int i = 0; i < kBlockSize; ++i) {
    if (lanes.has(i)) points_.color.set(i, surface_color(scene_, task.rays().ray(i), hits_.at(i), material));
  }
}

// What the paper does not know only the recursion can.
void PixelColors::look_at_layers(const Task& task, const BlockMask& lanes) {
  for (int i = 0; i < kBlockSize; ++i) {
    if (!lanes.has(i)) continue;
    points_.is_used.set(i, false);
    Sight sight{task.rays().ray(i), task.bounces_left, task.depth == 0};
    if (!task.level.cones.empty()) sight.cone = task.level.cones[task.ray(i)];
    Recursion recursion(scene_, light_point(task.level, task.ray(i)), rays_);
    task.colors().set(i, recursion.look_at_layers(sight, hits_.at(i)).color);
  }
}

// Mirrors show nothing of it.
void PixelColors::add_lights(const Task& task) {
  BlockMask lit;
  for (int i = 0; i < kBlockSize; ++i) {
    lit.lane[i] = points_.mirror_share[i] < 1 ? points_.is_used.lane[i] : 0;
  }
  const Color3f ambient = 255.0f * scene_.description().ambient;
  for (int i = 0; i < kBlockSize; ++i) points_.light.set(i, ambient);
  if (!lit.is_empty()) {
    for (const Light& light : scene_.description().lights) add_light(task, light, lit);
    if (!shining_.is_empty()) add_light_of_shapes(task, lit);
  }
  ColorBlock& colors = task.colors();
  for (int i = 0; i < kBlockSize; ++i) {
    const float share = lit.has(i) ? 1 - points_.mirror_share[i] : 0.0f;
    const Color3f seen = share * points_.color.at(i) * points_.light.at(i);
    colors.choose(i, points_.is_used.has(i), seen);
  }
}

// Adds one light where it is seen.
void PixelColors::add_light(const Task& task, const Light& light, const BlockMask& lit) {
  RayBlock shadow_rays;
  ColorBlock arriving;
  illuminate(light, points_.position, points_.shading_normal, points_.shadow_position, arriving, shadow_rays);
  BlockMask asked;
  for (int i = 0; i < kBlockSize; ++i) {
    const bool is_dark = (arriving.x[i] == 0) & (arriving.y[i] == 0) & (arriving.z[i] == 0);
    asked.lane[i] = is_dark ? 0 : lit.lane[i];
  }
  if (asked.is_empty()) return;
  if (shining_.has_see_through()) {
    for (int i = 0; i < kBlockSize; ++i) {
      if (!asked.has(i)) continue;
      const Color3f share = share_passing(scene_, shadow_rays.ray(i), rays_);
      points_.light.set(i, points_.light.at(i) + arriving.at(i) * share);
    }
    return;
  }
  rays_ += static_cast<std::uint64_t>(asked.count());
  const BlockMask hidden = find_hidden(shadow_rays, asked, task.coherence);
  for (int i = 0; i < kBlockSize; ++i) {
    const bool is_seen = (asked.lane[i] & ~hidden.lane[i]) != 0;
    points_.light.choose(i, is_seen, points_.light.at(i) + arriving.at(i));
  }
}

// From scattered points one by one is faster: each ray ends at the first thing that it meets.
BlockMask PixelColors::find_hidden(const RayBlock& rays, const BlockMask& asked, Coherence coherence) const {
  if (coherence == Coherence::kCoherent) return scene_.is_occluded(rays, asked, coherence);
  BlockMask hidden = BlockMask::none();
  for (int i = 0; i < kBlockSize; ++i) {
    if (asked.has(i)) hidden.set(i, scene_.is_occluded(rays.ray(i)));
  }
  return hidden;
}

void PixelColors::add_light_of_shapes(const Task& task, const BlockMask& lit) {
  for (int i = 0; i < kBlockSize; ++i) {
    if (!lit.has(i)) continue;
    Recursion recursion(scene_, light_point(task.level, task.ray(i)), rays_);
    points_.light.set(i, points_.light.at(i) + recursion.light_of_shapes(points_.at(i)));
  }
}

void PixelColors::reflect(const Task& task) {
  const Level& level = task.level;
  Level& next = *task.next;
  for (int i = 0; i < kBlockSize; ++i) {
    if (!points_.is_used.has(i) || !(points_.mirror_share[i] > 0)) continue;
    const std::uint32_t ray = task.ray(i);
    next.add(reflected_ray(task.rays().ray(i), points_.at(i)), points_.mirror_share[i] * points_.color.at(i),
             ray);
    if (!level.cones.empty()) next.cones.push_back(level.cones[ray].at(hits_.t[i]));
    if (!light_points_.empty()) next.origin.push_back(level.origin.empty() ? ray : level.origin[ray]);
  }
}

}  // namespace raytracer
