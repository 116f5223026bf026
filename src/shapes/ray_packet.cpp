#include "shapes/ray_packet.hpp"

namespace raytracer {

void Shape::find_hits(const RayPacket& rays, HitPacket& hits) const {
  for (int i = 0; i < RayPacket::kSize; ++i) {
    Hit hit;
    hits.t[i] = is_hit(rays.ray(i), hit) ? hit.t : kInfinity;
    hits.primitive[i] = hit.primitive;
    hits.u[i] = hit.u;
    hits.v[i] = hit.v;
  }
}

}  // namespace raytracer
