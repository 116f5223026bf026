#include "scene/light_set.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "core/numeric.hpp"
#include "lights/illuminate.hpp"
#include "lights/light_tree.hpp"
#include "scene/placed_surface.hpp"
#include "shapes/parallelogram.hpp"
#include "textures/material_at.hpp"

namespace raytracer {

namespace {

constexpr std::uint32_t kNone = 0xFFFFFFFF;
/// lambda/255 is what a white Lambert surface returns of a light; the irradiance is pi times that.
constexpr float kIrradianceOfLambda = static_cast<float>(kPi) / 255;

float largest(const Color3f& c) { return std::max({c.x, c.y, c.z}); }

bool is_finite(const Color3f& c) { return raytracer::is_finite(Vector3d(c)); }

/// Where an instance stands.
struct Placement {
  glm::dmat3 to_world, to_own;
  Vector3d translation;
  double volume_scale;
  glm::mat3 normal_to_own;  // for the sign alone: the transpose of to_world

  explicit Placement(const Instance& instance)
      : to_world(instance.linear),
        to_own(glm::inverse(to_world)),
        translation(instance.translation),
        volume_scale(std::abs(glm::determinant(to_world))),
        normal_to_own(glm::transpose(instance.linear)) {}

  Vector3f point_to_own(const Vector3f& world) const {
    return Vector3f(to_own * (Vector3d(world) - translation));
  }
  Vector3f normal_in_own(const Vector3f& world) const {
    const Vector3f own = normal_to_own * world;
    const float length = glm::length(own);
    return length > 0 ? own / length : Vector3f(0);
  }
  /// A cone of directions around the way from `from` to `to` (own space) is that much narrower in the world:
  /// |M w|^3 / |det M| for the unit vector w.
  double density_scale(const Vector3f& from, const Vector3f& to) const {
    const Vector3d way = Vector3d(to) - Vector3d(from);
    const double length = glm::length(way);
    if (!(length > 0)) return 0;
    const double stretch = glm::length(to_world * way) / length;
    return stretch * stretch * stretch / volume_scale;
  }
};

/// A shape that shines, in the space it is stored in.
struct ShiningShape {
  const Shape* shape = nullptr;
  const Material* material = nullptr;
  LightTree parts;      // empty where there is one part only
  LightItem item;       // of it all; its strength is that of radiance 1
  Color3f radiance{0};  // of a texture: its mean
  bool is_textured = false;
  bool is_one_sided = false;
};

/// A shape that shines, in one place.
struct Emitter {
  std::uint32_t shining;
  std::uint32_t placement;  // kNone: where it is stored
};

double seen_share(const LightCone& cone) {
  // A quarter of a convex body's surface is its mean silhouette.
  return 0.25 + 0.75 * std::max(0.0, static_cast<double>(cone.cos_spread));
}

/// The mean of what textures let shine, over the unit square of uv; never 0 in all channels, since it may
/// shine where it was not asked.
Color3f mean_of(const Material& material, const Box3f& bounds) {
  constexpr int kSide = 8;
  Color3f sum(0), most(0);
  TexturePoint point;
  point.uv_dx = {1.0F / kSide, 0};
  point.uv_dy = {0, 1.0F / kSide};
  for (int i = 0; i < kSide * kSide; ++i) {
    const Vector2f share((static_cast<float>(i % kSide) + 0.5F) / kSide,
                         (static_cast<float>(i / kSide) + 0.5F) / kSide);
    point.uv = share;
    point.position = bounds.lower + Vector3f(share.x, share.y, share.x) * bounds.diagonal();
    const Color3f value = emitted_at(material, point);
    sum += value / static_cast<float>(kSide * kSide);
    most = glm::max(most, value);
  }
  if (!(largest(most) > 0)) return Color3f(1e-6F);
  return glm::max(sum, 1e-3F * most);
}

LightItem item_of_part(const PartExtent& extent, bool is_one_sided, float back) {
  LightItem item;
  item.bounds = extent.bounds;
  item.cone = {extent.axis, extent.cos_spread, 0, is_one_sided ? 0.0F : back};
  item.strength[static_cast<std::size_t>(Falloff::kQuadratic)] =
      static_cast<double>(extent.area) * seen_share(item.cone);
  return item;
}

/// False where it shines nowhere.
bool gather_shape(const Shape& shape, const Material& material, ShiningShape& shining) {
  const std::uint32_t count = shape.part_count();
  if (count == 0 || !material.is_emissive()) return false;
  shining.shape = &shape;
  shining.material = &material;
  shining.is_textured =
      material.textures != nullptr && (material.textures->emission || material.textures->alpha);
  shining.is_one_sided = material.is_area_light;
  shining.radiance =
      shining.is_textured ? mean_of(material, shape.bounds()) : emitted_at(material, TexturePoint{});
  if (!is_finite(shining.radiance) || !(largest(shining.radiance) > 0)) return false;

  if (count == 1) {
    shining.item = item_of_part(shape.part_extent(0), shining.is_one_sided, 1);
  } else {
    // Of a body of several parts the far side of each is likely inside.
    constexpr float kInside = 0.25F;
    std::vector<LightItem> parts;
    parts.reserve(count);
    double strength = 0;
    for (std::uint32_t i = 0; i < count; ++i) {
      parts.push_back(item_of_part(shape.part_extent(i), shining.is_one_sided, kInside));
      strength += parts.back().strength[static_cast<std::size_t>(Falloff::kQuadratic)];
    }
    shining.parts = LightTree(parts);
    if (shining.parts.is_empty()) return false;
    shining.item.bounds = shape.bounds();
    shining.item.cone = shining.parts.cone();
    shining.item.cone.back = shining.is_one_sided ? 0.0F : 1.0F;
    // Each part's share of itself that is seen is in already but for the sides that all of them turn away.
    shining.item.strength[static_cast<std::size_t>(Falloff::kQuadratic)] =
        strength * seen_share(shining.item.cone);
  }
  const double strength = shining.item.strength[static_cast<std::size_t>(Falloff::kQuadratic)];
  return strength > 0 && std::isfinite(strength);
}

/// The item in the world, its strength that of the shape's radiance.
LightItem item_of(const ShiningShape& shining, const Instance* instance, const Placement* placement) {
  LightItem item = shining.item;
  double scale = static_cast<double>(largest(shining.radiance));
  if (placement != nullptr) {
    item.bounds = instance->bounds(item.bounds);
    const double volume = placement->volume_scale;
    const glm::dmat3 normals = glm::transpose(placement->to_own);
    const Vector3d axis = normals * Vector3d(item.cone.axis);
    const double length = glm::length(axis);
    // Turned and scaled alike in all directions a cone stays one; so does a single direction, whatever is
    // done to it.
    const glm::dmat3 square = glm::transpose(placement->to_world) * placement->to_world;
    const double side = std::cbrt(volume * volume);
    double skew = 0;
    for (int i = 0; i < 3; ++i) {
      for (int k = 0; k < 3; ++k) skew = std::max(skew, std::abs(square[i][k] - (i == k ? side : 0)));
    }
    const bool keeps_angles = skew < 1e-5 * side;
    item.cone.axis = length > 0 ? Vector3f(axis / length) : Vector3f(0, 1, 0);
    if (!keeps_angles && item.cone.cos_spread < 1) item.cone.cos_spread = -1;
    scale *= item.cone.cos_spread >= 1 ? volume * length : side;
  }
  for (double& strength : item.strength) strength *= scale;
  return item;
}

LightItem item_of(const Light& light) {
  LightItem item;
  item.bounds.extend(light.position);
  item.strength[static_cast<std::size_t>(light.falloff)] =
      static_cast<double>(kIrradianceOfLambda) * static_cast<double>(largest(light.lambda));
  if (light.kind == Light::Kind::kSpot) {
    const double outer = std::acos(std::clamp(static_cast<double>(light.cos_outer), -1.0, 1.0));
    const double inner =
        std::min(std::acos(std::clamp(static_cast<double>(light.cos_inner), -1.0, 1.0)), outer);
    item.cone = {light.direction, static_cast<float>(std::cos(inner)),
                 static_cast<float>(std::cos(outer - inner)), 0};
  }
  return item;
}

bool is_worth_it(const Light& light) { return is_finite(light.lambda) && largest(light.lambda) > 0; }

/// A number in [0, 1) with more digits than a float has: the rest from a hash of what is chosen
/// independently, so that of a million lights none is left out.
double refined(float u, const Vector2f& other) {
  std::uint32_t bits = std::bit_cast<std::uint32_t>(other.x) * 0x9E3779B1U;
  bits = (bits ^ bits >> 15) + std::bit_cast<std::uint32_t>(other.y) * 0x85EBCA77U;
  bits = (bits ^ bits >> 13) * 0xC2B2AE3DU;
  bits ^= bits >> 16;
  return std::min(static_cast<double>(u) + static_cast<double>(bits) * 0x1p-32 * 0x1p-24, 1 - 0x1p-53);
}

/// Where the shadow ray ends that comes from there: it must stay clear of the bound at the surface, and of
/// the rounding of a ray of this length.
Vector3f off_surface(const Vector3f& position, float position_error, const Vector3f& normal,
                     const Vector3f& from) {
  const Vector3f way = from - position;
  const float side = glm::dot(way, normal) < 0 ? -1.0F : 1.0F;
  const float rounding = 4 * static_cast<float>(kFloatRounding) * glm::dot(glm::abs(way), glm::abs(normal));
  return position + side * (position_error + rounding) * normal;
}

constexpr float kLeastDensity = 1e-30F;  // the reciprocal stays in range

/// Of all rooms the plainest, lit by one quad alone.
struct OnlyQuad {
  const shapes::Parallelogram* face = nullptr;
  float position_error = 0;
  Vector3f normal{0};
  Color3f radiance{0};
  bool is_one_sided = false;

