// What the words of light become: materials, area lights, settings; display and linear colours; and what is
// told where they contradict each other.
#include <cmath>
#include <string>
#include <vector>

#include "catch.hpp"
#include "raytracer/scene_file.hpp"

using raytracer::Color3f;
using raytracer::Diagnostic;
using raytracer::Falloff;
using raytracer::Light;
using raytracer::load_scene_text;
using raytracer::LoadedScene;
using raytracer::LoadOptions;
using raytracer::Material;
using raytracer::Method;
using raytracer::RenderSettings;
using raytracer::Sampling;
using raytracer::Scene;
using raytracer::Severity;
using raytracer::Tone;

namespace {

constexpr const char* kFrame = "camera { position 0 0 9 } light { position 5 5 9 } ";

LoadedScene load(const std::string& text, const LoadOptions& options = {}) {
  LoadedScene scene = load_scene_text(text, "words.txt", options);
  for (const Diagnostic& diagnostic : scene.diagnostics) UNSCOPED_INFO(raytracer::to_text(diagnostic));
  REQUIRE(scene.ok());
  return scene;
}

/// The material of the only shape; nothing is warned of.
Material material(const std::string& words, const std::string& before = {}) {
  const LoadedScene loaded = load(kFrame + before + "sphere { material { " + words + " } }");
  CHECK(loaded.diagnostics.empty());
  const auto scene = loaded.scene_at(0);
  REQUIRE(scene->description().shapes.size() == 1);
  return scene->description().materials[scene->description().material_of[0]];
}

std::vector<Diagnostic> complaints(const std::string& text, const LoadOptions& options = {}) {
  return load_scene_text(text, "words.txt", options).diagnostics;
}

/// The only message about a material of these words; it stands at `at` in them.
Diagnostic complaint(const std::string& words, const std::string& at) {
  const std::string text = kFrame + std::string("sphere { material { ") + words + " } }";
  const std::vector<Diagnostic> found = complaints(text);
  for (const Diagnostic& diagnostic : found) UNSCOPED_INFO(raytracer::to_text(diagnostic));
  REQUIRE(found.size() == 1);
  CHECK(found[0].column == text.find(at, text.find("material")) + 1);
  return found[0];
}

bool is_error(const Diagnostic& diagnostic) { return diagnostic.severity == Severity::kError; }

RenderSettings settings(const std::string& words, const LoadOptions& options = {}) {
  return load(kFrame + ("render { " + words + " } sphere { }"), options).settings;
}

Light first_light(const std::string& text) {
  return load("camera { position 0 0 9 } sphere { } " + text).scene_at(0)->description().lights.at(0);
}

constexpr float kTomato[3] = {255 / 255.0f, 99 / 255.0f, 71 / 255.0f};

float linear(float display) { return std::pow((display + 0.055f) / 1.055f, 2.4f); }

void check_color(const Color3f& found, const Color3f& wanted) {
  for (int c = 0; c < 3; ++c) CHECK(found[c] == Approx(wanted[c]).epsilon(1e-5));
}

}  // namespace

// --- materials -----------------------------------------------------------------------------------------

TEST_CASE("a material of the paper's two words has nothing else") {
  for (const char* words : {"", "color 0.2 0.3 0.4", "shininess 0.5"}) {
    const Material m = material(words);
    CHECK_FALSE(m.has_layer);
    CHECK(m.metallic == 0);
    CHECK(m.transmission == 0);
    CHECK(m.coat == 0);
    CHECK_FALSE(m.is_emissive());
    CHECK(m.alpha == 1);
    CHECK_FALSE(m.conductor);
  }
  CHECK(material("").color == Color3f(0.8f));
}

TEST_CASE("the layer is there once roughness, ior or specular is written, or light is let in") {
  for (const char* words : {"roughness 0.3", "ior 1.5", "specular 1", "transmission 1"})
    CHECK(material(words).has_layer);
  for (const char* words : {"metallic 1", "coat 1", "emission 1", "transmission 0"})
    CHECK_FALSE(material(words).has_layer);
}

