#include "core/printable.hpp"

#include <string>

#include "catch.hpp"

using namespace raytracer;

namespace {

const std::string kReplaced = "\xEF\xBF\xBD";

}  // namespace

TEST_CASE("printable keeps letters of every script, tabs and line feeds") {
  for (const std::string text : {"", "abc", "größe", "日本 𝄞", "a\tb", "a\nb\n"})
    REQUIRE(printable(text) == text);
}

TEST_CASE("printable replaces what steers a terminal") {
  REQUIRE(printable("a\x1b[31mb") == "a" + kReplaced + "[31mb");
  REQUIRE(printable("\r\x07\x7f") == kReplaced + kReplaced + kReplaced);
  REQUIRE(printable("\xC2\x9B") == kReplaced);   // CSI in C1
  REQUIRE(printable("\xC2\xA0") == "\xC2\xA0");  // a blank, and no control
  REQUIRE(printable(std::string(1, '\0')) == kReplaced);
}

TEST_CASE("printable replaces each byte that is no UTF-8") {
  REQUIRE(printable("\xFF\xFE") == kReplaced + kReplaced);
  REQUIRE(printable("\xC3") == kReplaced);
  REQUIRE(printable("\xE2\x82") == kReplaced + kReplaced);
  REQUIRE(printable("\xE2\x82z") == kReplaced + kReplaced + "z");
  REQUIRE(printable("\xF8zzzz") == kReplaced + "zzzz");
}

TEST_CASE("printable_characters gives one string a character, a line feed being none") {
  REQUIRE(printable_characters("aß\n") == std::vector<std::string>{"a", "ß", kReplaced});
}

TEST_CASE("shortened keeps the beginning and the end of a long text") {
  REQUIRE(shortened("abcdefgh", 8) == "abcdefgh");
  REQUIRE(shortened("abcdefghi", 8) == "abcdef…hi");
  REQUIRE(shortened("äbcdefghi", 8) == "äbcdef…hi");
  REQUIRE(shortened("", 8).empty());
}
