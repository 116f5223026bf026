#include "scene/callbacks.hpp"

#include <array>
#include <bit>
#include <cmath>
#include <cstring>

#include "core/numeric.hpp"
#include "shapes/ray_packet.hpp"

namespace raytracer {
namespace {

constexpr int kLanes = RayPacket::kSize;

const Shape& shape_of(void* user_data, unsigned primitive) {
  return *static_cast<const FiniteShapes*>(user_data)->shapes[primitive];
}

void bounds_callback(const RTCBoundsFunctionArguments* args) {
  const Box3f box = shape_of(args->geometryUserPtr, args->primID).bounds();
  *args->bounds_o = {box.lower.x, box.lower.y, box.lower.z, 0, box.upper.x, box.upper.y, box.upper.z, 0};
}

// Whether the shape that is asked comes before the one that was hit: by instance, the scene's own shapes
// first, then by shape.
bool comes_before(const RTCIntersectFunctionNArguments& args, unsigned hit_instance, unsigned hit_geometry,
                  unsigned hit_primitive) {
  // RTC_INVALID_GEOMETRY_ID, no instance, wraps to 0.
  const unsigned asked = args.context->instID[0] + 1, hit = hit_instance + 1;
  if (asked != hit) return asked < hit;
  if (hit_geometry == args.geomID) return args.primID < hit_primitive;
  const auto& finite = *static_cast<const FiniteShapes*>(args.geometryUserPtr);
  return finite.indices[args.primID] < finite.index_of(hit_geometry, hit_primitive);
}

// --- one ray
// ---------------------------------------------------------------------------------------------------------

// A ray among the `n` of a packet that lie in memory one coordinate after the other. n = 1 is a plain RTCRay.
Ray3f ray_in(RTCRayN* rays, unsigned n, unsigned i) {
  return {{RTCRayN_org_x(rays, n, i), RTCRayN_org_y(rays, n, i), RTCRayN_org_z(rays, n, i)},
          {RTCRayN_dir_x(rays, n, i), RTCRayN_dir_y(rays, n, i), RTCRayN_dir_z(rays, n, i)},
          RTCRayN_tnear(rays, n, i),
          RTCRayN_tfar(rays, n, i)};
}

inline void intersect_one(const RTCIntersectFunctionNArguments& args, unsigned n, unsigned i) {
  RTCRayN* rays = RTCRayHitN_RayN(args.rayhit, n);
  RTCHitN* hits = RTCRayHitN_HitN(args.rayhit, n);
  // A hit just as far as the nearest one so far still counts if its shape comes first.
  const bool has_hit = RTCHitN_geomID(hits, n, i) != RTC_INVALID_GEOMETRY_ID;
  Ray3f ray = ray_in(rays, n, i);
  const bool comes_first = has_hit && comes_before(args, RTCHitN_instID(hits, n, i, 0),
                                                   RTCHitN_geomID(hits, n, i), RTCHitN_primID(hits, n, i));
  if (comes_first) ray.t_max = std::nextafter(ray.t_max, kInfinity);
  Hit hit;
  if (!shape_of(args.geometryUserPtr, args.primID).is_hit(ray, hit)) return;
  RTCRayN_tfar(rays, n, i) = hit.t;
  RTCHitN_geomID(hits, n, i) = args.geomID;
  RTCHitN_primID(hits, n, i) = args.primID;
  RTCHitN_instID(hits, n, i, 0) = args.context->instID[0];
  RTCHitN_u(hits, n, i) = hit.u;
  RTCHitN_v(hits, n, i) = hit.v;
  RTCHitN_Ng_x(hits, n, i) = std::bit_cast<float>(hit.primitive);
}

inline void occlude_one(const RTCOccludedFunctionNArguments& args, unsigned n, unsigned i) {
  Hit ignored;
  if (shape_of(args.geometryUserPtr, args.primID).is_hit(ray_in(args.ray, n, i), ignored)) {
    RTCRayN_tfar(args.ray, n, i) = -kInfinity;
  }
}

// --- eight rays of a packet
// ------------------------------------------------------------------------------------------

// Lanes first … first + 7; those that are not `valid` are made idle.
RayPacket load(RTCRayN* rays, unsigned n, unsigned first, const int* valid) {
  RayPacket packet;
  copy_lanes<kLanes>(packet.origin_x, &RTCRayN_org_x(rays, n, first));
  copy_lanes<kLanes>(packet.origin_y, &RTCRayN_org_y(rays, n, first));
  copy_lanes<kLanes>(packet.origin_z, &RTCRayN_org_z(rays, n, first));
  copy_lanes<kLanes>(packet.direction_x, &RTCRayN_dir_x(rays, n, first));
  copy_lanes<kLanes>(packet.direction_y, &RTCRayN_dir_y(rays, n, first));
  copy_lanes<kLanes>(packet.direction_z, &RTCRayN_dir_z(rays, n, first));
  copy_lanes<kLanes>(packet.t_min, &RTCRayN_tnear(rays, n, first));
  const float* t_max = &RTCRayN_tfar(rays, n, first);
  for (int i = 0; i < kLanes; ++i) packet.t_max[i] = valid[i] != 0 ? t_max[i] : -kInfinity;
  return packet;
}

// All bits of a lane's number set, or none: what compilers make the processor's own vectors of.
using LaneMask = std::array<std::uint32_t, kLanes>;

constexpr std::uint32_t mask_of(bool is_set) { return is_set ? 0xFFFFFFFFU : 0; }

// Sets the chosen lanes, each of 32 bits.
void replace_lanes(void* to, const void* from, const LaneMask& chosen) {
  std::array<std::uint32_t, kLanes> old, next;
  std::memcpy(old.data(), to, sizeof old);
  std::memcpy(next.data(), from, sizeof next);
  for (std::size_t i = 0; i < kLanes; ++i) next[i] = (next[i] & chosen[i]) | (old[i] & ~chosen[i]);
  std::memcpy(to, next.data(), sizeof next);
}

void replace_lanes(void* to, std::uint32_t number, const LaneMask& chosen) {
  std::array<std::uint32_t, kLanes> everywhere;
  everywhere.fill(number);
  replace_lanes(to, everywhere.data(), chosen);
}

// comes_before() for eight lanes, of those that have a hit. Mostly that is of the same geometry.
LaneMask lanes_before(const RTCIntersectFunctionNArguments& args, const unsigned* instance,
                      const unsigned* geometry, const unsigned* primitive) {
  const unsigned own = args.context->instID[0], asked = args.geomID, part = args.primID;
  LaneMask comes_first;
  std::uint32_t others = 0;
  for (std::size_t i = 0; i < kLanes; ++i) {
    const std::uint32_t same = mask_of(geometry[i] == asked) & mask_of(instance[i] == own);
    comes_first[i] = same & mask_of(part < primitive[i]);
    others |= ~same & mask_of(geometry[i] != RTC_INVALID_GEOMETRY_ID);
  }
  if (others == 0) return comes_first;
  for (std::size_t i = 0; i < kLanes; ++i) {
    comes_first[i] = mask_of(geometry[i] != RTC_INVALID_GEOMETRY_ID &&
                             comes_before(args, instance[i], geometry[i], primitive[i]));
  }
  return comes_first;
}

void intersect_eight(const RTCIntersectFunctionNArguments& args, unsigned first) {
  RTCRayN* rays = RTCRayHitN_RayN(args.rayhit, args.N);
  RTCHitN* found = RTCRayHitN_HitN(args.rayhit, args.N);
  unsigned* geometry = &RTCHitN_geomID(found, args.N, first);
  unsigned* primitive = &RTCHitN_primID(found, args.N, first);
  unsigned* instance = &RTCHitN_instID(found, args.N, first, 0);
  RayPacket packet = load(rays, args.N, first, args.valid + first);
  const LaneMask comes_first = lanes_before(args, instance, geometry, primitive);  // as in intersect_one
  for (int i = 0; i < kLanes; ++i) {
    const bool is_extended = (comes_first[static_cast<std::size_t>(i)] != 0) & (packet.t_max[i] > 0);
    packet.t_max[i] = is_extended ? next_above(packet.t_max[i]) : packet.t_max[i];
  }
  HitPacket hits;
  shape_of(args.geometryUserPtr, args.primID).find_hits(packet, hits);
  LaneMask is_hit;
  std::uint32_t any = 0;
  for (int i = 0; i < kLanes; ++i) {
    is_hit[static_cast<std::size_t>(i)] = mask_of(hits.t[i] < kInfinity);
    any |= is_hit[static_cast<std::size_t>(i)];
  }
  if (any == 0) return;
  replace_lanes(&RTCRayN_tfar(rays, args.N, first), hits.t, is_hit);
  replace_lanes(&RTCHitN_u(found, args.N, first), hits.u, is_hit);
  replace_lanes(&RTCHitN_v(found, args.N, first), hits.v, is_hit);
  replace_lanes(&RTCHitN_Ng_x(found, args.N, first), hits.primitive, is_hit);
  replace_lanes(geometry, args.geomID, is_hit);
  replace_lanes(primitive, args.primID, is_hit);
  replace_lanes(instance, args.context->instID[0], is_hit);
}

void occlude_eight(const RTCOccludedFunctionNArguments& args, unsigned first) {
  HitPacket hits;
  shape_of(args.geometryUserPtr, args.primID)
      .find_hits(load(args.ray, args.N, first, args.valid + first), hits);
  float* t_max = &RTCRayN_tfar(args.ray, args.N, first);
  for (int i = 0; i < kLanes; ++i) t_max[i] = hits.t[i] < kInfinity ? -kInfinity : t_max[i];
}

// --- Embree's entries
// ------------------------------------------------------------------------------------------------

// Eights where more than one of them asks, else one by one.
template <class Arguments, class One, class Eight>
inline void for_valid_lanes(const Arguments& args, const One& one, const Eight& eight) {
  if (args.N == 1) {
    if (args.valid[0] != 0) one(args, 1, 0);
    return;
  }
  if (args.N % kLanes != 0) {
    for (unsigned i = 0; i < args.N; ++i) {
      if (args.valid[i] != 0) one(args, args.N, i);
    }
    return;
  }
  for (unsigned first = 0; first < args.N; first += kLanes) {
    unsigned count = 0;
    for (unsigned i = first; i < first + kLanes; ++i) count += args.valid[i] != 0;
    if (count > 1) {
      eight(args, first);
    } else if (count > 0) {
      for (unsigned i = first; i < first + kLanes; ++i) {
        if (args.valid[i] != 0) one(args, args.N, i);
      }
    }
  }
}

void intersect_callback(const RTCIntersectFunctionNArguments* args) {
  for_valid_lanes(*args, intersect_one, intersect_eight);
}

void occluded_callback(const RTCOccludedFunctionNArguments* args) {
  for_valid_lanes(*args, occlude_one, occlude_eight);
}

}  // namespace

void set_callbacks(RTCGeometry geometry, FiniteShapes& finite) {
  rtcSetGeometryUserPrimitiveCount(geometry, static_cast<unsigned>(finite.shapes.size()));
  rtcSetGeometryUserData(geometry, &finite);
  rtcSetGeometryBoundsFunction(geometry, bounds_callback, nullptr);
  rtcSetGeometryIntersectFunction(geometry, intersect_callback);
  rtcSetGeometryOccludedFunction(geometry, occluded_callback);
}

}  // namespace raytracer