  void sample(const LightQueries& queries, LightSamples& samples) const;
};

// As Parts::sample_emitter() does it.
void OnlyQuad::sample(const LightQueries& queries, LightSamples& samples) const {
  shapes::PlacesSeen seen;
  face->choose(queries.from, seen);
  LightSamples found;
  const OnlyQuad quad = *this;
  for (int i = 0; i < kBlockSize; ++i) {
    const Vector3f from = queries.from.position.at(i), position = seen.position.at(i);
    const Vector3f way = position - from;
    const float distance = glm::length(way);
    const Vector3f direction = way / distance;
    const Vector3f target = off_surface(position, quad.position_error, quad.normal, from);
    const bool is_seen = !quad.is_one_sided | (glm::dot(quad.normal, way) < 0);
    const float pdf = ((distance > 0) & (distance < kInfinity) & is_seen) ? seen.pdf[i] : 0.0F;
    found.direction.set(i, direction);
    found.target.set(i, target);
    found.radiance.set(i, quad.radiance);
    found.pdf[i] = pdf > kLeastDensity ? pdf : 0.0F;
    found.is_far[i] = found.is_delta[i] = 0;
  }
  samples = found;
}

}  // namespace

struct LightSet::Parts {
  std::vector<ShiningShape> shapes;
  std::vector<Placement> placements;
  std::vector<Emitter> emitters;
  std::vector<Light> local;  // point and spot lights; in the tree they follow the emitters
  LightTree tree;
  std::vector<Light> distant;
  std::vector<double> distant_sums;  // of their strengths, as shares of all: the last is 1
  const Environment* sky = nullptr;
  OnlyQuad only_quad;  // of nothing else; its face is null where there is more, or something else

