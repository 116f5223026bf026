#include "scene/pixel_color.hpp"

#include <algorithm>

#include "lights/illuminate.hpp"
#include "scene/recursion.hpp"
#include "scene/shining_parts.hpp"

namespace raytracer {

Color3f get_pixel_color(const Scene& scene, const Ray3f& ray, int bounces_left, std::uint64_t& rays) {
  return Recursion(scene, nullptr, rays).look({ray, bounces_left}).color;
}

// --- many rays
// -------------------------------------------------------------------------------------------------------

void PixelColors::trace(std::span<const Ray3f> rays, int bounces, std::span<Color3f> colors,
                        std::span<const Vector2f> light_points, std::span<const RayCone> cones) {
  if (rays.empty()) return;
  light_points_ = light_points;
  if (levels_.empty()) levels_.resize(1);
  levels_[0].rays.assign(rays.begin(), rays.end());
  levels_[0].cones.assign(cones.begin(), cones.end());
  std::size_t depth = 0;
  for (; static_cast<int>(depth) <= bounces && !levels_[depth].rays.empty(); ++depth) {
    shade(depth, bounces - static_cast<int>(depth));
  }
  while (--depth > 0) {
    const Level& level = levels_[depth];
    for (std::size_t i = 0; i < level.rays.size(); ++i) {
      levels_[depth - 1].colors[level.parent[i]] += level.share[i] * level.colors[i];
    }
  }
  std::copy(levels_[0].colors.begin(), levels_[0].colors.end(), colors.begin());
}

// What a level's rays see but for reflections, which become the next level.
void PixelColors::shade(std::size_t depth, int bounces_left) {
  if (bounces_left > 0 && levels_.size() == depth + 1) levels_.emplace_back();
  Level& level = levels_[depth];
  Level* next = bounces_left > 0 ? &levels_[depth + 1] : nullptr;
  if (next != nullptr) {
    next->rays.clear();
    next->cones.clear();
    next->parent.clear();
    next->share.clear();
    next->origin.clear();
  }
  lit_.clear();
  level.colors.assign(level.rays.size(), Color3f(0));
  const Coherence coherence = depth == 0 ? Coherence::kCoherent : Coherence::kIncoherent;
  find_hits(level.rays, coherence);
  for (std::uint32_t i = 0; i < level.rays.size(); ++i) {
    if (is_hit_[i]) {
      shade_hit(depth, bounces_left, i, next);
    } else {
      level.colors[i] = color_beyond(scene_.description(), level.rays[i], depth == 0);
    }
  }
  for (const Light& light : scene_.description().lights) add_light(light, coherence);
  if (!shining_.is_empty()) add_light_of_shapes(level);
  for (const LitPoint& lit : lit_) level.colors[lit.ray] += lit.share * lit.light;
}

// The place on what shines that belongs to a ray; null: its middle.
const Vector2f* PixelColors::light_point(const Level& level, std::uint32_t ray) const {
  if (light_points_.empty()) return nullptr;
  return &light_points_[level.origin.empty() ? ray : level.origin[ray]];
}

void PixelColors::add_light_of_shapes(const Level& level) {
  for (LitPoint& lit : lit_) {
    lit.light += Recursion(scene_, light_point(level, lit.ray), rays_).light_of_shapes(lit.point);
  }
}

void PixelColors::shade_hit(std::size_t depth, int bounces_left, std::uint32_t ray, Level* next) {
  Level& level = levels_[depth];
  const Ray3f& seen_along = level.rays[ray];
  const Hit& hit = hits_[ray];
  const Material& material = scene_.material_of(hit);
  if (!is_of_paper(material)) {
    Recursion recursion(scene_, light_point(level, ray), rays_);
    Sight sight{seen_along, bounces_left, depth == 0};
    if (!level.cones.empty()) sight.cone = level.cones[ray];
    level.colors[ray] = recursion.look_at_layers(sight, hit).color;
    return;
  }
  const float shininess = mirror_share(material);
  const Color3f color = surface_color(scene_, seen_along, hit, material);
  const ShadingPoint point = shading_point(scene_, seen_along, hit, scene_.surface_at(seen_along, hit));
  if (shininess < 1) {
    LitPoint& lit = lit_.emplace_back();
    lit.point = point;
    lit.ray = ray;
    lit.share = (1 - shininess) * color;
    lit.light = 255.0f * scene_.description().ambient;
  }
  if (shininess > 0 && next != nullptr) {
    next->rays.push_back(reflected_ray(seen_along, point));
    if (!level.cones.empty()) next->cones.push_back(level.cones[ray].at(hit.t));
    next->parent.push_back(ray);
    next->share.push_back(shininess * color);
    if (!light_points_.empty()) next->origin.push_back(level.origin.empty() ? ray : level.origin[ray]);
  }
}

// Fills hits_ and is_hit_. Rays that scatter are faster one by one.
void PixelColors::find_hits(const std::vector<Ray3f>& rays, Coherence coherence) {
  rays_ += rays.size();
  hits_.resize(rays.size());
  is_hit_.resize(rays.size());
  if (coherence == Coherence::kIncoherent) {
    for (std::size_t i = 0; i < rays.size(); ++i) is_hit_[i] = scene_.is_hit(rays[i], hits_[i]);
    return;
  }
  for (std::size_t first = 0; first < rays.size(); first += kMostRays) {
    const std::size_t count = std::min(kMostRays, rays.size() - first);
    const std::uint32_t found = scene_.is_hit(std::span(rays).subspan(first, count),
                                              std::span(hits_).subspan(first, count), coherence);
    for (std::size_t i = 0; i < count; ++i) is_hit_[first + i] = (found >> i & 1U) != 0;
  }
}

// Adds one light where it is seen to all the points of lit_. From scattered points, as with scattered rays,
// one by one is at least as fast.
void PixelColors::add_light(const Light& light, Coherence coherence) {
  ShadowRays waiting;
  for (std::uint32_t i = 0; i < lit_.size(); ++i) {
    const ShadingPoint& point = lit_[i].point;
    const Illumination arriving =
        illuminate(light, point.position, point.shading_normal, point.shadow_position);
    if (arriving.color == Color3f(0)) continue;
    if (shining_.has_see_through()) {
      lit_[i].light += arriving.color * share_passing(scene_, arriving.shadow_ray, rays_);
      continue;
    }
    ++rays_;
    if (coherence == Coherence::kIncoherent) {
      if (!scene_.is_occluded(arriving.shadow_ray)) lit_[i].light += arriving.color;
      continue;
    }
    waiting.rays[waiting.count] = arriving.shadow_ray;
    waiting.color[waiting.count] = arriving.color;
    waiting.to[waiting.count] = i;
    if (++waiting.count == kMostRays) add_seen(waiting);
  }
  if (waiting.count > 0) add_seen(waiting);
}

void PixelColors::add_seen(ShadowRays& waiting) {
  const std::uint32_t hidden =
      scene_.is_occluded(std::span(waiting.rays, waiting.count), Coherence::kCoherent);
  for (std::size_t i = 0; i < waiting.count; ++i) {
    if ((hidden >> i & 1U) == 0) lit_[waiting.to[i]].light += waiting.color[i];
  }
  waiting.count = 0;
}

}  // namespace raytracer
