#include "scene_file/quoted_names.hpp"

#include "catch.hpp"
#include "scene_file/diagnostics.hpp"
#include "scene_file/parser.hpp"

using namespace raytracer::scene_file;

TEST_CASE("a text's quoted names are known before it is evaluated", "[pictures]") {
  const Source source("scene", "", R"(
    let other = "let.png"
    material oak { color image "wood.png" { wrap mirror }  roughness image { file "rough \"1\".png" } }
    for i from 1 to 3 { sphere { material { color checker { a image "wood.png"  b image "a.jpg" } } } }
    if t > 1 { sky image { file "later.hdr" } }
    define tree (n 1) { mesh { file "tree.ply" } }
    sky image "studio.exr"
    sphere { center 1 0 0 })");
  Names names;
  Diagnostics diagnostics;
  const auto tree = parse(source, names, diagnostics);
  CHECK(quoted_names(*tree, names) ==
        std::vector<std::string>{"a.jpg", "rough \"1\".png", "studio.exr", "wood.png"});
}

TEST_CASE("all names that a text may ever mean are known", "[pictures]") {
  const Source source("scene", "", R"(
    let chosen = t > 1 ? "a.png" : "b.png"
    if t > 1 { include "part.txt" } else if t > 2 { sky image "c.exr" } else { include "other.txt" }
    define d (file "d.png") {
      sphere { material { color image { file (max(t, 1) > 1 ? "e.png" : "a.png") } } }
    }
    // "comment.png"
    for i from 0 to 2 { d { file "f.png" } })");
  Names names;
  Diagnostics diagnostics;
  const auto tree = parse(source, names, diagnostics);
  const NamesInText found = all_quoted_names(*tree, names);
  CHECK(found.all == std::vector<std::string>{"a.png", "b.png", "c.exr", "d.png", "e.png", "f.png",
                                              "other.txt", "part.txt"});
  CHECK(found.included == std::vector<std::string>{"other.txt", "part.txt"});
}