  // The way from a hit to its emitter: emitter = start + rank of the shape.
  std::vector<std::uint32_t> emitter_of_shape;   // of the scene's own shapes; kNone
  std::vector<std::uint32_t> start_of_instance;  // kNone
  std::vector<std::uint32_t> variant_of_instance;
  std::vector<std::vector<std::uint32_t>> rank_in_variant;  // per shared shapes and shape; empty: none shines

  explicit Parts(const SceneDescription& scene);

  void gather_own(const SceneDescription& scene, std::vector<LightItem>& items);
  void gather_instances(const SceneDescription& scene, std::vector<LightItem>& items);
  void gather_lights(const SceneDescription& scene, std::vector<LightItem>& items);
  void look_for_only_quad();

  const Placement* placement_of(const Emitter& emitter) const {
    return emitter.placement == kNone ? nullptr : &placements[emitter.placement];
  }
  std::uint32_t emitter_of(const Hit& hit) const;

  /// The shares of the three kinds; those that are not there, or can't reach the side of the normal, have
  /// none.
  struct Shares {
    float tree = 0, distant = 0, sky = 0;
  };
  Shares shares(const Vector3f& normal) const;

  bool sample_emitter(const Emitter& emitter, const Vector3f& position, const Vector3f& normal, double u_part,
                      const Vector2f& u, LightSample& sample) const;
  bool sample_local(const Light& light, const Vector3f& position, LightSample& sample) const;
  bool sample_distant(const Vector3f& normal, double u, LightSample& sample, double& probability) const;
};

// --- gathering
// -----------------------------------------------------------------------------------------------

LightSet::Parts::Parts(const SceneDescription& scene) {
  std::vector<LightItem> items;
  gather_own(scene, items);
  gather_instances(scene, items);
  gather_lights(scene, items);
  tree = LightTree(items);
  if (scene.sky != nullptr && !scene.sky->is_constant()) sky = scene.sky.get();
  look_for_only_quad();
}

void LightSet::Parts::look_for_only_quad() {
  if (emitters.size() != 1 || !local.empty() || !distant.empty() || sky != nullptr || tree.is_empty()) return;
  const ShiningShape& shining = shapes[emitters[0].shining];
  const shapes::Parallelogram* face = shining.shape->as_parallelogram();
  if (face == nullptr || emitters[0].placement != kNone || shining.is_textured) return;
  // What every point of it has in common, by any of them.
  const Vector3f above = Vector3f(face->at({0.5, 0.5}) + face->normal * std::sqrt(face->area()));
  ShapeSample point;
  if (!shining.shape->sample_part(0, above, Vector2f(0.5F), point)) return;
  only_quad = {face, point.position_error, point.normal, shining.radiance, shining.is_one_sided};
}

void LightSet::Parts::gather_own(const SceneDescription& scene, std::vector<LightItem>& items) {
  emitter_of_shape.assign(scene.shapes.size(), kNone);
  for (std::size_t i = 0; i < scene.shapes.size(); ++i) {
    ShiningShape shining;
    const Material& material = scene.materials[scene.material_of[i]];
    if (!material.is_emissive() || !gather_shape(*scene.shapes[i], material, shining)) continue;
    emitter_of_shape[i] = static_cast<std::uint32_t>(emitters.size());
    emitters.push_back({static_cast<std::uint32_t>(shapes.size()), kNone});
    items.push_back(item_of(shining, nullptr, nullptr));
    shapes.push_back(std::move(shining));
  }
}

// Instances of the same shapes with the same material in place of the shapes' own shine alike: one variant.
void LightSet::Parts::gather_instances(const SceneDescription& scene, std::vector<LightItem>& items) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> variants;
  std::vector<std::vector<std::uint32_t>> shining_of;
  const auto add_variant = [&](std::uint32_t i) {
    const SharedShapes& shared = *scene.shared[scene.instances[i].shared];
    std::vector<std::uint32_t>& shining_here = shining_of.emplace_back();
    std::vector<std::uint32_t>& rank = rank_in_variant.emplace_back();
    for (std::uint32_t k = 0; k < shared.size(); ++k) {
      const Material& material = scene.material(i, k);
      ShiningShape shining;
      if (!material.is_emissive() || !gather_shape(shared.shape(k), material, shining)) continue;
      if (rank.empty()) rank.assign(shared.size(), kNone);
      rank[k] = static_cast<std::uint32_t>(shining_here.size());
      shining_here.push_back(static_cast<std::uint32_t>(shapes.size()));
      shapes.push_back(std::move(shining));
    }
  };
  start_of_instance.assign(scene.instances.size(), kNone);
  variant_of_instance.resize(scene.instances.size());
  for (std::uint32_t i = 0; i < scene.instances.size(); ++i) {
    const Instance& instance = scene.instances[i];
    const auto [known, is_new] = variants.try_emplace({instance.shared, instance.material},
                                                      static_cast<std::uint32_t>(shining_of.size()));
    if (is_new) add_variant(i);
    variant_of_instance[i] = known->second;
    if (shining_of[known->second].empty()) continue;
    std::uint32_t placement = kNone;
    if (!instance.is_identity()) {
      const Placement where(instance);
      if (!(where.volume_scale > 0) || !std::isfinite(where.volume_scale)) continue;
      placement = static_cast<std::uint32_t>(placements.size());
      placements.push_back(where);
    }
    start_of_instance[i] = static_cast<std::uint32_t>(emitters.size());
    for (const std::uint32_t shining : shining_of[known->second]) {
      emitters.push_back({shining, placement});
      items.push_back(
          item_of(shapes[shining], &instance, placement == kNone ? nullptr : &placements[placement]));
    }
  }
}

