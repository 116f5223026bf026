#include "integrators/path_tracer.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "core/hash.hpp"
#include "integrators/weights.hpp"
#include "scene/any_material.hpp"
#include "shapes/hit_block.hpp"
#include "textures/material_at.hpp"

namespace raytracer {
namespace {

// The pairs of PathPoints that each bounce takes, after those of the camera: for a light, a lobe and a
// light's number, a direction, the roulette.
constexpr std::uint32_t kCameraPairs = 2, kPairsPerBounce = 4, kRoulettePair = 3;

// Most of the noise of matt rooms is in where the first two directions and the light that is looked at after
// the first of them meet: the first direction is spread together with both of the others, which leaves a
// fifth less of it.
constexpr std::uint32_t kFirstDirection = kCameraPairs + 2;
constexpr std::array<bool, kPairsPerBounce> kAreCompanions = {true, false, true, false};  // at bounce 1

// From here on the roulette decides whether a path is worth following, once it is weaker than this. Matt
// rooms are a tenth more efficient than with 1 in its place. Where glass or mirrors gather light that only
// few paths find, these must not count for many: a fifth of the noise of such scenes is worth a tenth of the
// time.
constexpr int kFirstRoulette = 3;
constexpr float kWeak = 0.25F, kWeakNearGlass = 0.1F;

// Once it is stronger than this two go on in its place. That often at most, and not for long: what has come
// from rounding would multiply for ever.
constexpr float kStrong = 2;
constexpr std::uint8_t kMostSplits = 16;

// In a closed white room no light is ever lost: from here on the roulette ends even the strongest paths.
constexpr int kLong = 128;
constexpr float kMostSurvival = 0.98F;

// Of textures whose points wait for each other. Further ones are asked point by point.
constexpr std::size_t kMostGroups = 8;

float largest(const Color3f& c) { return std::max({c.x, c.y, c.z}); }

bool is_black(const Color3f& c) { return !(c.x > 0 || c.y > 0 || c.z > 0); }

// The weight of light that the material's choice, of density `chosen`, has met, and that the lights would
// have chosen with density `by_lights`.
float weight_of_met(Sampling sampling, float chosen, float by_lights) {
  if (sampling == Sampling::kMaterials || !(by_lights > 0)) return 1;
  return sampling == Sampling::kLights ? 0 : power_heuristic(chosen, by_lights);
}

bool is_hidden_light(const Material& material) { return !material.is_visible && material.is_area_light; }

bool is_cutout(const Material& material) {
  return material.alpha < 1 || (material.textures != nullptr && material.textures->alpha != nullptr);
}

// Whether it sends light on that no shadow ray can find.
bool gathers_light(const Material& material) {
  constexpr float kSmooth = 0.15F;
  const bool is_smooth_metal = material.metallic > 0 && material.roughness < kSmooth;
  const MaterialTextures* textures = material.textures.get();
  return material.transmission > 0 || material.shininess > 0 || is_smooth_metal ||
         (textures != nullptr && (textures->transmission || textures->shininess));
}

// Whether the ray meets the surface from behind.
bool leaves(const Scene& scene, const Ray3f& ray, const Hit& hit) {
  return glm::dot(scene.surface_at(ray, hit).normal, ray.direction) > 0;
}

// Not inlined, so that the shape writes the point where it is wanted: GCC else copies it, and waits for the
// stores of single floats that it reads eight at once.
[[gnu::noinline]] SurfacePoint surface_at(const Scene& scene, const Ray3f& ray, const Hit& hit) {
  return scene.surface_at(ray, hit);
}

// The inside of what the ray meets, with the values there.
Medium medium_at(const Scene& scene, const Ray3f& ray, const Hit& hit) {
  const Material& material = scene.material_of(hit);
  if (!varies(scene, material)) return {material, material};
  SurfacePoint surface = scene.surface_at(ray, hit);
  return {material, scene.textured(ray, hit, {}, surface)};
}

}  // namespace

// --- where the eye is
// ------------------------------------------------------------------------------------------

Media media_at(const Scene& scene, const Vector3f& position) {
  Media media;
  // Whatever the way out leaves without having entered it is around the point, the innermost first.
  constexpr int kMostSurfaces = 256;
  Media met;
  Ray3f ray{position, scene.camera().forward()};
  Hit hit;
  for (int i = 0; i < kMostSurfaces && scene.is_hit(ray, hit); ++i) {
    const Material* material = &scene.material_of(hit);
    if (has_inside(*material)) {
      if (!leaves(scene, ray, hit)) {
        met.enter({*material, *material});
      } else if (met.innermost() != nullptr) {
        met.leave(met.innermost()->material);
      } else {
        media.surround(medium_at(scene, ray, hit));
      }
    }
    ray.t_min = std::nextafter(hit.t, kInfinity);
    hit = Hit{};
  }
  return media;
}

PathWorld::PathWorld(const Scene& scene)
    : has_cutouts(any_material(scene.description(), is_cutout)),
      has_media(any_material(scene.description(), has_inside)),
      has_hidden_lights(any_material(scene.description(), is_hidden_light)),
      weak(any_material(scene.description(), gathers_light) ? kWeakNearGlass : kWeak) {
  if (has_media) media = media_at(scene, scene.camera().position());
}

// --- paths
// -----------------------------------------------------------------------------------------------------

struct PathTracer::Vertex {
  const Hit& hit;
  const Material& material;        // as the scene has it: tells media apart
  const MaterialValues* resolved;  // with its textures' values here
  SurfacePoint surface;
  Vector3f facing;         // the geometric normal on the side from which the ray came
  Vector3f out;            // unit length, back along the ray
  Vector3f light_side{0};  // lights are looked for on this side; 0: on both
  BsdfFrame frame{};

