// The only file that knows Embree. Finite shapes are the primitives of one user geometry whose callbacks ask
// Shape::is_hit; endless shapes stay outside of the tree, which silently never visits infinite bounds.
#include "scene/accelerator.hpp"

#include <fmt/format.h>

#include <bit>
#include <cmath>
#include <vector>

#include "raytracer/error.hpp"
#include "scene/embree.hpp"
#include "scene/shape_list.hpp"

namespace raytracer {
namespace {

constexpr unsigned kAllGeometry = 0xFFFFFFFF;  // Embree 4's default mask would be 1

// The finite shapes, as the callbacks find them: primitive i is shape indices[i] of the scene, ascending.
struct FiniteShapes {
  std::vector<const Shape*> shapes;
  std::vector<std::uint32_t> indices;
};

// Embree (its rays' valid()) takes no coordinate beyond 1.844e18. Shapes end at 1e18; only a plane is met farther out,
// and nothing in the tree can be seen from there in single precision.
bool is_within_reach(const Ray3f& ray) {
  constexpr float kFarthest = 1.8e18f;
  const Vector3f largest = glm::max(glm::abs(ray.origin), glm::abs(ray.direction));
  return largest.x < kFarthest && largest.y < kFarthest && largest.z < kFarthest;
}

Ray3f to_ray(const RTCRay& ray) {
  return {{ray.org_x, ray.org_y, ray.org_z}, {ray.dir_x, ray.dir_y, ray.dir_z}, ray.tnear, ray.tfar};
}

RTCRay to_embree(const Ray3f& ray) {
  RTCRay result{};
  result.org_x = ray.origin.x;
  result.org_y = ray.origin.y;
  result.org_z = ray.origin.z;
  result.tnear = ray.t_min;
  result.dir_x = ray.direction.x;
  result.dir_y = ray.direction.y;
  result.dir_z = ray.direction.z;
  result.tfar = ray.t_max;
  result.mask = kAllGeometry;
  return result;
}

void bounds_callback(const RTCBoundsFunctionArguments* args) {
  const auto& finite = *static_cast<const FiniteShapes*>(args->geometryUserPtr);
  const Box3f box = finite.shapes[args->primID]->bounds();
  *args->bounds_o = {box.lower.x, box.lower.y, box.lower.z, 0, box.upper.x, box.upper.y, box.upper.z, 0};
}

void intersect_callback(const RTCIntersectFunctionNArguments* args) {
  if (args->valid[0] == 0) return;
  const auto& finite = *static_cast<const FiniteShapes*>(args->geometryUserPtr);
  auto& query = *reinterpret_cast<RTCRayHit*>(args->rayhit);
  // A hit just as far as the nearest one so far still counts if its shape comes first.
  const bool has_hit = query.hit.geomID != RTC_INVALID_GEOMETRY_ID;
  Ray3f ray = to_ray(query.ray);
  if (has_hit && args->primID < query.hit.primID) ray.t_max = std::nextafter(ray.t_max, kInfinity);
  Hit hit;
  if (!finite.shapes[args->primID]->is_hit(ray, hit)) return;
  query.ray.tfar = hit.t;
  query.hit.geomID = args->geomID;
  query.hit.primID = args->primID;
  query.hit.u = hit.u;
  query.hit.v = hit.v;
  query.hit.Ng_x = std::bit_cast<float>(hit.primitive);  // the normal's place is free: surface_at() knows better
}

void occluded_callback(const RTCOccludedFunctionNArguments* args) {
  if (args->valid[0] == 0) return;
  const auto& finite = *static_cast<const FiniteShapes*>(args->geometryUserPtr);
  auto& query = *reinterpret_cast<RTCRay*>(args->ray);
  Hit ignored;
  if (finite.shapes[args->primID]->is_hit(to_ray(query), ignored)) query.tfar = -kInfinity;
}

// One for the whole program: it holds the choice of instruction set, not scenes.
RTCDevice device() {
  static RTCDevice shared = rtcNewDevice(nullptr);
  if (shared == nullptr) throw Error(ErrorKind::kFile, "Embree finds no device to run on");
  return shared;
}

RTCScene build_tree(FiniteShapes& finite) {
  RTCGeometry geometry = rtcNewGeometry(device(), RTC_GEOMETRY_TYPE_USER);
  rtcSetGeometryUserPrimitiveCount(geometry, static_cast<unsigned>(finite.shapes.size()));
  rtcSetGeometryUserData(geometry, &finite);
  rtcSetGeometryBoundsFunction(geometry, bounds_callback, nullptr);
  rtcSetGeometryIntersectFunction(geometry, intersect_callback);
  rtcSetGeometryOccludedFunction(geometry, occluded_callback);
  rtcCommitGeometry(geometry);
  RTCScene scene = rtcNewScene(device());
  rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST);
  rtcAttachGeometry(scene, geometry);
  rtcReleaseGeometry(geometry);
  rtcCommitScene(scene);
  if (rtcGetDeviceError(device()) != RTC_ERROR_NONE) {
    rtcReleaseScene(scene);
    throw Error(ErrorKind::kFile, fmt::format("no memory for the tree over {} shapes", finite.shapes.size()));
  }
  return scene;
}

}  // namespace

struct Accelerator::Tree {
  FiniteShapes finite;
  ShapeList endless;
  RTCScene scene = nullptr;

  ~Tree() {
    if (scene != nullptr) rtcReleaseScene(scene);
  }
};

Accelerator::Accelerator(std::span<const std::unique_ptr<Shape>> shapes) : tree_(std::make_unique<Tree>()) {
  std::vector<const Shape*> endless;
  std::vector<std::uint32_t> endless_indices;
  for (std::uint32_t i = 0; i < shapes.size(); ++i) {
    const bool finite = shapes[i]->bounds().is_finite();
    (finite ? tree_->finite.shapes : endless).push_back(shapes[i].get());
    (finite ? tree_->finite.indices : endless_indices).push_back(i);
  }
  tree_->endless = ShapeList(std::move(endless), std::move(endless_indices));
  if (!tree_->finite.shapes.empty()) tree_->scene = build_tree(tree_->finite);
}

Accelerator::~Accelerator() = default;

bool Accelerator::is_hit(const Ray3f& ray, Hit& hit) const {
  Hit endless_hit;
  const bool hits_endless = !tree_->endless.is_empty() && tree_->endless.is_hit(ray, endless_hit);
  if (tree_->scene != nullptr && is_within_reach(ray)) {
    RTCRayHit query{};
    query.ray = to_embree(ray);
    // So near a tie that only the order of the shapes can settle it: both are looked at.
    if (hits_endless) query.ray.tfar = std::nextafter(endless_hit.t, kInfinity);
    query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    embree::intersect(tree_->scene, query);
    if (query.hit.geomID != RTC_INVALID_GEOMETRY_ID) {
      const std::uint32_t shape = tree_->finite.indices[query.hit.primID];
      if (!hits_endless || query.ray.tfar < endless_hit.t || shape < endless_hit.shape) {
        hit = {query.ray.tfar, shape, std::bit_cast<std::uint32_t>(query.hit.Ng_x), query.hit.u, query.hit.v};
        return true;
      }
    }
  }
  if (hits_endless) hit = endless_hit;
  return hits_endless;
}

bool Accelerator::is_occluded(const Ray3f& ray) const {
  if (tree_->scene != nullptr && is_within_reach(ray)) {
    RTCRay query = to_embree(ray);
    embree::occluded(tree_->scene, query);
    if (query.tfar < 0) return true;
  }
  return !tree_->endless.is_empty() && tree_->endless.is_occluded(ray);
}

}  // namespace raytracer
