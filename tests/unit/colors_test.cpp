#include "scene_file/colors.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "catch.hpp"

using raytracer::Vector3d;
using namespace raytracer::scene_file;

namespace {

Vector3d bytes(int r, int g, int b) { return Vector3d(r, g, b) / 255.0; }

}  // namespace

TEST_CASE("the 148 names of CSS are known, each once and in order", "[colors]") {
  const auto names = color_names();
  REQUIRE(names.size() == 148);
  REQUIRE(std::ranges::is_sorted(names));
  REQUIRE(std::ranges::adjacent_find(names) == names.end());
  for (const std::string_view name : names) {
    INFO(name);
    REQUIRE(named_color(name).has_value());
  }
}

TEST_CASE("names have the values of the standard", "[colors]") {
  const struct {
    const char* name;
    Vector3d color;
  } known[] = {
      {"black", bytes(0, 0, 0)},           {"white", bytes(255, 255, 255)},
      {"red", bytes(255, 0, 0)},           {"lime", bytes(0, 255, 0)},
      {"green", bytes(0, 128, 0)},         {"blue", bytes(0, 0, 255)},
      {"aliceblue", bytes(240, 248, 255)}, {"yellowgreen", bytes(154, 205, 50)},
      {"tomato", bytes(255, 99, 71)},      {"rebeccapurple", bytes(102, 51, 153)},
      {"orange", bytes(255, 165, 0)},      {"gray", bytes(128, 128, 128)},
      {"silver", bytes(192, 192, 192)},    {"darkgray", bytes(169, 169, 169)},
      {"navy", bytes(0, 0, 128)},          {"teal", bytes(0, 128, 128)},
      {"olive", bytes(128, 128, 0)},       {"maroon", bytes(128, 0, 0)},
      {"goldenrod", bytes(218, 165, 32)},  {"hotpink", bytes(255, 105, 180)},
      {"steelblue", bytes(70, 130, 180)},  {"peru", bytes(205, 133, 63)},
      {"tan", bytes(210, 180, 140)},       {"chocolate", bytes(210, 105, 30)},
  };
  for (const auto& k : known) {
    INFO(k.name);
    REQUIRE(named_color(k.name).value() == k.color);
  }
}

TEST_CASE("grey and gray are one colour, and so are the other twins", "[colors]") {
  int twins = 0;
  for (const std::string_view name : color_names()) {
    const std::size_t place = name.find("gray");
    if (place == std::string_view::npos) continue;
    std::string british(name);
    british[place + 2] = 'e';
    INFO(name);
    REQUIRE(named_color(british).value() == named_color(name).value());
    ++twins;
  }
  REQUIRE(twins == 7);
  REQUIRE(named_color("aqua").value() == named_color("cyan").value());
  REQUIRE(named_color("fuchsia").value() == named_color("magenta").value());
}

TEST_CASE("other words are no colours", "[colors]") {
  for (const char* word : {"", "Red", "redd", "re", "zzz", "a", "transparent", "#ff0000", "light blue"}) {
    INFO(word);
    REQUIRE_FALSE(named_color(word).has_value());
  }
}

TEST_CASE("hexadecimal digits are bytes, single ones doubled", "[colors]") {
  REQUIRE(hexadecimal_color("#000000") == Vector3d(0));
  REQUIRE(hexadecimal_color("#ffffff") == Vector3d(1));
  REQUIRE(hexadecimal_color("#FF8000") == bytes(255, 128, 0));
  REQUIRE(hexadecimal_color("#0a0B0c") == bytes(10, 11, 12));
  REQUIRE(hexadecimal_color("#f80") == bytes(255, 136, 0));
  REQUIRE(hexadecimal_color("#aBc") == bytes(170, 187, 204));
  REQUIRE(hexadecimal_color("#fff") == Vector3d(1));
}