TEST_CASE("roughness is 0.3, and 0 where transmission is written") {
  CHECK(material("ior 1.5").roughness == 0.3f);
  CHECK(material("metallic 1").roughness == 0.3f);
  CHECK(material("transmission 1").roughness == 0);
  CHECK(material("transmission 0.5  roughness 0.2").roughness == 0.2f);
}

TEST_CASE("colour is 0.8, and white where light goes through or a metal is measured") {
  CHECK(material("roughness 0.5").color == Color3f(0.8f));
  CHECK(material("transmission 1").color == Color3f(1));
  CHECK(material("eta 0.2 0.9 1.1  k 3.9 2.4 2.2").color == Color3f(1));
  CHECK(material("transmission 1  color 0.5").color == Color3f(0.5f));
}

TEST_CASE("every word of a material arrives") {
  const Material m = material(
      "color 0.1 0.2 0.3  shininess 0.25  roughness 0.6  metallic 0.5  ior 1.7  specular 0.4  anisotropy "
      "-0.3 "
      "coat 0.9  coat_roughness 0.15  emission 1 2 3  emission_strength 4  alpha 0.75  energy_compensation "
      "false");
  CHECK(m.color == Color3f(0.1f, 0.2f, 0.3f));
  CHECK(m.shininess == 0.25f);
  CHECK(m.roughness == 0.6f);
  CHECK(m.metallic == 0.5f);
  CHECK(m.ior == 1.7f);
  CHECK(m.specular == 0.4f);
  CHECK(m.anisotropy == -0.3f);
  CHECK(m.coat == 0.9f);
  CHECK(m.coat_roughness == 0.15f);
  CHECK(m.emission == Color3f(4, 8, 12));
  CHECK(m.alpha == 0.75f);
  CHECK_FALSE(m.energy_compensation);
  const Material glass = material("transmission 1  attenuation_color 0.5 0.6 0.7  attenuation_distance 2.5");
  CHECK(glass.attenuation_color == Color3f(0.5f, 0.6f, 0.7f));
  CHECK(glass.attenuation_distance == 2.5f);
  CHECK_FALSE(glass.thin);
  CHECK(material("transmission 1  thin true").thin);
  const Material metal = material("eta 0.2 0.9 1.1  k 3.9 2.4 2.2");
  REQUIRE(metal.conductor);
  CHECK(metal.conductor->eta == raytracer::Vector3f(0.2f, 0.9f, 1.1f));
  CHECK(metal.conductor->k == raytracer::Vector3f(3.9f, 2.4f, 2.2f));
  CHECK(metal.metallic == 1);
}

TEST_CASE("words of a material that contradict each other are errors at one of them") {
  CHECK(is_error(complaint("metallic 1  transmission 1", "transmission")));
  CHECK(is_error(complaint("transmission 0.5  eta 1 1 1  k 2 2 2", "transmission")));
  CHECK(is_error(complaint("eta 0.2 0.9 1.1", "eta")));
  CHECK(is_error(complaint("k 0.2 0.9 1.1", "k 0")));
  CHECK(is_error(complaint("eta 1 1 1  k 2 2 2  metallic 0.5", "metallic")));
  CHECK(is_error(complaint("emission 1e30  emission_strength 1e30", "emission_strength")));
}

TEST_CASE("values of a material out of their range are errors") {
  for (const char* words :
       {"color 1.01", "roughness 1.1", "roughness -0.1", "metallic 2", "ior 0.9", "specular 1.5",
        "transmission 1.2", "attenuation_color 2", "attenuation_distance 0", "emission -1", "coat 3",
        "coat_roughness -1", "anisotropy 1.2", "alpha 1.5", "eta 0 1 1", "k -1 0 0"}) {
    const std::vector<Diagnostic> found =
        complaints(kFrame + std::string("sphere { material { ") + words + " } }");
    INFO(words);
    REQUIRE(found.size() == 1);
    CHECK(is_error(found[0]));
  }
}

