// How expressions are read: what binds tighter than what, and from which side.
#include <string>
#include <vector>

#include "catch.hpp"
#include "raytracer/scene_file.hpp"

using raytracer::Diagnostic;
using raytracer::load_scene_text;
using raytracer::LoadedScene;
using raytracer::LoadOptions;

namespace {

struct Row {
  const char* expression;
  const char* value;  // as `raytracer params` prints it
};

// The names that the tables below compute with.
constexpr const char* kNames =
    "let a = 2\nlet b = 3\nlet v = (1, 2, 3)\nlet c = #ff8000\nlet yes = true\nlet no = false\nlet s = "
    "\"text\"\n";

void check_table(const std::vector<Row>& rows) {
  for (const Row& row : rows) {
    const LoadedScene scene = load_scene_text(
        std::string(kNames) + "let result = " + row.expression + "\nsphere { }\n", "expressions.txt");
    INFO(row.expression);
    for (const Diagnostic& diagnostic : scene.diagnostics) UNSCOPED_INFO(to_text(diagnostic));
    CHECK(scene.ok());
    if (scene.ok()) CHECK(scene.parameters.back().value == row.value);
  }
}

// The one message about `let x = <expression>`; its place must be where « and » stand.
void check_mistake(const std::string& marked, const std::string& words) {
  const std::string text = std::string(kNames) + "let result = " + marked + "\nsphere { }\n";
  const std::string open = "«", close = "»";
  const std::size_t begin = text.find(open), end = text.find(close) - open.size();
  std::string plain = text;
  plain.erase(plain.find(open), open.size());
  plain.erase(plain.find(close), close.size());
  const LoadedScene scene = load_scene_text(plain, "expressions.txt");
  INFO(marked);
  for (const Diagnostic& diagnostic : scene.diagnostics) UNSCOPED_INFO(to_text(diagnostic));
  CHECK_FALSE(scene.ok());
  CHECK(scene.diagnostics.size() == 1);
  if (scene.diagnostics.empty()) return;
  const Diagnostic& message = scene.diagnostics.front();
  const std::size_t line_begin = plain.rfind('\n', begin) + 1;
  CHECK(message.column == begin - line_begin + 1);
  CHECK(message.end_column == end - line_begin + 1);
  CHECK((message.message + " " + message.suggestion).find(words) != std::string::npos);
}

}  // namespace

TEST_CASE("operators bind as the language says", "[expressions]") {
  check_table({
      {"1 + 2 * 3", "7"},
      {"(1 + 2) * 3", "9"},
      {"2 * 3 + 1", "7"},
      {"10 - 4 - 3", "3"},
      {"10 - (4 - 3)", "9"},
      {"100 / 10 / 5", "2"},
      {"100 / (10 / 5)", "50"},
      {"2 * 6 / 3 * 4", "16"},
      {"7 / 2", "3.5"},
      {"-7 / 2", "-3.5"},
      {"1 / 3 * 3", "1"},
      {"17 % 5 * 2", "4"},
      {"2 * 17 % 5", "4"},
      // powers: tighter than a sign in front, to the right, and with a sign behind
      {"-2 ^ 2", "-4"},
      {"(-2) ^ 2", "4"},
      {"2 ^ 3 ^ 2", "512"},
      {"(2 ^ 3) ^ 2", "64"},
      {"2 ^ -1", "0.5"},
      {"2 ^ -1 ^ 2", "0.5"},
      {"2 * 3 ^ 2", "18"},
      {"2 ^ 3 * 2", "16"},
      {"-2 ^ -2", "-0.25"},
      {"0 ^ 0", "1"},
      {"4 ^ 0.5", "2"},
      // signs
      {"--2", "2"},
      {"- - - 2", "-2"},
      {"+-+2", "-2"},
      {"1 - -1", "2"},
      {"1--1", "2"},
      {"1-1", "0"},
      {"a-1", "1"},
      {"a -1", "1"},
      {"3 - +2", "1"},
      {"-a * b", "-6"},
      {"a * -b", "-6"},
      {"-v", "(-1, -2, -3)"},
      {"+v", "(1, 2, 3)"},
      // remainders: of the left sign, and of the right one
      {"7 % 3", "1"},
      {"7 % -3", "1"},
      {"-7 % 3", "-1"},
      {"(-7) % 3", "-1"},
      {"-7 % -3", "-1"},
      {"5.5 % 2", "1.5"},
      {"mod(-7, 3)", "2"},
      {"mod(7, -3)", "-2"},
      {"v % 2", "(1, 0, 1)"},
      {"7 % v", "(0, 1, 1)"},
  });
}