void LightSet::Parts::gather_lights(const SceneDescription& scene, std::vector<LightItem>& items) {
  double strongest = 0, sum = 0;
  for (const Light& light : scene.lights) {
    if (!is_worth_it(light)) continue;
    if (light.kind == Light::Kind::kDirectional) {
      distant.push_back(light);
      strongest = std::max(strongest, static_cast<double>(largest(light.lambda)));
    } else {
      local.push_back(light);
      items.push_back(item_of(light));
    }
  }
  // As in the tree, the weakest keep a share that a float can tell.
  constexpr double kLeastShare = 1e-12;
  for (const Light& light : distant) {
    sum += std::max(static_cast<double>(largest(light.lambda)) / strongest, kLeastShare);
    distant_sums.push_back(sum);
  }
  for (double& one : distant_sums) one /= sum;
}

// --- asking
// --------------------------------------------------------------------------------------------------

std::uint32_t LightSet::Parts::emitter_of(const Hit& hit) const {
  if (hit.instance == kNoInstance) return emitter_of_shape[hit.shape];
  const std::uint32_t start = start_of_instance[hit.instance];
  if (start == kNone) return kNone;
  const std::uint32_t rank = rank_in_variant[variant_of_instance[hit.instance]][hit.shape];
  return rank == kNone ? kNone : start + rank;
}