TEST_CASE("words of a material without effect are warned of") {
  CHECK_FALSE(is_error(complaint("emission_strength 2", "emission_strength")));
  CHECK_FALSE(is_error(complaint("coat_roughness 0.2", "coat_roughness")));
  CHECK_FALSE(is_error(complaint("thin true", "thin")));
  CHECK_FALSE(is_error(complaint("attenuation_color 0.5", "attenuation_color")));
  CHECK_FALSE(is_error(complaint("transmission 1  attenuation_color 0.5", "attenuation_color")));
  CHECK_FALSE(is_error(complaint("transmission 1  attenuation_distance 2", "attenuation_distance")));
}

TEST_CASE("words that come later are told apart from slips") {
  for (const char* word : {"sheen_color", "iridescence", "dispersion"}) {
    const Diagnostic told = complaint(word + std::string(" 1"), word);
    CHECK(is_error(told));
    CHECK(told.message == "'" + std::string(word) + "' can't be shown yet");
  }
}

TEST_CASE("a sheet of solid glass is warned of, a thin one and a closed shape are not") {
  const std::string frame = kFrame;
  const auto count = [&](const std::string& shape) { return complaints(frame + shape).size(); };
  for (const char* shape : {"quad", "disk", "triangle"}) {
    const std::string points = shape == std::string("triangle") ? "a 0 0 0  b 1 0 0  c 0 1 0  " : "";
    CHECK(count(shape + (" { " + points) + "material { transmission 1 } }") == 1);
    CHECK(count(shape + (" { " + points) + "material { transmission 1  thin true } }") == 0);
  }
  for (const char* shape : {"sphere", "cube", "torus", "cylinder"})
    CHECK(count(shape + std::string(" { material { transmission 1 } }")) == 0);
}

// --- the library -----------------------------------------------------------------------------------------

TEST_CASE("materials of the library need no definition") {
  const auto named = [](const std::string& text) {
    const LoadedScene loaded = load(kFrame + text);
    CHECK(loaded.diagnostics.empty());
    const auto scene = loaded.scene_at(0);
    return scene->description().materials[scene->description().material_of[0]];
  };
  CHECK(named("sphere { material glass }").transmission == 1);
  CHECK(named("sphere { material glass }").ior == 1.5f);
  CHECK(named("sphere { material water }").ior == 1.333f);
  CHECK(named("define ball (size 1) { sphere { radius size  material diamond } } ball { }").ior == 2.417f);
  CHECK(named("group { material mirror  sphere { } }").shininess == 1);
  CHECK(named("sphere { material gold }").conductor);
  CHECK(named("sphere { material gold }").conductor->k.x == Approx(3.98f).margin(0.01));
  CHECK(named("sphere { material chrome }").roughness == 0);
  // The scene's own goes first.
  CHECK(named("material glass { color 1 0 0 } sphere { material glass }").color == Color3f(1, 0, 0));
}

TEST_CASE("a material of the library is made once") {
  const LoadedScene loaded =
      load(kFrame + std::string("for i from 1 to 9 { sphere { center i 0 0  material ice } }"));
  CHECK(loaded.scene_at(0)->description().materials.size() == 2);
}

TEST_CASE("a misspelt material finds its name in the library, and one defined below is told") {
  const auto slip = complaints(kFrame + std::string("sphere { material glas }"));
  REQUIRE(slip.size() == 1);
  CHECK(slip[0].suggestion == "did you mean 'glass'?");
  const auto later = complaints(kFrame + std::string("sphere { material glass } material glass { }"));
  REQUIRE_FALSE(later.empty());
  CHECK(is_error(later[0]));
}

