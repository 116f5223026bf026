// let, for, if, define, include, groups' materials, settings, limits and time: what comes out of them.
#include <cmath>
#include <fstream>
#include <string>
#include <vector>

#include "catch.hpp"
#include "raytracer/error.hpp"
#include "raytracer/scene_file.hpp"
#include "unit/temporary_folder.hpp"

using raytracer::Color3f;
using raytracer::Diagnostic;
using raytracer::Error;
using raytracer::ErrorKind;
using raytracer::load_scene_file;
using raytracer::load_scene_text;
using raytracer::LoadedScene;
using raytracer::LoadOptions;
using raytracer::Scene;
using raytracer::SceneDescription;
using raytracer::Severity;

namespace {

std::string errors_of(const LoadedScene& scene) {
  std::string all;
  for (const Diagnostic& diagnostic : scene.diagnostics) {
    if (diagnostic.severity == Severity::kError) all += to_text(diagnostic);
  }
  return all;
}

std::shared_ptr<const Scene> scene_of(const LoadedScene& loaded, double time = 0) {
  INFO(errors_of(loaded));
  REQUIRE(loaded.ok());
  return loaded.scene_at(time);
}

std::shared_ptr<const Scene> scene_of(const std::string& text, const LoadOptions& options = {}) {
  INFO(text);
  return scene_of(load_scene_text(text, "statements.txt", options));
}

// Where the shapes' middles are along x: the tests below place spheres of radius 0.25 there.
std::vector<float> middles(const Scene& scene) {
  std::vector<float> all;
  const SceneDescription& description = scene.description();
  for (const auto& shape : description.shapes) all.push_back(shape->bounds().center().x);
  for (const auto& instance : description.instances) {
    const raytracer::SharedShapes& shared = *description.shared[instance.shared];
    for (std::uint32_t i = 0; i < shared.size(); ++i) {
      all.push_back(instance.bounds(shared.shape(i).bounds()).center().x);
    }
  }
  return all;
}
std::vector<float> middles(const std::string& text, const LoadOptions& options = {}) {
  return middles(*scene_of(text, options));
}

std::vector<float> shapes_colors(const std::string& text) {
  const auto scene = scene_of(text);
  std::vector<float> reds;
  for (const std::uint32_t index : scene->description().material_of) {
    reds.push_back(scene->description().materials[index].color.r);
  }
  return reds;
}

void check_near(const std::vector<float>& found, const std::vector<float>& wanted) {
  REQUIRE(found.size() == wanted.size());
  for (std::size_t i = 0; i < found.size(); ++i) {
    INFO(i);
    CHECK(std::abs(found[i] - wanted[i]) < 1e-5f);
  }
}

// The place and the words of the only mistake.
void check_mistake(const std::string& text, std::uint32_t line, std::uint32_t column,
                   const std::string& words, const LoadOptions& options = {}) {
  const LoadedScene scene = load_scene_text(text, "statements.txt", options);
  INFO(text);
  INFO(errors_of(scene));
  CHECK_FALSE(scene.ok());
  CHECK(scene.diagnostics.size() == 1);
  if (scene.diagnostics.empty()) return;
  const Diagnostic& message = scene.diagnostics.front();
  CHECK(message.line == line);
  CHECK(message.column == column);
  CHECK((message.message + " " + message.suggestion).find(words) != std::string::npos);
}

// A sphere at (x, 0, 0) for the expression x.
std::string ball(const std::string& x) { return "sphere { radius 0.25 center (" + x + ") 0 0 }\n"; }

std::string value_of(const LoadedScene& scene, const std::string& name) {
  for (const auto& parameter : scene.parameters) {
    if (parameter.name == name) return parameter.value;
  }
  return "no such let";
}

void write(const std::string& path, const std::string& text) { std::ofstream(path) << text; }

LoadOptions with_setting(const std::string& name, const std::string& value) {
  LoadOptions options;
  options.settings.push_back({name, value});
  return options;
}

ErrorKind kind_of_failure(const std::string& text, const LoadOptions& options, std::string& message) {
  try {
    load_scene_text(text, "statements.txt", options);
  } catch (const Error& error) {
    message = error.what();
    return error.kind();
  }
  FAIL("nothing was thrown");
  return ErrorKind::kScene;
}

}  // namespace

// --- for ---------------------------------------------------------------------------------------------------

TEST_CASE("a loop includes both ends", "[statements]") {
  check_near(middles("for i from 0 to 3 { " + ball("i") + "}"), {0, 1, 2, 3});
  check_near(middles("for i from -2 to 1 { " + ball("i") + "}"), {-2, -1, 0, 1});
  check_near(middles("for i from 5 to 5 { " + ball("i") + "}"), {5});
  check_near(middles("for i from 0.5 to 3 { " + ball("i") + "}"), {0.5, 1.5, 2.5});
  check_near(middles("let n = 3 for i from n - 1 to n * 2 { " + ball("i") + "}"), {2, 3, 4, 5, 6});
}

TEST_CASE("a loop's step may be any but 0", "[statements]") {
  check_near(middles("for i from 0 to 10 step 5 { " + ball("i") + "}"), {0, 5, 10});
  check_near(middles("for i from 0 to 9 step 5 { " + ball("i") + "}"), {0, 5});
  check_near(middles("for i from 3 to 0 step -1 { " + ball("i") + "}"), {3, 2, 1, 0});
  check_near(middles("for i from 0 to 1 step 0.25 { " + ball("i") + "}"), {0, 0.25, 0.5, 0.75, 1});
  check_near(middles("for i from 1 to 0 step -0.5 { " + ball("i") + "}"), {1, 0.5, 0});
  check_mistake("for i from 0 to 3 step 0 { }", 1, 24, "'step'");
}

