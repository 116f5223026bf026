#include "scene_file/lexer.hpp"

#include <clocale>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "catch.hpp"

using namespace raytracer;
using namespace raytracer::scene_file;

namespace {

struct Lexed {
  std::vector<TokenType> types;  // without the end
  std::vector<std::string> texts;
  std::vector<double> numbers;
  std::vector<std::string> comments;
  std::vector<Diagnostic> messages;
};

Lexed lex(const std::string& text, LexMode mode = LexMode::kValues) {
  const Source source("test", "", text);
  Diagnostics diagnostics;
  Lexer lexer(source, diagnostics);
  Lexed result;
  for (Token token = lexer.next(mode); token.type != TokenType::kEnd; token = lexer.next(mode)) {
    result.types.push_back(token.type);
    result.texts.emplace_back(source.text(token.span));
    result.numbers.push_back(token.number);
    REQUIRE(token.span.begin < token.span.end);
  }
  REQUIRE(lexer.next(mode).type == TokenType::kEnd);  // and again
  for (const Span& comment : lexer.comments()) result.comments.emplace_back(source.text(comment));
  result.messages = diagnostics.take();
  return result;
}

/// The one number that the text is.
double number(const std::string& text) {
  const Lexed lexed = lex(text);
  INFO("'" << text << "'");
  REQUIRE(lexed.messages.empty());
  REQUIRE(lexed.types == std::vector<TokenType>{TokenType::kNumber});
  REQUIRE(lexed.texts.front() == text);
  return lexed.numbers.front();
}

using Texts = std::vector<std::string>;

}  // namespace

TEST_CASE("numbers are read as they are written", "[lexer]") {
  REQUIRE(number("1") == 1);
  REQUIRE(number("-1") == -1);
  REQUIRE(number("+1") == 1);
  REQUIRE(number(".5") == 0.5);
  REQUIRE(number("-.5") == -0.5);
  REQUIRE(number("1.") == 1);
  REQUIRE(number("1.5e-3") == 1.5e-3);
  REQUIRE(number("1E+3") == 1000);
  REQUIRE(number("1.e2") == 100);
  REQUIRE(number("007") == 7);
  REQUIRE(number("0.1") == 0.1);
  REQUIRE(number("123456789.987654321") == 123456789.987654321);
  REQUIRE(number("1.7976931348623157e308") == std::numeric_limits<double>::max());
  REQUIRE((number("-0") == 0 && std::signbit(number("-0"))));
  REQUIRE(number("1e-400") == 0);
  REQUIRE(number("0." + std::string(400, '0') + "1") == 0);
}

TEST_CASE("numbers are read the same in every locale", "[lexer]") {
  const std::string before = std::setlocale(LC_ALL, nullptr);
  for (const char* locale : {"de_DE.UTF-8", "fr_FR.UTF-8", "C"}) {
    if (std::setlocale(LC_ALL, locale) == nullptr) continue;  // not installed here
    const double value = number("1.5");
    std::setlocale(LC_ALL, before.c_str());
    REQUIRE(value == 1.5);
  }
}

TEST_CASE("what only begins like a number is one mistake", "[lexer]") {
  for (const std::string text : {"0x10", "1.2.3", "12abc", "1e", "1e5x", "1_000", "1..2", "5e+"}) {
    const Lexed lexed = lex(text);
    INFO("'" << text << "'");
    REQUIRE(lexed.messages.size() == 1);
    REQUIRE(lexed.messages[0].column == 1);
    REQUIRE(lexed.types.front() == TokenType::kBad);
  }
  const Lexed large = lex("1e999");
  REQUIRE(large.messages.size() == 1);
  REQUIRE(large.types == std::vector<TokenType>{TokenType::kBad});
}

TEST_CASE("a sign belongs to the number in a list and is an operator in an expression", "[lexer]") {
  REQUIRE(lex("0 -1 +2").texts == Texts{"0", "-1", "+2"});
  REQUIRE(lex("0 -1 +2", LexMode::kExpression).texts == Texts{"0", "-", "1", "+", "2"});
  REQUIRE(lex("a<=b!=-1", LexMode::kExpression).texts == Texts{"a", "<=", "b", "!=", "-", "1"});
}

TEST_CASE("words, braces, strings and colours are told apart without blanks", "[lexer]") {
  const Lexed lexed = lex("sphere{color#fff}file\"a b\"(x)_a1");
  REQUIRE(lexed.messages.empty());
  REQUIRE(lexed.texts == Texts{"sphere", "{", "color", "#fff", "}", "file", "\"a b\"", "(", "x", ")", "_a1"});
  using T = TokenType;
  REQUIRE(lexed.types == std::vector<T>{T::kWord, T::kOpenBrace, T::kWord, T::kColor, T::kCloseBrace,
                                        T::kWord, T::kString, T::kOpenParenthesis, T::kWord,
                                        T::kCloseParenthesis, T::kWord});
}

