#include "core/suggest.hpp"

#include <string>
#include <string_view>
#include <vector>

#include "catch.hpp"

using raytracer::nearest_word;

namespace {

const std::vector<std::string_view> kWords = {"radius", "center",    "color",        "shininess", "look_at",
                                              "up",     "intensity", "vertical_fov", "size",      "normal"};

}  // namespace

TEST_CASE("one slip of the finger finds the word", "[suggest]") {
  REQUIRE(nearest_word("raduis", kWords) == "radius");   // neighbours swapped
  REQUIRE(nearest_word("radus", kWords) == "radius");    // a letter left out
  REQUIRE(nearest_word("raddius", kWords) == "radius");  // a letter too many
  REQUIRE(nearest_word("radios", kWords) == "radius");   // another letter
  REQUIRE(nearest_word("Radius", kWords) == "radius");
  REQUIRE(nearest_word("COLOR", kWords) == "color");
  REQUIRE(nearest_word("colour", kWords) == "color");
  REQUIRE(nearest_word("centre", kWords) == "center");
  REQUIRE(nearest_word("lookat", kWords) == "look_at");
  REQUIRE(nearest_word("verticalfov", kWords) == "vertical_fov");
  REQUIRE(nearest_word("shinyness", kWords) == "shininess");
  REQUIRE(nearest_word("radius", kWords) == "radius");
}

TEST_CASE("every single edit of a longer word finds it", "[suggest]") {
  for (const std::string_view word : kWords) {
    if (word.size() < 4) continue;
    for (std::size_t i = 0; i < word.size(); ++i) {
      std::string without(word), other(word), more(word);
      without.erase(i, 1);
      other[i] = 'q';
      more.insert(i, 1, 'q');
      INFO(word << ", letter " << i);
      CHECK(nearest_word(without, kWords) == word);
      CHECK(nearest_word(other, kWords) == word);
      CHECK(nearest_word(more, kWords) == word);
      if (i > 0) {
        std::string swapped(word);
        std::swap(swapped[i - 1], swapped[i]);
        CHECK(nearest_word(swapped, kWords) == word);
      }
    }
  }
}

TEST_CASE("another word altogether finds nothing", "[suggest]") {
  REQUIRE(nearest_word("banana", kWords).empty());
  REQUIRE(nearest_word("x", kWords).empty());
  REQUIRE(nearest_word("", kWords).empty());
  REQUIRE(nearest_word("ip", kWords).empty());
  REQUIRE(nearest_word("radius", {}).empty());
  REQUIRE(nearest_word(std::string(100000, 'r'), kWords).empty());
}

TEST_CASE("the nearest of several wins, and among equals the first", "[suggest]") {
  const std::vector<std::string_view> words = {"falloff", "fallout", "failoff"};
  REQUIRE(nearest_word("fallout", words) == "fallout");
  REQUIRE(nearest_word("faloff", words) == "falloff");
  REQUIRE(nearest_word("faxloff", words) == "falloff");
}