LightSet::Parts::Shares LightSet::Parts::shares(const Vector3f& normal) const {
  Shares all;
  all.tree = tree.is_empty() ? 0.0F : 1.0F;
  all.sky = sky == nullptr ? 0.0F : 1.0F;
  if (!distant.empty()) {
    // One of them is asked whether it reaches this side; of many some will.
    const bool reaches =
        distant.size() > 1 || normal == Vector3f(0) || glm::dot(distant[0].direction, normal) < 0;
    all.distant = reaches ? 1.0F : 0.0F;
  }
  const float sum = all.tree + all.sky + all.distant;
  if (sum > 1) {
    all.tree /= sum;
    all.sky /= sum;
    all.distant /= sum;
  }
  return all;
}

bool LightSet::Parts::sample_emitter(const Emitter& emitter, const Vector3f& position, const Vector3f& normal,
                                     double u_part, const Vector2f& u, LightSample& sample) const {
  const ShiningShape& shining = shapes[emitter.shining];
  const Placement* placement = placement_of(emitter);
  const Vector3f from = placement != nullptr ? placement->point_to_own(position) : position;

  std::uint32_t part = 0;
  double probability = 1;
  if (!shining.parts.is_empty()) {
    const Vector3f own_normal = placement != nullptr ? placement->normal_in_own(normal) : normal;
    if (!shining.parts.choose(from, own_normal, u_part, part, probability)) return false;
  }
  ShapeSample chosen;
  if (!shining.shape->sample_part(part, from, u, chosen)) return false;
  if (shining.is_one_sided && glm::dot(chosen.normal, from - chosen.position) <= 0) return false;

  SurfacePoint point;
  point.position = chosen.position;
  point.position_error = chosen.position_error;
  point.normal = point.shading_normal = chosen.normal;
  double density = probability * static_cast<double>(chosen.pdf);
  if (placement != nullptr) {
    density *= placement->density_scale(from, chosen.position);
    point = placed_surface(point, placement->to_world, placement->to_own, placement->translation);
  }
  const Vector3f way = point.position - position;
  const float distance = glm::length(way);
  if (!(distance > 0 && distance < kInfinity)) return false;
  sample.direction = way / distance;
  sample.target = off_surface(point.position, point.position_error, point.normal, position);
  sample.radiance = shining.radiance;
  sample.pdf = static_cast<float>(density);
  if (shining.is_textured) {
    Hit hit;
    hit.t = 1;
    hit.primitive = part;
    hit.u = chosen.u;
    hit.v = chosen.v;
    TexturePoint asked;
    asked.uv = shining.shape->detail_at({from, chosen.position - from}, hit).uv;
    asked.position = point.position;
    asked.normal = point.normal;
    sample.radiance = emitted_at(*shining.material, asked);
  }
  return true;
}

