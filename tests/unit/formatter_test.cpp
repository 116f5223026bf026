// Canonical form: what it looks like, that it is a fixed point, and that it keeps every token and every
// comment.
#include "scene_file/formatter.hpp"

#include <filesystem>
#include <fstream>
#include <random>
#include <sstream>

#include "catch.hpp"
#include "scene_file/parser.hpp"

using namespace raytracer;
using namespace raytracer::scene_file;

namespace {

std::string formatted(const std::string& text) {
  const FormattedText result = format_text(text, "scene");
  for (const Diagnostic& d : result.diagnostics) UNSCOPED_INFO(to_text(d));
  REQUIRE(result.diagnostics.empty());
  return result.text;
}

// The tokens, and apart from them the comments, as they stand in the text.
struct Content {
  std::vector<std::string> tokens, comments;
  bool operator==(const Content&) const = default;
};

std::string without_carriage_returns(std::string_view text) {
  std::string out;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '\r' && text.substr(i + 1, 1) == "\n") continue;
    out += text[i] == '\r' ? '\n' : text[i];
  }
  return out;
}

struct Parsed {
  explicit Parsed(const std::string& text)
      : source("scene", "", text), tree(parse(source, names, diagnostics, &tokens)) {}

  Content content() const {
    Content content;
    for (const ReadToken& read : tokens) content.tokens.emplace_back(source.text(read.token.span));
    for (const Span& span : tree->comments) {
      std::string comment = without_carriage_returns(source.text(span));
      if (comment.starts_with("//")) comment.erase(comment.find_last_not_of(" \t\v\f") + 1);
      content.comments.push_back(comment);
    }
    return content;
  }

  Source source;
  Names names;
  Diagnostics diagnostics;
  std::vector<ReadToken> tokens;
  std::unique_ptr<SyntaxTree> tree;
};

void check_laws(const std::string& text) {
  INFO(text);
  const std::string once = formatted(text);
  REQUIRE(formatted(once) == once);
  REQUIRE(Parsed(once).content() == Parsed(text).content());
}

// The same tokens and comments with other space, line ends and further comments between them.
std::string respaced(const std::string& text, std::mt19937& random) {
  const Parsed parsed(text);
  std::vector<Span> pieces = parsed.tree->comments;
  for (const ReadToken& read : parsed.tokens) pieces.push_back(read.token.span);
  std::ranges::sort(pieces, {}, &Span::begin);
  constexpr const char* kSpaces[] = {" ",
                                     "  ",
                                     "\t",
                                     "\n",
                                     "\n\n\n\n",
                                     "\r\n",
                                     " /* new */ ",
                                     " // new\n",
                                     "\n// new \n\n",
                                     " /* of /* two */\n lines */",
                                     "   \n  "};
  std::string out;
  std::uint32_t end = 0;
  for (const Span& piece : pieces) {
    const std::string gap(text.substr(end, piece.begin - end));
    const bool needs_line =
        out.rfind("//") != std::string::npos && out.find('\n', out.rfind("//")) == std::string::npos;
    const bool changes = random() % 3 == 0;
    out += !changes ? gap : needs_line ? "\n" : kSpaces[random() % std::size(kSpaces)];
    out += text.substr(piece.begin, piece.end - piece.begin);
    end = piece.end;
  }
  return out;
}

std::string read(const std::filesystem::path& path) {
  std::ostringstream text;
  text << std::ifstream(path, std::ios::binary).rdbuf();
  return text.str();
}

std::vector<std::string> all_scenes() {
  std::vector<std::string> texts;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(SCENES)) {
    if (entry.path().extension() == ".txt") texts.push_back(read(entry.path()));
  }
  return texts;
}

constexpr const char* kEverything = R"(raytracer 1 // version
let   n=12   // n
let ring = (-3.5+ -2)^2 *sin( 45 ) -  - 1
light spot  lamp{position 1 2 3} sphere { } cube{radius 1 /* c */ center 0 0 0}
/* lead
     multi */ sphere ball {   // tail
   center   n   ring   n   radius 2


   // own
   material { color tomato }   // red
}
define snowman (size 1,
   hat black, at (1,2,3)
  ) { sphere { center at
 radius size } }
snowman { at n n n size 2 } snowman { at n n n translate 1 1 1
   at n n n scale 2 }
if n>2 and(n<3){ sphere{ } } else if not(n==3){ sphere{ } }
else /* why */ { // k
cube { } }
for i from -1 to n-1 step (n/2) { include "a \"b\" c.txt" }
sphere { matrix 1 0 0 0
   0 1 0 0 // row
   0 0 1 0 rotate_axis 0 1 0
    45 }
other { at x y size 2 hat red }
let v = (n>1 ? 1:2).x
sphere // head
{
})";

}  // namespace