TEST_CASE("a loop's count forgives rounding", "[statements]") {
  for (const int count : {3, 7, 10, 100, 1000}) {
    const auto scene =
        scene_of("for i from 0 to 1 step 1 / " + std::to_string(count) + " { " + ball("i") + "}");
    REQUIRE(scene->description().shapes.size() == static_cast<std::size_t>(count) + 1);
  }
  REQUIRE(middles("for i from 0 to 1 step 0.1 { " + ball("i") + "}").size() == 11);
  REQUIRE(middles("for i from 0.1 to 0.7 step 0.1 { " + ball("i") + "}").size() == 7);
  REQUIRE(middles("for i from 0 to 0.999 step 0.1 { " + ball("i") + "}").size() == 10);
}

TEST_CASE("a loop's values do not add up roundings", "[statements]") {
  const LoadedScene scene = load_scene_text(
      "for i from 0 to 1 step 0.1 { if i > 0.95 { sphere { radius (i == 10 * 0.1 ? 1 : 2) } } }",
      "statements.txt");
  REQUIRE(scene_of(scene)->description().shapes.size() == 1);
  REQUIRE(std::abs(scene_of(scene)->description().shapes[0]->bounds().upper.x - 1) < 1e-5f);
}

TEST_CASE("a loop may have no turns", "[statements]") {
  REQUIRE(middles("sphere { }\nfor i from 1 to 0 { " + ball("i") + "}").size() == 1);
  REQUIRE(middles("sphere { }\nfor i from 0 to 1 step -1 { " + ball("i") + "}").size() == 1);
  REQUIRE(middles("sphere { }\nfor i from 0 to -1e300 { " + ball("i") + "}").size() == 1);
  REQUIRE(middles("for i from 0 to -0.5 step -1 { " + ball("i") + "}").size() == 1);
}

TEST_CASE("loops stand in loops, and the inner one hides a name", "[statements]") {
  check_near(middles("for i from 0 to 2 { for j from 0 to i { " + ball("10 * i + j") + "} }"),
             {0, 10, 11, 20, 21, 22});
  check_near(middles("for i from 0 to 1 { for i from 5 to 6 { " + ball("i") + "} " + ball("i") + "}"),
             {5, 6, 0, 5, 6, 1});
  check_near(middles("let i = 7 for i from 0 to 1 { " + ball("i") + "} " + ball("i")), {0, 1, 7});
}

TEST_CASE("a loop counts in numbers", "[statements]") {
  check_mistake("for i from (1, 2, 3) to 4 { }", 1, 12, "a vector");
  check_mistake("for i from 0 to \"x\" { }", 1, 17, "a string");
  check_mistake("for i from 0 to 3 step true { }", 1, 24, "true or false");
  check_mistake("for i from 0 to 1 / 0 { }", 1, 17, "division by zero");
  check_mistake("for i from 0 to n { }", 1, 17, "'n'");
}

// --- let ---------------------------------------------------------------------------------------------------

TEST_CASE("an inner let hides an outer one until its block ends", "[statements]") {
  check_near(middles("let a = 1 group { let a = 2 " + ball("a") + "} " + ball("a")), {2, 1});
  check_near(middles("let a = 1 if true { let a = a + 1 " + ball("a") + "} " + ball("a")), {2, 1});
  check_near(middles("let a = 1 for i from 0 to 1 { let a = a + i " + ball("a") + "} " + ball("a")),
             {1, 2, 1});
  check_near(middles("let a = 1 sphere { let a = 5 radius 0.25 center a 0 0 } " + ball("a")), {5, 1});
  check_near(middles("let a = 1 group { group { let a = 2 " + ball("a") + "} " + ball("a") + "}"), {2, 1});
  check_near(middles("group { let a = 3 translate a 0 0 " + ball("0") + "}"), {3});
}

TEST_CASE("a let is not seen behind its block", "[statements]") {
  check_mistake("group { let a = 2 sphere { } }\nsphere { radius a }", 2, 17, "'a'");
  check_mistake("for i from 0 to 1 { let a = i }\nsphere { radius a }", 2, 17, "'a'");
  check_mistake("for i from 0 to 1 { }\nsphere { radius (i) }", 2, 18, "'i'");
  check_mistake("if true { let a = 1 }\nsphere { radius a }", 2, 17, "'a'");
  check_mistake("define d { let a = 1 sphere { radius a } }\nd { }\nsphere { radius a }", 3, 17, "'a'");
  check_mistake("sphere { let a = 1 radius a }\nsphere { radius a }", 2, 17, "'a'");
}

TEST_CASE("a let is not seen before it stands", "[statements]") {
  check_mistake("sphere { radius a }\nlet a = 2", 1, 17, "'a'");
  check_mistake("let a = b + 1\nlet b = 2\nsphere { radius (a + b) }", 1, 9, "'b'");
  check_mistake("let a = a\nsphere { }", 1, 9, "'a'");
}

TEST_CASE("assigning twice in a block is an error that shows both places", "[statements]") {
  const LoadedScene scene = load_scene_text("let a = 1\nlet a = 2\nsphere { radius a }", "statements.txt");
  REQUIRE(scene.diagnostics.size() == 1);
  REQUIRE(scene.diagnostics[0].line == 2);
  REQUIRE(scene.diagnostics[0].column == 5);
  REQUIRE(scene.diagnostics[0].notes.size() == 1);
  REQUIRE(scene.diagnostics[0].notes[0].line == 1);
  REQUIRE(scene.diagnostics[0].notes[0].column == 5);
  check_mistake("group { let a = 1\nlet a = 2 sphere { radius a } }", 2, 5, "'a'");
  check_mistake("sphere { let a = 1\nlet a = 2 radius a }", 2, 5, "'a'");
  check_mistake("for i from 0 to 3 { let a = 1\nlet a = 2 sphere { radius a } }", 2, 5, "'a'");
  check_mistake("if true { let a = 1\nlet a = 2 sphere { radius a } }", 2, 5, "'a'");
  check_mistake("define d { let a = 1\nlet a = 2 sphere { radius a } }\nd { }", 2, 5, "'a'");
}

