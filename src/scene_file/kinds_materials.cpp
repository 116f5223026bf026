// The rows of `material`: the paper's two words, and glTF 2.0's metallic-roughness model with its ratified
// extensions.
#include <array>
#include <limits>
#include <memory>
#include <optional>
#include <string_view>

#include "scene_file/builder.hpp"
#include "scene_file/kinds.hpp"
#include "textures/patterns.hpp"

namespace raytracer::scene_file {
namespace {

constexpr Range kIndexOfRefraction{1, 10, false};
constexpr Range kMetalIndex{0, 100, true};        // eta of a metal
constexpr Range kMetalAbsorption{0, 100, false};  // its k
constexpr Range kEvenly{-1, 1, false};
constexpr Range kBending{-100, 100, false};

/// Textures that multiply the one of the same name.
struct Factors {
  TexturePointer emission, normal_map, bump;
};

struct MaterialInput {
  std::optional<ColorValue> color;
  double shininess = 0;
  std::optional<double> roughness, metallic, ior, specular;
  double anisotropy = 0;
  std::optional<Vector3d> eta, k;
  double transmission = 0;
  bool thin = false;
  ColorValue attenuation_color{Vector3d(1)};
  std::optional<double> attenuation_distance;
  double coat = 0, coat_roughness = 0;
  ColorValue emission{Vector3d(0)};
  double emission_strength = 1;
  double alpha = 1;
  bool energy_compensation = true;
  MaterialTextures textures;
  Factors factors;
  std::optional<ColorValue> normal_map;
  std::optional<double> bump;
  double normal_scale = 1, bump_scale = 1;
};
constexpr PropertyRow kMaterial[] = {
    property<&MaterialInput::color>("color", "The share of light that it returns, or lets through.")
        .within(kShare)
        .or_else("0.8; 1 with transmission, or eta and k")
        .or_texture<&MaterialInput::textures, &MaterialTextures::color>(),
    property<&MaterialInput::shininess>("shininess", "0 is matt, 1 all mirror, between is partly both.")
        .or_texture<&MaterialInput::textures, &MaterialTextures::shininess>(),
    property<&MaterialInput::roughness>(
        "roughness", "0 is polished, 1 dull. It, ior or specular puts a layer over the colour.")
        .within(kShare)
        .or_else("0.3; 0 with transmission")
        .or_texture<&MaterialInput::textures, &MaterialTextures::roughness>(),
    property<&MaterialInput::metallic>("metallic", "1 is metal, which reflects in its colour.")
        .within(kShare)
        .or_else("0")
        .or_texture<&MaterialInput::textures, &MaterialTextures::metallic>(),
    property<&MaterialInput::ior>("ior", "How strongly it refracts: water 1.33, glass 1.5, diamond 2.42.")
        .within(kIndexOfRefraction)
        .or_else("1.5")
        .or_texture<&MaterialInput::textures, &MaterialTextures::ior>(),
    property<&MaterialInput::specular>("specular", "The strength of the layer's reflection.")
        .within(kShare)
        .or_else("1")
        .or_texture<&MaterialInput::textures, &MaterialTextures::specular>(),
    property<&MaterialInput::transmission>("transmission",
                                           "1 is clear: light goes in instead of coming back.")
        .within(kShare)
        .or_texture<&MaterialInput::textures, &MaterialTextures::transmission>(),
    property<&MaterialInput::thin>("thin", "A sheet without an inside, as a soap bubble or a pane."),
    property<&MaterialInput::attenuation_color>(
        "attenuation_color", "What white light has become after attenuation_distance inside.")
        .within(kShare)
        .or_texture<&MaterialInput::textures, &MaterialTextures::attenuation_color>(),
    property<&MaterialInput::attenuation_distance>("attenuation_distance",
                                                   "The way inside after which it has.")
        .in("scene units")
        .within(kPositive)
        .or_else("endless: clear")
        .or_texture<&MaterialInput::textures, &MaterialTextures::attenuation_distance>(),
    property<&MaterialInput::emission>("emission", "What it gives off; 1 is white.")
        .within(kBrightness)
        .or_texture<&MaterialInput::textures, &MaterialTextures::emission>(),
    property<&MaterialInput::emission_strength>("emission_strength", "Times emission.")
        .within(kBrightness)
        .or_texture<&MaterialInput::factors, &Factors::emission>(),
    property<&MaterialInput::coat>("coat", "The share of it that has a clear coat over all else.")
        .within(kShare)
        .or_texture<&MaterialInput::textures, &MaterialTextures::coat>(),
    property<&MaterialInput::coat_roughness>("coat_roughness", "The roughness of the coat.")
        .within(kShare)
        .or_texture<&MaterialInput::textures, &MaterialTextures::coat_roughness>(),
    property<&MaterialInput::anisotropy>("anisotropy", "Brushed: highlights grow along u (> 0) or across.")
        .within(kEvenly)
        .or_texture<&MaterialInput::textures, &MaterialTextures::anisotropy>(),
    property<&MaterialInput::alpha>("alpha", "Below 1 it is there for that share of the light only.")
        .within(kShare)
        .or_texture<&MaterialInput::textures, &MaterialTextures::alpha>()
        .as_opacity(),
    property<&MaterialInput::energy_compensation>(
        "energy_compensation", "Gives rough surfaces the light back that is scattered more than once."),
    property<&MaterialInput::eta>("eta", "A measured metal: its index of refraction for red, green and blue.")
        .within(kMetalIndex)
        .as(PropertyType::kVector)
        .or_else("no measured metal")
        .or_texture<&MaterialInput::textures, &MaterialTextures::eta>(),
    property<&MaterialInput::k>("k", "Its absorption for red, green and blue.")
        .within(kMetalAbsorption)
        .as(PropertyType::kVector)
        .or_else("no measured metal")
        .or_texture<&MaterialInput::textures, &MaterialTextures::k>(),
    property<&MaterialInput::normal_map>("normal_map",
                                         "Bends the normal: red, green, blue are along u, v and away.")
        .or_texture<&MaterialInput::textures, &MaterialTextures::normal_map>()
        .for_textures_alone()
        .or_else("not given"),
    property<&MaterialInput::normal_scale>("normal_scale", "How strongly it does.")
        .within(kBending)
        .or_texture<&MaterialInput::factors, &Factors::normal_map>(),
    property<&MaterialInput::bump>("bump", "Heights that bend the normal, as if they were there.")
        .or_texture<&MaterialInput::textures, &MaterialTextures::bump>()
        .for_textures_alone()
        .or_else("not given"),
    property<&MaterialInput::bump_scale>("bump_scale", "The height of 1.")
        .in("scene units")
        .or_texture<&MaterialInput::factors, &Factors::bump>(),
};

constexpr std::string_view kWordsToCome[] = {"sheen_color", "iridescence", "dispersion"};

// Whether what is said fits together; says where not.
bool is_consistent(const MaterialInput& in, BlockContext& block) {
  if (in.eta.has_value() != in.k.has_value()) {
    block.error(in.eta ? "eta" : "k", "'eta' and 'k' make a metal together",
                in.eta ? "k 3.9 2.4 1.6" : "eta 0.14 0.37 1.44");
    return false;
  }
  if (in.eta && in.metallic && *in.metallic < 1 && !in.textures.metallic) {
    block.error("metallic", "'eta' and 'k' are a metal's, and 'metallic' says it is none",
                "remove 'metallic'");
    return false;
  }
  const double metallic = in.metallic.value_or(in.eta ? 1 : 0);
  if (metallic == 1 && in.transmission > 0) {
    block.error("transmission",
                "a metal lets no light in: 'metallic' and 'transmission' contradict each other",
                "remove one of them");
    return false;
  }
  return true;
}

// Words without effect because another one is missing.
void warn_of_idle_words(const MaterialInput& in, BlockContext& block) {
  struct Idle {
    std::string_view word;
    bool has_effect;
    std::string_view needed, example;
  };
  const bool has_inside = in.transmission > 0 && !in.thin;
  const bool lets_in = in.transmission > 0;
  const Idle idle[] = {
      {"attenuation_color", has_inside, lets_in ? "an inside" : "'transmission'",
       lets_in ? "thin false" : "transmission 1"},
      {"attenuation_distance", has_inside, lets_in ? "an inside" : "'transmission'",
       lets_in ? "thin false" : "transmission 1"},
      {"attenuation_color", in.attenuation_distance.has_value(), "'attenuation_distance'",
       "attenuation_distance 1"},
      {"attenuation_distance", block.is_given("attenuation_color"), "'attenuation_color'",
       "attenuation_color 0.6 0.9 0.7"},
      {"thin", lets_in || !in.thin, "'transmission'", "transmission 1"},
      {"emission_strength", block.is_given("emission"), "'emission'", "emission 1"},
      {"coat_roughness", in.coat > 0 || block.is_given("coat"), "'coat'", "coat 1"},
      {"normal_scale", in.textures.normal_map != nullptr, "'normal_map'", "normal_map image \"normals.png\""},
      {"bump_scale", in.textures.bump != nullptr, "'bump'", "bump noise { }"},
  };
  for (const Idle& row : idle) {
    if (row.has_effect || !block.is_given(row.word)) continue;
    block.warning(
        row.word,
        std::string("'") + std::string(row.word) + "' has no effect without " + std::string(row.needed),
        std::string(row.example));
  }
}

TextureInput input_of(const TexturePointer& texture, const Color3f& same) {
  return texture ? TextureInput(texture) : TextureInput(same);
}

// Null where it is the same everywhere.
TexturePointer rescaled(const TextureInput& texture, const TextureInput& factor, const Range& range,
                        Rescaling rescaling = {}) {
  if (!texture.texture && !factor.texture) return nullptr;
  if (!factor.texture && factor.color == Color3f(1)) return texture.texture;
  rescaling.factor = factor;
  rescaling.least = static_cast<float>(range.least);
  rescaling.most = static_cast<float>(range.most);
  return make_rescaled(texture, std::move(rescaling));
}

// Null where there are none.
std::shared_ptr<const MaterialTextures> textures_of(const MaterialInput& in) {
  MaterialTextures textures = in.textures;
  const auto factor_of = [](const TexturePointer& factor, double same) {
    return input_of(factor, Color3f(static_cast<float>(same)));
  };
  textures.emission = rescaled(input_of(textures.emission, Color3f(in.emission.rgb)),
                               factor_of(in.factors.emission, in.emission_strength), kBrightness);
  if (textures.normal_map) {
    Rescaling bending;
    bending.around = Color3f(0.5f);
    bending.channels = {1, 1, 0};
    textures.normal_map =
        rescaled(textures.normal_map, factor_of(in.factors.normal_map, in.normal_scale), kBending, bending);
  }
  if (textures.bump) {
    textures.bump = rescaled(textures.bump, factor_of(in.factors.bump, in.bump_scale), kAnyNumber);
  }
  if (textures == MaterialTextures{}) return nullptr;
  return std::make_shared<const MaterialTextures>(std::move(textures));
}

void build_material(const MaterialInput& in, BlockContext& block) {
  if (!is_consistent(in, block)) return;
  warn_of_idle_words(in, block);
  Material material;
  const bool lets_in = in.transmission > 0;
  const bool is_measured = in.eta.has_value();
  material.color = Color3f(in.color.value_or(ColorValue{Vector3d(lets_in || is_measured ? 1 : 0.8)}).rgb);
  material.shininess = static_cast<float>(in.shininess);
  material.has_layer = in.roughness || in.ior || in.specular || lets_in;
  material.roughness = static_cast<float>(in.roughness.value_or(block.is_given("transmission") ? 0 : 0.3));
  material.metallic = static_cast<float>(in.metallic.value_or(is_measured ? 1 : 0));
  material.ior = static_cast<float>(in.ior.value_or(1.5));
  material.specular = static_cast<float>(in.specular.value_or(1));
  material.anisotropy = static_cast<float>(in.anisotropy);
  if (is_measured) material.conductor = {Vector3f(*in.eta), Vector3f(*in.k)};
  material.transmission = static_cast<float>(in.transmission);
  material.thin = in.thin;
  material.attenuation_color = Color3f(in.attenuation_color.rgb);
  if (in.attenuation_distance) {
    material.attenuation_distance = static_cast<float>(*in.attenuation_distance);
  }
  material.coat = static_cast<float>(in.coat);
  material.coat_roughness = static_cast<float>(in.coat_roughness);
  const Vector3d emission = in.emission_strength * in.emission.rgb;
  if (std::max({emission.x, emission.y, emission.z}) > kBrightest) {
    return block.error("emission_strength",
                       "'emission' times 'emission_strength' is more than can be computed with");
  }
  material.emission = Color3f(emission);
  material.alpha = static_cast<float>(in.alpha);
  material.energy_compensation = in.energy_compensation;
  material.textures = textures_of(in);
  block.add_material(material);
}

}  // namespace

std::span<const KindRow> material_kinds() {
  static const KindRow rows[] = {[] {
    KindRow row = kind<MaterialInput, build_material>("material", "What a surface is made of.", kMaterial);
    row.block_class = BlockClass::kMaterial;
    row.words_to_come = kWordsToCome;
    return row;
  }()};
  return rows;
}

}  // namespace raytracer::scene_file