TEST_CASE("a scene written down has the library's materials once") {
  const LoadedScene loaded =
      load(kFrame + std::string("sphere { material glass } sphere { material glass }"));
  const std::string json = loaded.json_at(0, {});
  CHECK(json.find(R"("name": "glass", "transmission": 1, "ior": 1.5})") != std::string::npos);
  const auto again = load(json).scene_at(0);
  CHECK(again->description().materials[again->description().material_of[1]].transmission == 1);
}

// --- settings --------------------------------------------------------------------------------------------

TEST_CASE("what is not said of a picture follows from the method") {
  const RenderSettings classic = settings(""), path = settings("method path");
  CHECK(classic.method == Method::kClassic);
  CHECK(classic.samples == 1);
  CHECK(classic.bounces == 8);
  CHECK_FALSE(classic.development.is_linear);
  CHECK(path.method == Method::kPath);
  CHECK(path.samples == 64);
  CHECK(path.bounces == raytracer::kUnlimitedBounces);
  CHECK(path.development.is_linear);
  CHECK(settings("method path  samples 3  bounces 2").samples == 3);
  CHECK(settings("method path  samples 3  bounces 2").bounces == 2);
}

TEST_CASE("the words of method path arrive") {
  const RenderSettings s = settings(
      "method path  sampling lights  clamp 5  exposure -1.5  tone aces  white_balance 0.5 1 2  seed 7");
  CHECK(s.sampling == Sampling::kLights);
  CHECK(s.clamp_indirect == 5);
  CHECK(s.development.exposure == -1.5f);
  CHECK(s.development.tone == Tone::kAces);
  CHECK(s.development.white == Color3f(0.5f, 1, 2));
  CHECK(s.seed == 7);
  CHECK(settings("method path  sampling materials").sampling == Sampling::kMaterials);
  CHECK(settings("method path  tone agx").development.tone == Tone::kAgx);
  CHECK(settings("method path  tone filmic").development.tone == Tone::kFilmic);
}

TEST_CASE("a white balance of one number is a temperature") {
  const Color3f white = settings("method path  white_balance 3200").development.white;
  CHECK(white == settings("method path  white_balance (kelvin(3200))").development.white);
  CHECK(white.x == 1);
  CHECK(white.z < 0.4f);
  for (const char* words : {"white_balance 12", "white_balance 50000", "white_balance 1 0 0"}) {
    CHECK(complaints(kFrame + ("render { method path  " + std::string(words) + " } sphere { }")).size() == 1);
  }
}

TEST_CASE("the caller's method, samples and seed go first") {
  LoadOptions options;
  options.method = Method::kPath;
  options.seed = 9;
  CHECK(settings("method classic  seed 3", options).method == Method::kPath);
  CHECK(settings("method classic  seed 3", options).seed == 9);
  CHECK(settings("", options).samples == 64);
}

TEST_CASE("words for the other method are warned of at their place") {
  const auto warnings = [](const std::string& words, const LoadOptions& options = {}) {
    return complaints(kFrame + ("render { " + words + " } sphere { }"), options).size();
  };
  for (const char* words : {"exposure 1", "tone agx", "clamp 3", "sampling both", "white_balance 3200"}) {
    CHECK(warnings(words) == 1);
    CHECK(warnings("method path  " + std::string(words)) == 0);
  }
  CHECK(warnings("ambient 0.1") == 0);
  CHECK(warnings("method path  ambient 0.1") == 1);
  LoadOptions preview;
  preview.method = Method::kClassic;
  CHECK(warnings("method path  exposure 1  tone agx", preview) == 0);
}

TEST_CASE("the hash of a moment follows all that the picture does") {
  const auto hash = [](const std::string& words, const LoadOptions& options = {}) {
    return load(kFrame + ("render { " + words + " } sphere { }"), options).moment_at(0).hash;
  };
  const auto plain = hash("method path");
  CHECK(plain == hash("method path"));
  for (const char* words :
       {"exposure 1", "tone agx", "clamp 3", "sampling lights", "white_balance 3200", "seed 1"})
    CHECK_FALSE(hash("method path  " + std::string(words)) == plain);
  LoadOptions classic;
  classic.method = Method::kClassic;
  CHECK_FALSE(hash("method path", classic) == plain);
}

