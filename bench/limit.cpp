// The yardstick: what a picture of a mesh costs at least. It traces the very camera and shadow rays that
// raytracer traces, in packets through Embree, with the simplest Lambert shading, and writes the same PNG
// with the same code. It knows one kind of file, one camera and one light.
#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <string>
#include <utility>
#include <vector>

#include "core/mapped_file.hpp"
#include "core/parallel.hpp"
#include "raytracer/camera.hpp"
#include "raytracer/error.hpp"
#include "raytracer/image.hpp"
#include "sampling/sobol.hpp"
#include "scene/embree.hpp"

using namespace raytracer;

namespace {

constexpr int kTile = 32, kPacket = 16;

struct Mesh {
  std::vector<Vector3f> positions;
  std::vector<glm::uvec3> triangles;
};

/// A binary PLY as make_mesh.py writes it: x y z, and triangles as a byte 3 and three numbers.
Mesh read_ply(const std::string& path) {
  const MappedFile file(path);
  const std::string_view text = file.bytes();
  const std::size_t body = text.find("end_header\n") + 11;
  const auto count = [&](const char* word) {
    return std::strtoull(text.data() + text.find(word) + std::strlen(word), nullptr, 10);
  };
  Mesh mesh;
  mesh.positions.resize(count("element vertex "));
  mesh.triangles.resize(count("element face "));
  const char* at = text.data() + body;
  std::memcpy(mesh.positions.data(), at, 12 * mesh.positions.size());
  at += 12 * mesh.positions.size();
  constexpr std::size_t kRows = 65536;
  parallel_for(mesh.triangles.size() / kRows + 1, [&](std::size_t part) {
    const std::size_t end = std::min(mesh.triangles.size(), (part + 1) * kRows);
    for (std::size_t i = part * kRows; i < end; ++i) std::memcpy(&mesh.triangles[i], at + 13 * i + 1, 12);
  });
  mesh.positions.reserve(mesh.positions.size() + 1);
  return mesh;
}

RTCScene build(const Mesh& mesh) {
  RTCDevice device = rtcNewDevice(nullptr);
  RTCScene scene = rtcNewScene(device);
  rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST);
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, mesh.positions.data(), 0,
                             12, mesh.positions.size());
  rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, mesh.triangles.data(), 0,
                             12, mesh.triangles.size());
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(scene, geometry);
  rtcCommitScene(scene);
  return scene;
}

struct Job {
  Camera camera;
  Vector3f light;
  float lambda;  // of the light, times the surface's colour
  Color3f background;
  int samples;
};

void set(RTCRay16& rays, int i, const Vector3f& origin, const Vector3f& direction, float t_max) {
  rays.org_x[i] = origin.x, rays.org_y[i] = origin.y, rays.org_z[i] = origin.z;
  rays.dir_x[i] = direction.x, rays.dir_y[i] = direction.y, rays.dir_z[i] = direction.z;
  rays.tnear[i] = rays.time[i] = 0;
  rays.tfar[i] = t_max;
  rays.mask[i] = 0xFFFFFFFF;
  rays.id[i] = rays.flags[i] = 0;
}

/// Adds one sample of a block of 4 x 4 pixels; returns the shadow rays traced.
int trace(RTCScene scene, const Job& job, const Image& image, int x, int y, int sample, Color3f* sums) {
  alignas(64) int valid[kPacket];
  RTCRayHit16 query;
  Ray3f rays[kPacket];
  for (int i = 0; i < kPacket; ++i) {
    const int px = x + i % 4, py = y + i / 4;
    valid[i] = px < image.width && py < image.height ? -1 : 0;
    const auto number = static_cast<std::uint32_t>(image.index(px, py));
    const Vector2f within =
        job.samples == 1 ? Vector2f(0.5f)
                         : sobol_point(static_cast<std::uint32_t>(sample), hash_bits(number ^ hash_bits(0)));
    rays[i] = job.camera.ray_through((px + static_cast<double>(within.x)) / image.width,
                                     (py + static_cast<double>(within.y)) / image.height);
    set(query.ray, i, rays[i].origin, rays[i].direction, kInfinity);
    query.hit.geomID[i] = query.hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
  }
  embree::intersect(valid, scene, query, Coherence::kCoherent);
  RTCRay16 shadows;
  float strength[kPacket];
  int traced = 0;
  for (int i = 0; i < kPacket; ++i) {
    const bool is_hit = valid[i] != 0 && query.hit.geomID[i] != RTC_INVALID_GEOMETRY_ID;
    if (valid[i] != 0 && !is_hit) sums[i] += 255.0f * job.background;
    valid[i] = 0;
    if (!is_hit) continue;
    const Vector3f position = rays[i].at(query.ray.tfar[i]);
    Vector3f normal = glm::normalize(Vector3f(query.hit.Ng_x[i], query.hit.Ng_y[i], query.hit.Ng_z[i]));
    if (glm::dot(normal, rays[i].direction) > 0) normal = -normal;
    const Vector3f to_light = job.light - position;
    const float cosine = glm::dot(to_light, normal);
    if (!(cosine > 0)) continue;
    strength[i] = job.lambda * cosine / glm::dot(to_light, to_light);
    const Vector3f start = position + 1e-5f * normal;
    set(shadows, i, start, job.light - start, 1);
    valid[i] = -1;
    ++traced;
  }
  if (traced == 0) return 0;
  embree::occluded(valid, scene, shadows, Coherence::kCoherent);
  for (int i = 0; i < kPacket; ++i) {
    if (valid[i] != 0 && !(shadows.tfar[i] < 0)) sums[i] += Color3f(strength[i]);
  }
  return traced;
}