TEST_CASE("comparisons and logic bind as the language says", "[expressions]") {
  check_table({
      {"1 < 2", "true"},
      {"2 < 1", "false"},
      {"2 <= 2", "true"},
      {"2 < 2", "false"},
      {"2 >= 2", "true"},
      {"2 > 2", "false"},
      {"2 == 2", "true"},
      {"2 != 2", "false"},
      {"1 + 1 == 2", "true"},
      {"1 + 1 < 1 * 3", "true"},
      {"-1 < 1", "true"},
      {"0.1 + 0.2 == 0.3", "false"},
      {"0 == -0", "true"},
      {"not a == b", "true"},
      {"not 1 == 1", "false"},
      {"not true == false", "true"},
      {"not not yes", "true"},
      {"not no and no", "false"},
      {"not (no and no)", "true"},
      {"1 < 2 and 3 < 4 or false", "true"},
      {"false and false or true", "true"},
      {"false and (false or true)", "false"},
      {"true or true and false", "true"},
      {"(true or true) and false", "false"},
      {"no or not no and yes", "true"},
      {"yes == (1 < 2)", "true"},
      {"true != false", "true"},
      {"\"a\" == \"a\"", "true"},
      {"\"a\" != \"b\"", "true"},
      {"s == \"text\"", "true"},
      {"v == (1, 2, 3)", "true"},
      {"v != (1, 2, 4)", "true"},
      {"red == #ff0000", "true"},
      {"red == (1, 0, 0)", "true"},
  });
}

TEST_CASE("a choice binds loosest and to the right", "[expressions]") {
  check_table({
      {"yes ? 1 : 2", "1"},
      {"no ? 1 : 2", "2"},
      {"no ? 1 : no ? 2 : 3", "3"},
      {"no ? 1 : yes ? 2 : 3", "2"},
      {"yes ? no ? 1 : 2 : 3", "2"},
      {"yes ? yes ? 1 : 2 : 3", "1"},
      {"a > 1 ? a + 1 : a - 1", "3"},
      {"1 + (no ? 1 : 2) * 10", "21"},
      {"yes or no ? 1 : 2", "1"},
      {"yes ? no : yes", "false"},
      {"yes ? \"one\" : 2", "\"one\""},
      {"yes ? v : red", "(1, 2, 3)"},
      {"not yes ? 1 : 2", "2"},
  });
}

TEST_CASE("what is not asked for is not computed", "[expressions]") {
  check_table({
      {"false and 1 / 0 == 1", "false"},
      {"true or 1 / 0 == 1", "true"},
      {"false and sqrt(-1) > 0 or true", "true"},
      {"true or nothing_of_that_name", "true"},
      {"true ? 1 : 1 / 0", "1"},
      {"false ? sqrt(-1) : 2", "2"},
      {"a == 0 ? 0 : 1 / a", "0.5"},
  });
  check_mistake("true and «1 / 0» == 1", "division by zero");
  check_mistake("false ? 1 : «1 / 0»", "division by zero");
}