// --- lights ----------------------------------------------------------------------------------------------

TEST_CASE("an area light is a quad that shines on one side") {
  const auto scene =
      load(
          "camera { position 0 0 9 } light area lamp { origin 1 2 3  width 2 0 0  height 0 0 2 "
          "radiance 4 5 6  visible false }")
          .scene_at(0);
  CHECK(scene->description().lights.empty());
  REQUIRE(scene->description().shapes.size() == 1);
  const Material& m = scene->description().materials[scene->description().material_of[0]];
  CHECK(m.is_area_light);
  CHECK_FALSE(m.is_visible);
  CHECK(m.emission == Color3f(4, 5, 6));
  CHECK(m.color == Color3f(0));
  CHECK(scene->description().shapes[0]->bounds().lower.x == Approx(1).margin(1e-5));
}

TEST_CASE("an area light of no size is an error") {
  const auto found = complaints(kFrame + std::string("light area { width 1 0 0  height 2 0 0 } sphere { }"));
  REQUIRE(found.size() == 1);
  CHECK(is_error(found[0]));
}

TEST_CASE("radiant intensity is a light of 1/pi and inverse squares") {
  const Light light = first_light("light { position 0 0 9  radiant_intensity 1 2 3 }");
  CHECK(light.falloff == Falloff::kQuadratic);
  check_color(light.lambda, Color3f(1, 2, 3) * (255 / 3.14159265f));
  for (const char* words : {"intensity 3", "color red", "falloff none"}) {
    const auto found =
        complaints(kFrame + ("sphere { } light { radiant_intensity 1 1 1  " + std::string(words) + " }"));
    REQUIRE(found.size() == 1);
    CHECK(is_error(found[0]));
  }
}

TEST_CASE("very strong and very weak lights stand side by side") {
  const auto scene = load(
                         "camera { position 0 0 9 } sphere { } light { position 0 0 9  intensity 1e30 } "
                         "light { position 3 0 9  intensity 1e-30 }")
                         .scene_at(0);
  CHECK(scene->description().lights[0].lambda.x == Approx(1e30f));
  CHECK(scene->description().lights[1].lambda.x == Approx(1e-30f));
  CHECK(
      complaints("camera { position 0 0 9 } sphere { } light { position 0 0 9  intensity 1e30  color 1e30 }")
          .size() == 1);
}

TEST_CASE("a scene in which anything shines gets no headlight") {
  const auto lights = [](const std::string& text) {
    return load("camera { position 0 0 9 } sphere { } " + text).scene_at(0)->description().lights.size();
  };
  CHECK(lights("") == 1);
  CHECK(lights("light area { origin 0 3 0 }") == 0);
  CHECK(lights("sphere { center 5 0 0  material { emission 1 } }") == 0);
  CHECK(lights("background { color 1 }") == 1);
  CHECK(lights("render { method path } background { color 1 }") == 0);
  CHECK(lights("render { method path }") == 1);
  CHECK(lights("material unused { emission 1 }") == 1);
}

TEST_CASE("lights in closed shapes, cameras in glass and darkness are warned of") {
  const auto count = [](const std::string& text) { return complaints(text).size(); };
  CHECK(count("camera { position 0 0 9 } light { } sphere { }") == 1);
  CHECK(count("camera { position 0 0 9 } light { } sphere { material glass }") == 0);
  CHECK(count("camera { position 0 0 9 } light { } cylinder { base 0 -2 0  top 0 2 0  open true }") == 0);
  CHECK(count("camera { position 0 0 9 } light { } sphere { radius 20 } sphere { center 4 0 0 }") == 0);
  CHECK(count("camera { position 0 0 9 } light { position 9 9 9 } sphere { radius 20  material water }") ==
        1);
  CHECK(count("camera { position 0 0 9 } light { position 9 9 9  intensity 0 } sphere { }") == 1);
}