  Vector3f offset_position(const Vector3f& direction, const std::optional<float>& epsilon) const {
    const float offset = epsilon.value_or(surface.position_error);
    return surface.position + (glm::dot(direction, surface.normal) > 0 ? offset : -offset) * surface.normal;
  }
  // Where a ray to a light starts.
  Vector3f shadow_position(const Vector3f& direction, const std::optional<float>& epsilon) const {
    const bool is_reflected = glm::dot(direction, is_smooth() ? light_side : facing) > 0;
    if (!is_reflected) return offset_position(direction, epsilon);
    return surface.position + epsilon.value_or(surface.position_error) * facing + surface.shadow_offset;
  }

  // The media behind the surface that a ray goes through.
  void cross(const Vector3f& direction, Media& media) const {
    if (!has_inside(material)) return;
    if (glm::dot(direction, surface.normal) < 0) {
      media.enter({material, *resolved});
    } else {
      media.leave(&material);
    }
  }

  // Whether facets stand for a curved surface that lets no light through.
  bool is_smooth() const { return surface.shadow_offset != Vector3f(0) && light_side != Vector3f(0); }

  // What the light from a direction becomes. The curved surface is lit as far as its own normal says, facets
  // or not; where else the edge of the light would follow them. (No path goes on that way: the densities of
  // sample() and pdf() stay what they are.) `pdf` becomes the density of the direction.
  Color3f evaluate(const Bsdf& bsdf, const Vector3f& in, float& pdf) const {
    if (!is_smooth() || glm::dot(in, facing) > 0) return bsdf.evaluate(out, in, pdf);
    pdf = 0;
    BsdfFrame curved = frame;
    curved.geometric_normal = frame.normal;
    return Bsdf(*resolved, curved).evaluate(out, in);
  }
};

PathTracer::PathTracer(const Scene& scene, const PathSettings& settings, const PathPoints& points,
                       const PathWorld& world)
    : scene_(scene),
      settings_(settings),
      points_(points),
      media_(world.media),
      lights_(scene.lights()),
      has_cutouts_(world.has_cutouts),
      has_media_(world.has_media),
      has_hidden_lights_(world.has_hidden_lights),
      weak_(world.weak),
      groups_(kMostGroups) {}

void PathTracer::trace(std::span<const Ray3f> rays, std::span<const RayCone> cones,
                       std::span<const PathNumber> numbers, std::span<Color3f> colors) {
  colors_ = colors;
  cones_ = cones;
  std::ranges::fill(colors, Color3f(0));
  paths_.clear();
  paths_.resize(rays.size());
  numbers_.assign(numbers.begin(), numbers.end());
  for (std::uint32_t i = 0; i < rays.size(); ++i) {
    paths_[i].ray = rays[i];
    paths_[i].slot = i;
    if (!cones.empty()) paths_[i].spread = cones[i].spread;
  }
  if (has_media_) media_of_.assign(rays.size(), media_);
  for (int depth = 0; !paths_.empty(); ++depth) {
    find_hits(depth);
    drop_missed(depth);
    draw_points(depth);
    shade(depth);
  }
}

Footprint PathTracer::footprint_of(const Path& path, float distance, int depth) const {
  if (cones_.empty()) return {};
  return depth == 0 ? cones_[path.slot].footprint_at(distance) : path.spread.footprint_at(distance);
}

void PathTracer::draw_points(int depth) {
  const std::uint32_t first = kCameraPairs + kPairsPerBounce * static_cast<std::uint32_t>(depth);
  std::vector<Vector2f>* const pairs[kPairsPerBounce] = {&light_points_, &choice_points_, &scatter_points_,
                                                         &chance_points_};
  for (std::uint32_t i = 0; i < kPairsPerBounce; ++i) {
    pairs[i]->resize(paths_.size());
    if (i == kRoulettePair && depth < kFirstRoulette) continue;
    if (depth == 1 && kAreCompanions[i]) {
      points_.fill_companion(kFirstDirection, i, numbers_, *pairs[i]);
    } else {
      points_.fill(first + i, numbers_, *pairs[i]);
    }
  }
}

// Rays that have been scattered are asked for together with others that go into the same eighth of space;
// within it they keep their order, by which they are neighbours.
void PathTracer::order_rays(int depth) {
  const auto count = static_cast<std::uint32_t>(paths_.size());
  order_.resize(count);
  if (depth == 0) {
    for (std::uint32_t i = 0; i < count; ++i) order_[i] = i;
    return;
  }
  const auto octant = [&](std::uint32_t i) {
    const Vector3f& way = paths_[i].ray.direction;
    return static_cast<std::size_t>(way.x < 0) + 2 * static_cast<std::size_t>(way.y < 0) +
           4 * static_cast<std::size_t>(way.z < 0);
  };
  std::uint32_t ends[9]{};
  for (std::uint32_t i = 0; i < count; ++i) ++ends[octant(i) + 1];
  for (int k = 0; k < 8; ++k) ends[k + 1] += ends[k];
  for (std::uint32_t i = 0; i < count; ++i) order_[ends[octant(i)]++] = i;
}

// In packets throughout: the eye's rays go the same way, and even scattered ones gain a little.
void PathTracer::find_hits(int depth) {
  const std::size_t count = paths_.size();
  const Coherence coherence = depth == 0 ? Coherence::kCoherent : Coherence::kIncoherent;
  ray_count_ += count;
  hits_.resize(count);
  is_hit_.resize(count);
  order_rays(depth);
  RayBlock rays{};
  HitBlock hits;
  for (std::size_t first = 0; first < count; first += kBlockSize) {
    const std::size_t size = std::min<std::size_t>(kBlockSize, count - first);
    const std::uint32_t* const asked = order_.data() + first;
    for (std::size_t i = 0; i < size; ++i) rays.set(static_cast<int>(i), paths_[asked[i]].ray);
    const BlockMask found = scene_.is_hit(rays, BlockMask::first(size), hits, coherence);
    for (std::size_t i = 0; i < size; ++i) {
      is_hit_[asked[i]] = found.has(static_cast<int>(i)) ? 1 : 0;
      hits_[asked[i]] = hits.at(static_cast<int>(i));
    }
  }
  if (!has_cutouts_ && !(has_hidden_lights_ && depth == 0)) return;
  for (std::uint32_t i = 0; i < count; ++i) pass_through(paths_[i], i, depth);
}

// Those that hit nothing see the sky, and are done.
void PathTracer::drop_missed(int depth) {
  for (std::size_t i = 0; i < paths_.size(); ++i) {
    if (is_hit_[i] == 0) add_sky(paths_[i], depth);
  }
  keep_paths(is_hit_);
  goes_on_.resize(paths_.size());
}

// Closes the gaps that the others leave.
void PathTracer::keep_paths(const std::vector<std::uint8_t>& stays) {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < paths_.size(); ++i) {
    if (stays[i] == 0) continue;
    if (kept != i) move_path(i, kept);
    ++kept;
  }
  paths_.resize(kept);
  numbers_.resize(kept);
}

