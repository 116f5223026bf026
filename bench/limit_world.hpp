// What the yardstick draws, as bench/languages.py writes it: plain numbers on lines.
#pragma once

#include <string>
#include <vector>

#include "raytracer/camera.hpp"

namespace raytracer::limit {

/// Points that shine white all around.
struct Lamp {
  Vector3f position;
  float lambda;  // 255 shows white as white
  bool fades;    // with 1/distance
};

struct Surface {
  Color3f color;
  float mirror_share;
};

struct Quad {
  Vector3f corner, width, height;
};

/// All that has one surface; of meshes in the buffers that Embree reads.
struct Part {
  Surface surface;
  std::vector<glm::vec4> spheres;  // centre and radius
  std::vector<Quad> quads;
  std::vector<Vector3f> points;
  std::vector<glm::uvec3> triangles;
};

struct World {
  int width = 0, height = 0, samples = 1, bounces = 0;
  Camera camera;
  Color3f background{0};
  std::vector<Lamp> lamps;
  std::vector<Part> parts;
};

World read_world(const std::string& path);

}  // namespace raytracer::limit