bool LightSet::Parts::sample_local(const Light& light, const Vector3f& position, LightSample& sample) const {
  const Vector3f way = light.position - position;
  const float distance = glm::length(way);
  if (!(distance > 0 && distance < kInfinity)) return false;
  sample.direction = way / distance;
  sample.target = light.position;
  sample.is_delta = true;
  float strength = kIrradianceOfLambda * lights::fade(light.falloff, distance);
  if (light.kind == Light::Kind::kSpot) {
    strength *= lights::cone_share(light, -glm::dot(sample.direction, light.direction));
  }
  sample.radiance = strength * light.lambda;
  sample.pdf = 1;
  return strength > 0;
}

bool LightSet::Parts::sample_distant(const Vector3f& normal, double u, LightSample& sample,
                                     double& probability) const {
  const auto at = std::upper_bound(distant_sums.begin(), distant_sums.end() - 1, u);
  const auto index = static_cast<std::size_t>(at - distant_sums.begin());
  probability *= distant_sums[index] - (index > 0 ? distant_sums[index - 1] : 0);
  const Light& light = distant[index];
  if (normal != Vector3f(0) && !(glm::dot(light.direction, normal) < 0)) return false;
  sample.direction = -light.direction;
  sample.is_far = true;
  sample.is_delta = true;
  sample.radiance = kIrradianceOfLambda * light.lambda;
  sample.pdf = 1;
  return true;
}

LightSet::LightSet(const SceneDescription& scene) : parts_(std::make_unique<Parts>(scene)) {}

LightSet::~LightSet() = default;

bool LightSet::is_empty() const {
  return parts_->tree.is_empty() && parts_->distant.empty() && parts_->sky == nullptr;
}

