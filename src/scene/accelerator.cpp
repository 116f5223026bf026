// Where Embree is asked. Meshes are geometries of its own kind, all other finite shapes the primitives of one
// user geometry; endless shapes stay outside of the tree, which silently never visits infinite bounds.
#include "scene/accelerator.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <vector>

#include "core/numeric.hpp"
#include "raytracer/error.hpp"
#include "scene/callbacks.hpp"
#include "scene/embree.hpp"
#include "scene/shape_list.hpp"
#include "shapes/mesh.hpp"

namespace raytracer {
namespace {

constexpr unsigned kAllGeometry = 0xFFFFFFFF;  // Embree 4's default mask would be 1

// Embree (its rays' valid()) takes no coordinate beyond 1.844e18. Shapes end at 1e18; only a plane is met
// farther out, and nothing in the tree can be seen from there in single precision.
constexpr float kFarthest = 1.8e18f;

// Without branches, for blocks of rays; false where anything is no number.
inline bool is_within_reach(const Vector3f& v) {
  const float x = std::abs(v.x), y = std::abs(v.y), z = std::abs(v.z);
  return (x < kFarthest) & (y < kFarthest) & (z < kFarthest);
}
inline bool is_within_reach(const Vector3f& origin, const Vector3f& direction) {
  const bool starts_near = is_within_reach(origin), is_short = is_within_reach(direction);
  return starts_near & is_short;
}
inline bool is_within_reach(const Ray3f& ray) { return is_within_reach(ray.origin, ray.direction); }

// Written out whole, for Embree reads four floats at once and would have to wait for eight single stores.
RTCRay to_embree(const Ray3f& ray) {
  return {ray.origin.x,
          ray.origin.y,
          ray.origin.z,
          ray.t_min,
          ray.direction.x,
          ray.direction.y,
          ray.direction.z,
          0,
          ray.t_max,
          kAllGeometry,
          0,
          0};
}

void set_rays(RTCRay16& query, const RayBlock& rays) {
  copy_lanes<kBlockSize>(query.org_x, rays.origin_x);
  copy_lanes<kBlockSize>(query.org_y, rays.origin_y);
  copy_lanes<kBlockSize>(query.org_z, rays.origin_z);
  copy_lanes<kBlockSize>(query.tnear, rays.t_min);
  copy_lanes<kBlockSize>(query.dir_x, rays.direction_x);
  copy_lanes<kBlockSize>(query.dir_y, rays.direction_y);
  copy_lanes<kBlockSize>(query.dir_z, rays.direction_z);
  copy_lanes<kBlockSize>(query.tfar, rays.t_max);
  for (int i = 0; i < kBlockSize; ++i) {
    query.time[i] = 0;
    query.mask[i] = kAllGeometry;
    query.id[i] = query.flags[i] = 0;
  }
}

// The lanes that Embree shall follow: those that are within reach, as above.
BlockMask lanes_within_reach(const RayBlock& rays, const BlockMask& asked) {
  BlockMask mask;
  for (int i = 0; i < kBlockSize; ++i) {
    mask.lane[i] = is_within_reach(rays.origin(i), rays.direction(i)) ? asked.lane[i] : 0;
  }
  return mask;
}

// One for the whole program: it holds the choice of instruction set, not scenes.
RTCDevice device() {
  static RTCDevice shared = rtcNewDevice(nullptr);
  if (shared == nullptr) throw Error(ErrorKind::kFile, "Embree finds no device to run on");
  return shared;
}

void attach(RTCScene scene, RTCGeometry geometry, unsigned id) {
  rtcCommitGeometry(geometry);
  rtcAttachGeometryByID(scene, geometry, id);
  rtcReleaseGeometry(geometry);
}

void attach_shapes(RTCScene scene, FiniteShapes& finite) {
  if (finite.shapes.empty()) return;
  RTCGeometry geometry = rtcNewGeometry(device(), RTC_GEOMETRY_TYPE_USER);
  set_callbacks(geometry, finite);
  attach(scene, geometry, kAskedShapes);
}

// Embree reads the mesh's own buffers: corners as three indices of 32 bits, positions as three floats, of
// which it loads four at a time.
void attach_mesh(RTCScene scene, const TriangleMesh& mesh, unsigned id) {
  const MeshData& data = mesh.data();
  static_assert(sizeof(data.positions[0]) == 12 && sizeof(data.triangles[0]) == 12);
  RTCGeometry geometry = rtcNewGeometry(device(), RTC_GEOMETRY_TYPE_TRIANGLE);
  rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, data.positions.data(), 0,
                             sizeof(data.positions[0]), data.positions.size());
  rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                             data.triangles.data() + mesh.first_triangle(), 0, sizeof(data.triangles[0]),
                             mesh.triangle_count());
  attach(scene, geometry, id);
}