TEST_CASE("built-in names can't be taken", "[statements]") {
  for (const std::string name :
       {"t", "frame", "pi", "true", "false", "sin", "random", "let", "for", "if", "from", "and"}) {
    const LoadedScene scene = load_scene_text("let " + name + " = 1\nsphere { }", "statements.txt");
    INFO(name);
    CHECK_FALSE(scene.ok());
    CHECK(scene.diagnostics.size() == 1);
    if (!scene.diagnostics.empty()) CHECK(scene.diagnostics[0].column == 5);
  }
  check_mistake("define sphere { }", 1, 8, "'sphere'");
  check_mistake("define d (t 1) { }", 1, 11, "'t'");
  check_mistake("define d (translate 1) { }", 1, 11, "'translate'");
  check_mistake("define d (material 1) { }", 1, 11, "'material'");
}

TEST_CASE("lets hold every type", "[statements]") {
  const LoadedScene scene = load_scene_text(
      "let n = 1.5\nlet b = true\nlet v = (1, 2, 3)\nlet c = tomato\nlet s = \"a\"\nsphere { radius n center "
      "v "
      "material { color c } }\ncylinder { open b }\n",
      "statements.txt");
  REQUIRE(scene_of(scene)->description().shapes.size() == 2);
  REQUIRE(value_of(scene, "n") == "1.5");
  REQUIRE(value_of(scene, "b") == "true");
  REQUIRE(value_of(scene, "v") == "(1, 2, 3)");
  REQUIRE(value_of(scene, "c") == "#ff6347");
  REQUIRE(value_of(scene, "s") == "\"a\"");
}

TEST_CASE("parameters are the lets outside of all braces, in order", "[statements]") {
  const LoadedScene scene = load_scene_text(
      "sphere { let r = 1 radius r }\nlet a = 1\ngroup { let b = 2 sphere { radius b } }\nif true { let c = "
      "3 sphere { radius "
      "c } }\nfor i from 0 to 0 { let d = 4 sphere { radius d } }\ndefine e { let f = 5 sphere { radius f } "
      "}\ne { }\nlet g "
      "= a + 1\nsphere { radius g }",
      "statements.txt");
  REQUIRE(scene.ok());
  REQUIRE(scene.parameters.size() == 2);
  REQUIRE(scene.parameters[0].name == "a");
  REQUIRE(scene.parameters[1].name == "g");
  REQUIRE(scene.parameters[1].value == "2");
}

TEST_CASE("values of properties may be names, expressions and literals side by side", "[statements]") {
  check_near(middles("let x = 4 let y = 5 sphere { radius 0.25 center x y 0 }"), {4});
  check_near(middles("let x = 4 let y = 5 let z = 6 sphere { center x y z radius 0.25 }"), {4});
  check_near(middles("let x = 4 let z = 6 sphere { center x -1 z radius 0.25 }"), {4});
  check_near(middles("let x = 4 sphere { center (x + 1) x 0 radius 0.25 }"), {5});
  check_near(middles("let p = (4, 5, 6) sphere { center p radius 0.25 }"), {4});
  check_near(middles("let p = (4, 5, 6) sphere { center (p + (1, 0, 0)) radius 0.25 }"), {5});
  check_near(middles("sphere { center pi 0 pi radius 0.25 }"), {3.14159265f});
  check_near(middles("let z = 1 group { translate z 0 z sphere { radius 0.25 } }"), {1});
  check_near(middles("let z = 1 group { translate z 0 z sphere ball { radius 0.25 } }"), {1});
  check_near(middles("let z = 1 group { translate z 0 z light spot { } sphere { radius 0.25 } }"), {1});
  check_near(middles("let z = 1 group { translate z 0 z sphere { center 1 0 0 radius 0.25 } sphere { center "
                     "2 0 0 radius "
                     "0.25 } }"),
             {2, 3});
}

TEST_CASE("a name at the end of a vector does not swallow what follows", "[statements]") {
  const std::string names =
      "let x = 1 let z = 2 let r = 0.25 material m { }\n"
      "define d (at 0 0 0, size 1) { sphere { center at radius size } }\n";
  for (const std::string text : {"sphere { center x 0 z radius r }",
                                 "sphere { center x x x radius r }",
                                 "sphere { center x 0 z material m }",
                                 "sphere { center x 0 z material { color red } }",
                                 "sphere { center 1 0 z radius pi }",
                                 "sphere { center x 0 z let q = 3 radius q }",
                                 "sphere { translate 0 0 z center x 0 z radius r }",
                                 "cube { center x 0 z size r }",
                                 "cube { center x x z size x z r }",
                                 "cube { rotate 0 0 x center x x x size r }",
                                 "cube { scale x z r center x 0 0 }",
                                 "d { at x 0 z size 2 }",
                                 "d { at x 0 z size r }",
                                 "d { at x x x }",
                                 "d { at x 0 z material m }",
                                 "d { size r at x 0 z translate 0 0 z rotate 0 90 0 }",
                                 "d one { translate x 0 z size r }",
                                 "group { translate x 0 z d { } }",
                                 "group { translate x 0 z d one { } }",
                                 "group { translate x 0 z rotate 0 x 0 sphere { } }",
                                 "group { translate x 0 z material m sphere { } }",
                                 "group { translate x 0 z for i from 1 to 1 { sphere { } } }",
                                 "group { translate x 0 z if true { sphere { } } }",
                                 "group { translate x 0 z let q = 3 sphere { } }",
                                 "cylinder { base x 0 z top x z z open true radius r }"}) {
    const LoadedScene scene = load_scene_text(names + text, "statements.txt");
    INFO(text);
    INFO(errors_of(scene));
    CHECK(scene.ok());
    if (scene.ok()) CHECK(scene.shapes == 1);
  }
  for (const std::string text : {"light { position x 0 z color white intensity r }",
                                 "light spot { position x 0 z look_at z x x color white }",
                                 "camera { position x 0 z look_at z x r fov 30 }",
                                 "camera { position x 0 z look_at 0 0 0 up r x r }"}) {
    const LoadedScene scene = load_scene_text(names + "sphere { } " + text, "statements.txt");
    INFO(text);
    INFO(errors_of(scene));
    CHECK(scene.ok());
  }
}

