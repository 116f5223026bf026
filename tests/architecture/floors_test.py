"""The walls of the house, read off the sources: who may include whom, and where each outside library lives.

docs/architecture.md explains the floors. A folder includes its own files, lower floors, and the public headers."""

import pathlib
import re
import tempfile
import unittest

ROOT = pathlib.Path(__file__).parents[2]

FLOORS = {
    "core": 0,
    "image": 1, "sampling": 1, "meshes": 1,
    "shapes": 2, "textures": 2, "materials": 2,
    "lights": 3, "cameras": 3,
    "scene": 4,
    "integrators": 5,
    "render": 6, "scene_file": 6,
    "cli": 7,
}

# The floor on which a public header's contents stand: the lowest folder that may include it.
PUBLIC_FLOORS = {
    "vector3f.hpp": 0, "error.hpp": 0,
    "image.hpp": 1,
    "shape.hpp": 2, "shapes.hpp": 2, "texture.hpp": 2, "material.hpp": 2,
    "light.hpp": 3, "camera.hpp": 3,
    "scene.hpp": 4,
    "method.hpp": 5,
    "render.hpp": 6, "scene_file.hpp": 6,
}
# Where neither of two neighbours knows the other, a public header of one is not the other's either; the one way
# through is the function from time to scene, which render.hpp declares and the builder implements.
FORBIDDEN_PUBLIC = {("render", "scene_file.hpp")}

# Each outside library, how its headers are recognised, and the only files that may include them.
LIBRARIES = {
    "Embree": (r"embree\d?/", {"src/scene/embree.hpp"}),
    "oneTBB": (r"(oneapi/)?tbb[/.]", {"src/core/parallel.cpp"}),
    "libpng": (r"png\.h|libpng", {"src/image/png.cpp", "src/image/read_png.cpp"}),
    "zlib": (r"z(lib|conf)\.h", {"src/image/zlib_pieces.cpp"}),
    "OpenEXR": (r"(OpenEXR/)?(Imf|Imath|Iex|half)", {"src/image/exr.cpp"}),
    "libjpeg": (r"j(peglib|error|config)\.h", {"src/image/jpeg.cpp"}),
    "CLI11": (r"CLI/", {"src/cli/options.cpp"}),
}
# May be included anywhere in src; GLM in the public headers as well.
EVERYWHERE = r"fmt/\w+\.h|glm/[\w/]+\.hpp"
SYSTEM = r"[a-z_0-9]+|(sys/)?[a-z_]+\.h|[a-z]mmintrin\.h"
# Our own headers over a library, and who may include them.
WRAPPERS = {"scene/embree.hpp": {"src/scene/accelerator.cpp", "src/scene/callbacks.hpp"},
            "scene/callbacks.hpp": {"src/scene/accelerator.cpp", "src/scene/callbacks.cpp"}}

INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]', re.MULTILINE)


def sources(root, *folders):
    return sorted(path for folder in folders for path in (root / folder).rglob("*") if path.suffix in (".hpp", ".cpp"))


def code_of(path):
    """The text without comments, strings and characters in quotation marks."""
    text = path.read_text(encoding="utf-8")
    text = re.sub(r'R"(\w*)\(.*?\)\1"', '""', text, flags=re.DOTALL)
    return re.sub(r'//[^\n]*|/\*.*?\*/|"(\\.|[^"\\\n])*"|\'(\\.|[^\'\\\n])+\'', " ", text, flags=re.DOTALL)


def wrong_includes(root):
    """One line for every include that crosses a wall."""
    found = []
    for path in sources(root, "src", "include"):
        name = path.relative_to(root).as_posix()
        folder = name.split("/")[1] if name.startswith("src/") else None
        for quote, included in INCLUDE.findall(path.read_text(encoding="utf-8")):
            reason = (wrong_own(root, name, folder, included) if quote == '"' else wrong_outside(name, folder, included))
            if reason:
                found.append(f"{name} includes {included}: {reason}")
    return found


def wrong_own(root, name, folder, included):
    target, _, rest = included.partition("/")
    if target == "raytracer":
        if not (root / "include" / included).exists():
            return "there is no such public header"
        if rest not in PUBLIC_FLOORS:
            return "the public header has no floor in this test"
        own_floor = PUBLIC_FLOORS[name.split("/")[-1]] if folder is None else FLOORS.get(folder, -1)
        if PUBLIC_FLOORS[rest] > own_floor or (folder, rest) in FORBIDDEN_PUBLIC:
            return "an upward arrow"
        return None
    if folder is None:
        return "a public header includes only public headers"
    if folder not in FLOORS or target not in FLOORS:
        return "a folder without a floor"
    if not (root / "src" / included).exists():
        return "there is no such file (paths are relative to src)"
    if name not in WRAPPERS.get(included, {name}):
        return "the library behind it has its own file"
    if target != folder and FLOORS[target] >= FLOORS[folder]:
        return "an upward arrow" if FLOORS[target] > FLOORS[folder] else "neighbours do not know each other"
    return None