void attach_instance(RTCScene scene, RTCScene shared, const Instance& instance, unsigned id) {
  RTCGeometry geometry = rtcNewGeometry(device(), RTC_GEOMETRY_TYPE_INSTANCE);
  rtcSetGeometryInstancedScene(geometry, shared);
  const glm::mat3& m = instance.linear;
  const float columns[12] = {m[0].x,
                             m[0].y,
                             m[0].z,
                             m[1].x,
                             m[1].y,
                             m[1].z,
                             m[2].x,
                             m[2].y,
                             m[2].z,
                             instance.translation.x,
                             instance.translation.y,
                             instance.translation.z};
  rtcSetGeometryTransform(geometry, 0, RTC_FORMAT_FLOAT3X4_COLUMN_MAJOR, columns);
  attach(scene, geometry, id);
}

void commit(RTCScene scene, std::size_t things) {
  rtcCommitScene(scene);
  if (rtcGetDeviceError(device()) != RTC_ERROR_NONE) {
    throw Error(ErrorKind::kFile, fmt::format("no memory for the tree over {} shapes", things));
  }
}

}  // namespace

struct Accelerator::Tree {
  FiniteShapes finite;
  ShapeList endless;
  // Of each instance the tree that stands there. Instance i is geometry first_instance() + i.
  std::vector<const Tree*> instances;
  RTCScene scene = nullptr;

  unsigned first_instance() const { return static_cast<unsigned>(finite.meshes.size()) + 1; }

  void add(const Shape& shape, std::uint32_t index) {
    const TriangleMesh* mesh = shape.as_mesh();
    if (mesh != nullptr) {
      finite.meshes.push_back(mesh);
      finite.mesh_indices.push_back(index);
    } else {
      finite.shapes.push_back(&shape);
      finite.indices.push_back(index);
    }
  }

  ~Tree() {
    if (scene != nullptr) rtcReleaseScene(scene);
  }

  // Asks the endless shapes. So near a tie that only the order of the shapes can settle it both are looked
  // at: the ray for the tree ends just behind the hit.
  bool is_endless_hit(Ray3f& ray, Hit& hit) const {
    if (endless.is_empty() || !endless.is_hit(ray, hit)) return false;
    ray.t_max = std::nextafter(hit.t, kInfinity);
    return true;
  }

  // Likewise for the lanes of a block; shortens the rays for the tree in `t_max`.
  BlockMask ask_endless(const RayBlock& rays, const BlockMask& asked, HitBlock& hits, float* t_max) const {
    const BlockMask found = endless.find_hits(rays, asked, hits);
    for (int i = 0; i < kBlockSize; ++i) {
      t_max[i] = found.has(i) ? next_above(hits.t[i]) : t_max[i];
    }
    return found;
  }

  // A hit in the tree, as Embree tells it.
  struct Found {
    float t;
    unsigned instance_id, geometry, primitive;
    float part, u, v;
  };

  const FiniteShapes& shapes_of(const Found& found) const {
    return found.instance_id == RTC_INVALID_GEOMETRY_ID
               ? finite
               : instances[found.instance_id - first_instance()]->finite;
  }

  // Of a big mesh next to nothing is in the processor's cache that the surfaces will be made of. That is the
  // first half of it, for Scene::prefetch().
  [[gnu::always_inline]] void prefetch_numbers(const Found& found) const {
    if (found.geometry != kAskedShapes)
      shapes_of(found).meshes[found.geometry - 1]->prefetch_numbers(found.primitive);
  }

  // The nearer of what the tree found and of `hit`, which the endless shapes have found if `has_hit`.
  bool choose(const Found& found, bool has_hit, Hit& hit) const {
    const bool is_own = found.instance_id == RTC_INVALID_GEOMETRY_ID;
    const std::uint32_t instance = is_own ? kNoInstance : found.instance_id - first_instance();
    const std::uint32_t shape = shapes_of(found).index_of(found.geometry, found.primitive);
    if (has_hit && found.t >= hit.t && (!is_own || shape > hit.shape)) return true;
    const bool is_asked = found.geometry == kAskedShapes;
    const std::uint32_t part = is_asked ? std::bit_cast<std::uint32_t>(found.part) : found.primitive;
    hit = {found.t, shape, part, found.u, found.v, instance};
    return true;
  }
};