// Goes on along the ray behind whatever is not there for this path.
void PathTracer::pass_through(Path& path, std::uint32_t index, int depth) {
  constexpr std::uint32_t kMostPasses = 1000;
  for (std::uint32_t passes = 0; is_hit_[index] != 0 && is_passed(path, index, depth, passes); ++passes) {
    path.ray.t_min = std::nextafter(hits_[index].t, kInfinity);
    hits_[index] = Hit{};
    ++ray_count_;
    is_hit_[index] = passes < kMostPasses && scene_.is_hit(path.ray, hits_[index]) ? 1 : 0;
  }
}

bool PathTracer::is_passed(const Path& path, std::uint32_t index, int depth, std::uint32_t passes) const {
  const Hit& hit = hits_[index];
  const Material& material = scene_.material_of(hit);
  if (is_hidden_light(material) && depth == 0) return true;
  if (!has_cutouts_ || !is_cutout(material)) return false;
  // Who has come into glass by a hole sees none of it; who has come in through the glass sees all of it.
  if (has_inside(material) && leaves(scene_, path.ray, hit)) return !media_of_[index].contains(&material);
  const std::uint32_t bits = hash_bits(
      numbers_[index].reversed ^
      hash_bits(settings_.seed + 0x9E3779B9U * (static_cast<std::uint32_t>(depth) * 1024U + passes)));
  return unit_float(bits) >= scene_.alpha_at(path.ray, hit);
}