// --- if ----------------------------------------------------------------------------------------------------

TEST_CASE("the first condition that holds chooses", "[statements]") {
  for (const int a : {0, 1, 2, 3}) {
    const std::string text = "let a = " + std::to_string(a) + "\nif a == 0 { " + ball("10") +
                             "} else if a == 1 { " + ball("11") + "} else if a == 2 { " + ball("12") +
                             "} else { " + ball("13") + "}";
    check_near(middles(text), {static_cast<float>(10 + a)});
  }
  REQUIRE(middles("sphere { }\nif false { sphere { } }").size() == 1);
  REQUIRE(middles("sphere { }\nif false { sphere { } } else if false { sphere { } }").size() == 1);
  check_near(middles("if 1 < 2 { if 2 < 1 { " + ball("1") + "} else { " + ball("2") + "} } else { " +
                     ball("3") + "}"),
             {2});
  check_near(middles("group { translate 1 0 0 if true { " + ball("1") + "} }"), {2});
}

TEST_CASE("a condition is true or false", "[statements]") {
  check_mistake("if 1 { }", 1, 4, "a number");
  check_mistake("if \"yes\" { }", 1, 4, "a string");
  check_mistake("if n > 2 { }", 1, 4, "'n'");
  check_mistake("if true { } else if 3 { }\nif false { } else if 3 { }", 2, 22, "a number");
}

// --- define ------------------------------------------------------------------------------------------------

TEST_CASE("a definition is used like a shape, with its parameters", "[statements]") {
  const std::string d = "define d (x 1, y 0) { " + ball("x + 10 * y") + "}\n";
  check_near(middles(d + "d { } d { x 2 } d { y 3 } d { y 1 x 4 } d { x (1 + 1) }"), {1, 2, 31, 14, 2});
  check_near(middles(d + "d { translate 100 0 0 } d { x 2 translate 100 0 0 }"), {101, 102});
  check_near(middles(d + "group { translate 5 0 0 d { } }"), {6});
  check_near(middles(d + "d { scale 2 } d { rotate 0 180 0 }"), {2, -1});
  check_near(middles(d + "d one { } d two { }"), {1, 1});
  check_near(middles(d + "let x = 9 d { x x } d { x (x + 1) }"), {9, 10});
}

TEST_CASE("parameters are of the type of their default", "[statements]") {
  const std::string d =
      "define d (n 1, v 0 1 0, c red, b true, s \"a\", w (1, 2, 3)) { sphere { radius n center v material { "
      "color c } } if b "
      "and s == \"a\" { sphere { center w } } }\n";
  REQUIRE(middles(d + "d { }").size() == 2);
  REQUIRE(middles(d + "d { n 2 v 1 2 3 c 0.5 0.5 0.5 b false s \"b\" w (3, 2, 1) }").size() == 1);
  REQUIRE(
      middles(
          d +
          "d { c blue } d { c #fff } d { c 0.5 } d { c (hsv(0, 1, 1)) } d { v (1, 2, 3) } d { s (\"a\") }")
          .size() == 12);
  const auto wrong = [&](const std::string& use, std::uint32_t column, const std::string& words) {
    check_mistake(d + use, 2, column, words);
  };
  wrong("d { n (1, 2, 3) }", 7, "a number");
  wrong("d { n \"2\" }", 7, "a number");
  wrong("d { n true }", 7, "a number");
  wrong("d { v 1 }", 7, "three numbers");
  wrong("d { v 1 2 }", 7, "three numbers");
  wrong("d { n 1 2 }", 9, "a number");
  wrong("d { c \"red\" }", 7, "a colour");
  wrong("d { b 1 }", 7, "true or false");
  wrong("d { s 1 }", 7, "a string");
  wrong("d { m 1 }", 5, "'m'");
  wrong("d { n 1 n 2 }", 9, "twice");
  wrong("d { n }", 5, "a number");
  wrong("d { sphere { } }", 5, "sphere");
}

TEST_CASE("defaults are computed where the definition stands", "[statements]") {
  check_near(middles("let a = 3 define d (x a, y (a + 1)) { " + ball("x") + ball("y") +
                     "} group { let a = 50 d { } }"),
             {3, 4});
  check_mistake("define d (x a) { }\nlet a = 1", 1, 13, "'a'");
  check_mistake("define d (x) { }", 1, 11, "'x'");
  check_mistake("define d (x 1, x 2) { }", 1, 16, "'x'");
  check_mistake("define d (x 1 2) { }", 1, 13, "found 2");
}