TEST_CASE("canonical form by examples") {
  const auto [written, wanted] = GENERATE(table<std::string, std::string>({
      {"", ""},
      {"\n\n// alone  \n\n", "// alone\n"},
      {"raytracer 1 sphere{}", "raytracer 1\nsphere { }\n"},
      {"sphere   ball{center 0 1 0 radius   1}", "sphere ball { center 0 1 0  radius 1 }\n"},
      {"sphere {\ncenter 0 1 0 radius 1}", "sphere {\n  center 0 1 0\n  radius 1\n}\n"},
      {"sphere { center 0 1 0\n}", "sphere {\n  center 0 1 0\n}\n"},
      {"sphere\n{\n\n}", "sphere { }\n"},
      {"group { sphere { } cube { } }", "group { sphere { }  cube { } }\n"},
      {"group {\n\n sphere { }\n\n\n\n cube { }\n\n}", "group {\n  sphere { }\n\n  cube { }\n}\n"},
      {"sphere { } cube { }", "sphere { }\ncube { }\n"},
      {"let a=1+-2*sin( 30 )^2", "let a = 1 + -2 * sin(30) ^ 2\n"},
      {"let a = - ( 1,2 ,3 ) .x", "let a = -(1, 2, 3).x\n"},
      {"let a = not(b)?c:d", "let a = not (b) ? c : d\n"},
      {"let a=(1<2 and 3>=4)", "let a = (1 < 2 and 3 >= 4)\n"},
      {"sphere { radius( 1 )center -1 +2 .5 }", "sphere { radius (1)  center -1 +2 .5 }\n"},
      {"sphere { center x y z radius r }", "sphere { center x y z  radius r }\n"},
      {"group { translate x y z material { } }", "group { translate x y z  material { } }\n"},
      {"define d(a 1,b(2*3)){sphere{radius a}}", "define d (a 1, b (2 * 3)) { sphere { radius a } }\n"},
      {"define d (at (0,0,0), s 1) { }\nd { at x y z s 2 }",
       "define d (at (0, 0, 0), s 1) { }\nd { at x y z  s 2 }\n"},
      {"for i from 0 to n-1{sphere{}}", "for i from 0 to n - 1 { sphere { } }\n"},
      {"if a{sphere{}}\nelse if b{}else{cube{}}",
       "if a {\n  sphere { }\n} else if b { } else {\n  cube { }\n}\n"},
      {"sphere { // c\n radius 1 }//d", "sphere {  // c\n  radius 1\n}  //d\n"},
      {"sphere { /* a */ radius 1 }", "sphere { /* a */ radius 1 }\n"},
      {"/* a */ /* b */ sphere { }", "/* a */ /* b */ sphere { }\n"},
      {"sphere { }\n// below\n  // and below\ncube { }", "sphere { }\n// below\n// and below\ncube { }\n"},
      {"\xEF\xBB\xBFsphere { }\r\n\r\n\r\n/* a\r\n b */\rcube { }\r",
       "sphere { }\n\n/* a\n b */\ncube { }\n"},
      {"sphere { matrix 1 0 0 0\n0 1 0 0\n0 0 1 0 }",
       "sphere {\n  matrix 1 0 0 0\n      0 1 0 0\n      0 0 1 0\n}\n"},
      {"let a = max(\n1,\n2\n)", "let a = max(\n    1,\n    2\n)\n"},
      {"include\n  \"a  b.txt\"", "include \"a  b.txt\"\n"},
  }));
  REQUIRE(formatted(written) == wanted);
  check_laws(written);
}

TEST_CASE("a block has 100 columns for one line, of which its indentation takes some") {
  // Characters count, not bytes.
  const std::string name(100 - std::string("sphere  { /* ü */ }").size() + 1, 'n');
  const std::string fits = "sphere " + name + " { /* ü */ }\n",
                    too_wide = "sphere n" + name + " { /* ü */ }\n";
  REQUIRE(formatted(fits) == fits);
  REQUIRE(formatted(too_wide) == "sphere n" + name + " {  /* ü */\n}\n");
  REQUIRE(formatted("group {\n" + fits + "}") == "group {\n  sphere " + name + " {  /* ü */\n  }\n}\n");
}

TEST_CASE("a text with a slip is not formatted") {
  const FormattedText result = format_text("sphere {\n  radius (1 + \n}\n", "bad.txt");
  REQUIRE(result.text.empty());
  REQUIRE(result.diagnostics.size() == 1);
  REQUIRE(result.diagnostics[0].file == "bad.txt");
  REQUIRE(result.diagnostics[0].line == 2);
}

TEST_CASE("formatting keeps the tokens and comments of every scene") {
  const std::vector<std::string> scenes = all_scenes();
  REQUIRE(scenes.size() > 10);
  for (const std::string& text : scenes) check_laws(text);
}

TEST_CASE("formatting is a fixed point whatever stands between the tokens") {
  std::mt19937 random(3);  // the same on every machine
  std::vector<std::string> texts = all_scenes();
  for (int i = 0; i < 200; ++i) texts.emplace_back(kEverything);
  for (const std::string& text : texts) check_laws(respaced(text, random));
}
