"""Scenes as JSON: what `raytracer json` writes renders to the same bytes as the text it came from."""

import json
import pathlib
import re
import shutil
import tempfile
import unittest

from program import ROOT, run

SMALL = ("--size", "40x24", "--samples", "1", "-q", "-o", "-")

SCENES = {
    "definitions": """
        define snowman (size 1, hat black) {
          sphere ball { center 0 (0.5*size) 0  radius (0.5*size) }
          cylinder { base 0 size 0  top 0 (1.4*size) 0  radius (0.2*size)  material { color hat } }
        }
        for i from 0 to 6 { snowman { size (1 + (i % 2))  translate (i - 3) 0 0  material { color (i / 6) 0.5 0.2 } } }
        snowman { hat (hsv(10, 0.7, 0.33))  translate 0 2 0 }""",
    "fractal": """
        define flake (depth 0) {
          sphere { radius 0.5 }
          if depth > 0 {
            for i from 0 to 3 { group { rotate 0 (90 * i) 0  flake { depth (depth - 1)  translate 0.8 0 0  scale 0.5 } } }
          }
        }
        flake { depth 3 }""",
    "local names": """
        for i from 0 to 2 {
          material m { color (i / 2) 0.3 0.3 }
          define d (r 0.3) { material n { color 0.2 (i / 2) 0.4 }  sphere s { radius r  material n } }
          sphere s { center (2 * i) 0 0  radius 0.4  material m }
          group { translate (2 * i) 1 0  d { }  d { r 0.2  translate 0 0.5 0 }  d { translate 0 -2 0 } }
        }""",
    "shared": """
        define wall () { for i from 0 to 30 { cube { center (0.2 * (i % 6)) (0.2 * floor(i / 6)) 0  size 0.15 } } }
        material a { color tomato }
        for k from 0 to 5 { wall { translate (k - 3) (-1 + 0.1 * k) 0  rotate 0 (20 * k) 0  material a } }
        wall { rotate_axis 1 2 3 20  pivot 1 2 3  scale 1 0.5 2 }
        wall { matrix 1 0 0 0  0 1 0.1 0.5  0 0 1 0.3 }""",
    "everything": """
        image { size 80 40 }
        camera front { position 0 1 6  look_at 0 0.5 0  vertical_fov 30 }
        camera { position 6 1 0  look_at 0 0.5 0 }
        render { samples 2  bounces 3  seed 7  ambient 0.1 }
        background { color (kelvin(3000)) }
        light spot lamp { position 2 5 3  look_at 0 0 0  angle 50  soft_edge 0.3  falloff none  intensity 200 }
        light lantern { position -3 5 3  color (hsv(40, 0.4, 1)) }
        light directional { direction 1 -1 -1  intensity 40  color #abc }
        cylinder { open true  radius 0.2  material { color #123456  shininess 0.3 } }
        torus { center 1e-7 0.1 -0  tube_radius (1/3)  material { color (0.1 + 0.2) 0.5 0.7 } }
        group { material { color teal }  translate 1 0 0  sphere { radius 0.3 }  cube { center 0 0.6 0  size 0.2 0.3 0.4 } }""",
}


