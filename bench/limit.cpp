// The yardstick: what a picture costs at least. It traces the very camera, mirror and shadow rays that
// raytracer traces, in packets through Embree, with the simplest Lambert shading, and writes the same PNG
// with the same code. It reads what bench/languages.py writes for it and knows no other scenes.
#include <fmt/format.h>

#include <chrono>
#include <cstdlib>
#include <utility>

#include "core/parallel.hpp"
#include "limit_trace.hpp"
#include "limit_tree.hpp"
#include "limit_world.hpp"
#include "raytracer/error.hpp"
#include "raytracer/image.hpp"

using namespace raytracer;

namespace {

double seconds_since(std::chrono::steady_clock::time_point& start) {
  const auto now = std::chrono::steady_clock::now();
  return std::chrono::duration<double>(now - std::exchange(start, now)).count();
}

void run(const char* scene, const char* picture) {
  auto start = std::chrono::steady_clock::now();
  const limit::World world = limit::read_world(scene);
  const double load = seconds_since(start);
  const limit::Tree tree = limit::build_tree(world);
  const double build = seconds_since(start);
  Image image(world.width, world.height);
  const std::uint64_t rays = limit::trace(world, tree, image);
  const double render = seconds_since(start);
  const std::vector<std::uint8_t> png = encode_png(image);
  const double encode = seconds_since(start);
  write_file(picture, png);
  fmt::print(
      "{{\"load\": {:.6f}, \"build\": {:.6f}, \"render\": {:.6f}, \"encode\": {:.6f}, \"write\": {:.6f}, "
      "\"rays\": {}}}\n",
      load, build, render, encode, seconds_since(start), rays);
  std::fflush(stdout);
  // Like raytracer, it leaves the memory to the system.
  std::_Exit(0);
}

}  // namespace

int main(int count, char** arguments) {
  constexpr int kArguments = 4;
  if (count != kArguments) {
    fmt::print(stderr, "limit scene picture.png threads\n");
    return 2;
  }
  try {
    run_with_threads(std::atoi(arguments[3]), [&] { run(arguments[1], arguments[2]); });
  } catch (const Error& error) {
    fmt::print(stderr, "{}\n", error.what());
    return static_cast<int>(error.kind());
  }
}