def wrong_outside(name, folder, included):
    for library, (pattern, homes) in LIBRARIES.items():
        if re.match(pattern, included):
            return None if name in homes else f"{library} has its own file"
    if folder is None:
        return None if re.fullmatch(r"glm/[\w/]+\.hpp|[a-z_0-9]+", included) else "GLM alone stands in public headers"
    return None if re.fullmatch(f"{EVERYWHERE}|{SYSTEM}", included) else "an unknown library"


# What only the program itself may do: the library throws, prints nothing and exits nowhere.
ENDS_THE_PROCESS = re.compile(r"(?<![\w.>])(?:std::|::)?(_?_?exit|_Exit|quick_exit|abort|terminate)\s*\(")
PRINTS = re.compile(r"\b(?:std::)?(cout|cerr|clog|printf|puts|putchar|perror)\b|\bfmt::print\b|\bstd(?:out|err)\b")


def wrong_words(root):
    found = []
    for path in sources(root, "src", "include"):
        name = path.relative_to(root).as_posix()
        in_program = name.startswith("src/cli/")
        for number, line in enumerate(code_of(path).split("\n"), 1):
            ends = ENDS_THE_PROCESS.search(line)
            if ends and not (in_program and ends[1] == "_exit"):  # the one way out of a signal handler
                found.append(f"{name}:{number}: {ends[0]}")
            if PRINTS.search(line) and not in_program:
                found.append(f"{name}:{number}: {PRINTS.search(line)[0]}")
    return found


def longest_line_allowed(root):
    return int(re.search(r"^ColumnLimit: (\d+)$", (root / ".clang-format").read_text(), re.MULTILINE)[1])


def long_lines(root):
    """Lines beyond .clang-format's limit, but for those that hold a raw string, which it leaves alone."""
    limit, found = longest_line_allowed(root), []
    for path in sources(root, "src", "include", "tests", "bench"):
        for number, line in enumerate(path.read_text(encoding="utf-8").split("\n"), 1):
            if len(line) > limit and 'R"' not in line:
                found.append(f"{path.relative_to(root)}:{number}: {len(line)} characters")
    return found


class Floors(unittest.TestCase):
    def test_no_include_crosses_a_wall(self):
        self.assertEqual(wrong_includes(ROOT), [])

    def test_every_folder_has_a_floor(self):
        self.assertEqual({path.name for path in (ROOT / "src").iterdir()} - set(FLOORS), set())

    def test_no_source_lies_outside_of_the_folders(self):
        self.assertEqual([path.name for path in (ROOT / "src").iterdir() if not path.is_dir()], [])

    def test_every_public_header_has_a_floor(self):
        self.assertEqual({path.name for path in (ROOT / "include" / "raytracer").iterdir()}, set(PUBLIC_FLOORS))

    def test_every_library_is_where_this_test_says(self):
        for library, (pattern, homes) in LIBRARIES.items():
            for home in homes:
                included = [name for _, name in INCLUDE.findall((ROOT / home).read_text(encoding="utf-8"))]
                self.assertTrue(any(re.match(pattern, name) for name in included), f"{library} is not in {home}")

    def test_headers_begin_with_pragma_once(self):
        for path in sources(ROOT, "src", "include"):
            if path.suffix == ".hpp":
                self.assertEqual(len(re.findall(r"^#pragma once$", path.read_text(encoding="utf-8"), re.MULTILINE)), 1, path)

    def test_no_circles_within_a_folder(self):
        includes = {}
        for path in sources(ROOT, "src"):
            name = path.relative_to(ROOT / "src").as_posix()
            includes[name] = [target for quote, target in INCLUDE.findall(path.read_text(encoding="utf-8")) if quote == '"']
        def reaches(start, name, seen):
            for target in includes.get(name, []):
                if target == start or (target not in seen and reaches(start, target, seen | {target})):
                    return True
            return False
        self.assertEqual([name for name in includes if reaches(name, name, {name})], [])


class Words(unittest.TestCase):
    def test_the_library_prints_nothing_and_exits_nowhere(self):
        self.assertEqual(wrong_words(ROOT), [])

    def test_lines_fit(self):
        self.assertEqual(long_lines(ROOT), [])

    def test_sources_are_plain_text(self):
        for path in sources(ROOT, "src", "include", "tests", "bench"):
            data = path.read_bytes()
            self.assertTrue(data.endswith(b"\n") and not data.endswith(b"\n\n"), f"the end of {path}")
            self.assertNotIn(b"\t", data, path)
            self.assertNotIn(b"\r", data, path)
            self.assertNotRegex(data, rb"[ ]\n", path)