std::uint64_t render_tile(RTCScene scene, const Job& job, Image& image, int left, int top) {
  std::uint64_t rays = 0;
  for (int y = top; y < std::min(top + kTile, image.height); y += 4) {
    for (int x = left; x < std::min(left + kTile, image.width); x += 4) {
      Color3f sums[kPacket] = {};
      for (int sample = 0; sample < job.samples; ++sample)
        rays += kPacket + static_cast<std::uint64_t>(trace(scene, job, image, x, y, sample, sums));
      for (int i = 0; i < kPacket; ++i) {
        if (x + i % 4 < image.width && y + i / 4 < image.height)
          image.set(x + i % 4, y + i / 4, sums[i] / static_cast<float>(job.samples));
      }
    }
  }
  return rays;
}

double seconds_since(std::chrono::steady_clock::time_point& start) {
  const auto now = std::chrono::steady_clock::now();
  return std::chrono::duration<double>(now - std::exchange(start, now)).count();
}

void run(char** arguments) {
  const auto number = [&](int i) { return std::atof(arguments[i]); };
  const auto vector = [&](int i) { return Vector3d(number(i), number(i + 1), number(i + 2)); };
  auto start = std::chrono::steady_clock::now();
  const Mesh mesh = read_ply(arguments[1]);
  const double load = seconds_since(start);
  RTCScene scene = build(mesh);
  const double build_time = seconds_since(start);

  Image image(std::atoi(arguments[3]), std::atoi(arguments[4]));
  const double half_height = std::tan(glm::radians(number(12)) / 2);
  const Job job{
      Camera(vector(6), vector(9), Vector3d(0, 1, 0), half_height * image.width / image.height, half_height),
      Vector3f(vector(13)), static_cast<float>(number(16) * number(17)), Color3f(0.25f, 0.4f, 0.65f),
      std::atoi(arguments[5])};
  const int across = (image.width + kTile - 1) / kTile, down = (image.height + kTile - 1) / kTile;
  std::vector<std::uint64_t> rays(static_cast<std::size_t>(across * down));
  parallel_for(rays.size(), [&](std::size_t i) {
    const int tile = static_cast<int>(i);
    rays[i] = render_tile(scene, job, image, tile % across * kTile, tile / across * kTile);
  });
  const double render = seconds_since(start);
  const std::vector<std::uint8_t> png = encode_png(image);
  const double encode = seconds_since(start);
  write_file(arguments[2], png);
  std::uint64_t all = 0;
  for (const std::uint64_t each : rays) all += each;
  fmt::print(
      "{{\"load\": {:.6f}, \"build\": {:.6f}, \"render\": {:.6f}, \"encode\": {:.6f}, \"write\": {:.6f}, "
      "\"rays\": {}}}\n",
      load, build_time, render, encode, seconds_since(start), all);
}

}  // namespace

int main(int count, char** arguments) {
  constexpr int kArguments = 18;
  if (count != kArguments) {
    fmt::print(stderr,
               "limit mesh.ply picture.png width height samples position(3) look_at(3) vertical_fov light(3) "
               "intensity color\n");
    return 2;
  }
  try {
    run(arguments);
  } catch (const Error& error) {
    fmt::print(stderr, "{}\n", error.what());
    return static_cast<int>(error.kind());
  }
  // Like raytracer, it leaves the memory to the system.
  std::fflush(stdout);
  std::_Exit(0);
}