TEST_CASE("comments end with their line, or nest, and are kept", "[lexer]") {
  const Lexed lexed = lex("a // b /* c\nd /* e /* f */ g // */ h /**/ i//");
  REQUIRE(lexed.messages.empty());
  REQUIRE(lexed.texts == Texts{"a", "d", "h", "i"});
  REQUIRE(lexed.comments == Texts{"// b /* c", "/* e /* f */ g // */", "/**/", "//"});
  REQUIRE(lex("a // b\rc // d\r\ne").texts == Texts{"a", "c", "e"});
  REQUIRE(lex("\"// no comment /*\" x").texts == Texts{"\"// no comment /*\"", "x"});
}

TEST_CASE("a comment or string left open is reported where it opened", "[lexer]") {
  const Lexed comment = lex("a\n  /* b /* c */ d\n e");
  REQUIRE(comment.messages.size() == 1);
  REQUIRE(comment.messages[0].line == 2);
  REQUIRE(comment.messages[0].column == 3);
  REQUIRE(comment.texts == Texts{"a"});
  for (const std::string end : {"\n", "\r\n", "\r", ""}) {
    const Lexed string = lex("a \"b" + end);
    REQUIRE(string.messages.size() == 1);
    REQUIRE(string.messages[0].line == 1);
    REQUIRE(string.messages[0].column == 3);
  }
}

TEST_CASE("strings know two escapes", "[lexer]") {
  const Lexed lexed = lex(R"("a\"b\\c\n" d)");
  REQUIRE(lexed.messages.empty());
  REQUIRE(lexed.texts == Texts{R"("a\"b\\c\n")", "d"});
  REQUIRE(unquote(lexed.texts[0]) == R"(a"b\c\n)");
  REQUIRE(unquote("\"\"").empty());
  REQUIRE(lex(R"("a\\" b)").texts == Texts{R"("a\\")", "b"});
}

TEST_CASE("colours have three or six hexadecimal digits", "[lexer]") {
  REQUIRE(lex("#abc #012DEF").messages.empty());
  REQUIRE(lex("#abc #012DEF").types == std::vector<TokenType>(2, TokenType::kColor));
  for (const std::string text : {"#", "#a", "#ab", "#abcd", "#abcde", "#abcdefa", "#xyz", "#12345g"}) {
    INFO(text);
    REQUIRE(lex(text).messages.size() == 1);
  }
}

TEST_CASE("blanks of every kind and a byte-order mark only separate", "[lexer]") {
  const Lexed lexed =
      lex("\xEF\xBB\xBF"
          "a\tb\vc\fd\r\ne  f\n");
  REQUIRE(lexed.messages.empty());
  REQUIRE(lexed.texts == Texts{"a", "b", "c", "d", "e", "f"});
  REQUIRE(lex("").texts.empty());
  REQUIRE(lex("\xEF\xBB\xBF").texts.empty());
}

TEST_CASE("a text cut at any byte ends, and tells one mistake for what is left open", "[lexer]") {
  const std::string text =
      "a \"s\\\"\" /* c /* d */ */ #ff8800 -1.5e-3 { } ( ) // e\n ä \xF0\x9F\x8E\x88 <= != \x01 \x7F";
  for (std::size_t length = 0; length <= text.size(); ++length) {
    for (const LexMode mode : {LexMode::kValues, LexMode::kExpression}) {
      const Lexed lexed = lex(text.substr(0, length), mode);
      INFO("the first " << length << " bytes");
      REQUIRE(lexed.types.size() <= length);
      if (length <= 52) REQUIRE(lexed.messages.size() <= 1);  // up to where the nonsense begins
    }
  }
}

TEST_CASE("every single byte is a token, a blank or a mistake", "[lexer]") {
  for (int byte = 0; byte < 256; ++byte) {
    const std::string text = {'a', ' ', static_cast<char>(byte), ' ', 'b'};
    const Lexed lexed = lex(text);
    INFO("byte " << byte);
    REQUIRE(lexed.texts.front() == "a");
    REQUIRE(lexed.messages.size() <= 1);
    if (lexed.messages.empty() && byte != '"' && byte != '/') REQUIRE(lexed.texts.back() == "b");
  }
}

TEST_CASE("looking ahead changes nothing and says nothing", "[lexer]") {
  const Source source("test", "", "a /* c */ 0x1 b");
  Diagnostics diagnostics;
  Lexer lexer(source, diagnostics);
  Lexer ahead = lexer.quiet_copy();
  while (ahead.next(LexMode::kValues).type != TokenType::kEnd) continue;
  REQUIRE_FALSE(diagnostics.has_errors());
  REQUIRE(lexer.comments().empty());
  REQUIRE(source.text(lexer.next(LexMode::kValues).span) == "a");
  REQUIRE(lexer.next(LexMode::kValues).type == TokenType::kBad);
  REQUIRE(diagnostics.has_errors());
  REQUIRE(source.text(lexer.next(LexMode::kValues).span) == "b");
  REQUIRE(lexer.comments().size() == 1);
}