bool LightSet::sample(const Vector3f& position, const Vector3f& normal, float u_light, const Vector2f& u,
                      LightSample& sample) const {
  const Parts::Shares shares = parts_->shares(normal);
  double choice = refined(u_light, u);
  double probability = 1;
  sample = {};
  const auto takes = [&](float share) {
    if (choice < static_cast<double>(share)) {
      choice /= static_cast<double>(share);
      probability = static_cast<double>(share);
      return true;
    }
    choice -= static_cast<double>(share);
    return false;
  };
  if (takes(shares.tree)) {
    std::uint32_t item = 0;
    double chosen = 1;
    if (!parts_->tree.choose(position, normal, choice, item, chosen)) return false;
    probability *= chosen;
    const auto emitters = static_cast<std::uint32_t>(parts_->emitters.size());
    if (item >= emitters) {
      if (!parts_->sample_local(parts_->local[item - emitters], position, sample)) return false;
    } else if (!parts_->sample_emitter(parts_->emitters[item], position, normal, choice, u, sample)) {
      return false;
    }
  } else if (takes(shares.distant)) {
    if (!parts_->sample_distant(normal, choice, sample, probability)) return false;
  } else if (shares.sky > 0) {
    probability = static_cast<double>(shares.sky);
    if (!parts_->sky->sample(u, sample.direction, sample.pdf)) return false;
    sample.is_far = true;
    sample.radiance = parts_->sky->radiance(sample.direction);
  } else {
    return false;
  }
  sample.pdf = static_cast<float>(static_cast<double>(sample.pdf) * probability);
  return sample.pdf > kLeastDensity && sample.pdf < kInfinity;
}

void LightSet::sample(const LightQueries& queries, LightSamples& samples) const {
  if (parts_->only_quad.face != nullptr) return parts_->only_quad.sample(queries, samples);
  const shapes::PlacesToSeeFrom& from = queries.from;
  for (int i = 0; i < queries.count; ++i) {
    LightSample one;
    const bool is_chosen =
        sample(from.position.at(i), queries.normal.at(i), queries.u_light[i], {from.u[i], from.v[i]}, one);
    samples.direction.set(i, one.direction);
    samples.target.set(i, one.target);
    samples.radiance.set(i, one.radiance);
    samples.pdf[i] = is_chosen ? one.pdf : 0.0F;
    samples.is_far[i] = one.is_far ? 1 : 0;
    samples.is_delta[i] = one.is_delta ? 1 : 0;
  }
}

float LightSet::pdf(const Vector3f& position, const Vector3f& normal, const Hit& hit,
                    const SurfacePoint& point) const {
  const std::uint32_t index = parts_->emitter_of(hit);
  if (index == kNone) return 0;
  const double share = static_cast<double>(parts_->shares(normal).tree);
  double density = share * parts_->tree.probability(position, normal, index);
  const Emitter& emitter = parts_->emitters[index];
  const ShiningShape& shining = parts_->shapes[emitter.shining];
  const Placement* placement = parts_->placement_of(emitter);
  if (placement == nullptr) {
    if (!shining.parts.is_empty()) density *= shining.parts.probability(position, normal, hit.primitive);
    return static_cast<float>(density *
                              static_cast<double>(shining.shape->part_pdf(hit.primitive, position, point)));
  }
  const Vector3f from = placement->point_to_own(position);
  if (!shining.parts.is_empty()) {
    density *= shining.parts.probability(from, placement->normal_in_own(normal), hit.primitive);
  }
  SurfacePoint own = point;
  own.position = placement->point_to_own(point.position);
  own.normal = own.shading_normal = placement->normal_in_own(point.normal);
  density *= placement->density_scale(from, own.position);
  return static_cast<float>(density * static_cast<double>(shining.shape->part_pdf(hit.primitive, from, own)));
}

float LightSet::sky_pdf(const Vector3f&, const Vector3f& normal, const Vector3f& direction) const {
  if (parts_->sky == nullptr) return 0;
  return parts_->shares(normal).sky * parts_->sky->pdf(direction);
}

}  // namespace raytracer
