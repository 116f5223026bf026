#include "scene_file/picture_names.hpp"

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