TEST_CASE("vectors and their components", "[expressions]") {
  check_table({
      {"v.x", "1"},
      {"v.y", "2"},
      {"v.z", "3"},
      {"v.r", "1"},
      {"v.g", "2"},
      {"v.b", "3"},
      {"(4, 5, 6).y", "5"},
      {"(v * 2).z", "6"},
      {"-v.x", "-1"},
      {"v.y ^ 2", "4"},
      {"2 ^ v.y", "4"},
      {"cross((1, 0, 0), (0, 1, 0)).z", "1"},
      {"red.r + red.x", "2"},
      {"(1, 2, 3)", "(1, 2, 3)"},
      {"(1 + 1, 2 * 2, -3)", "(2, 4, -3)"},
      {"(v.x, (2), ((3)))", "(1, 2, 3)"},
      {"v + v", "(2, 4, 6)"},
      {"v - (1, 1, 1)", "(0, 1, 2)"},
      {"v * 2", "(2, 4, 6)"},
      {"2 * v", "(2, 4, 6)"},
      {"v * v", "(1, 4, 9)"},
      {"v / 2", "(0.5, 1, 1.5)"},
      {"6 / v", "(6, 3, 2)"},
      {"v / v", "(1, 1, 1)"},
  });
}

TEST_CASE("display colours stay themselves until they are computed with", "[expressions]") {
  check_table({
      {"red", "#ff0000"},
      {"#f80", "#ff8800"},
      {"c", "#ff8000"},
      {"(c)", "#ff8000"},
      {"(#ff8000)", "#ff8000"},
      {"(red)", "#ff0000"},
      {"yes ? red : blue", "#ff0000"},
      {"no ? red : blue", "#0000ff"},
      {"hsv(120, 1, 1)", "#00ff00"},
      {"red * 1", "(1, 0, 0)"},
      {"red + black", "(1, 0, 0)"},
      {"mix(red, blue, 0)", "(1, 0, 0)"},
      {"(1, 0, 0)", "(1, 0, 0)"},
      {"(red.r, red.g, red.b)", "(1, 0, 0)"},
  });
}

TEST_CASE("numbers, strings and names are read as they are written", "[expressions]") {
  check_table({
      {".5", "0.5"},
      {"1.", "1"},
      {"1.5e-3", "0.0015"},
      {"1e3", "1000"},
      {"0.1", "0.1"},
      {"pi", "3.141592653589793"},
      {"\"\"", "\"\""},
      {"\"a \\\"b\\\" \\\\ c\"", "\"a \\\"b\\\" \\\\ c\""},
      {"(\"text\")", "\"text\""},
      {"\"ünïcode\"", "\"ünïcode\""},
      {"t", "0"},
      {"frame", "1"},
      {"true", "true"},
      {"a /* between */ + // and behind\n b", "5"},
      {"a\n+\nb", "5"},
  });
}

TEST_CASE("an expression in a let runs as far as it can, and no further", "[expressions]") {
  const LoadedScene scene = load_scene_text(
      "let a = 1 + 2 let b = a * 2 sphere { radius b } let c = b\nlet d = c - 1 group { }", "let.txt");
  REQUIRE(scene.ok());
  REQUIRE(scene.parameters.size() == 4);
  REQUIRE(scene.parameters[0].value == "3");
  REQUIRE(scene.parameters[1].value == "6");
  REQUIRE(scene.parameters[2].value == "6");
  REQUIRE(scene.parameters[3].value == "5");
}

