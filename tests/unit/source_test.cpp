#include "scene_file/source.hpp"

#include <string>

#include "catch.hpp"

using raytracer::scene_file::LineColumn;
using raytracer::scene_file::Source;

namespace {

const std::string kByteOrderMark = "\xEF\xBB\xBF";

Source source(const std::string& text) { return {"name.txt", "/name.txt", text}; }

/// The line and column of the first place where `word` stands.
LineColumn place_of(const Source& text, const std::string& word) {
  return text.locate(static_cast<std::uint32_t>(text.text().find(word)));
}

void require_place(const LineColumn& place, std::uint32_t line, std::uint32_t column) {
  INFO("line " << place.line << ", column " << place.column);
  REQUIRE(place.line == line);
  REQUIRE(place.column == column);
}

}  // namespace

TEST_CASE("lines and columns count from 1", "[source]") {
  const Source text = source("one two\n\n  three\n");
  require_place(place_of(text, "one"), 1, 1);
  require_place(place_of(text, "two"), 1, 5);
  require_place(text.locate(7), 1, 8);  // the line feed itself
  require_place(text.locate(8), 2, 1);
  require_place(place_of(text, "three"), 3, 3);
  require_place(text.locate(17), 4, 1);  // the end of the text
}

TEST_CASE("every kind of line end counts once", "[source]") {
  for (const std::string end : {"\n", "\r\n", "\r"}) {
    const Source text = source("a" + end + end + "b c" + end + "d");
    require_place(place_of(text, "a"), 1, 1);
    require_place(place_of(text, "b"), 3, 1);
    require_place(place_of(text, "c"), 3, 3);
    require_place(place_of(text, "d"), 4, 1);
    REQUIRE(text.line_at(static_cast<std::uint32_t>(text.text().find('c'))) == "b c");
    REQUIRE(text.line_at(static_cast<std::uint32_t>(text.text().find('d'))) == "d");
  }
  const Source mixed = source("a\n\rb\r\nc\r");
  require_place(place_of(mixed, "b"), 3, 1);
  require_place(place_of(mixed, "c"), 4, 1);
  require_place(mixed.locate(8), 5, 1);
}

TEST_CASE("columns are characters, whatever bytes they take, and a tab is one", "[source]") {
  const Source text = source("\tä€\xF0\x9F\x8E\x88 x\nß y");
  require_place(place_of(text, "ä"), 1, 2);
  require_place(place_of(text, "€"), 1, 3);
  require_place(place_of(text, "\xF0\x9F\x8E\x88"), 1, 4);
  require_place(place_of(text, "x"), 1, 6);
  require_place(place_of(text, "y"), 2, 3);
}

TEST_CASE("a byte-order mark takes no column and is no part of the line", "[source]") {
  const Source text = source(kByteOrderMark + "one\ntwo");
  require_place(text.locate(0), 1, 1);
  require_place(place_of(text, "one"), 1, 1);
  require_place(place_of(text, "two"), 2, 1);
  REQUIRE(text.line_at(3) == "one");
  REQUIRE(text.line_at(0) == "one");
  REQUIRE(source(kByteOrderMark).line_at(3).empty());
}

TEST_CASE("the line of any offset is the one that holds it", "[source]") {
  const Source text = source("first\nsecond\n\nlast");
  REQUIRE(text.line_at(0) == "first");
  REQUIRE(text.line_at(4) == "first");
  REQUIRE(text.line_at(5) == "first");  // its line feed
  REQUIRE(text.line_at(6) == "second");
  REQUIRE(text.line_at(13).empty());
  REQUIRE(text.line_at(14) == "last");
  REQUIRE(text.line_at(18) == "last");  // the end of the text
  REQUIRE(source("").line_at(0).empty());
  require_place(source("").locate(0), 1, 1);
}

TEST_CASE("each offset of a text lies on the line that it is said to lie on", "[source]") {
  const Source text = source(kByteOrderMark + "a ä\r\n\r\n€ b\rc\n\n\xFF\xC3");
  for (std::uint32_t offset = 0; offset <= text.text().size(); ++offset) {
    // Counted by hand from the beginning.
    std::uint32_t line = 1;
    for (std::uint32_t i = 0; i < offset; ++i) {
      const char c = text.text()[i];
      const bool before_line_feed = i + 1 < text.text().size() && text.text()[i + 1] == '\n';
      if (c == '\n' || (c == '\r' && !before_line_feed)) ++line;
    }
    INFO("offset " << offset);
    REQUIRE(text.locate(offset).line == line);
    REQUIRE(text.locate(offset).column >= 1);
  }
}

TEST_CASE("Of a long line only the part around the offset is given, in whole characters") {
  const Source text = source("first\n0123456789ßabcdefghi\nlast");
  const auto at = [&](const char* word) { return static_cast<std::uint32_t>(text.text().find(word)); };
  REQUIRE(text.line_at(at("5"), 3) == "234567");
  REQUIRE(text.line_at(at("9"), 2) == "789");    // half of ß is left out
  REQUIRE(text.line_at(at("a"), 1) == "a");      // so is its other half
  REQUIRE(text.line_at(at("1"), 4) == "01234");  // the line before is none of its own
  REQUIRE(text.line_at(at("hi"), 4) == "defghi");
  REQUIRE(text.line_at(at("5"), 100) == "0123456789ßabcdefghi");
  REQUIRE(text.line_at(static_cast<std::uint32_t>(text.text().size()), 2) == "st");
}
