// Where Embree is asked. Meshes are geometries of its own kind, all other finite shapes the primitives of one
// user geometry; endless shapes stay outside of the tree, which silently never visits infinite bounds.
#include "scene/accelerator.hpp"

#include <fmt/format.h>

#include <bit>
#include <cmath>
#include <vector>

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

bool is_within_reach(const Ray3f& ray) {
  const Vector3f largest = glm::max(glm::abs(ray.origin), glm::abs(ray.direction));
  return largest.x < kFarthest && largest.y < kFarthest && largest.z < kFarthest;
}

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

void set_lane(RTCRay16& rays, std::size_t i, const Ray3f& ray) {
  rays.org_x[i] = ray.origin.x;
  rays.org_y[i] = ray.origin.y;
  rays.org_z[i] = ray.origin.z;
  rays.tnear[i] = ray.t_min;
  rays.dir_x[i] = ray.direction.x;
  rays.dir_y[i] = ray.direction.y;
  rays.dir_z[i] = ray.direction.z;
  rays.time[i] = 0;
  rays.tfar[i] = ray.t_max;
  rays.mask[i] = kAllGeometry;
  rays.id[i] = rays.flags[i] = 0;
}

// The lanes of a packet that Embree shall follow, as it wants them marked: those of the first `count` that
// are within reach, as above.
struct alignas(64) ValidLanes {
  int lane[kMostRays];
  ValidLanes(const RTCRay16& rays, std::size_t count) {
    const auto is_near = [](float x) { return (x < kFarthest) & (x > -kFarthest); };
    for (std::size_t i = 0; i < kMostRays; ++i) {
      const bool is_valid = (i < count) & is_near(rays.org_x[i]) & is_near(rays.org_y[i]) &
                            is_near(rays.org_z[i]) & is_near(rays.dir_x[i]) & is_near(rays.dir_y[i]) &
                            is_near(rays.dir_z[i]);
      lane[i] = is_valid ? -1 : 0;
    }
  }
};

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

  // Of a big mesh next to nothing is in the processor's cache that the surfaces will be made of.
  [[gnu::always_inline]] void prefetch(const Found& found) const {
    if (found.geometry != kAskedShapes)
      shapes_of(found).meshes[found.geometry - 1]->prefetch(found.primitive);
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

std::uint32_t Accelerator::is_hit(std::span<const Ray3f> rays, std::span<Hit> hits,
                                  Coherence coherence) const {
  RTCRayHit16 query;
  if (rays.size() < kMostRays) query = {};  // the lanes that nobody fills
  std::uint32_t answer = 0;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    Ray3f rest = rays[i];
    answer |= std::uint32_t{tree_->is_endless_hit(rest, hits[i])} << i;
    set_lane(query.ray, i, rest);
    query.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
    query.hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
  }
  if (tree_->scene == nullptr) return answer;
  embree::intersect(ValidLanes(query.ray, rays.size()).lane, tree_->scene, query, coherence);
  const RTCHit16& found = query.hit;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    if (found.geomID[i] == RTC_INVALID_GEOMETRY_ID) continue;
    const bool hits_endless = (answer >> i & 1U) != 0;
    const Tree::Found lane{query.ray.tfar[i], found.instID[0][i], found.geomID[i], found.primID[i],
                           found.Ng_x[i],     found.u[i],         found.v[i]};
    tree_->prefetch(lane);
    tree_->choose(lane, hits_endless, hits[i]);
    answer |= 1U << i;
  }
  return answer;
}

std::uint32_t Accelerator::is_occluded(std::span<const Ray3f> rays, Coherence coherence) const {
  std::uint32_t answer = 0;
  if (tree_->scene != nullptr) {
    RTCRay16 query;
    if (rays.size() < kMostRays) query = {};
    for (std::size_t i = 0; i < rays.size(); ++i) set_lane(query, i, rays[i]);
    embree::occluded(ValidLanes(query, rays.size()).lane, tree_->scene, query, coherence);
    for (std::size_t i = 0; i < rays.size(); ++i) answer |= std::uint32_t{query.tfar[i] < 0} << i;
  }
  if (tree_->endless.is_empty()) return answer;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    if ((answer >> i & 1U) == 0) answer |= std::uint32_t{tree_->endless.is_occluded(rays[i])} << i;
  }
  return answer;
}

}  // namespace raytracer
