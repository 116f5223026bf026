// A mesh as read from a file, whatever the format.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "raytracer/vector3f.hpp"

namespace raytracer {

struct MeshData {
  std::vector<Vector3f> positions;
  std::vector<Vector3f> normals;    ///< none, or one per position; unit length, or 0 where the file has none
  std::vector<Vector2f> uvs;        ///< none, or one per position
  std::vector<Color3f> colors;      ///< none, or one per position
  bool has_display_colors = false;  ///< colours were bytes, which are display values; else linear
  std::vector<std::array<std::uint32_t, 3>> triangles;

  /// Triangles `begin` … `end` - 1 are of materials[material]; those of no range have the mesh's own
  /// material.
  struct Range {
    std::uint32_t begin = 0, end = 0;
    std::uint32_t material = 0;
  };
  std::vector<Range> ranges;
  /// As an MTL file says it, colours linear; what it does not say keeps these values.
  struct NamedMaterial {
    enum class Map : std::uint8_t {
      kColor,      ///< map_Kd
      kEmission,   ///< map_Ke
      kRoughness,  ///< map_Pr
      kMetallic,   ///< map_Pm
      kAlpha,      ///< map_d
      kNormal,     ///< norm
      kBump,       ///< map_bump, bump: heights, but many programs write normals there
    };
    static constexpr std::size_t kMaps = 7;

    std::string name;
    Color3f color{0.8f};                  ///< Kd
    Color3f emission{0};                  ///< Ke
    Color3f specular{0};                  ///< Ks
    float exponent = 0;                   ///< Ns
    float alpha = 1;                      ///< d, or 1 - Tr
    float ior = 1.5f;                     ///< Ni
    float roughness = -1;                 ///< Pr; below 0: not said
    float metallic = 0;                   ///< Pm
    int illumination = -1;                ///< illum; below 0: not said
    std::optional<float> bump_scale;      ///< -bm of map_bump or bump
    std::array<std::string, kMaps> maps;  ///< as written, relative to the MTL file's folder; empty: none
    std::string folder;                   ///< of the MTL file

    const std::string& map(Map which) const { return maps[static_cast<std::size_t>(which)]; }
  };
  std::vector<NamedMaterial> materials;

  std::vector<std::string> files_read;  ///< besides the mesh's own (MTL)
  std::vector<std::string> remarks;  ///< what a user should know: faces left out, a material file not found
};

}  // namespace raytracer
