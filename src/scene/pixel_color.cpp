#include "scene/pixel_color.hpp"

#include <algorithm>

#include "lights/illuminate.hpp"

namespace raytracer {
namespace {

inline ShadingPoint shading_point(const Scene& scene, const Ray3f& ray, const Hit& hit) {
  const SurfacePoint surface = scene.surface_at(ray, hit);
  ShadingPoint point;
  const bool is_back = glm::dot(surface.normal, ray.direction) > 0;
  point.normal = is_back ? -surface.normal : surface.normal;
  point.shading_normal = is_back ? -surface.shading_normal : surface.shading_normal;
  if (const auto& epsilon = scene.description().epsilon) {
    // The paper's way: the point as the ray's equation gives it, its rounding error included.
    point.position = ray.at(hit.t);
    point.offset_position = point.position + *epsilon * point.normal;
  } else {
    point.position = surface.position;
    point.offset_position = point.position + surface.position_error * point.normal;
  }
  point.shadow_position = point.offset_position + surface.shadow_offset;
  return point;
}

// A mirror that is curved by its shading normals alone may send a ray into itself: it then goes along the
// surface.
Ray3f reflected_ray(const Ray3f& ray, const ShadingPoint& point) {
  Vector3f direction = glm::reflect(ray.direction, point.shading_normal);
  const float away = glm::dot(direction, point.normal);
  if (away < 0) direction -= 1.001f * away * point.normal;
  return {point.offset_position, direction};
}

// With what the vertices of a mesh say.
Color3f surface_color(const Scene& scene, const Ray3f& ray, const Hit& hit, const Material& material) {
  if (!scene.has_vertex_colors() || !material.takes_vertex_colors) return material.color;
  return material.color * scene.detail_at(ray, hit).color;
}

float mirror_share(const Material& material) { return glm::clamp(material.shininess, 0.0f, 1.0f); }

// The sum over the lights that the point sees, in units of the buffers.
Color3f direct_light(const Scene& scene, const ShadingPoint& point, std::uint64_t& rays) {
  Color3f sum = 255.0f * scene.description().ambient;
  for (const Light& light : scene.description().lights) {
    const Illumination arriving =
        illuminate(light, point.position, point.shading_normal, point.shadow_position);
    if (arriving.color == Color3f(0)) continue;
    ++rays;
    if (!scene.is_occluded(arriving.shadow_ray)) sum += arriving.color;
  }
  return sum;
}

}  // namespace

Color3f get_pixel_color(const Scene& scene, const Ray3f& ray, int bounces_left, std::uint64_t& rays) {
  ++rays;
  Hit hit;
  if (!scene.is_hit(ray, hit)) return 255.0f * scene.description().background;
  const Material& material = scene.material_of(hit);
  const float shininess = mirror_share(material);
  const ShadingPoint point = shading_point(scene, ray, hit);
  const Color3f tint = surface_color(scene, ray, hit, material);
  Color3f color(0);
  if (shininess < 1) color += (1 - shininess) * tint * direct_light(scene, point, rays);
  if (shininess > 0 && bounces_left > 0) {
    const Ray3f reflected = reflected_ray(ray, point);
    color += shininess * tint * get_pixel_color(scene, reflected, bounces_left - 1, rays);
  }
  return color;
}

// --- many rays
// -------------------------------------------------------------------------------------------------------

void PixelColors::trace(std::span<const Ray3f> rays, int bounces, std::span<Color3f> colors) {
  if (rays.empty()) return;
  if (levels_.empty()) levels_.resize(1);
  levels_[0].rays.assign(rays.begin(), rays.end());
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
    next->parent.clear();
    next->share.clear();
  }
  lit_.clear();
  level.colors.assign(level.rays.size(), Color3f(0));
  const Coherence coherence = depth == 0 ? Coherence::kCoherent : Coherence::kIncoherent;
  find_hits(level.rays, coherence);
  for (std::uint32_t i = 0; i < level.rays.size(); ++i) {
    if (is_hit_[i]) {
      shade_hit(level, i, hits_[i], next);
    } else {
      level.colors[i] = 255.0f * scene_.description().background;
    }
  }
  for (const Light& light : scene_.description().lights) add_light(light, coherence);
  for (const LitPoint& lit : lit_) level.colors[lit.ray] += lit.share * lit.light;
}

void PixelColors::shade_hit(Level& level, std::uint32_t ray, const Hit& hit, Level* next) {
  const Material& material = scene_.material_of(hit);
  const float shininess = mirror_share(material);
  const ShadingPoint point = shading_point(scene_, level.rays[ray], hit);
  const Color3f tint = surface_color(scene_, level.rays[ray], hit, material);
  if (shininess < 1) {
    LitPoint& lit = lit_.emplace_back();
    lit.point = point;
    lit.ray = ray;
    lit.share = (1 - shininess) * tint;
    lit.light = 255.0f * scene_.description().ambient;
  }
  if (shininess > 0 && next != nullptr) {
    next->rays.push_back(reflected_ray(level.rays[ray], point));
    next->parent.push_back(ray);
    next->share.push_back(shininess * tint);
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