class FromText(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def check_same(self, scene, time="0", options=()):
        """In JSON the scene makes the same picture. It is written beside the scene: it names the same files."""
        written = scene.with_suffix(".json")
        done = run("json", scene, "--time-at", time, "-o", written, *options)
        self.assertEqual(done.returncode, 0, done.stderr)
        parsed = json.loads(written.read_text())
        self.assertEqual(parsed["raytracer"], 1)
        before = run(scene, "--time-at", time, *options, *SMALL)
        after = run(written, *SMALL)
        self.assertEqual(before.returncode, 0)
        self.assertEqual(after.returncode, 0, after.stderr)
        self.assertEqual(after.stdout, before.stdout)
        # Once evaluated, a scene is what it says.
        self.assertEqual(run("json", written).stdout, written.read_bytes())
        return parsed["blocks"]

    def check_text(self, text, **more):
        scene = self.folder / "scene.txt"
        scene.write_text(text)
        return self.check_same(scene, **more)

    def test_all_example_scenes(self):
        scenes = sorted(shutil.copytree(ROOT / "scenes", self.folder / "scenes").rglob("*.txt"))
        self.assertGreater(len(scenes), 10)
        for scene in scenes:
            if "shutter" in scene.read_text() or run("check", scene).returncode != 0:
                continue
            with self.subTest(scene=str(scene)):
                self.check_same(scene)

    def test_scenes_written_for_this(self):
        for name, text in SCENES.items():
            with self.subTest(name=name):
                self.check_text(text)

    def test_a_moment(self):
        text = "animation { duration 4  fps 10 }\nif t > 1 { sphere { center t 0 0 } } else { cube { } }\nsphere { center 0 (frame / 10) 0 }"
        blocks = self.check_text(text, time="1.5")
        self.assertEqual([b["kind"] for b in blocks], ["sphere", "sphere"])
        self.assertEqual(blocks[0]["center"], [1.5, 0, 0])
        self.assertEqual(blocks[1]["center"], [0, 1.6, 0])

    def test_definitions_and_uses_are_kept(self):
        blocks = self.check_text(SCENES["definitions"])
        defined = [b["name"] for b in blocks if b["kind"] == "define"]
        self.assertEqual(defined, ["snowman", "snowman_2", "snowman_3"])
        uses = [b for b in blocks if b["kind"] != "define"]
        self.assertEqual([u["kind"] for u in uses],
                         ["snowman", "snowman_2"] * 3 + ["snowman", "snowman_3"])
        self.assertEqual(uses[1], {"kind": "snowman_2", "material": {"color": [1 / 6, 0.5, 0.2]},
                                   "transforms": [{"translate": [-2, 0, 0]}]})
        fractal = self.check_text(SCENES["fractal"])
        self.assertEqual([b["name"] for b in fractal if b["kind"] == "define"],
                         ["flake_4", "flake_3", "flake_2", "flake"])

    def test_display_colors_are_marked(self):
        blocks = self.check_text("sphere { material { color #ff8000 } }  sphere { material { color tomato } }"
                                 " sphere { material { color (hsv(30, 0.5, 0.7)) } }"
                                 " sphere { material { color 1 0.5 0 } }  sphere { material { color 0.3 } }")
        colors = [b["material"]["color"] for b in blocks]
        self.assertEqual(colors[:2] + colors[3:], ["#ff8000", "#ff6347", [1, 0.5, 0], [0.3, 0.3, 0.3]])
        self.assertEqual(list(colors[2]), ["display"])
        self.assertAlmostEqual(colors[2]["display"][0], 0.7)

    def test_settings_and_included_files_are_flattened(self):
        (self.folder / "part").mkdir()
        (self.folder / "part" / "ball.txt").write_text("sphere { radius size }")
        blocks = self.check_text('let size = 1\ninclude "part/ball.txt"', options=("--set", "size=0.25"))
        self.assertEqual(blocks, [{"kind": "sphere", "radius": 0.25}])

    def test_shapes_share_a_material_of_the_library(self):
        """Two shapes of one material are one volume, of two materials they are not; the scene has its own names besides."""
        text = """
            image { size 40 24 }  render { method path  samples 4 }  camera { position 0 0 6 }  background { color 1 }
            sphere { center -0.4 0 0  material water }
            sphere { center 0.4 0 0  material water }
            define d { material water { color 0.1 0.7 0.2 }  sphere { center 0 1.5 0  radius 0.5  material water } }
            d { }"""
        blocks = self.check_text(text)
        materials = [block for block in blocks if block["kind"] == "material"]
        self.assertEqual([(each["name"], each["ior"]) for each in materials], [("water", 1.333)])
        self.assertEqual([block["material"] for block in blocks if block["kind"] == "sphere"], ["water", "water"])

    def test_names_of_files_are_relative_to_the_file_that_names_them(self):
        for folder in ("sub/part", "other"):
            (self.folder / folder).mkdir(parents=True)
        for name in ("a.png", "b.png"):
            shutil.copy(ROOT / "tests/render/expected/first.png", self.folder / "sub" / "part" / name)
        scene = self.folder / "sub" / "scene.txt"
        scene.write_text('sphere { material { color image "part/a.png" } }\ninclude "part/b.txt"\n')
        (self.folder / "sub" / "part" / "b.txt").write_text('sky image "b.png"\n')

        def names(place, *arguments):
            done = run("json", "sub/scene.txt", *arguments, cwd=self.folder)
            self.assertEqual(done.returncode, 0, done.stderr)
            text = (self.folder / place).read_text() if place else done.stdout.decode()
            return sorted(re.findall(r'"file": "(.*?)"', text))
        self.assertEqual(names(None), ["part/a.png", "part/b.png"])
        self.assertEqual(names("sub/s.json", "-o", "sub/s.json"), ["part/a.png", "part/b.png"])
        self.assertEqual(names("s.json", "-o", "s.json"), ["sub/part/a.png", "sub/part/b.png"])
        self.assertEqual(names("other/s.json", "-o", "other/s.json"), ["../sub/part/a.png", "../sub/part/b.png"])
        picture = run(scene, *SMALL).stdout
        for place, options in (("sub/s.json", []), ("s.json", []), ("other/s.json", ["--allow-path", self.folder])):
            self.assertEqual(run(self.folder / place, *options, *SMALL).stdout, picture, place)

    def test_an_open_shutter_is_refused(self):
        scene = self.folder / "scene.txt"
        scene.write_text("camera { shutter 0.5 }\nsphere { center t 0 0 }\n")
        done = run("json", scene)
        self.assertEqual((done.returncode, done.stdout), (1, b""))
        self.assertIn(b"scene.txt:1:1", done.stderr)

    def test_nothing_is_overwritten(self):
        scene = self.folder / "scene.txt"
        scene.write_text("sphere { }")
        self.assertEqual(run("json", scene, "-o", scene).returncode, 3)
        self.assertEqual(scene.read_text(), "sphere { }")


def scene_of(block):
    return '{"raytracer": 1, "blocks": [\n' + block + "\n]}"


class Mistakes(unittest.TestCase):
    """What is wrong with a JSON scene, where it is said to be, and words of the message."""

    CASES = [
        ("", 1, 1, "a value is missing"),
        ('{"blocks": [}', 1, 13, "a value is missing"),
        ('{"blocks": [],}', 1, 15, "a name in quotes is missing"),
        ('{"blocks" []}', 1, 11, "':' is missing"),
        ('{"blocks": [] "raytracer": 1}', 1, 15, "',' or '}' is missing"),
        ('{"blocks": [1 2]}', 1, 15, "',' or ']' is missing"),
        ('{"blocks": [\n', 1, 12, "this '[' is never closed"),
        ('{"blocks": []', 1, 1, "this '{' is never closed"),
        ('{"blocks": []} x', 1, 16, "behind the scene"),
        ('{"blocks": [], "blocks": []}', 1, 16, "given twice"),
        ('{"blocks": [], "blo\\u0063ks": []}', 1, 16, "given twice"),
        ('{"blocks": [tru]}', 1, 13, "'tru' stands where a value is missing"),
        ('{"blocks": [01]}', 1, 13, "'01' is not a number"),
        ('{"blocks": [1.]}', 1, 13, "'1.' is not a number"),
        ('{"blocks": [-]}', 1, 13, "'-' is not a number"),
        ('{"blocks": [1e999]}', 1, 13, "too large"),
        ('{"blocks": [+1]}', 1, 13, "'+' stands where"),
        ('{"blocks": ["a\\q"]}', 1, 15, "no escape"),
        ('{"blocks": ["\\u12g4"]}', 1, 14, "no escape"),
        ('{"blocks": ["\\ud800"]}', 1, 14, "half a character"),
        ('{"blocks": ["ä\t"]}', 1, 15, "control character"),
        ('{"blocks": ["ab\n"]}', 1, 13, "not closed on its line"),
        ('{"blocks": [' + "[" * 600, 1, 527, "nested more than"),
        ("{}", 1, 1, 'a scene needs "blocks"'),
        ('{"raytracer": 2, "blocks": []}', 1, 15, "no version"),
        ('{"block": []}', 1, 3, "a scene has no 'block'"),
        ('{"blocks": {}}', 1, 12, "a list of blocks is missing"),
        (scene_of("3"), 2, 1, "a block is missing"),
        (scene_of("{}"), 2, 1, 'a block needs a "kind"'),
        (scene_of('{"kind": 3}'), 2, 10, "a name in quotes is missing"),
        (scene_of('{"kind": "sphere ball"}'), 2, 10, "is no name"),
        (scene_of('{"kind": "sphear"}'), 2, 11, "no kind of block 'sphear'"),
        (scene_of('{"kind": "for"}'), 2, 10, "JSON has no 'for'"),
        (scene_of('{"kind": "sphere", "variant": "big"}'), 2, 32, "there is no sphere 'big'"),
        (scene_of('{"kind": "light", "variant": "spto"}'), 2, 31, "there is no light 'spto'"),
        (scene_of('{"kind": "light", "name": "spot"}'), 2, 28, "is a variant"),
        (scene_of('{"kind": "sphere", "raduis": 1}'), 2, 21, "no property 'raduis'"),
        (scene_of('{"kind": "sphere", "a b": 1}'), 2, 20, "is no name of a property"),
        (scene_of('{"kind": "sphere", "radius": "1"}'), 2, 30, "takes a number"),
        (scene_of('{"kind": "sphere", "radius": "pi"}'), 2, 30, "takes a number"),
        (scene_of('{"kind": "sphere", "radius": null}'), 2, 30, "null is no value"),
        (scene_of('{"kind": "sphere", "radius": -1}'), 2, 30, "must be greater than 0"),
        (scene_of('{"kind": "sphere", "center": [0, 1]}'), 2, 31, "takes three numbers, found 2"),
        (scene_of('{"kind": "sphere", "center": []}'), 2, 21, "needs three numbers"),
        (scene_of('{"kind": "sphere", "center": [0, 1, [2]]}'), 2, 37, "a list is no value"),
        (scene_of('{"kind": "sphere", "material": "chrom"}'), 2, 33, "no material 'chrom'"),
        (scene_of('{"kind": "sphere", "material": {"colour": "red"}}'), 2, 34, "no property 'colour'"),
        (scene_of('{"kind": "sphere", "material": {"color": "#12"}}'), 2, 42, "is not a colour"),
        (scene_of('{"kind": "sphere", "material": {"color": "rde"}}'), 2, 42, "no colour"),
        (scene_of('{"kind": "sphere", "material": {"color": "t"}}'), 2, 42, "no colour"),
        (scene_of('{"kind": "sphere", "material": {"color": {"display": [1, 2]}}}'), 2, 54, "three numbers"),
        (scene_of('{"kind": "sphere", "transforms": {}}'), 2, 34, "a list of transforms is missing"),
        (scene_of('{"kind": "sphere", "transforms": [{"rotat": [0, 1, 0]}]}'), 2, 37, "no transform 'rotat'"),
        (scene_of('{"kind": "sphere", "transforms": [{"scale": 1, "rotate": [0, 1, 0]}]}'), 2, 35, "one word"),
        (scene_of('{"kind": "sphere", "transforms": [{"scale": 0}]}'), 2, 37, "must not be 0"),
        (scene_of('{"kind": "sphere", "children": [{"kind": "cube"}]}'), 2, 43, "can't hold a cube"),
        (scene_of('{"kind": "define"}'), 2, 11, 'needs a "name"'),
        (scene_of('{"kind": "define", "name": "sphere"}'), 2, 29, "built in"),
        (scene_of('{"kind": "define", "name": "a", "childs": []}'), 2, 34, "no 'childs'"),
        (scene_of('{"kind": "include"}'), 2, 11, "needs the name of a file"),
        (scene_of('{"kind": "include", "file": "n\\u00f6n\\"e.txt"}'), 2, 29, "there is no file 'nön\"e.txt'"),
        (scene_of('{"name": "a", "kind": "sphere"},\n{"kind": "sphere", "name": "a"}'), 3, 11, "a second sphere"),
    ]

    def test_places(self):
        for text, line, column, message in self.CASES:
            with self.subTest(text=text[:80]), tempfile.TemporaryDirectory() as folder:
                scene = pathlib.Path(folder) / "scene.json"
                scene.write_text(text)
                done = run("check", "--format", "json", scene)
                self.assertEqual(done.returncode, 1, done.stderr)
                errors = [json.loads(each) for each in done.stdout.decode().splitlines()]
                self.assertEqual([(e["line"], e["column"]) for e in errors], [(line, column)], errors)
                self.assertIn(message, errors[0]["message"])

    def test_several_at_once(self):
        done = run("check", "-", "--format", "json", stdin=scene_of(
            '{"kind": "sphere", "radius": -1},\n{"kind": "cube", "sise": 1, "center": 2}').encode())
        self.assertEqual(done.stdout.count(b'"severity": "error"'), 3)

    def test_a_number_too_large_or_a_second_value_ends_nothing(self):
        done = run("check", "-", "--format", "json", stdin=scene_of(
            '{"kind": "sphere", "raduis": 1},\n{"kind": "sphere", "radius": 1e999},\n'
            '{"kind": "sphere", "center": [0, 1e999, 1]},\n{"kind": "cube", "size": 1, "size": 2},\n'
            '{"kind": "cube", "sise": 1}').encode())
        errors = [json.loads(each) for each in done.stdout.decode().splitlines()]
        self.assertEqual([e["line"] for e in errors], [2, 3, 4, 5, 6], errors)
        self.assertEqual([e["message"].count("too large") for e in errors], [0, 1, 1, 0, 0])


class AnyText(unittest.TestCase):
    def test_form_is_recognised(self):
        block = '{"kind": "sphere", "radius": 0.5, "name": "b\\u0061ll"}'
        self.assertIn(b"is no name", run("check", "-", stdin=scene_of(block).encode()).stderr)
        done = run("check", "-", stdin=b"\xef\xbb\xbf \r\n" + scene_of('{"kind": "sphere"}').encode())
        self.assertEqual(done.returncode, 0, done.stderr)

    def test_an_unused_material_is_called_by_its_name(self):
        block = '{"name": "red", "kind": "material"}, {"kind": "sphere"}'
        self.assertIn(b"'material red' is never used", run("check", "-", stdin=scene_of(block).encode()).stderr)

    def test_a_stray_brace_makes_no_json(self):
        self.assertIn(b"this '{' belongs to no block", run("check", "-", stdin=b"{ radius 1 }").stderr)

    def test_strings_hold_any_character(self):
        with tempfile.TemporaryDirectory() as folder:
            name = 'ä "q" \\ 😀.txt'
            (pathlib.Path(folder) / name).write_text("sphere { radius 0.5 }")
            for ascii_only in (True, False):
                scene = pathlib.Path(folder) / "scene.json"
                scene.write_text(json.dumps({"blocks": [{"kind": "include", "file": name}]}, ensure_ascii=ascii_only))
                blocks = json.loads(run("json", scene).stdout)["blocks"]
                self.assertEqual(blocks, [{"kind": "sphere", "radius": 0.5}])

    def test_a_text_that_ends_anywhere_is_refused(self):
        text = run("json", "-", stdin=SCENES["everything"].encode()).stdout
        self.assertGreater(len(text), 1000)
        for end in range(1, len(text) - 2, 7):
            done = run("check", "-", stdin=text[:end])
            self.assertEqual(done.returncode, 1, text[:end])

    def test_fmt_leaves_json_alone(self):
        done = run("fmt", "-", stdin=scene_of('{"kind": "sphere"}').encode())
        self.assertEqual((done.returncode, done.stdout), (2, b""))


if __name__ == "__main__":
    unittest.main()