void PathTracer::shade(int depth) {
  waiting_.count = 0;
  constexpr std::size_t kAhead = 4;
  for (std::uint32_t i = 0; i < paths_.size(); ++i) {
    if (scene_.has_meshes() && i + kAhead < paths_.size()) scene_.prefetch(hits_[i + kAhead]);
    shade_hit(i, depth);
  }
  for (std::size_t i = 0; i < group_count_; ++i) {
    if (groups_[i].vertices.count > 0) shade_matt(groups_[i], depth);
  }
  group_count_ = 1;
  add_unoccluded();
  keep_paths(goes_on_);
  if (depth < kLong) split_strong();
}

// Of a path that stands for more than it began with two go on, each for half of it: where light is long on
// its way, as in rough diamonds, a few of them would else make up most of the picture.
void PathTracer::split_strong() {
  for (std::size_t i = 0; i < paths_.size(); ++i) {
    Path& path = paths_[i];
    const bool is_strong = largest(path.throughput) > kStrong * path.radiance_scale;
    if (!is_strong || path.splits == kMostSplits) continue;
    path.throughput *= 0.5F;
    ++path.splits;
    numbers_.push_back({hash_bits(numbers_[i].reversed + path.splits)});
    paths_.push_back(Path(path));  // `path` is gone after that
    if (has_media_) {
      media_of_.resize(paths_.size());
      media_of_.back() = media_of_[i];
    }
  }
}