TEST_CASE("mistakes in expressions are told where they are", "[expressions]") {
  check_mistake("«1 / 0»", "division by zero");
  check_mistake("1 + «2 % 0» * 3", "division by zero");
  check_mistake("1 + «a / (a - 2)» + 1", "division by zero");
  check_mistake("«(1 + a) / 0»", "division by zero");
  check_mistake("«v / (1, 0, 1)»", "division by zero");
  check_mistake("«0 ^ -1»", "division by zero");
  check_mistake("«(0 - 2) ^ 0.5»", "not a number");
  check_mistake("«10 ^ 400»", "too large");
  check_mistake("«1e300 * 1e300»", "too large");
  check_mistake("1 + «sqrt(-1)»", "sqrt");
  check_mistake("1 + «nothing»", "'nothing'");
  check_mistake("«yess»", "did you mean 'yes'?");
  check_mistake("«sine»(30)", "did you mean 'sin'?");
  check_mistake("1 + «sin»", "sin(x)");
  check_mistake("«v + 1»", "between a vector and a number");
  check_mistake("a + «yes»", "true or false");
  check_mistake("«s» * 2", "a string");
  check_mistake("-«s»", "a string");
  check_mistake("not «1»", "true or false");
  check_mistake("«1» and yes", "true or false");
  check_mistake("yes and «1»", "true or false");
  check_mistake("«1» ? 2 : 3", "true or false");
  check_mistake("«a == s»", "a number is never equal to a string");
  check_mistake("«v» < 2", "a vector");
  check_mistake("1 < «yes»", "true or false");
  check_mistake("«a».x", "a number");
  check_mistake("(1, «v», 3)", "a vector");
  check_mistake("«v» ^ 2", "a number");
  check_mistake("2 ^ «v»", "a vector");
}

TEST_CASE("mistakes in the form of expressions are told where they are", "[expressions]") {
  check_mistake("1 < 2 «<» 3", "chained");
  check_mistake("v.«w»", "'w'");
  check_mistake("v.«xyz»", "'xyz'");
  check_mistake("«(1, 2)»", "three components");
  check_mistake("«(1, 2, 3, 4)»", "three components");
  check_mistake("yes ? 1 «sphere» { }", "':'");
  check_mistake("(1 + 2 «sphere» { }", "')'");
  check_mistake("1 + «)»", "value is missing");
  check_mistake("1 + «*» 2", "value is missing");
  check_mistake("«sphere» { }", "");
  check_mistake("1 + «let» q = 3", "value is missing");
  check_mistake("«sin(1, 2)»", "sin(x)");
  check_mistake("«let» = 2", "value is missing");
}

TEST_CASE("expressions are nested as deep as the limit says, and no text makes them fall over",
          "[expressions]") {
  const auto repeat = [](const std::string& text, int count) {
    std::string all;
    for (int i = 0; i < count; ++i) all += text;
    return all;
  };
  REQUIRE(load_scene_text("let x = " + repeat("(", 200) + "1" + repeat(")", 200) + "\nsphere { radius x }",
                          "deep.txt")
              .ok());
  for (const auto& [before, after] : std::vector<std::pair<std::string, std::string>>{{"(", ")"},
                                                                                      {"-", ""},
                                                                                      {"not ", ""},
                                                                                      {"sin(", ")"},
                                                                                      {"2 ^ ", ""},
                                                                                      {"true ? 1 : ", ""},
                                                                                      {"(1, 2, ", ")"}}) {
    const LoadedScene scene = load_scene_text(
        "let x = " + repeat(before, 100'000) + "1" + repeat(after, 100'000) + "\nsphere { }", "deep.txt");
    INFO(before);
    CHECK_FALSE(scene.ok());
    CHECK(scene.diagnostics.size() == 1);
  }
}

TEST_CASE("long chains of one operator are computed or refused", "[expressions]") {
  for (const std::string chain : {" + 1", " * 1", " - 1"}) {
    std::string text = "let x = 1";
    for (int i = 0; i < 1000; ++i) text += chain;
    CHECK(load_scene_text(text + "\nsphere { }", "chain.txt").ok());
  }
  for (const std::string chain : {" + 1", ".x", " and true", " or false", " % 2"}) {
    std::string text =
        chain.starts_with(" a") || chain.starts_with(" o") ? "let x = true" : "let x = (1, 2, 3)";
    for (int i = 0; i < 500'000; ++i) text += chain;
    const LoadedScene scene = load_scene_text(text + "\nsphere { }", "chain.txt");
    INFO(chain);
    CHECK((scene.ok() || scene.diagnostics.size() == 1));
  }
}
