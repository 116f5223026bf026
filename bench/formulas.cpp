// How many formulas over a point are computed per second on one core: each is `color (…)` of a material,
// asked as a hit asks it, and as sixteen hits at once do. Prints one line each: millions per second for both,
// the best of several runs, and the formula.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <string>
#include <vector>

#include "raytracer/scene_file.hpp"
#include "textures/texture_block.hpp"

namespace {

using namespace raytracer;

constexpr const char* kFormulas[] = {
    // ten terms
    "0.5 + 0.1 * p.x + 0.2 * p.y * p.y - 0.05 * p.z + 0.3 * u * v + 0.02 * n.y - 0.1 * u * u + 0.04 * p.x * "
    "p.z"
    " + 0.03 * v * n.x + 0.06 * p.y * u",
    "u * u + v * v + p.x * p.y + p.y * p.z + p.z * p.x + n.x * u + n.y * v + n.z * p.x + p.x + p.y",
    "u + v + p.x + p.y + p.z + n.x + n.y + n.z + 0.5 * u + 0.25 * v",
    "abs(p.x) + max(p.y, 0) + min(u, v) + floor(4 * u) * 0.1 + clamp(v, 0.2, 0.8) + sqrt(u) + (u < v ? 0.1 : "
    "0.2) + u / 3"
    " + p.z % 1 + v",
    // three colours
    "(0.5 + 0.1 * p.x, 0.4 + 0.2 * u * v, 0.3 + 0.1 * n.y)",
    "0.5 * (n + (1, 1, 1))",
    "0.5 + 0.3 * sin(360 * u) * cos(180 * v)",
    "0.5 + 0.2 * noise(4 * p)",
};

std::vector<TexturePoint> some_points() {
  std::vector<TexturePoint> points(1024);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto x = static_cast<float>(i) / 1024;
    points[i].position = {x, 2 * x - 1, 0.3F - x};
    points[i].normal = glm::normalize(Vector3f(x, 1, 0.5F));
    points[i].uv = {x, 1 - x};
  }
  return points;
}

float ask_one_by_one(const Texture& texture, const std::vector<TexturePoint>& points) {
  float sum = 0;
  for (const TexturePoint& point : points) sum += texture.at(point).x;
  return sum;
}

float ask_in_blocks(const Texture& texture, const std::vector<TexturePoint>& points) {
  float sum = 0;
  TextureBlock block;
  block.count = kBlockSize;
  ColorBlock colors;
  for (std::size_t i = 0; i < points.size(); i += kBlockSize) {
    for (int lane = 0; lane < kBlockSize; ++lane) block.set(lane, points[i + static_cast<std::size_t>(lane)]);
    texture.colors_at(block, colors);
    for (const float x : colors.x) sum += x;
  }
  return sum;
}

double millions_per_second(const Texture& texture, const std::vector<TexturePoint>& points,
                           float (*ask)(const Texture&, const std::vector<TexturePoint>&)) {
  constexpr int kRuns = 20, kRounds = 100;
  double best = 0;
  float sum = 0;
  for (int run = 0; run < kRuns; ++run) {
    const auto begin = std::chrono::steady_clock::now();
    for (int round = 0; round < kRounds; ++round) sum += ask(texture, points);
    const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - begin;
    best = std::max(best, kRounds * static_cast<double>(points.size()) / taken.count() / 1e6);
  }
  return sum == 0.123F ? 0 : best;  // so that nothing is left out
}

}  // namespace

int main() {
  const std::vector<TexturePoint> points = some_points();
  for (const std::string formula : kFormulas) {
    const LoadedScene loaded = load_scene_text("sphere { material { color (" + formula + ") } }", "formula");
    if (!loaded.ok()) return 1;
    const auto scene = loaded.scene_at(0);
    const SceneDescription& description = scene->description();
    const Material& material = description.materials[description.material_of[0]];
    const Texture& texture = *material.textures->color;
    fmt::print("{:6.1f} {:6.1f}  {}\n", millions_per_second(texture, points, ask_one_by_one),
               millions_per_second(texture, points, ask_in_blocks), formula);
  }
}