class House(unittest.TestCase):
    def test_what_a_newcomer_looks_for_is_there(self):
        for name in ("README.md", "CMakeLists.txt", "CMakePresets.json", "CHANGELOG.md", "LICENSE", "setup.sh", ".clang-format",
                     ".clang-tidy", ".ci/run", ".ci/full", "docs/architecture.md", "docs/scene-language.md",
                     "scenes/showcase.txt", "bench", "tests/consumer"):
            self.assertTrue((ROOT / name).exists(), name)

    def test_the_readme_shows_two_commands_and_a_picture_that_exists(self):
        text = (ROOT / "README.md").read_text(encoding="utf-8")
        self.assertIn("./setup.sh", text)
        self.assertIn("./setup.sh --tests", text)
        pictures = re.findall(r"!\[[^\]]*\]\(([^)]+)\)", text)
        self.assertGreater(len(pictures), 0)
        for picture in pictures:
            self.assertTrue((ROOT / picture).exists(), picture)

    def test_links_within_the_documents_lead_somewhere(self):
        for document in [ROOT / "README.md", *(ROOT / "docs").glob("*.md")]:
            for target in re.findall(r"\]\((?!https?:|#|mailto:)([^)#\s]+)", document.read_text(encoding="utf-8")):
                self.assertTrue((document.parent / target).exists(), f"{document.name}: {target}")


class ThisTestItself(unittest.TestCase):
    """It can fail: every kind of violation, planted in a little house of its own, is found."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = pathlib.Path(folder.name)
        for name in ("image.hpp", "scene.hpp", "scene_file.hpp", "vector3f.hpp", "error.hpp"):
            self.plant(f"include/raytracer/{name}", "#pragma once\n")
        for name in ("core/a.hpp", "shapes/a.hpp", "scene/embree.hpp", "render/a.hpp", "scene_file/a.hpp", "cli/a.hpp"):
            self.plant(f"src/{name}", "#pragma once\n")

    def plant(self, name, text):
        path = self.root / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)

    def test_a_sound_house_passes(self):
        self.plant("src/cli/main.cpp", '#include <vector>\n#include <fmt/format.h>\n#include "render/a.hpp"\n'
                                       '#include "scene_file/a.hpp"\n#include "cli/a.hpp"\nfmt::print(stderr, "");')
        self.plant("src/scene/accelerator.cpp", '#include "scene/embree.hpp"\n#include "shapes/a.hpp"\n// exit(1)\n')
        self.plant("src/image/png.cpp", '#include <png.h>\nauto s = "abort(1) cout"; on_exit(); x.terminate();\n')
        self.assertEqual(wrong_includes(self.root) + wrong_words(self.root), [])

    def test_every_forbidden_include_is_found(self):
        for name, line in (
                ("src/core/x.cpp", '#include "shapes/a.hpp"'), ("src/shapes/x.cpp", '#include "cli/a.hpp"'),
                ("src/render/x.cpp", '#include "scene_file/a.hpp"'), ("src/scene_file/x.cpp", '#include "render/a.hpp"'),
                ("src/render/x.cpp", '#include "raytracer/scene_file.hpp"'),
                ("src/core/x.cpp", '#include "raytracer/scene.hpp"'), ("src/core/x.cpp", '#include "raytracer/image.hpp"'),
                ("src/core/x.cpp", '#include "core/missing.hpp"'), ("src/core/x.cpp", '#include "raytracer/missing.hpp"'),
                ("src/cellar/x.cpp", '#include "core/a.hpp"'), ("include/raytracer/image.hpp", '#include "core/a.hpp"'),
                ("include/raytracer/vector3f.hpp", '#include "raytracer/scene.hpp"'),
                ("include/raytracer/image.hpp", "#include <fmt/format.h>"), ("include/raytracer/image.hpp", "#include <png.h>"),
                ("src/render/x.cpp", "# include <embree4/rtcore.h>"), ("src/scene/x.cpp", '#include "scene/embree.hpp"'),
                ("src/scene/accelerator.cpp", "#include <embree3/rtcore.h>"), ("src/render/x.cpp", "#include <tbb/tbb.h>"),
                ("src/render/x.cpp", "#include <oneapi/tbb/task.h>"), ("src/image/x.cpp", "#include <png.h>"),
                ("src/image/png.cpp", "#include <zlib.h>"), ("src/cli/main.cpp", "#include <CLI/App.hpp>"),
                ("src/core/x.cpp", "#include <boost/any.hpp>")):
            with self.subTest(file=name, line=line):
                path = self.root / name
                before = path.read_text() if path.exists() else None
                self.plant(name, line + "\n")
                self.assertEqual(len(wrong_includes(self.root)), 1, wrong_includes(self.root))
                self.plant(name, before or "\n")

    def test_every_forbidden_word_is_found(self):
        for line in ("exit(1);", "std::exit(1);", "::_exit(1);", "std::abort();", "std::terminate();", "printf(\"\");",
                     "std::printf(\"\");", "std::cout << 1;", "cerr << 1;", "fmt::print(\"\");", "std::fputs(s, stderr);",
                     "quick_exit(0);", "perror(0);"):
            self.plant("src/render/x.cpp", f"void f() {{ {line} }}\n")
            self.assertEqual(len(wrong_words(self.root)), 1, line)

    def test_a_long_line_is_found(self):
        self.plant(".clang-format", "ColumnLimit: 40\n")
        self.plant("src/core/x.cpp", "// " + "x" * 38 + "\n// " + "ü" * 37 + "\n")
        self.assertEqual(long_lines(self.root), ["src/core/x.cpp:1: 41 characters"])


if __name__ == "__main__":
    unittest.main()