// --- colours ---------------------------------------------------------------------------------------------

TEST_CASE("display colours become linear in path, and only there") {
  const std::string path = "render { method path } ";
  const Color3f tomato(kTomato[0], kTomato[1], kTomato[2]);
  const Color3f linear_tomato(linear(tomato.x), linear(tomato.y), linear(tomato.z));
  check_color(material("color tomato").color, tomato);
  check_color(material("color tomato", path).color, linear_tomato);
  check_color(material("color #ff6347", path).color, linear_tomato);
  check_color(material("color (hsv(0, 0, 0.5))", path).color, Color3f(linear(0.5f)));
  check_color(material("color 0.3 0.4 0.5", path).color, Color3f(0.3f, 0.4f, 0.5f));
  check_color(material("color 0.5", path).color, Color3f(0.5f));
  check_color(material("color (kelvin(3200))", path).color, material("color (kelvin(3200))").color);
  // What arithmetic makes of one is plain numbers, a name for one is not.
  check_color(material("color (tomato * 0.5)", path).color, 0.5f * tomato);
  check_color(material("color soft", path + "let soft = tomato ").color, linear_tomato);
  check_color(material("color (1 > 2 ? red : tomato)", path).color, linear_tomato);
}

TEST_CASE("display colours stay what they are through definitions, settings and JSON") {
  const std::string text = std::string("render { method path } let shade = tomato ") + kFrame +
                           "define ball (c black, v 0 0 0) { sphere { material { color c  emission v } } } "
                           "ball { c shade  v shade }";
  const Color3f linear_tomato(linear(kTomato[0]), linear(kTomato[1]), linear(kTomato[2]));
  const auto check = [&](const LoadedScene& loaded) {
    const auto scene = loaded.scene_at(0);
    const Material& m = scene->description().materials[scene->description().material_of[0]];
    check_color(m.color, linear_tomato);
    check_color(m.emission, linear_tomato);
  };
  const LoadedScene loaded = load(text);
  check(loaded);
  check(load(loaded.json_at(0, {})));
  LoadOptions options;
  options.settings.push_back({"shade", "#ff6347"});
  check(load(text, options));
  options.method = Method::kClassic;
  check_color(load(text, options).scene_at(0)->description().materials.back().color,
              Color3f(kTomato[0], kTomato[1], kTomato[2]));
}

TEST_CASE("a method that only evaluation can tell means the same to colours") {
  const std::string sphere = kFrame + std::string("sphere { material { color tomato } }");
  const auto color = [](const LoadedScene& loaded, double time) {
    return loaded.scene_at(time)->description().materials.back().color;
  };
  const Color3f tomato(kTomato[0], kTomato[1], kTomato[2]);
  const Color3f linear_tomato(linear(tomato.x), linear(tomato.y), linear(tomato.z));
  check_color(color(load("if 1 > 0 { render { method path } } " + sphere), 0), linear_tomato);
  const LoadedScene changing = load("animation { duration 9 } if t > 2 { render { method path } } " + sphere +
                                    " sphere { center t 3 0 }");
  check_color(color(changing, 0), tomato);
  check_color(color(changing, 3), linear_tomato);
  check_color(color(changing, 1), tomato);
}

TEST_CASE("uses of a definition with a display colour and its bare numbers are not the same") {
  const auto scene =
      load("render { method path } " + std::string(kFrame) +
           "define row (c black) { for i from 1 to 20 { sphere { center i 0 0 material { color c } } } } "
           "row { c #808080 } row { c #808080 } row { c (#808080 * 1) } row { c (#808080 * 1) }")
          .scene_at(0);
  const auto& shared = scene->description().shared;
  REQUIRE(shared.size() == 2);
  CHECK(shared[0]->material_of(0).color.x == Approx(linear(128 / 255.0f)));
  CHECK(shared[1]->material_of(0).color.x == Approx(128 / 255.0f));
}