TEST_CASE("a definition's body sees what stood before it, not what stands before its use", "[statements]") {
  check_near(middles("let a = 1 define d { " + ball("a") + "} group { let a = 2 d { } }"), {1});
  check_near(middles("let a = 1 define d { " + ball("a") + "} for a from 5 to 6 { d { } }"), {1, 1});
  check_mistake("define d { sphere { radius b } }\nlet b = 2\nd { }\nsphere { radius b }", 1, 28, "'b'");
  check_mistake("define d { e { } }\ndefine e { sphere { } }\nd { }", 1, 12, "'e'");
  check_mistake("define d { sphere { material m } }\nmaterial m { }\nd { }\nsphere { material m }", 1, 30,
                "'m'");
  check_mistake("define d { sphere { radius q } }\ndefine e (q 2) { d { } }\ne { }", 1, 28, "'q'");
}

TEST_CASE("a mistake in a definition also shows where it was used from", "[statements]") {
  const LoadedScene scene = load_scene_text(
      "define d (r 1) { sphere { radius r } }\ndefine e (s 1) { d { r s } }\n  e { s 0 }", "statements.txt");
  REQUIRE(scene.diagnostics.size() == 1);
  const Diagnostic& message = scene.diagnostics[0];
  REQUIRE(message.line == 1);
  REQUIRE(message.column == 34);
  REQUIRE(message.notes.size() == 2);
  REQUIRE(message.notes[0].line == 2);
  REQUIRE(message.notes[0].column == 18);
  REQUIRE(message.notes[1].line == 3);
  REQUIRE(message.notes[1].column == 3);
}

TEST_CASE("definitions use themselves under an if that ends it", "[statements]") {
  check_near(middles("define d (n 3) { " + ball("n") + "if n > 0 { d { n (n - 1) } } }\nd { }"),
             {3, 2, 1, 0});
  check_near(middles("define d (n 2) { " + ball("0") +
                     "if n > 0 { d { n (n - 1) translate 1 0 0 scale 0.5 } } }\nd { }"),
             {0, 1, 1.5});
  REQUIRE(
      middles("define d (n 5) { if n == 0 { sphere { } } else { d { n (n - 1) } d { n (n - 1) } } }\nd { }")
          .size() == 32);
}

TEST_CASE("definitions stand in definitions and loops, local to them", "[statements]") {
  check_near(middles("define d (x 1) { define e { " + ball("x") +
                     "} e { } e { translate 10 0 0 } }\nd { } d { x 2 }"),
             {1, 11, 2, 12});
  check_near(middles("for i from 0 to 1 { define e { " + ball("i") + "} e { } }"), {0, 1});
  check_mistake("for i from 0 to 1 { define e { sphere { } } e { } }\ne { }", 2, 1, "'e'");
  check_mistake("define d { define e { sphere { } } e { } }\nd { }\ne { }", 3, 1, "'e'");
  check_mistake("define d { }\ndefine d { }", 2, 8, "'d'");
  check_near(middles("define d { " + ball("1") + "} for i from 0 to 0 { define d { " + ball("2") +
                     "} d { } } d { }"),
             {2, 1});
}

TEST_CASE("a definition never sees names that came behind it", "[statements]") {
  // Behind the group its let is gone; another one must not take its place in the body.
  const LoadedScene scene = load_scene_text("group { let a = 1 define d { " + ball("a") +
                                                "} d { } }\nlet b = 5\nlet c = 6\nd { }\n" + ball("b + c"),
                                            "statements.txt");
  if (scene.ok()) check_near(middles(*scene_of(scene)), {1, 1, 11});
  if (!scene.ok()) REQUIRE(scene.diagnostics.size() == 1);
}

TEST_CASE("a definition made under a condition is there behind it", "[statements]") {
  check_near(
      middles("if 1 > 0 { define d { " + ball("1") + "} } else { define d { " + ball("2") + "} }\nd { }"),
      {1});
}

// --- names -------------------------------------------------------------------------------------------------

TEST_CASE("names are local to a turn and a use", "[statements]") {
  REQUIRE(middles("for i from 0 to 2 { sphere ball { } material m { } }").size() == 3);
  REQUIRE(middles("define d { sphere ball { } material m { } }\nd { } d { } sphere ball { }").size() == 3);
  check_mistake("for i from 0 to 0 { sphere ball { }\nsphere ball { } }", 2, 1, "'ball'");
  check_mistake("sphere ball { }\ngroup { sphere ball { } }", 2, 9, "'ball'");
  check_mistake("sphere ball { }\nif true { sphere ball { } }", 2, 11, "'ball'");
  REQUIRE(middles("sphere ball { }\nfor i from 0 to 1 { sphere ball { } }").size() == 3);
  check_mistake("define d { sphere { } }\nd one { }\nd one { }", 3, 1, "'one'");
  REQUIRE(middles("sphere ball { } cube ball { }").size() == 2);
}

TEST_CASE("materials are local to loops and definitions, not to groups and ifs", "[statements]") {
  REQUIRE(shapes_colors("group { material m { color 0.5 0 0 } sphere { } }\nsphere { material m }").back() ==
          0.5f);
  REQUIRE(shapes_colors("if true { material m { color 0.5 0 0 } }\nsphere { material m }").back() == 0.5f);
  check_mistake("for i from 0 to 1 { material m { } sphere { material m } }\nsphere { material m }", 2, 19,
                "'m'");
  check_mistake("define d { material m { } sphere { material m } }\nd { }\nsphere { material m }", 3, 19,
                "'m'");
  const auto reds =
      shapes_colors("for i from 0 to 4 { material m { color (i / 4) 0 0 } sphere { material m } }");
  check_near(reds, {0, 0.25f, 0.5f, 0.75f, 1});
  check_near(shapes_colors("material m { color 0.25 0 0 } for i from 0 to 0 { material m { color 0.5 0 0 } "
                           "sphere { material m } "
                           "}\nsphere { material m }"),
             {0.5f, 0.25f});
}

