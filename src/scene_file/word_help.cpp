#include "scene_file/word_help.hpp"

namespace raytracer::scene_file {
namespace {

constexpr WordRow kStatements[] = {
    {"let", "let name = value", "Gives a value a name.",
     "Known from there to the end of the block. 'raytracer --set name=value' replaces one at the top of the "
     "scene.",
     "let size = 2\nsphere { radius (size / 4) }\n"},
    {"for", "for name from value to value [step value] { … }", "Repeats a part of the scene.",
     "Both ends are included; the step is 1 unless said.",
     "for i from 0 to 4 {\n  sphere { center (i - 2) 0 0  radius 0.4 }\n}\n"},
    {"if", "if value { … } [else { … }]", "Chooses a part of the scene.",
     "The value is a comparison or another truth; 'else if' goes on choosing.",
     "let detailed = true\nif detailed { torus { } } else { sphere { } }\n"},
    {"define", "define name (parameter value, …) { … }", "Makes a kind of block of one's own.",
     "Each parameter has a default. It is used like a built-in block, with transforms and a material.",
     "define pawn (height 1, shade red) {\n  cone { top 0 height 0  radius 0.4 }\n"
     "  sphere { center 0 height 0  radius 0.25  material { color shade } }\n}\n"
     "pawn { height 1.5  translate -1 0 0 }\npawn { shade gold  translate 1 0 0 }\n"},
    {"include", "include \"file\"", "Stands for the text of another file.",
     "The path is relative to the file that says it. Files outside of the scene's folder need --allow-path.",
     ""},
    {"raytracer", "raytracer 1", "The language's version, at the beginning of a file; may be left out.",
     "A scene keeps its look when the language grows.", "raytracer 1\nsphere { }\n"},
};

constexpr WordRow kConstants[] = {
    {"pi", "pi", "3.14159…", "", ""},
    {"t", "t", "The time in seconds.", "Any number of a scene may depend on it.",
     "sphere { center 0 (2 * t) 0 }\n"},
    {"frame", "frame", "The number of the frame, from 1.", "", ""},
};

}  // namespace

std::span<const WordRow> all_statements() { return kStatements; }
std::span<const WordRow> all_constants() { return kConstants; }

}  // namespace raytracer::scene_file
