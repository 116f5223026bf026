#include <charconv>
#include <clocale>
#include <cstdlib>
#include <random>

#include "catch.hpp"
#include "meshes/chunks.hpp"
#include "meshes/obj_lines.hpp"
#include "meshes/text.hpp"

using namespace raytracer::meshes;

namespace {

double number_of(const std::string& text) {
  Cursor c(text);
  double value = 0;
  INFO(text);
  REQUIRE(read_number(c, value));
  REQUIRE(c.at == c.end);
  return value;
}

bool is_number(const std::string& text) {
  Cursor c(text);
  double value = 0;
  const bool is = read_number(c, value);
  if (!is) REQUIRE(c.at == text.data());
  return is;
}

}  // namespace

TEST_CASE("numbers of a text are read as they are written") {
  REQUIRE(number_of("0") == 0);
  REQUIRE(std::signbit(number_of("-0")));
  REQUIRE(number_of("1") == 1);
  REQUIRE(number_of("+1.5") == 1.5);
  REQUIRE(number_of("-.25") == -0.25);
  REQUIRE(number_of("2.") == 2);
  REQUIRE(number_of("1e3") == 1000);
  REQUIRE(number_of("1E+3") == 1000);
  REQUIRE(number_of(".8e-001") == 0.08);
  REQUIRE(number_of("-5e-324") == -5e-324);
  REQUIRE(number_of("123456789012345678901234567890") == 123456789012345678901234567890.0);
  REQUIRE(number_of("0.000000000000000000000000000001") == 1e-30);
  REQUIRE(number_of("1e300") == 1e300);
}

TEST_CASE("numbers beyond every double become infinite or 0") {
  REQUIRE(number_of("1e999") == HUGE_VAL);
  REQUIRE(number_of("-1e999") == -HUGE_VAL);
  REQUIRE(number_of("1e99999999999") == HUGE_VAL);
  REQUIRE(number_of("1e-999") == 0);
  REQUIRE(number_of("0." + std::string(400, '0') + "1") == 0);
  REQUIRE(number_of("1" + std::string(400, '0')) == HUGE_VAL);
}

TEST_CASE("what programs write for no number is read as such") {
  for (const std::string text : {"nan", "-nan", "NaN", "nan(ind)", "1.#IND", "-1.#QNAN"})
    REQUIRE(std::isnan(number_of(text)));
  for (const std::string text : {"inf", "INF", "infinity", "1.#INF"}) REQUIRE(number_of(text) == HUGE_VAL);
  REQUIRE(number_of("-inf") == -HUGE_VAL);
}

TEST_CASE("what is no number is left alone") {
  for (const std::string text :
       {"", "-", "+", ".", "e", "1e", "1e+", "+-1", "--1", "1x", "1.2.3", "1,5", "0x10", "x"})
    REQUIRE_FALSE(is_number(text));
}

TEST_CASE("random floats written with nine digits come back exactly, others within a last bit of double") {
  std::mt19937 random(1);
  for (int i = 0; i < 50000; ++i) {
    const auto bits = static_cast<std::uint32_t>(random());
    const float value = std::bit_cast<float>(bits);
    if (!std::isfinite(value) || std::abs(value) < 1e-37f) continue;
    char text[64];
    const char* const format = i % 3 == 0 ? "%.9g" : i % 3 == 1 ? "%.8e" : "%.17g";
    std::snprintf(text, sizeof text, format, static_cast<double>(value));
    REQUIRE(static_cast<float>(number_of(text)) == value);
    REQUIRE(std::abs(number_of(text) - std::strtod(text, nullptr)) <=
            std::abs(0x1p-51 * static_cast<double>(value)));
  }
}

TEST_CASE("whole numbers end where their digits do") {
  const std::string text = "-12/3";
  Cursor c(text);
  std::int64_t value = 0;
  REQUIRE(read_integer(c, value));
  REQUIRE(value == -12);
  REQUIRE(*c.at == '/');
  Cursor huge(std::string_view("1234567890123456789"));
  REQUIRE_FALSE(read_integer(huge, value));
}

TEST_CASE("texts are cut only where a line begins") {
  std::string text;
  for (int i = 0; i < 500; ++i) text += std::string(static_cast<std::size_t>(i % 37), 'x') + '\n';
  for (const std::size_t size : std::initializer_list<std::size_t>{1, 16, 17, 100, 5000, 100000}) {
    std::string joined;
    for (const std::string_view chunk : cut_at_lines(text, size, [](const char*) { return true; })) {
      REQUIRE_FALSE(chunk.empty());
      REQUIRE(chunk.back() == '\n');
      joined += chunk;
    }
    REQUIRE(joined == text);
  }
  REQUIRE(cut_at_lines(text, 16, [](const char*) { return false; }).size() == 1);
  REQUIRE(cut_at_lines("", 16, [](const char*) { return true; }).empty());
}

TEST_CASE("of several failures the first in the file is told") {
  const std::string text(100, 'x');
  for (int turn = 0; turn < 20; ++turn) {
    try {
      for_each_chunk(100, [&](std::size_t i) {
        if (i >= 40) throw Failure{text.data() + i, "wrong"};
      });
      FAIL("nothing was thrown");
    } catch (const Failure& failure) {
      REQUIRE(failure.at == text.data() + 40);
    }
  }
}