// --- groups' materials -------------------------------------------------------------------------------------

TEST_CASE("a group's material is the default of its children", "[statements]") {
  const std::string m =
      "material a { color 0.1 0 0 } material b { color 0.2 0 0 } material c { color 0.3 0 0 }\n";
  check_near(shapes_colors("sphere { }"), {0.8f});
  check_near(
      shapes_colors(
          m + "group { material a sphere { } sphere { material b } group { sphere { } } group { material c "
              "sphere { } } } sphere { }"),
      {0.1f, 0.2f, 0.1f, 0.3f, 0.8f});
  check_near(shapes_colors(m + "group { sphere { } material a }"), {0.1f});
  check_near(shapes_colors("group { material { color 0.6 0 0 } sphere { } if true { sphere { } } for i from "
                           "1 to 1 { sphere { } } }"),
             {0.6f, 0.6f, 0.6f});
  check_near(
      shapes_colors(
          m +
          "define d { sphere { } sphere { material b } }\nd { } d { material a } group { material c d { } }"),
      {0.8f, 0.2f, 0.1f, 0.2f, 0.3f, 0.2f});
  check_near(shapes_colors(
                 "define d (shade 0.5) { sphere { material { color shade 0 0 } } }\nd { } d { shade 0.25 }"),
             {0.5f, 0.25f});
}

// --- include -----------------------------------------------------------------------------------------------

TEST_CASE("include stands for the file's text", "[statements]") {
  const TemporaryFolder folder;
  write(folder / "names.txt",
        "let size = 4\nmaterial m { color 0.5 0 0 }\ndefine d { " + ball("size") + "}\n");
  write(folder / "main.txt", "include \"names.txt\"\nd { }\n" + ball("size + 1") + "sphere { material m }\n");
  const LoadedScene scene = load_scene_file(folder / "main.txt");
  check_near(middles(*scene_of(scene)), {4, 5, 0});
  REQUIRE(value_of(scene, "size") == "4");
  REQUIRE(scene.files_read.size() == 2);

  write(folder / "sees.txt", ball("outer"));
  write(folder / "main2.txt",
        "let outer = 7\ninclude \"sees.txt\"\ngroup { translate 1 0 0 include \"sees.txt\" }\n"
        "for outer from 1 to 2 { include \"sees.txt\" }\nif true { include \"sees.txt\" }\n");
  check_near(middles(*scene_of(load_scene_file(folder / "main2.txt"))), {7, 8, 1, 2, 7});
}

TEST_CASE("include's paths are relative to the file that says it", "[statements]") {
  const TemporaryFolder folder;
  std::filesystem::create_directories(folder / "parts/inner");
  write(folder / "main.txt", "include \"parts/one.txt\"\n");
  write(folder / "parts/one.txt", "include \"inner/two.txt\"\n" + ball("1"));
  write(folder / "parts/inner/two.txt", "include \"../three.txt\"\n" + ball("2"));
  write(folder / "parts/three.txt", ball("3"));
  check_near(middles(*scene_of(load_scene_file(folder / "main.txt"))), {3, 2, 1});
}

TEST_CASE("a let twice through an include shows both files", "[statements]") {
  const TemporaryFolder folder;
  write(folder / "part.txt", "let a = 1\n");
  write(folder / "main.txt", "let a = 2\ninclude \"part.txt\"\nsphere { radius a }\n");
  const LoadedScene scene = load_scene_file(folder / "main.txt");
  REQUIRE(scene.diagnostics.size() == 1);
  REQUIRE(scene.diagnostics[0].file.ends_with("part.txt"));
  REQUIRE(scene.diagnostics[0].notes.size() ==
          2);  // where it was first assigned, and where the file was included
  REQUIRE(scene.diagnostics[0].notes[0].file.ends_with("main.txt"));
  REQUIRE(scene.diagnostics[0].notes[0].line == 1);
  REQUIRE(scene.diagnostics[0].notes[1].line == 2);
}

// --- settings ----------------------------------------------------------------------------------------------

TEST_CASE("a setting replaces a top-level let", "[statements]") {
  const std::string text =
      "let n = 2\nlet m = n * 10\nlet v = (1, 2, 3)\nlet c = red\nlet s = \"text\"\nlet b = true\n"
      "for i from 1 to n { sphere { } }\nsphere { radius m center v material { color c } }\nif b and s == "
      "\"text\" { sphere { } }";
  const auto value_with = [&](const std::string& name, const std::string& value, const std::string& of) {
    const LoadedScene scene = load_scene_text(text, "statements.txt", with_setting(name, value));
    INFO(name << '=' << value);
    INFO(errors_of(scene));
    REQUIRE(scene.ok());
    return value_of(scene, of);
  };
  CHECK(value_with("n", "24", "n") == "24");
  CHECK(value_with("n", "24", "m") == "240");
  CHECK(value_with("n", "1.5e2", "n") == "150");
  CHECK(value_of(load_scene_text("let n = 1 sphere { center n 0 0 }", "s.txt", with_setting("n", "-2")),
                 "n") == "-2");
  CHECK(value_with("n", "1 + 2 * 3", "n") == "7");
  CHECK(value_with("v", "4,5,6", "v") == "(4, 5, 6)");
  CHECK(value_with("v", "(4, 5, 6)", "v") == "(4, 5, 6)");
  CHECK(value_with("v", "-4, 5.5, 6", "v") == "(-4, 5.5, 6)");
  CHECK(value_with("c", "tomato", "c") == "#ff6347");
  CHECK(value_with("c", "0.5", "c") == "(0.5, 0.5, 0.5)");
  CHECK(value_with("c", "#0f0", "c") == "#00ff00");
  CHECK(value_with("c", "0.5,0.25,1", "c") == "(0.5, 0.25, 1)");
  CHECK(value_with("c", "hsv(0, 1, 1)", "c") == "#ff0000");
  CHECK(value_with("s", "other words", "s") == "\"other words\"");
  CHECK(value_with("s", "12", "s") == "\"12\"");
  CHECK(value_with("s", "red", "s") == "\"red\"");
  CHECK(value_with("b", "false", "b") == "false");
  REQUIRE(middles(text, with_setting("n", "5")).size() == 7);
}