// Where all that there is to a vertex is a matt surface, it waits for others like it.
void PathTracer::shade_hit(std::uint32_t index, int depth) {
  Path& path = paths_[index];
  const Hit& hit = hits_[index];
  const Material& material = scene_.material_of(hit);
  const SurfacePoint surface = raytracer::surface_at(scene_, path.ray, hit);
  const MaterialTextures* const textures = material.textures.get();
  MattGroup* group = textures == nullptr ? groups_.data() : group_of(*textures, path.spread.is_rough);
  const bool is_plain = !has_cutouts_ && depth < settings_.bounces && is_matt(material) &&
                        (group != nullptr || varies_in_color_alone(*textures)) && !material.is_emissive() &&
                        !material.is_area_light && !scene_.has_vertex_colors() &&
                        surface.shading_normal == surface.normal &&
                        (!has_media_ || media_of_[index].innermost() == nullptr);
  if (!is_plain) {
    goes_on_[index] = shade_any(path, material, surface, index, depth) ? 1 : 0;
    return;
  }
  Color3f color = material.color;
  if (textures != nullptr) {
    const bool may_wait =
        !cones_.empty() && (path.spread.is_rough || (depth == 0 && cones_[path.slot].is_one_of_many()));
    if (may_wait && group == nullptr) group = new_group(*textures, path.spread.is_rough);
    if (may_wait && group != nullptr) {
      ask_color(*group, path, hit);
    } else {
      const Footprint footprint = footprint_of(path, hit.t, depth);
      color = color_at(*textures->color, scene_.texture_point(path.ray, hit, footprint, surface));
      group = groups_.data();
    }
  }
  if (!cones_.empty()) path.spread = path.spread.at(hit.t);
  MattVertices& matt = group->vertices;
  const auto lane = static_cast<int>(matt.count);
  matt.add(index, surface, path.ray.direction);
  matt.offset[lane] = scene_.description().epsilon.value_or(surface.position_error);
  matt.color.set(lane, color);
  matt.throughput.set(lane, path.throughput);
  matt.lights.from.u[lane] = light_points_[index].x;
  matt.lights.from.v[lane] = light_points_[index].y;
  matt.lights.u_light[lane] = choice_points_[index].x;
  matt.u[lane] = scatter_points_[index].x;
  matt.v[lane] = scatter_points_[index].y;
  if (matt.count == MattVertices::kSize) shade_matt(*group, depth);
}

// Where the texture of its colour is asked, for the next vertex of the group.
void PathTracer::ask_color(MattGroup& group, const Path& path, const Hit& hit) {
  const auto lane = static_cast<int>(group.vertices.count);
  TextureQueries& queries = group.queries;
  if (queries.is_uv_asked) queries.set_detail(lane, scene_.detail_at(path.ray, hit));
  if (queries.is_rough) {
    queries.width[lane] = path.spread.at(hit.t).width;
  } else {
    queries.set_seen(lane, path.ray, hit.t, cones_[path.slot]);
  }
}

// Where vertices with such textures wait; null: not yet anywhere.
PathTracer::MattGroup* PathTracer::group_of(const MaterialTextures& textures, bool is_rough) {
  for (std::size_t i = 1; i < group_count_; ++i) {
    MattGroup& group = groups_[i];
    if (group.textures == &textures && group.queries.is_rough == is_rough) return &group;
  }
  return nullptr;
}

PathTracer::MattGroup* PathTracer::new_group(const MaterialTextures& textures, bool is_rough) {
  if (group_count_ == kMostGroups) return nullptr;
  MattGroup& group = groups_[group_count_++];
  group.textures = &textures;
  group.queries.is_rough = is_rough;
  group.queries.is_uv_asked = textures.color->asks_uv();
  return &group;
}

