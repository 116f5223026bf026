#include "scene/recursion.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "lights/illuminate.hpp"
#include "materials/bsdf.hpp"
#include "materials/fresnel.hpp"
#include "sampling/sobol.hpp"
#include "scene/shining_parts.hpp"

namespace raytracer {
namespace {

constexpr float kPi = 3.14159265f;

// Less than half a step of the picture is not worth a ray.
constexpr float kLeastWeight = 1.0f / 512;
// How often both rays of a pane are followed, then the stronger counts for both: 2^4 rays for one at most.
constexpr int kMostSplits = 4;

float largest(const Color3f& c) { return std::max({c.x, c.y, c.z}); }

// How much of its surroundings a rough surface mirrors. They are seen sharp, as a recursion sees them, so
// they fade out as the roughness grows; its highlights are computed as they are.
float sharpness(float roughness) { return std::max(0.0f, 1 - 2 * roughness); }

// Below, facets are a mirror: light that shines is seen in it instead of making a highlight on it.
bool is_smooth(float roughness) { return roughness < 0.01f; }

}  // namespace

// --- the paper -----------------------------------------------------------------------------------------

// get_pixel_color: the light that comes straight from the lights, and what is seen in the mirror.
Seen Recursion::look(const Sight& sight) {
  ++rays_;
  Hit hit;
  if (!scene_.is_hit(sight.ray, hit)) return {color_beyond(scene_.description(), sight.ray, sight.is_camera)};
  const Material& material = scene_.material_of(hit);
  if (!is_of_paper(material) || sight.media.innermost() != nullptr) return look_at_layers(sight, hit);
  const float shininess = mirror_share(material);
  const ShadingPoint point = shading_point(scene_, sight.ray, hit, scene_.surface_at(sight.ray, hit));
  const Color3f color = surface_color(scene_, sight.ray, hit, material);
  Seen seen;
  if (shininess < 1) seen.color += (1 - shininess) * color * direct_light(point);
  if (shininess > 0 && sight.bounces_left > 0) {
    Sight mirrored = sight;
    mirrored.ray = reflected_ray(sight.ray, point);
    mirrored.bounces_left = sight.bounces_left - 1;
    mirrored.is_camera = false;
    mirrored.cone = sight.cone.at(hit.t);
    seen.color += shininess * color * look(mirrored).color;
  }
  return seen;
}

// The sum over the lights that the point sees, in units of the buffers.
Color3f Recursion::direct_light(const ShadingPoint& point) {
  Color3f sum = 255.0f * scene_.description().ambient;
  for (const Light& light : scene_.description().lights) {
    const Illumination arriving =
        illuminate(light, point.position, point.shading_normal, point.shadow_position);
    if (arriving.color == Color3f(0)) continue;
    sum += arriving.color * passing(arriving.shadow_ray);
  }
  return sum + light_of_shapes(point);
}

Color3f Recursion::passing(const Ray3f& shadow_ray) {
  if (shining_.has_see_through()) return share_passing(scene_, shadow_ray, rays_);
  ++rays_;
  return Color3f(scene_.is_occluded(shadow_ray) ? 0.0f : 1.0f);
}

// --- what shines ---------------------------------------------------------------------------------------

// Calls function(direction, light) for the light that arrives from each, 1 is white.
template <class Function>
void Recursion::for_each_shining(const ShadingPoint& point, const Function& function) {
  for (std::uint32_t k = 0; k < shining_.sample_count(); ++k) {
    Vector2f u(0.5f);
    if (light_point_ != nullptr) {  // each has its own points, as evenly spread
      const std::uint32_t bits = hash_bits(k + 1);
      u = glm::fract(*light_point_ + Vector2f(unit_float(bits), unit_float(hash_bits(bits))));
    }
    ShiningSample sample;
    if (!shining_.sample(k, point.position, u, sample)) continue;
    if (!(glm::dot(sample.direction, point.normal) > 0)) continue;
    const Ray3f shadow_ray{point.shadow_position, sample.target - point.shadow_position, 0, 1};
    const Color3f share = passing(shadow_ray);
    if (share != Color3f(0)) function(sample.direction, share * sample.light);
  }
}

Color3f Recursion::light_of_shapes(const ShadingPoint& point) {
  Color3f sum(0);
  for_each_shining(point, [&](const Vector3f& direction, const Color3f& light) {
    sum += std::max(0.0f, glm::dot(direction, point.shading_normal)) / kPi * light;
  });
  return 255.0f * sum;
}

// --- layers, metal, glass --------------------------------------------------------------------------------

struct Recursion::Surface {
  const Material& own;             // tells media apart
  const MaterialValues& material;  // with its textures' values
  ShadingPoint point;
  Vector3f out;          // unit length, back along the ray
  bool is_outside;       // whether the ray came from where the normal points
  float before, behind;  // the indices of refraction on the ray's side and on the other
  float position_error;
  Vector3f tangent{0};
};

// What the branches of the recursion count, and what light from everywhere does.
struct Recursion::Shares {
  Color3f mirror{0};          // of the reflected ray
  Color3f blurred_mirror{0};  // likewise, of all but what shines there: highlights are that already
  Color3f through{0};         // of the refracted ray
  Color3f ambient{0};
};

Seen Recursion::look_at_layers(const Sight& sight, const Hit& hit) {
  const Material& own = scene_.material_of(hit);
  if (own.is_area_light && !own.is_visible && sight.is_camera) return look_behind(sight, hit);
  SurfacePoint point = scene_.surface_at(sight.ray, hit);
  std::optional<MaterialValues> textured;
  const bool is_outside = glm::dot(point.normal, sight.ray.direction) < 0;
  if (varies(scene_, own)) {
    textured = scene_.textured(sight.ray, hit, sight.cone.footprint_at(hit.t), point);
    if (!is_outside) textured->ior = sight.media.ior_of(&own, textured->ior);
  }
  const MaterialValues& material = textured ? *textured : static_cast<const MaterialValues&>(own);

  const float length = glm::length(sight.ray.direction);
  float before = sight.media.ior(), behind = material.ior;
  const bool is_in_glass = has_inside(own) && !is_outside;
  if (is_in_glass) {
    before = material.ior;
    behind = sight.media.ior_without(&own);
  }
  Surface surface{own,
                  material,
                  shading_point(scene_, sight.ray, hit, point),
                  -sight.ray.direction / length,
                  is_outside,
                  before,
                  behind,
                  scene_.description().epsilon.value_or(point.position_error)};
  if (material.anisotropy != 0) surface.tangent = scene_.detail_at(sight.ray, hit).along_u;

  Seen seen;
  if (!own.is_area_light || is_outside) seen.emitted = 255.0f * material.emission;
  seen.color = seen.emitted;
  if (!own.is_area_light) {
    BsdfFrame frame;
    const float side = is_outside ? 1.0f : -1.0f;
    frame.geometric_normal = side * surface.point.normal;
    frame.normal = side * surface.point.shading_normal;
    frame.tangent = surface.tangent;
    frame.ior_outside = is_in_glass ? behind : before;
    frame.ior_inside = is_in_glass ? before : behind;
    const Bsdf bsdf(material, frame);
    if (!bsdf.is_delta()) seen.color += lit_by_lights(surface, bsdf);
    const Shares shares = shares_of(surface);
    seen.color += 255.0f * shares.ambient * scene_.description().ambient;
    if (sight.bounces_left > 0) {
      Sight wider = sight;
      wider.cone = sight.cone.at(hit.t);
      seen.color += look_on(wider, surface, shares);
    }
  }
  if (const float alpha = scene_.alpha_at(sight.ray, hit); alpha < 1) {
    const Seen behind_it = look_behind(sight, hit);
    seen.color = glm::mix(behind_it.color, seen.color, alpha);
    seen.emitted = glm::mix(behind_it.emitted, seen.emitted, alpha);
  }
  if (const Medium* medium = sight.media.innermost()) {
    const Color3f left = glm::exp(-hit.t * length * medium->absorption);
    seen.color *= left;
    seen.emitted *= left;
  }
  return seen;
}

// What the ray sees past a surface that isn't there for it.
Seen Recursion::look_behind(const Sight& sight, const Hit& hit) {
  Sight further = sight;
  further.ray.t_min = std::nextafter(hit.t, kInfinity);
  return look(further);
}

// The matt share and the highlights of rough facets.
Color3f Recursion::lit_by_lights(const Surface& surface, const Bsdf& bsdf) {
  const ShadingPoint& point = surface.point;
  Color3f sum(0);
  for (const Light& light : scene_.description().lights) {
    const Illumination arriving =
        illuminate(light, point.position, point.shading_normal, point.shadow_position);
    if (arriving.color == Color3f(0)) continue;
    const Vector3f in = glm::normalize(arriving.shadow_ray.direction);
    const float cosine = glm::dot(in, point.shading_normal);
    if (!(cosine > 1e-6f)) continue;
    const Color3f value = bsdf.evaluate(surface.out, in);
    if (value == Color3f(0)) continue;
    sum += kPi / cosine * value * arriving.color * passing(arriving.shadow_ray);
  }
  for_each_shining(point, [&](const Vector3f& in, const Color3f& light) {
    sum += 255.0f * bsdf.evaluate(surface.out, in) * light;
  });
  return sum;
}

Recursion::Shares Recursion::shares_of(const Surface& surface) const {
  const MaterialValues& m = surface.material;
  const float cosine = std::min(1.0f, std::abs(glm::dot(surface.out, surface.point.shading_normal)));
  const float shininess = mirror_share(m), rest = 1 - shininess;
  const bool is_in_glass = has_inside(surface.own) && !surface.is_outside;
  Shares shares;
  shares.mirror = shininess * m.color;

  float below = rest;  // what the coat lets through
  if (m.coat > 0 && !is_in_glass) {
    const float coat = rest * m.coat * fresnel_dielectric(cosine, 1.5f / surface.before).reflectance;
    (is_smooth(m.coat_roughness) ? shares.mirror : shares.blurred_mirror) +=
        Color3f(coat * sharpness(m.coat_roughness));
    below -= coat;
  }
  const float metal = below * m.metallic, glass = below * (1 - m.metallic) * m.transmission,
              opaque = below * (1 - m.metallic) * (1 - m.transmission);
  Color3f facets(0);
  if (metal > 0) {
    facets += metal * (m.conductor ? m.color * fresnel_conductor(
                                                   ConductorSquares(*m.conductor, surface.before), cosine)
                                   : fresnel_schlick(m.color, cosine));
  }
  const float eta = surface.behind / surface.before;
  float layer = 0;
  if (opaque > 0 && (m.has_layer || m.transmission > 0)) {
    layer = m.specular * fresnel_dielectric(cosine, std::max(eta, 1 / eta)).reflectance;
    facets += Color3f(opaque * layer);
  }
  if (glass > 0) {
    const Boundary boundary = fresnel_dielectric(cosine, m.thin ? std::max(eta, 1 / eta) : eta);
    float reflected = boundary.is_total ? 1 : m.specular * boundary.reflectance;
    if (m.thin) reflected = both_faces(reflected);
    facets += Color3f(glass * reflected);
    shares.through = glass * (1 - reflected) * m.color;
  }
  const float sharp = is_smooth(m.roughness) ? 1 : sharpness(m.roughness);
  (is_smooth(m.roughness) ? shares.mirror : shares.blurred_mirror) += sharp * facets;
  shares.ambient = opaque * (1 - layer) * m.color + (1 - sharp) * facets;
  return shares;
}

// Follows the reflected and the refracted ray, as far as they are worth it.
Color3f Recursion::look_on(const Sight& sight, const Surface& surface, const Shares& shares) {
  Color3f mirror = shares.mirror, blurred = shares.blurred_mirror, through = shares.through;
  const float reflects = largest(mirror + blurred), transmits = largest(through);
  bool goes_back = reflects * sight.weight > kLeastWeight,
       goes_through = transmits * sight.weight > kLeastWeight;
  const bool splits = goes_back && goes_through;
  if (splits && sight.splits >= kMostSplits) {  // the stronger stands for both
    const float all = (reflects + transmits) / std::max(reflects, transmits);
    mirror *= all;
    blurred *= all;
    through *= all;
    (reflects > transmits ? goes_through : goes_back) = false;
  }
  Sight next = sight;
  next.bounces_left = sight.bounces_left - 1;
  next.is_camera = false;
  next.splits = sight.splits + (splits ? 1 : 0);
  Color3f color(0);
  if (goes_back) {
    next.weight = sight.weight * std::min(1.0f, reflects);
    next.ray = reflected_ray(sight.ray, surface.point);
    const Seen seen = look(next);
    color += mirror * seen.color + blurred * (seen.color - seen.emitted);
  }
  if (goes_through) {
    const ShadingPoint& point = surface.point;
    next.weight = sight.weight * std::min(1.0f, transmits);
    Vector3f direction = -surface.out;
    if (has_inside(surface.own)) {
      direction = glm::refract(direction, point.shading_normal, surface.before / surface.behind);
      if (surface.is_outside) {
        next.media.enter({surface.own, surface.material});
      } else {
        next.media.leave(&surface.own);
      }
    }
    const float into = glm::dot(direction, point.normal);
    if (into >= 0) direction -= (into + 1e-3f) * point.normal;  // bent by a shading normal: along the surface
    next.ray = {point.position - surface.position_error * point.normal, direction};
    color += through * look(next).color;
  }
  return color;
}

}  // namespace raytracer
