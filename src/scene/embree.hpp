// Embree 3 and 4 under one roof. Only the accelerator includes this.
#pragma once

#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

#include "core/lanes.hpp"
#include "raytracer/scene.hpp"

namespace raytracer::embree {

#if RTC_VERSION_MAJOR >= 4
inline void intersect(RTCScene scene, RTCRayHit& ray) { rtcIntersect1(scene, &ray, nullptr); }
inline void occluded(RTCScene scene, RTCRay& ray) { rtcOccluded1(scene, &ray, nullptr); }
inline void intersect(const int* valid, RTCScene scene, RTCRayHit16& rays, Coherence coherence) {
  RTCIntersectArguments with;
  rtcInitIntersectArguments(&with);
  if (coherence == Coherence::kCoherent) with.flags = RTC_RAY_QUERY_FLAG_COHERENT;
  rtcIntersect16(valid, scene, &rays, &with);
}
inline void occluded(const int* valid, RTCScene scene, RTCRay16& rays, Coherence coherence) {
  RTCOccludedArguments with;
  rtcInitOccludedArguments(&with);
  if (coherence == Coherence::kCoherent) with.flags = RTC_RAY_QUERY_FLAG_COHERENT;
  rtcOccluded16(valid, scene, &rays, &with);
}
#else
inline RTCIntersectContext context(Coherence coherence) {
  RTCIntersectContext result;
  rtcInitIntersectContext(&result);
  if (coherence == Coherence::kCoherent) result.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  return result;
}
inline void intersect(RTCScene scene, RTCRayHit& ray) {
  RTCIntersectContext with = context(Coherence::kIncoherent);
  rtcIntersect1(scene, &with, &ray);
}
inline void occluded(RTCScene scene, RTCRay& ray) {
  RTCIntersectContext with = context(Coherence::kIncoherent);
  rtcOccluded1(scene, &with, &ray);
}
inline void intersect(const int* valid, RTCScene scene, RTCRayHit16& rays, Coherence coherence) {
  RTCIntersectContext with = context(coherence);
  rtcIntersect16(valid, scene, &with, &rays);
}
inline void occluded(const int* valid, RTCScene scene, RTCRay16& rays, Coherence coherence) {
  RTCIntersectContext with = context(coherence);
  if (coherence == Coherence::kIncoherent) return rtcOccluded16(valid, scene, &with, &rays);
  // Coherent rays go by eights: the code for sixteen, as Debian 12 has compiled it for AVX-512
  // (Embree 3.13.5), writes a mask of 16 bits to the stack and reads 64 of them back, and does not return if
  // the others are not 0.
  for (int first = 0; first < 16; first += 8) {
    RTCRay8 eight;
    copy_lanes<8>(eight.org_x, rays.org_x + first);
    copy_lanes<8>(eight.org_y, rays.org_y + first);
    copy_lanes<8>(eight.org_z, rays.org_z + first);
    copy_lanes<8>(eight.tnear, rays.tnear + first);
    copy_lanes<8>(eight.dir_x, rays.dir_x + first);
    copy_lanes<8>(eight.dir_y, rays.dir_y + first);
    copy_lanes<8>(eight.dir_z, rays.dir_z + first);
    copy_lanes<8>(eight.time, rays.time + first);
    copy_lanes<8>(eight.tfar, rays.tfar + first);
    copy_lanes<8>(eight.mask, rays.mask + first);
    copy_lanes<8>(eight.id, rays.id + first);
    copy_lanes<8>(eight.flags, rays.flags + first);
    rtcOccluded8(valid + first, scene, &with, &eight);
    copy_lanes<8>(rays.tfar + first, eight.tfar);
  }
}
#endif

}  // namespace raytracer::embree