// Does for those that wait what shade_any() does for one.
void PathTracer::shade_matt(MattGroup& group, int depth) {
  MattVertices& matt = group.vertices;
  const auto count = static_cast<int>(matt.count);
  if (group.textures != nullptr) {
    group.queries.count = count;
    TextureBlock points;
    texture_points(group.queries, matt.position, matt.normal, points);
    colors_at(*group.textures->color, points, matt.color);
  }
  matt.lights.count = count;
  lights_.sample(matt.lights, light_samples_);
  matt.find_light(light_samples_, settings_.sampling);
  for (int i = 0; i < count; ++i) {
    if (matt.is_lit[i] == 0) continue;
    const LightSamples& to = light_samples_;
    LightSample light;
    light.is_far = to.is_far[i] != 0;
    light.direction = to.direction.at(i);
    light.target = to.target.at(i);
    let_wait(light.shadow_ray(matt.start.at(i)), matt.light.at(i), paths_[matt.path[i]].slot, nullptr, depth);
  }
  matt.scatter();
  for (int i = 0; i < count; ++i) {
    const std::uint32_t index = matt.path[i];
    Path& path = paths_[index];
    const Vector3f direction = matt.direction.at(i), position = matt.position.at(i);
    path.throughput = matt.throughput.at(i);
    path.pdf = matt.pdf[i];
    path.from = position;
    path.from_normal = matt.side[i] * matt.normal.at(i);
    path.ray = {position + matt.side[i] * matt.offset[i] * matt.normal.at(i), direction};
    if (!cones_.empty() && path.pdf > 0) path.spread.scatter(path.pdf);
    const float survival = path.pdf > 0 ? roulette(path, depth, chance_points_[index].x) : 0.0F;
    path.throughput *= survival;
    goes_on_[index] = survival > 0 ? 1 : 0;
  }
  matt.count = 0;
}

void PathTracer::move_path(std::size_t from, std::size_t to) {
  paths_[to] = paths_[from];
  numbers_[to] = numbers_[from];
  hits_[to] = hits_[from];
  if (has_media_) media_of_[to] = media_of_[from];
}

// The light of one vertex; false where the path ends there.
bool PathTracer::shade_any(Path& path, const Material& material, const SurfacePoint& surface,
                           std::uint32_t index, int depth) {
  const Hit& hit = hits_[index];
  Vertex vertex{hit, material, &material, surface, {}, {}, {}, {}};
  const float length = glm::length(path.ray.direction);
  vertex.out = -path.ray.direction / length;
  const bool is_outside = glm::dot(vertex.surface.normal, vertex.out) > 0;
  vertex.facing = is_outside ? vertex.surface.normal : -vertex.surface.normal;
  const float distance = hit.t * length;
  const Footprint arriving = footprint_of(path, distance, depth);
  path.spread = path.spread.at(distance);
  const Media* const media = has_media_ ? &media_of_[index] : nullptr;
  if (media != nullptr && media->innermost() != nullptr) {
    path.throughput *= glm::exp(-distance * media->innermost()->absorption);
  }
  if (media != nullptr && !is_outside && media->is_covered(&material)) {
    media_of_[index].leave(&material);
    path.ray = {vertex.offset_position(path.ray.direction, scene_.description().epsilon), path.ray.direction};
    return true;
  }
  std::optional<MaterialValues> textured;
  if (varies(scene_, material)) {
    // Light that could have been chosen is seen as it would have been: sharp.
    const bool is_sharp = path.pdf > 0 && material.is_emissive();
    const Footprint footprint = is_sharp ? Footprint{} : arriving;
    textured = scene_.textured(path.ray, hit, footprint, vertex.surface);
    if (media != nullptr && !is_outside) textured->ior = media->ior_of(&material, textured->ior);
    vertex.resolved = &*textured;
  }
  if (vertex.resolved->is_emissive()) add_emission(path, vertex, depth);
  if (material.is_area_light || depth >= settings_.bounces || is_black(path.throughput)) return false;

  // At a silhouette the shading normal may look away from the eye: it is turned back, just far enough.
  Vector3f shading = is_outside ? vertex.surface.shading_normal : -vertex.surface.shading_normal;
  constexpr float kLeastCosine = 0.01F;
  const float cosine = glm::dot(shading, vertex.out);
  if (cosine < kLeastCosine && shading != vertex.facing)
    shading = glm::normalize(shading + (kLeastCosine - cosine) * vertex.out);
  const bool is_smooth = vertex.surface.shadow_offset != Vector3f(0);
  if (!(vertex.resolved->transmission > 0)) vertex.light_side = is_smooth ? shading : vertex.facing;

  BsdfFrame& frame = vertex.frame;
  frame.geometric_normal = vertex.surface.normal;
  frame.normal = is_outside ? shading : -shading;
  if (material.anisotropy != 0) frame.tangent = scene_.detail_at(path.ray, hit).along_u;
  frame.ior_inside = vertex.resolved->ior;
  if (media != nullptr) {
    const bool is_leaving = has_inside(material) && !is_outside;
    frame.ior_outside = is_leaving ? media->ior_without(&material) : media->ior();
  }
  const Bsdf bsdf(*vertex.resolved, frame);
  if (!bsdf.is_delta()) add_direct_light(path, vertex, bsdf, index, depth);
  return scatter(path, vertex, bsdf, index, depth);
}

