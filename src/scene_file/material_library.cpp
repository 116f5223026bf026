#include "scene_file/material_library.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "materials/metals.hpp"

namespace raytracer::scene_file {
namespace {

struct Row {
  std::string_view name, help, text;
};

// The measured metals, as they come from the workshop: neither dull nor a mirror.
constexpr std::string_view kMetalText = "eta {:.3g} {:.3g} {:.3g}  k {:.3g} {:.3g} {:.3g}  roughness {}";
constexpr double kMetalRoughness = 0.2;

LibraryMaterial measured(std::string_view name, std::string_view help, const ConductorIndex& index,
                         double roughness) {
  const Vector3f &eta = index.eta, &k = index.k;
  return {name, help, fmt::format(kMetalText, eta.x, eta.y, eta.z, k.x, k.y, k.z, roughness)};
}

// One row registers a material.
constexpr Row kRows[] = {
    {"glass", "Clear glass.", "transmission 1  ior 1.5"},
    {"frosted_glass", "Glass that is seen through, but not clearly.",
     "transmission 1  ior 1.5  roughness 0.35"},
    {"water", "Clear water.", "transmission 1  ior 1.333"},
    {"ice", "Ice, a little dull.", "transmission 1  ior 1.31  roughness 0.05"},
    {"diamond", "Diamond, without its play of colours.", "transmission 1  ior 2.417"},
    {"soap_film", "A film as thin as a bubble's.", "transmission 1  ior 1.333  thin true"},
    {"mirror", "A good mirror.", "color 0.95  shininess 1"},
    {"plaster", "A white wall.", "color 0.85 0.84 0.81"},
    {"paper", "White paper.", "color 0.88 0.88 0.86"},
    {"chalk", "White chalk.", "color 0.92"},
    {"clay", "Burnt clay, as of flower pots.", "color 0.52 0.2 0.1  roughness 0.85"},
    {"concrete", "Grey concrete.", "color 0.45 0.44 0.42  roughness 0.9"},
    {"marble", "White marble, polished.", "color 0.82 0.81 0.78  roughness 0.15"},
    {"wood", "Brown wood, without its grain.", "color 0.36 0.2 0.09  roughness 0.5"},
    {"leather", "Brown leather.", "color 0.14 0.06 0.03  roughness 0.45"},
    {"porcelain", "White glazed porcelain.", "color 0.86 0.85 0.82  roughness 0.5  coat 1"},
    {"plastic", "White plastic.", "color 0.8  roughness 0.2"},
    {"rubber", "Black rubber.", "color 0.025  roughness 0.75"},
    {"lacquer", "Red lacquer, as of cars.", "color 0.5 0.01 0.01  roughness 0.4  coat 1"},
};

}  // namespace

std::span<const LibraryMaterial> material_library() {
  static const std::vector<LibraryMaterial> all = [] {
    std::vector<LibraryMaterial> materials;
    for (const Metal& metal : metals())
      materials.push_back(measured(metal.name, "A measured metal.", metal.index, kMetalRoughness));
    materials.push_back(measured("chrome", "Chromium, polished.", *find_metal("chromium"), 0));
    for (const Row& row : kRows) materials.push_back({row.name, row.help, std::string(row.text)});
    return materials;
  }();
  return all;
}

const LibraryMaterial* find_library_material(std::string_view name) {
  const auto all = material_library();
  const auto found = std::ranges::find(all, name, &LibraryMaterial::name);
  return found == all.end() ? nullptr : &*found;
}

}  // namespace raytracer::scene_file