TEST_CASE("a setting leaves inner lets of the same name alone", "[statements]") {
  check_near(middles("let a = 1 group { let a = 2 " + ball("a") + "} if true { let a = 3 " + ball("a") +
                         "} " + ball("a"),
                     with_setting("a", "9")),
             {2, 3, 9});
}

TEST_CASE("a setting that fits no let is an error of usage", "[statements]") {
  const std::string text =
      "let count = 2\nlet tint = red\nsphere { radius count material { color tint } }\n"
      "group { let inner = 1 sphere { radius inner } }";
  const auto check = [&](const std::string& name, const std::string& value, const std::string& words) {
    std::string message;
    INFO(name << '=' << value);
    CHECK(kind_of_failure(text, with_setting(name, value), message) == ErrorKind::kUsage);
    INFO(message);
    CHECK(message.find(words) != std::string::npos);
  };
  check("cuont", "3", "did you mean 'count'?");
  check("nothing", "3", "count, tint");
  check("inner", "3", "count, tint");
  check("count", "red", "a number");
  check("count", "(1, 2, 3)", "a number");
  check("count", "words", "a number");
  check("count", "true", "a number");
  check("count", "1/0", "a number");
  check("tint", "true", "a colour");
  check("tint", "tomatoo", "a colour");
  check("count", "", "count");
  check("t", "3", "t");
}

// --- limits ------------------------------------------------------------------------------------------------

TEST_CASE("each limit refuses at the place that asked, and can be raised", "[statements]") {
  LoadOptions options;
  options.limits.shapes = 10;
  const std::string eleven = "for i from 1 to 11 {\n  sphere { }\n}";
  check_mistake(eleven, 1, 1, "10 shapes", options);  // before the first is made
  options.limits.shapes = 11;
  REQUIRE(scene_of(eleven, options)->description().shapes.size() == 11);

  options = {};
  options.limits.steps = 1000;
  const std::string busy = "for i from 1 to 900 {\n  let a = i * i + i\n}\nsphere { }";
  const LoadedScene refused = load_scene_text(busy, "statements.txt", options);
  REQUIRE(refused.diagnostics.size() == 1);
  REQUIRE(refused.diagnostics[0].message.find("1000 steps") != std::string::npos);
  REQUIRE(scene_of(busy)->description().shapes.size() == 1);

  options = {};
  options.limits.nesting = 10;
  const std::string deep = "define d (n 10) { sphere { } if n > 0 { d { n (n - 1) } } }\n";
  REQUIRE(scene_of(deep + "d { n 9 }", options)->description().shapes.size() == 10);
  check_mistake(deep + "d { }", 1, 41, "10 deep", options);
  options.limits.nesting = 11;
  REQUIRE(scene_of(deep + "d { }", options)->description().shapes.size() == 11);

  const TemporaryFolder folder;
  write(folder / "a.txt", "include \"b.txt\"\n");
  write(folder / "b.txt", "include \"c.txt\"\n");
  write(folder / "c.txt", "sphere { }\n");
  options = {};
  options.limits.include_depth = 1;
  const LoadedScene scene = load_scene_file(folder / "a.txt", options);
  REQUIRE(scene.diagnostics.size() == 1);
  REQUIRE(scene.diagnostics[0].file.ends_with("b.txt"));
  options.limits.include_depth = 2;
  REQUIRE(load_scene_file(folder / "a.txt", options).ok());
}

TEST_CASE("loops without end are refused before their first turn", "[statements]") {
  for (const std::string text :
       {"for i from 0 to 1e18 { sphere { } }", "for i from 0 to 1 step 1e-300 { sphere { } }",
        "for i from -1e308 to 1e308 { }", "for i from 0 to -1e18 step -1 { }"}) {
    const LoadedScene scene = load_scene_text(text, "statements.txt");
    INFO(text);
    CHECK_FALSE(scene.ok());
    CHECK(scene.diagnostics.size() == 1);
  }
}

TEST_CASE("nesting of every kind at once is refused, not fallen over", "[statements]") {
  for (const std::string opening :
       {"group { ", "if true { ", "for i from 0 to 0 { ", "if false { } else { "}) {
    std::string text = "define d (n 0) { ", closing;
    for (int i = 0; i < 200; ++i) {
      text += opening;
      closing += "} ";
    }
    text += "if n < 250 { d { n (n + 1) } } " + closing + "}\nd { }\nsphere { }";
    const LoadedScene scene = load_scene_text(text, "statements.txt");
    INFO(opening);
    CHECK((scene.ok() || scene.diagnostics.size() == 1));
  }
}

// --- time --------------------------------------------------------------------------------------------------

