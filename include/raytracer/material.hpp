// What a surface does with light.
#pragma once

#include <memory>
#include <optional>

#include "raytracer/texture.hpp"
#include "raytracer/vector3f.hpp"

namespace raytracer {

/// The index of refraction and the absorption of a metal, per channel.
struct ConductorIndex {
  Vector3f eta{0}, k{1};
};

/// Textures that stand in for a material's values of the same name; null: the value itself counts.
struct MaterialTextures {
  TexturePointer color, shininess, roughness, metallic, ior, specular, transmission, attenuation_color,
      attenuation_distance, emission, coat, coat_roughness, anisotropy, alpha;
  TexturePointer eta, k;      ///< of the conductor
  TexturePointer normal_map;  ///< tangent space: linear r, g, b in 0..1 for x, y, z in -1..1
  TexturePointer bump;        ///< a height along the normal, in scene units

  bool operator==(const MaterialTextures&) const = default;
};

/// What a material is at one point. Data alone. The paper's two words first; the rest means what glTF 2.0's
/// metallic-roughness model and its ratified extensions mean by it. Shares are 0..1.
struct MaterialValues {
  Color3f color{0.8f};  ///< share of the light that the surface returns, per channel, 0..1
  float shininess = 0;  ///< share of a perfect mirror, clamped to 0..1: <= 0 is diffuse, >= 1 all mirror

  /// Whether the dielectric layer over the diffuse base is there: once roughness, ior or specular is written.
  bool has_layer = false;
  float roughness = 0.3f;  ///< alpha of GGX is its square
  float metallic = 0;
  /// Of the layer, and of the inside where light is let in. A body whose values differ from place to place
  /// has throughout, for light on its way, those of the place where that came in; so have the two
  /// attenuations.
  float ior = 1.5f;
  float specular = 1;    ///< strength of the dielectric reflection
  float anisotropy = 0;  ///< -1..1: roughness grows across (> 0: highlights along) the surface's u direction
  std::optional<ConductorIndex> conductor;  ///< a measured metal; `color` then tints its reflection

  float transmission = 0;                  ///< share of the base that lets light in instead of scattering it
  bool thin = false;                       ///< a sheet without an inside: light goes straight through
  Color3f attenuation_color{1};            ///< what white light has become after …
  float attenuation_distance = kInfinity;  ///< … this way inside, in scene units

  float coat = 0;  ///< share of the surface with a clear coat of index 1.5
  float coat_roughness = 0;

  Color3f emission{0};  ///< radiance given off, 1 is white; emission times emission_strength
  float alpha = 1;      ///< below 1 the surface is there for that share of the rays only

  bool energy_compensation =
      true;  ///< multiple scattering between the facets; false: single scattering alone

  /// The surface of an area light: shines on the side of its normal only and reflects nothing.
  bool is_area_light = false;
  bool is_visible = true;  ///< of an area light: whether the camera sees it

  /// Whether the colours of a mesh's vertices multiply `color`.
  bool takes_vertex_colors = true;

  bool is_emissive() const { return emission.x > 0 || emission.y > 0 || emission.z > 0; }
};

/// The same everywhere but for what its textures say.
struct Material : MaterialValues {
  std::shared_ptr<const MaterialTextures> textures;  ///< null: none

  /// Whether it shines anywhere.
  bool is_emissive() const { return MaterialValues::is_emissive() || (textures && textures->emission); }
};

}  // namespace raytracer
