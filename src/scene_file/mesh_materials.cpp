// From the words of an MTL file to a material.
#include <cmath>

#include "scene_file/mesh_store.hpp"

namespace raytracer::scene_file {
namespace {

// The roughness of a Phong lobe of that exponent: B. Walter et al., "Microfacet Models for Refraction through
// Rough Surfaces", EGSR 2007, section 5.2: alpha = sqrt(2 / (n + 2)), and alpha is the square of the
// roughness.
float roughness_of_exponent(float exponent) { return std::pow(2 / (exponent + 2), 0.25f); }

bool is_black(const Color3f& color) { return color == Color3f(0); }

}  // namespace

std::span<const MtlMap> mtl_maps() {
  using Map = MeshData::NamedMaterial::Map;
  static constexpr MtlMap kMaps[] = {
      {Map::kColor, &MaterialTextures::color, MtlContent::kColor},
      {Map::kEmission, &MaterialTextures::emission, MtlContent::kColor},
      {Map::kRoughness, &MaterialTextures::roughness},
      {Map::kMetallic, &MaterialTextures::metallic},
      {Map::kAlpha, &MaterialTextures::alpha},
      {Map::kNormal, &MaterialTextures::normal_map},
      {Map::kBump, &MaterialTextures::normal_map, MtlContent::kBumpNormals},
      {Map::kBump, &MaterialTextures::bump, MtlContent::kBumpHeights},
  };
  return kMaps;
}

Material material_from_mtl(const MeshData::NamedMaterial& said) {
  Material material;
  material.color = said.color;
  material.emission = said.emission;
  material.alpha = said.alpha;
  material.metallic = said.metallic;
  material.ior = said.ior > 1 ? said.ior : 1.5f;
  // Without a highlight the surface is a plain Lambert one.
  const bool has_maps = !said.map(MeshData::NamedMaterial::Map::kRoughness).empty() ||
                        !said.map(MeshData::NamedMaterial::Map::kMetallic).empty();
  material.has_layer = said.roughness >= 0 || said.metallic > 0 || has_maps || !is_black(said.specular);
  if (said.roughness >= 0) {
    material.roughness = said.roughness;
  } else if (material.has_layer) {
    material.roughness = roughness_of_exponent(std::max(0.0f, said.exponent));
  }
  return material;
}

}  // namespace raytracer::scene_file
