// Embree 3 and 4 under one roof. Only the accelerator includes this.
#pragma once

#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

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
  rtcOccluded16(valid, scene, &with, &rays);
}
#endif

}  // namespace raytracer::embree
