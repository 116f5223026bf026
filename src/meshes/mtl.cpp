#include "meshes/mtl.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "meshes/obj_lines.hpp"
#include "raytracer/error.hpp"

namespace raytracer::meshes {
namespace {

using Material = MeshData::NamedMaterial;

// A material takes far more memory than the few letters that can begin one.
constexpr std::size_t kMostMaterials = 65536;

bool read_finite(Cursor& c, float& value) {
  skip_obj_blanks(c);
  double number = 0;
  if (!read_number(c, number) || !std::isfinite(static_cast<float>(number))) return false;
  value = static_cast<float>(number);
  return true;
}

// "r g b", or "r" alone for a grey. Colours from files of spectra and in CIE XYZ stay as they were.
void read_color(Cursor& c, Color3f& color) {
  Color3f read(0);
  if (!read_finite(c, read.r)) return;
  if (!read_finite(c, read.g)) {
    read.g = read.b = read.r;
  } else if (!read_finite(c, read.b)) {
    return;
  }
  color = glm::max(read, Color3f(0));
}

// How many words follow an option of a texture map at most, and whether all of them are numbers.
struct MapOption {
  std::string_view name;
  int words;
  bool numbers;
};
constexpr MapOption kMapOptions[] = {
    {"-blendu", 1, false}, {"-blendv", 1, false}, {"-boost", 1, true},       {"-mm", 2, true},
    {"-o", 3, true},       {"-s", 3, true},       {"-t", 3, true},           {"-texres", 1, false},
    {"-clamp", 1, false},  {"-bm", 1, true},      {"-imfchan", 1, false},    {"-type", 1, false},
    {"-cc", 1, false},     {"-halo", 0, false},   {"-colorspace", 1, false},
};

// `bump_scale` becomes what -bm says.
void skip_map_options(Cursor& c, std::optional<float>* bump_scale = nullptr) {
  while (true) {
    skip_obj_blanks(c);
    const std::string_view word = peek_word(c);
    const auto* const option = std::find_if(std::begin(kMapOptions), std::end(kMapOptions),
                                            [&](const MapOption& known) { return known.name == word; });
    if (option == std::end(kMapOptions)) return;
    read_word(c);
    for (int i = 0; i < option->words; ++i) {
      skip_obj_blanks(c);
      double number = 0;
      if (!option->numbers) {
        read_word(c);
      } else if (!read_number(c, number)) {
        break;
      } else if (option->name == "-bm" && bump_scale != nullptr &&
                 std::isfinite(static_cast<float>(number))) {
        *bump_scale = static_cast<float>(number);
      }
    }
  }
}

std::string read_map(Cursor& c, std::optional<float>* bump_scale = nullptr) {
  skip_map_options(c, bump_scale);
  std::string name(read_rest(c));
  std::replace(name.begin(), name.end(), '\\', '/');  // as Windows writes folders
  return name;
}

// One statement's reader. They leave the cursor anywhere in the statement.
using Read = void (*)(Cursor&, Material&);

template <float Material::*kField>
void number(Cursor& c, Material& material) {
  read_finite(c, material.*kField);
}
template <Color3f Material::*kField>
void color(Cursor& c, Material& material) {
  read_color(c, material.*kField);
}
template <Material::Map kMap>
void map(Cursor& c, Material& material) {
  material.maps[static_cast<std::size_t>(kMap)] = read_map(c);
}
void bump(Cursor& c, Material& material) {
  material.bump_scale.reset();
  material.maps[static_cast<std::size_t>(Material::Map::kBump)] = read_map(c, &material.bump_scale);
}
void dissolve(Cursor& c, Material& material) {
  skip_map_options(c);
  read_finite(c, material.alpha);
}
void transparency(Cursor& c, Material& material) {
  float value = 0;
  if (read_finite(c, value)) material.alpha = 1 - value;
}
void illumination(Cursor& c, Material& material) {
  skip_obj_blanks(c);
  std::int64_t value = 0;
  if (read_integer(c, value) && value >= 0 && value <= 1000) material.illumination = static_cast<int>(value);
}

const std::map<std::string_view, Read>& statements() {
  static const std::map<std::string_view, Read> kStatements = {
      {"Kd", color<&Material::color>},
      {"Ke", color<&Material::emission>},
      {"Ks", color<&Material::specular>},
      {"Ns", number<&Material::exponent>},
      {"Ni", number<&Material::ior>},
      {"Pr", number<&Material::roughness>},
      {"Pm", number<&Material::metallic>},
      {"d", dissolve},
      {"Tr", transparency},
      {"illum", illumination},
      {"map_Kd", map<Material::Map::kColor>},
      {"map_Ke", map<Material::Map::kEmission>},
      {"map_Pr", map<Material::Map::kRoughness>},
      {"map_Pm", map<Material::Map::kMetallic>},
      {"map_d", map<Material::Map::kAlpha>},
      {"norm", map<Material::Map::kNormal>},
      {"map_Kn", map<Material::Map::kNormal>},
      {"bump", bump},
      {"map_bump", bump},
      {"map_Bump", bump},
  };
  return kStatements;
}

}  // namespace

void read_mtl(std::string_view text, const std::string& folder, std::vector<Material>& materials) {
  if (text.substr(0, 3) == "\xEF\xBB\xBF") text.remove_prefix(3);
  Cursor c(text);
  bool in_material = false, has_dissolve = false;
  while (find_statement(c)) {
    Cursor now = c;
    skip_statement(c);
    const std::string_view word = read_word(now);
    if (word == "newmtl") {
      if (materials.size() == kMostMaterials) {
        throw Error(ErrorKind::kScene, "its material files have more than 65,536 materials");
      }
      Material& material = materials.emplace_back();
      material.name = read_rest(now);
      material.folder = folder;
      in_material = true;
      has_dissolve = false;
    } else if (in_material) {
      const auto known = statements().find(word);
      if (word == "d") has_dissolve = true;
      if (word == "Tr" && has_dissolve) continue;  // files that say both mean 'd' (some write Tr = d)
      if (known != statements().end()) known->second(now, materials.back());
    }
  }
}

}  // namespace raytracer::meshes
