#include "limit_shapes.hpp"

#include <algorithm>
#include <cmath>
#include <type_traits>

namespace raytracer::limit {
namespace {

/// Where a ray meets a shape, and the normal there, of any length. No hit: an infinite t.
struct Meeting {
  float t;
  Vector3f normal;
};

Box3f bounds(const glm::vec4& sphere) {
  const Vector3f center(sphere);
  return {center - sphere.w, center + sphere.w};
}

inline Meeting meet(const glm::vec4& sphere, const Vector3f& origin, const Vector3f& direction) {
  const Vector3f to_center = Vector3f(sphere) - origin;
  const float scale = 1 / glm::dot(direction, direction), nearest = glm::dot(to_center, direction) * scale;
  const Vector3f aside = nearest * direction - to_center;
  // Taken from the nearest point of the ray, so that small spheres far away keep their digits.
  const float inside = sphere.w * sphere.w - glm::dot(aside, aside);
  const float half = std::sqrt(std::max(inside, 0.0f) * scale);
  return {inside >= 0 ? nearest - half : kInfinity, aside - half * direction};
}

Box3f bounds(const Quad& quad) {
  Box3f box;
  for (int i = 0; i < 4; ++i) {
    box.extend(quad.corner + static_cast<float>(i & 1) * quad.width +
               static_cast<float>(i >> 1) * quad.height);
  }
  return box;
}

inline Meeting meet(const Quad& quad, const Vector3f& origin, const Vector3f& direction) {
  const Vector3f normal = glm::cross(quad.width, quad.height), from_corner = origin - quad.corner;
  const float t = -glm::dot(from_corner, normal) / glm::dot(direction, normal);
  const Vector3f place = from_corner + t * direction;
  const float square = glm::dot(normal, normal), u = glm::dot(glm::cross(place, quad.height), normal),
              v = glm::dot(glm::cross(quad.width, place), normal);
  const bool is_within = (u >= 0) & (u <= square) & (v >= 0) & (v <= square);
  return {is_within ? t : kInfinity, normal};
}

template <class Shape>
const Shape& shape(void* shapes, unsigned i) {
  return static_cast<const Shape*>(shapes)[i];
}

template <class Shape>
void tell_bounds(const RTCBoundsFunctionArguments* asked) {
  const Box3f box = bounds(shape<Shape>(asked->geometryUserPtr, asked->primID));
  *asked->bounds_o = {box.lower.x, box.lower.y, box.lower.z, 0, box.upper.x, box.upper.y, box.upper.z, 0};
}

template <int kLanes>
Vector3f origin(const RTCRayNt<kLanes>& rays, int i) {
  return {rays.org_x[i], rays.org_y[i], rays.org_z[i]};
}

template <int kLanes>
Vector3f direction(const RTCRayNt<kLanes>& rays, int i) {
  return {rays.dir_x[i], rays.dir_y[i], rays.dir_z[i]};
}

// The loops choose by ?: and & alone, so that they are made into vector instructions.

template <int kLanes, class Shape>
void intersect(const RTCIntersectFunctionNArguments& asked) {
  auto& [rays, hits] = *reinterpret_cast<RTCRayHitNt<kLanes>*>(asked.rayhit);
  const Shape met = shape<Shape>(asked.geometryUserPtr, asked.primID);
  const unsigned geometry = asked.geomID;
  const int* valid = asked.valid;
#pragma GCC ivdep
  for (int i = 0; i < kLanes; ++i) {
    const Meeting meeting = meet(met, origin(rays, i), direction(rays, i));
    const bool is_hit = (valid[i] != 0) & (meeting.t > rays.tnear[i]) & (meeting.t < rays.tfar[i]);
    rays.tfar[i] = is_hit ? meeting.t : rays.tfar[i];
    hits.Ng_x[i] = is_hit ? meeting.normal.x : hits.Ng_x[i];
    hits.Ng_y[i] = is_hit ? meeting.normal.y : hits.Ng_y[i];
    hits.Ng_z[i] = is_hit ? meeting.normal.z : hits.Ng_z[i];
    hits.geomID[i] = is_hit ? geometry : hits.geomID[i];
  }
}

template <int kLanes, class Shape>
void occlude(const RTCOccludedFunctionNArguments& asked) {
  auto& rays = *reinterpret_cast<RTCRayNt<kLanes>*>(asked.ray);
  const Shape met = shape<Shape>(asked.geometryUserPtr, asked.primID);
  const int* valid = asked.valid;
#pragma GCC ivdep
  for (int i = 0; i < kLanes; ++i) {
    const float t = meet(met, origin(rays, i), direction(rays, i)).t;
    const bool is_hit = (valid[i] != 0) & (t > rays.tnear[i]) & (t < rays.tfar[i]);
    rays.tfar[i] = is_hit ? -kInfinity : rays.tfar[i];
  }
}

/// Calls `work` with as many lanes as Embree asks about: one ray, or what its processor takes of a packet at
/// a time.
template <class Work>
void with_lanes(unsigned lanes, const Work& work) {
  if (lanes == 1) return work(std::integral_constant<int, 1>());
  if (lanes == 4) return work(std::integral_constant<int, 4>());
  if (lanes == 8) return work(std::integral_constant<int, 8>());
  work(std::integral_constant<int, 16>());
}

template <class Shape>
RTCGeometry geometry(RTCDevice device, const std::vector<Shape>& shapes) {
  RTCGeometry made = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_USER);
  rtcSetGeometryUserPrimitiveCount(made, static_cast<unsigned>(shapes.size()));
  rtcSetGeometryUserData(made, const_cast<Shape*>(shapes.data()));
  rtcSetGeometryBoundsFunction(made, tell_bounds<Shape>, nullptr);
  rtcSetGeometryIntersectFunction(made, [](const RTCIntersectFunctionNArguments* asked) {
    with_lanes(asked->N, [&](auto lanes) { intersect<lanes(), Shape>(*asked); });
  });
  rtcSetGeometryOccludedFunction(made, [](const RTCOccludedFunctionNArguments* asked) {
    with_lanes(asked->N, [&](auto lanes) { occlude<lanes(), Shape>(*asked); });
  });
  return made;
}

}  // namespace

RTCGeometry sphere_geometry(RTCDevice device, const std::vector<glm::vec4>& spheres) {
  return geometry(device, spheres);
}

RTCGeometry quad_geometry(RTCDevice device, const std::vector<Quad>& quads) {
  return geometry(device, quads);
}

}  // namespace raytracer::limit