TEST_CASE("what reads t or frame depends on time", "[statements]") {
  for (const std::string text :
       {"sphere { radius (1 + t) }", "sphere { radius frame }", "if t > 2 { sphere { } } sphere { }",
        "let speed = 3 * t sphere { radius (1 + speed) }", "for i from 0 to t { sphere { } }",
        "define d (x 1) { sphere { radius (x + t) } } d { }",
        "define d (x 1) { sphere { radius x } } d { x (1 + t) }", "group { rotate 0 (90 * t) 0 sphere { } }",
        "sphere { material { color (t < 1 ? red : blue) } }",
        "camera { position (t) 0 5 look_at 0 0 0 } sphere { }", "light { intensity (100 + t) } sphere { }"}) {
    const LoadedScene scene = load_scene_text(text, "statements.txt");
    INFO(text);
    INFO(errors_of(scene));
    CHECK(scene.ok());
    CHECK(scene.depends_on_time);
  }
  for (const std::string text :
       {"sphere { }", "animation { duration 4 } sphere { }", "let a = random(1) sphere { radius a }",
        "for i from 0 to 3 { sphere { center i 0 0 } }",
        "define d (x 1) { sphere { radius (x + t) } } sphere { }"}) {
    const LoadedScene scene = load_scene_text(text, "statements.txt");
    INFO(text);
    CHECK(scene.ok());
    CHECK_FALSE(scene.depends_on_time);
  }
}

TEST_CASE("a scene is evaluated anew for each time", "[statements]") {
  const LoadedScene scene = load_scene_text(
      "animation { duration 2 fps 10 } " + ball("t") + ball("frame") + "if t >= 1 { " + ball("99") + "}",
      "s.txt");
  check_near(middles(*scene_of(scene, 0)), {0, 1});
  check_near(middles(*scene_of(scene, 0.5)), {0.5f, 6});
  check_near(middles(*scene_of(scene, 1)), {1, 11, 99});
  check_near(middles(*scene_of(scene, 1.05)), {1.05f, 11, 99});
  check_near(middles(*scene_of(scene, 0)), {0, 1});
  const LoadedScene still = load_scene_text(ball("3"), "s.txt");
  REQUIRE(scene_of(still, 0) == scene_of(still, 7));  // the very same
}

TEST_CASE("frame numbers are whole at the times of frames", "[statements]") {
  for (const int fps : {10, 24, 25, 30, 60, 120}) {
    const LoadedScene scene = load_scene_text(
        "animation { duration 100 fps " + std::to_string(fps) + " } " + ball("frame") + ball("t"), "s.txt");
    for (const int frame : {1, 2, 3, 7, 30, 31, 100, 1001}) {
      INFO(fps << ' ' << frame);
      const auto found = middles(*scene_of(scene, static_cast<double>(frame - 1) / fps));
      REQUIRE(std::abs(found[0] - static_cast<float>(frame)) < 1e-3f);
    }
  }
}

TEST_CASE("a mistake that only another time shows is thrown there", "[statements]") {
  const LoadedScene scene = load_scene_text("sphere { radius (1 - t) }", "statements.txt");
  REQUIRE(scene.ok());
  REQUIRE_NOTHROW(scene.scene_at(0.5));
  try {
    scene.scene_at(1);
    FAIL("nothing was thrown");
  } catch (const Error& error) {
    REQUIRE(error.kind() == ErrorKind::kScene);
    const std::string text = error.what();
    REQUIRE(text.find("t = 1") != std::string::npos);
    REQUIRE(text.find("statements.txt:1:17") != std::string::npos);
  }
  REQUIRE_NOTHROW(scene.scene_at(0.25));
}

TEST_CASE("an animation has the frames that begin within it", "[statements]") {
  const auto frames = [](const std::string& text) {
    const LoadedScene scene = load_scene_text(text + " sphere { }", "statements.txt");
    REQUIRE(scene.ok());
    return scene.animation.frames();
  };
  REQUIRE(frames("") == 1);
  REQUIRE(frames("animation { duration 4 }") == 96);
  REQUIRE(frames("animation { duration 4 fps 25 }") == 100);
  REQUIRE(frames("animation { duration 0.1 fps 30 }") == 3);
  REQUIRE(frames("animation { duration 0.01 fps 30 }") == 1);
  REQUIRE(frames("animation { duration 1.01 fps 10 }") == 11);
  REQUIRE(frames("let d = 2 animation { duration (d * 2) fps 10 }") == 40);
  check_mistake("animation { fps 10 }", 1, 1, "'duration'");
  check_mistake("animation { duration 0 }", 1, 22, "duration");
  check_mistake("animation { duration 1 fps 0 }", 1, 28, "fps");
}

TEST_CASE("settings hold at every time", "[statements]") {
  const LoadedScene scene =
      load_scene_text("let a = 1 " + ball("a + t"), "statements.txt", with_setting("a", "10"));
  check_near(middles(*scene_of(scene, 0)), {10});
  check_near(middles(*scene_of(scene, 2)), {12});
}

// --- warnings ----------------------------------------------------------------------------------------------

TEST_CASE("what is defined and never used is warned of, and no more", "[statements]") {
  const auto warnings = [](const std::string& text) {
    const LoadedScene scene = load_scene_text(
        "camera { position 0 0 9 look_at 0 0 0 } light { position 0 9 9 } sphere { } " + text, "s.txt");
    INFO(errors_of(scene));
    REQUIRE(scene.ok());
    return scene.diagnostics.size();
  };
  CHECK(warnings("") == 0);
  CHECK(warnings("let a = 1") == 1);
  CHECK(warnings("let a = 1 let b = a") == 1);
  CHECK(warnings("let a = 1 sphere { radius a }") == 0);
  CHECK(warnings("let a = 1 define d (x a) { sphere { } } d { }") == 0);
  CHECK(warnings("let a = 1 if a > 2 { }") == 0);
  CHECK(warnings("material m { }") == 1);
  CHECK(warnings("define d { sphere { } }") == 1);
  CHECK(warnings("define d { sphere { } } d { }") == 0);
}
