// Broken scenes by the thousand: whatever the text, loading ends, and either there is a scene or an error
// with a place.
#include <algorithm>
#include <cstdint>
#include <random>
#include <string>
#include <string_view>
#include <vector>

#include "catch.hpp"
#include "raytracer/scene_file.hpp"

namespace {

using namespace raytracer;

// Every kind of block, of value and of comment that the language has.
constexpr std::string_view kWholeLanguage = R"(raytracer 1
// a line /* not nested
image { size 32 20 } /* a /* nested */ one */
camera front { position 0 1.5 +6. look_at 0 .5 0 up 0 1 0 fov 4.5e1 }
camera side { position 6 0 0 look_at 0 0 0 vertical_fov 30 rotate 0 5 0 }
render { method classic samples 2 bounces 3 epsilon 1e-4 seed 7 ambient 0.1 }
background { color #123 }
light { position -4 6 5 intensity 1800 color white falloff linear }
light point near { position 1 1 1 falloff quadratic }
light directional sun { direction 0 -1 -0.5 color 1 0.9 0.8 }
light spot lamp { position 3 3 3 look_at 0 0 0 angle 40 soft_edge 0.5 falloff none }
material chrome { color #e6e6e6 shininess 0.8 }
material paper { color tomato }
sphere ball { center -2.2 1 0 radius 1 material chrome }
cube { center 2.2 1 0 size 1.8 rotate 0 30 0 material { color 0.2 0.5 0.9 } }
cube { size 1 2 3 scale 0.5 1 -1 pivot 0 1 0 rotate_axis 1 1 0 45 translate 0 0 -3 }
plane { point 0 -1 0 normal 0 1 0.1 }
disk { center 0 -0.5 0 normal 0 1 0 radius 2 }
group swing {
  material paper
  rotate 0 0 20
  material local { color 0.5 }
  quad { origin -1 0 -2 width 2 0 0 height 0 2 0 material local }
  group {
    scale 0.5
    cylinder { base 0 0 0 top 0 1 0 radius 0.3 open true }
    cone { base 1 0 0 top 1 1 0 top_radius 0.1 }
  }
  torus { center 0 2 0 axis 0 0 1 radius 0.8 tube_radius 0.2 }
}
triangle { a 0 0 1 b 1 0 1 c 0 1 1 matrix 1 0 0 0  0 1 0 0  0 0 1 0 }
animation { duration 4 fps 24 }
let n = 2 + 3 * 4 % 5 - 2 ^ 2
let p = (1, 2, 3).x > 0 and not false ? (0, n, 0) : -(1, 1, 1)
for i from 0 to 2 step 1 {
  let a = 360 * i / 3 + 30 * t
  sphere { center (cos(a)) 0.4 (sin(a)) radius (0.2 + random(i) / 10) material { color (hsv(a, 0.7, 0.9)) } }
}
define snowman (size 1, hat black) {
  sphere { center p radius (0.5 * size) }
  if size > 0.5 { snowman { size (size / 2) hat red translate -3 0 0 } }
  cylinder { radius 0.3 material { color hat } }
}
snowman { size 2 rotate 0 20 0 }
)";

std::size_t line_count(std::string_view text) {
  const auto ends = std::count(text.begin(), text.end(), '\n') + std::count(text.begin(), text.end(), '\r');
  return static_cast<std::size_t>(ends) + 1;
}

bool has_sane_place(const Diagnostic& diagnostic, std::string_view text) {
  if (diagnostic.line == 0) return true;  // of the scene as a whole
  return diagnostic.line <= line_count(text) && diagnostic.column >= 1 &&
         diagnostic.column <= text.size() + 1 && diagnostic.end_line >= diagnostic.line &&
         (diagnostic.end_line > diagnostic.line || diagnostic.end_column >= diagnostic.column);
}

// What holds for every text. One REQUIRE for each text keeps the thousands of them fast.
std::string complaint_about(const std::string& text) {
  const LoadedScene scene = load_scene_text(text, "fuzz.txt");
  std::size_t errors = 0, warnings = 0;
  for (const Diagnostic& diagnostic : scene.diagnostics) {
    (diagnostic.severity == Severity::kError ? errors : warnings) += 1;
    if (!has_sane_place(diagnostic, text)) return "a message has no sane place: " + to_text(diagnostic);
    if (diagnostic.message.empty()) return "a message is empty";
    if (to_text(diagnostic).empty() || to_json(diagnostic).find('\n') != std::string::npos) {
      return "a message does not print: " + to_text(diagnostic);
    }
  }
  if (scene.ok() != (errors == 0)) return "a scene with errors, or none without";
  if (errors > 0 && warnings > 0) return "a warning beside an error";
  return {};
}

void require_sound(const std::string& text) {
  const std::string complaint = complaint_about(text);
  INFO(text);
  REQUIRE(complaint == "");
}

// The same numbers everywhere: std::uniform_int_distribution is not.
class Dice {
 public:
  std::size_t below(std::size_t limit) { return static_cast<std::size_t>(engine_() % limit); }

 private:
  std::mt19937_64 engine_{20240229};
};

TEST_CASE("The scene that the broken ones are made of is sound") {
  const LoadedScene scene = load_scene_text(std::string(kWholeLanguage), "whole.txt");
  std::string messages;
  for (const Diagnostic& diagnostic : scene.diagnostics) messages += to_text(diagnostic);
  REQUIRE(messages == "");
  REQUIRE(scene.ok());
  REQUIRE(scene.shapes > 10);
}

TEST_CASE("A scene cut at every byte is a scene or a mistake with a place") {
  for (std::size_t length = 0; length <= kWholeLanguage.size(); ++length) {
    require_sound(std::string(kWholeLanguage.substr(0, length)));
    require_sound(std::string(kWholeLanguage.substr(length)));
  }
}

TEST_CASE("A scene without any one of its bytes is a scene or a mistake with a place") {
  for (std::size_t i = 0; i < kWholeLanguage.size(); ++i) {
    require_sound(std::string(kWholeLanguage).erase(i, 1));
  }
}

TEST_CASE("A scene with bytes changed at random is a scene or a mistake with a place") {
  Dice dice;
  for (int i = 0; i < 4000; ++i) {
    std::string text(kWholeLanguage);
    for (std::size_t changes = 1 + dice.below(8); changes > 0; --changes) {
      text[dice.below(text.size())] = static_cast<char>(dice.below(256));
    }
    require_sound(text);
  }
}

TEST_CASE("A scene with pieces moved at random is a scene or a mistake with a place") {
  Dice dice;
  for (int i = 0; i < 4000; ++i) {
    std::string text(kWholeLanguage);
    const std::string piece = text.substr(dice.below(text.size()), dice.below(60));
    text.insert(dice.below(text.size()), piece);
    text.erase(dice.below(text.size()), dice.below(60));
    require_sound(text);
  }
}

TEST_CASE("Words of the language in any order are a scene or a mistake with a place") {
  constexpr std::string_view kWords[] = {
      "sphere",    "cube",     "group",    "light",   "spot",     "material", "camera", "image", "include",
      "raytracer", "radius",   "center",   "size",    "color",    "rotate",   "matrix", "red",   "chrome",
      "true",      "nan",      "-inf",     "1e999",   "1e-999",   "0",        "-1",     "2",     "3.5",
      "1e30",      "#fff",     "#12",      "\"a\"",   "\"",       "{",        "{",      "}",     "}",
      "(",         ")",        ",",        "=",       "/*",       "*/",       "//",     "\n",    "\r",
      "\xFF",      "\xC3\xA4", "\x1B[31m", ".",       "-",        "+",        "5cm",    "..",    "#",
      "quad",      "width",    "height",   "a",       "triangle", "open",     "pivot",  "scale", "plane",
      "normal",    "fov",      "t",        "let",     "for",      "from",     "to",     "step",  "if",
      "define",    "and",      "not",      "?",       ":",        "^",        "==",     "sin",   "random",
      "<",         "x",        "(1,2)",    "(1,2,3)", "hsv",      "%",        "i"};
  Dice dice;
  for (int i = 0; i < 4000; ++i) {
    std::string text;
    for (std::size_t words = dice.below(60); words > 0; --words) {
      text += kWords[dice.below(std::size(kWords))];
      if (dice.below(8) != 0) text += ' ';
    }
    require_sound(text);
  }
}

TEST_CASE("What is nested far too deep is told, not followed") {
  for (const std::string_view opening : {"group {", "sphere { material {", "/*", "{", "(", "if true {",
                                         "for i from 0 to 1 {", "define a () {", "let x = ("}) {
    std::string text;
    for (int i = 0; i < 10000; ++i) text += opening;
    require_sound(text);
    REQUIRE_FALSE(load_scene_text(text, "deep.txt").ok());
  }
}

TEST_CASE("Expressions nested or chained far too long are told, not followed") {
  for (const std::string_view link :
       {"(", "-", "not ", "1 + ", "2 ^ ", "1 - ", "true ? 1 : ", "true ? ", "sin(", "true and ", "1 < "}) {
    std::string text = "let x = ";
    for (int i = 0; i < 100000; ++i) text += link;
    require_sound(text + "1\n");
  }
  std::string text = "let x = (1, 2, 3)";
  for (int i = 0; i < 100000; ++i) text += ".x";
  require_sound(text + "\n");
}

TEST_CASE("What a definition makes of itself ends") {
  for (const char* text : {"define a () { a { } }\na { }\n", "define a (n 1) { a { n (n + 1) } }\na { }\n",
                           "define a (n 1) { if n > 0 { a { n n } } }\na { }\n"}) {
    require_sound(text);
    REQUIRE_FALSE(load_scene_text(text, "endless.txt").ok());
  }
}

TEST_CASE("Groups within groups to a sensible depth are fine") {
  std::string text;
  for (int i = 0; i < 50; ++i) text += "group { rotate 0 1 0 ";
  text += "sphere { }";
  for (int i = 0; i < 50; ++i) text += '}';
  REQUIRE(load_scene_text(text, "deep.txt").ok());
}

}  // namespace