Accelerator::Accelerator(std::span<const std::unique_ptr<Shape>> shapes,
                         std::span<const std::shared_ptr<const SharedShapes>> shared,
                         std::span<const Instance> instances)
    : tree_(std::make_unique<Tree>()) {
  std::vector<const Shape*> endless;
  std::vector<std::uint32_t> endless_indices;
  for (std::uint32_t i = 0; i < shapes.size(); ++i) {
    const Box3f bounds = shapes[i]->bounds();
    if (bounds.is_empty()) continue;  // a mesh without triangles
    if (bounds.is_finite()) {
      tree_->add(*shapes[i], i);
    } else {
      endless.push_back(shapes[i].get());
      endless_indices.push_back(i);
    }
  }
  tree_->endless = ShapeList(std::move(endless), std::move(endless_indices));
  const FiniteShapes& finite = tree_->finite;
  const std::size_t things = finite.shapes.size() + finite.meshes.size() + instances.size();
  if (things == 0) return;
  tree_->scene = rtcNewScene(device());
  rtcSetSceneFlags(tree_->scene, RTC_SCENE_FLAG_ROBUST);
  attach_shapes(tree_->scene, tree_->finite);
  for (std::size_t i = 0; i < finite.meshes.size(); ++i)
    attach_mesh(tree_->scene, *finite.meshes[i], static_cast<unsigned>(i) + 1);
  for (std::size_t i = 0; i < instances.size(); ++i) {
    const Tree* below = shared[instances[i].shared]->accelerator().tree_.get();
    tree_->instances.push_back(below);
    if (below->scene == nullptr) continue;
    attach_instance(tree_->scene, below->scene, instances[i],
                    tree_->first_instance() + static_cast<unsigned>(i));
  }
  commit(tree_->scene, things);
}

Accelerator::~Accelerator() = default;

bool Accelerator::has_meshes() const {
  return !tree_->finite.meshes.empty() || std::ranges::any_of(tree_->instances, [](const Tree* below) {
    return !below->finite.meshes.empty();
  });
}

bool Accelerator::is_hit(const Ray3f& ray, Hit& hit) const {
  Ray3f rest = ray;
  const bool hits_endless = tree_->is_endless_hit(rest, hit);
  if (tree_->scene == nullptr || !is_within_reach(ray)) return hits_endless;
  RTCRayHit query;
  query.ray = to_embree(rest);
  query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  embree::intersect(tree_->scene, query);
  const RTCHit& found = query.hit;
  if (found.geomID == RTC_INVALID_GEOMETRY_ID) return hits_endless;
  return tree_->choose(
      {query.ray.tfar, found.instID[0], found.geomID, found.primID, found.Ng_x, found.u, found.v},
      hits_endless, hit);
}

bool Accelerator::is_occluded(const Ray3f& ray) const {
  if (tree_->scene != nullptr && is_within_reach(ray)) {
    RTCRay query = to_embree(ray);
    embree::occluded(tree_->scene, query);
    if (query.tfar < 0) return true;
  }
  return !tree_->endless.is_empty() && tree_->endless.is_occluded(ray);
}

BlockMask Accelerator::is_hit(const RayBlock& rays, const BlockMask& asked, HitBlock& hits,
                              Coherence coherence) const {
  RTCRayHit16 query;
  set_rays(query.ray, rays);
  BlockMask found = BlockMask::none();
  if (!tree_->endless.is_empty()) found = tree_->ask_endless(rays, asked, hits, query.ray.tfar);
  if (tree_->scene == nullptr) return found;
  for (int i = 0; i < kBlockSize; ++i) query.hit.geomID[i] = query.hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
  embree::intersect(lanes_within_reach(rays, asked).lane, tree_->scene, query, coherence);
  const RTCHit16& hit = query.hit;
  const auto found_in = [&](int i) -> Tree::Found {
    return {query.ray.tfar[i], hit.instID[0][i], hit.geomID[i], hit.primID[i],
            hit.Ng_x[i],       hit.u[i],         hit.v[i]};
  };
  for (int i = 0; i < kBlockSize; ++i) {
    if (hit.geomID[i] != RTC_INVALID_GEOMETRY_ID) tree_->prefetch_numbers(found_in(i));
  }
  for (int i = 0; i < kBlockSize; ++i) {
    if (hit.geomID[i] == RTC_INVALID_GEOMETRY_ID) continue;
    const Tree::Found lane = found_in(i);
    Hit nearest = found.has(i) ? hits.at(i) : Hit{};
    tree_->choose(lane, found.has(i), nearest);
    hits.set(i, nearest);
    found.set(i, true);
  }
  return found;
}

BlockMask Accelerator::is_occluded(const RayBlock& rays, const BlockMask& asked, Coherence coherence) const {
  BlockMask hidden = BlockMask::none();
  if (tree_->scene != nullptr) {
    RTCRay16 query;
    set_rays(query, rays);
    embree::occluded(lanes_within_reach(rays, asked).lane, tree_->scene, query, coherence);
    for (int i = 0; i < kBlockSize; ++i) hidden.lane[i] = query.tfar[i] < 0 ? asked.lane[i] : 0;
  }
  if (tree_->endless.is_empty()) return hidden;
  BlockMask rest;
  for (int i = 0; i < kBlockSize; ++i) rest.lane[i] = asked.lane[i] & ~hidden.lane[i];
  if (rest.is_empty()) return hidden;
  const BlockMask behind = tree_->endless.are_occluded(rays, rest);
  for (int i = 0; i < kBlockSize; ++i) hidden.lane[i] |= behind.lane[i];
  return hidden;
}

}  // namespace raytracer
