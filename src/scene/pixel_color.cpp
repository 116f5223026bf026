#include "scene/pixel_color.hpp"

#include "lights/illuminate.hpp"

namespace raytracer {
namespace {

// A hit as shading sees it: the normal turned towards where the ray came from, and where further rays start.
struct ShadingPoint {
  Vector3f position, normal, offset_position;
};

ShadingPoint shading_point(const Scene& scene, const Ray3f& ray, const Hit& hit) {
  const SurfacePoint surface = scene.surface_at(ray, hit);
  ShadingPoint point;
  point.normal = glm::dot(surface.normal, ray.direction) > 0 ? -surface.normal : surface.normal;
  if (const auto& epsilon = scene.description().epsilon) {
    // The paper's way: the point as the ray's equation gives it, its rounding error included.
    point.position = ray.at(hit.t);
    point.offset_position = point.position + *epsilon * point.normal;
  } else {
    point.position = surface.position;
    point.offset_position = point.position + surface.position_error * point.normal;
  }
  return point;
}

// The sum over the lights that the point sees, in units of the buffers.
Color3f direct_light(const Scene& scene, const ShadingPoint& point, std::uint64_t& rays) {
  Color3f sum = 255.0f * scene.description().ambient;
  for (const Light& light : scene.description().lights) {
    const Illumination arriving = illuminate(light, point.position, point.normal, point.offset_position);
    if (arriving.color == Color3f(0)) continue;
    ++rays;
    if (!scene.is_occluded(arriving.shadow_ray)) sum += arriving.color;
  }
  return sum;
}

}  // namespace

Color3f get_pixel_color(const Scene& scene, const Ray3f& ray, int bounces_left, std::uint64_t& rays) {
  ++rays;
  Hit hit;
  if (!scene.is_hit(ray, hit)) return 255.0f * scene.description().background;
  const Material& material = scene.material_of(hit);
  const float shininess = glm::clamp(material.shininess, 0.0f, 1.0f);
  const ShadingPoint point = shading_point(scene, ray, hit);
  Color3f color(0);
  if (shininess < 1) color += (1 - shininess) * material.color * direct_light(scene, point, rays);
  if (shininess > 0 && bounces_left > 0) {
    const Ray3f reflected{point.offset_position, glm::reflect(ray.direction, point.normal)};
    color += shininess * material.color * get_pixel_color(scene, reflected, bounces_left - 1, rays);
  }
  return color;
}

}  // namespace raytracer
