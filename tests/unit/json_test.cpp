// JSON to values and to scenes: escapes, and that no cut or changed text does harm.
#include <random>

#include "catch.hpp"
#include "raytracer/scene_file.hpp"
#include "scene_file/json_text.hpp"

using namespace raytracer;
using namespace raytracer::scene_file;

namespace {

constexpr const char* kScene = R"({"raytracer": 1, "blocks": [
  {"kind": "camera", "position": [0, 1, 5.0e0]},
  {"kind": "light", "variant": "spot", "name": "lamp", "position": [1, 2, 3], "angle": 40},
  {"kind": "material", "name": "red", "color": {"display": [1, 0.25, 1e-3]}},
  {"kind": "define", "name": "pair", "children": [{"kind": "sphere"}, {"kind": "cube", "size": 0.5}]},
  {"kind": "pair", "transforms": [{"rotate": [0, 30, 0]}, {"scale": -1}], "material": "red"},
  {"kind": "group", "material": {"color": "#ff8000", "shininess": 0.5},
   "children": [{"kind": "cylinder", "open": true}]}
]})";

LoadedScene load(const std::string& text) { return load_scene_text(text, "scene.json"); }

}  // namespace

TEST_CASE("escapes of JSON strings") {
  REQUIRE(json_unescape(R"(a\"\\\/\b\f\n\r\t)") == "a\"\\/\b\f\n\r\t");
  REQUIRE(json_unescape(R"(\u0041\u00e4\u20AC\ud83d\ude00!)") == "A\xC3\xA4\xE2\x82\xAC\xF0\x9F\x98\x80!");
  REQUIRE(json_quoted("a\"\\\n\x01\xC3\xA4") == "\"a\\\"\\\\\\u000a\\u0001\xC3\xA4\"");
  for (int byte = 1; byte < 256; ++byte) {
    const std::string text(1, static_cast<char>(byte));
    const std::string quoted = json_quoted(text);
    REQUIRE(json_unescape(quoted.substr(1, quoted.size() - 2)) == text);
  }
}

TEST_CASE("a scene in JSON is a scene") {
  const LoadedScene scene = load(kScene);
  for (const Diagnostic& d : scene.diagnostics) UNSCOPED_INFO(to_text(d));
  REQUIRE(scene.diagnostics.empty());
  REQUIRE(scene.ok());
  REQUIRE(scene.shapes >= 3);
  const std::string written = scene.json_at(0, {});
  REQUIRE(load(written).json_at(0, {}) == written);
}

TEST_CASE("a JSON scene cut at any byte is an error with a place") {
  const std::string text = kScene;
  for (std::size_t end = 0; end < text.size(); ++end) {
    const LoadedScene scene = load(text.substr(0, end));
    INFO(text.substr(0, end));
    REQUIRE(!scene.ok());
    REQUIRE(scene.diagnostics.size() == 1);
    REQUIRE(scene.diagnostics[0].line > 0);
  }
}

TEST_CASE("a JSON scene with any bytes changed loads or tells why not") {
  std::mt19937 random(5);
  constexpr std::string_view kBytes = "{}[]\",:\\ntu0159.eE+-#a \n\xC3\xFF";
  for (int round = 0; round < 20000; ++round) {
    std::string text = kScene;
    for (unsigned i = 0; i <= random() % 3; ++i)
      text[random() % text.size()] = kBytes[random() % kBytes.size()];
    const LoadedScene scene = load(text);
    INFO(text);
    REQUIRE((scene.ok() || !scene.diagnostics.empty()));
  }
}