void PathTracer::add_sky(const Path& path, int depth) {
  const SceneDescription& scene = scene_.description();
  if (scene.sky == nullptr || (depth == 0 && !scene.is_sky_visible)) {
    add(path.slot, path.throughput * scene.background, depth);
    return;
  }
  const Vector3f direction = glm::normalize(path.ray.direction);
  float weight = 1;
  if (path.pdf > 0) {
    weight =
        weight_of_met(settings_.sampling, path.pdf, lights_.sky_pdf(path.from, path.from_normal, direction));
  }
  add(path.slot, weight * path.throughput * scene.sky->radiance(direction), depth);
}

void PathTracer::add_emission(const Path& path, const Vertex& vertex, int depth) {
  if (vertex.resolved->is_area_light && glm::dot(vertex.surface.normal, vertex.out) <= 0) return;
  float weight = 1;
  if (path.pdf > 0) {
    weight = weight_of_met(settings_.sampling, path.pdf,
                           lights_.pdf(path.from, path.from_normal, vertex.hit, vertex.surface));
  }
  add(path.slot, weight * path.throughput * vertex.resolved->emission, depth);
}

// Looks at one light, chosen by what it may contribute.
void PathTracer::add_direct_light(const Path& path, const Vertex& vertex, const Bsdf& bsdf,
                                  std::uint32_t index, int depth) {
  LightSample light;
  if (!lights_.sample(vertex.surface.position, vertex.light_side, choice_points_[index].x,
                      light_points_[index], light)) {
    return;
  }
  if (settings_.sampling == Sampling::kMaterials && !light.is_delta) return;
  float chosen = 0;  // the density with which the material would have
  const Color3f value = vertex.evaluate(bsdf, light.direction, chosen);
  if (is_black(value) || !(light.pdf > 0)) return;
  float weight = 1;
  if (!light.is_delta && settings_.sampling == Sampling::kBoth) {
    weight = power_heuristic(light.pdf, chosen);
  }
  Media media;
  if (has_cutouts_ && has_media_) {
    media = media_of_[index];
    if (glm::dot(light.direction, vertex.facing) < 0) vertex.cross(light.direction, media);
  }
  // Multiplied in this order nothing overflows that is not too large itself.
  let_wait(light.shadow_ray(vertex.shadow_position(light.direction, scene_.description().epsilon)),
           path.throughput * value * (weight / light.pdf) * light.radiance, path.slot, &media, depth);
}

// Until there is a packet of shadow rays; `media` may be null where there are no cut-outs.
void PathTracer::let_wait(const Ray3f& ray, Color3f light, std::uint32_t slot, const Media* media,
                          int depth) {
  if (depth > 0 && settings_.clamp_indirect > 0) {
    const float most = largest(light);
    if (most > settings_.clamp_indirect) light *= settings_.clamp_indirect / most;
  }
  const std::size_t i = waiting_.count++;
  waiting_.rays.set(static_cast<int>(i), ray);
  waiting_.light[i] = light;
  waiting_.slot[i] = slot;
  if (has_cutouts_ && media != nullptr) waiting_.media[i] = *media;
  if (waiting_.count == kBlockSize) add_unoccluded();
}

// Chooses where the path goes on; false where it ends.
bool PathTracer::scatter(Path& path, const Vertex& vertex, const Bsdf& bsdf, std::uint32_t index, int depth) {
  BsdfSample sample;
  if (!bsdf.sample(vertex.out, choice_points_[index].y, scatter_points_[index], sample)) return false;
  path.throughput *= sample.weight;
  path.pdf = sample.is_delta ? 0 : sample.pdf;
  path.from = vertex.surface.position;
  path.from_normal = vertex.light_side;
  path.ray = {vertex.offset_position(sample.direction, scene_.description().epsilon), sample.direction};
  if (!sample.is_delta && !cones_.empty()) path.spread.scatter(sample.pdf);
  if (sample.is_transmission && has_inside(vertex.material)) {
    Media& media = media_of_[index];
    const float before = media.ior();
    vertex.cross(sample.direction, media);
    const float ratio = before / media.ior();
    path.radiance_scale *= ratio * ratio;
  }
  const float survival = roulette(path, depth, chance_points_[index].x);
  path.throughput *= survival;
  return survival > 0;
}

// By what a path that goes on stands for those that don't; 0 for one of these. Compares with what the path
// began with, never with an amount of light; radiance that a refraction has compressed comes back when it
// leaves.
float PathTracer::roulette(const Path& path, int depth, float u) const {
  const float strength = largest(path.throughput);
  if (!(strength > 0) || !(strength < kInfinity)) return 0;
  if (depth < kFirstRoulette) return 1;
  const float most = depth < kLong ? 1.0F : kMostSurvival;
  const float survival = std::min(strength / (weak_ * path.radiance_scale), most);
  if (survival >= 1) return 1;
  return u < survival ? 1 / survival : 0;
}

void PathTracer::add(std::uint32_t slot, Color3f light, int depth) {
  const float most = largest(light);
  if (!(most < kInfinity) || !(glm::dot(light, Color3f(1)) >= 0)) return;  // no NaN ever reaches the picture
  if (depth > 1 && settings_.clamp_indirect > 0 && most > settings_.clamp_indirect) {
    light *= settings_.clamp_indirect / most;
  }
  colors_[slot] += light;
}

void PathTracer::add_unoccluded() {
  const std::size_t count = waiting_.count;
  waiting_.count = 0;
  if (count == 0) return;
  ray_count_ += count;
  if (has_cutouts_) {
    for (std::size_t i = 0; i < count; ++i) {
      add(waiting_.slot[i],
          share_seen(waiting_.rays.ray(static_cast<int>(i)), waiting_.media[i]) * waiting_.light[i], 0);
    }
    return;
  }
  const BlockMask hidden = scene_.is_occluded(waiting_.rays, BlockMask::first(count), Coherence::kIncoherent);
  for (std::size_t i = 0; i < count; ++i) {
    if (!hidden.has(static_cast<int>(i))) add(waiting_.slot[i], waiting_.light[i], 0);
  }
}

// How much of the light along a shadow ray the cut-outs in its way let pass; `media` are around its origin.
float PathTracer::share_seen(Ray3f ray, const Media& media) const {
  constexpr int kMostSurfaces = 1000;
  float share = 1;
  Hit hit;
  for (int i = 0; i < kMostSurfaces && scene_.is_hit(ray, hit); ++i) {
    const Material& material = scene_.material_of(hit);
    if (!is_cutout(material)) return 0;
    if (has_inside(material) && leaves(scene_, ray, hit)) {
      if (media.contains(&material)) return 0;
    } else {
      share *= 1 - scene_.alpha_at(ray, hit);
    }
    if (!(share > 0)) return 0;
    ray.t_min = std::nextafter(hit.t, kInfinity);
    hit = Hit{};
  }
  return share;
}

}  // namespace raytracer
