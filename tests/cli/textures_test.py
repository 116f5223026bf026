"""Textures, skies and lenses in scenes: what is said where something is wrong, and that JSON says the same."""

import json
import pathlib
import struct
import tempfile
import unittest
import zlib

from program import run

SMALL = ("--size", "40x24", "--samples", "1", "-q", "-o", "-")


def png(width, height, pixel):
    """A PNG of 8-bit grey, RGB, or RGB and alpha, whose pixels are pixel(x, y)."""
    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
    rows = b"".join(b"\0" + b"".join(bytes(pixel(x, y)) for x in range(width)) for y in range(height))
    header = struct.pack(">IIBBBBB", width, height, 8, {1: 0, 3: 2, 4: 6}[len(pixel(0, 0))], 0, 0, 0)
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b""))


PICTURE = png(8, 8, lambda x, y: (32 * x, 32 * y, 128))
LIGHT = "camera { position 0 1 6  look_at 0 0.5 0 }\nlight { position 2 5 5  intensity 1200 }\n"

MISTAKES = [
    ("sphere { material { color chekcer { } } }", "there is no texture 'chekcer'", "did you mean 'checker'?"),
    ("sphere { material { color checker } }", "'checker' needs braces", "color checker { … }"),
    ("sphere { material { color checker { c red } } }", "checker has no property 'c'", "a, b"),
    ("sphere { material { color imgae \"wood.png\" } }", "there is no texture 'imgae'", "did you mean 'image'?"),
    ("sphere { material { color checker \"wood.png\" } }", "a checker has no file", "color checker { … }"),
    ("sphere { material { color image \"no.png\" } }", "there is no file 'no.png'", "looked for"),
    ("sphere { material { color image \"/etc/passwd\" } }", "lies outside of the scene's folder", "--allow-path"),
    ("sphere { material { color image \"broken.png\" { wrap mirror } } }", "'broken.png' can't be shown: ", ""),
    ("sphere { material { color image { wrap mirror } } }", "image has no 'file'", "file"),
    ("sphere { material { color image \"wood.png\" { wrap miror } } }", "found 'miror'", "did you mean 'mirror'?"),
    ("sphere { material { roughness (n) } }", "'roughness' takes a number, found a vector", "(v.x)"),
    ("sphere { material { color (u + p) } }", "'+' between a number and a vector", ""),
    ("sphere { material { color (u + q) } }", "there is no 'q'", ""),
    ("sphere { radius (u) }", "there is no 'u'", ""),
    ("sphere { material { normal_map 0.5 } }", "'normal_map' takes a texture", "normal_map noise { }"),
    ("sphere { material { color ramp { stop 0 red } } }", "ramp has no 'by'", ""),
    ("sphere { material { color ramp { by (u) } } }", "ramp has no 'stop'", "stop 0.5 red"),
    ("sky image { }", "sky image has no 'file'", "file"),
    ("sphere { material { color image 5 } }", "'image' takes the name of one file, found 5", 'color image "file"'),
    ('sphere { material { color image "a.png" "b.png" } }', "one file, found \"b.png\"", 'color image "file"'),
    ('let a = "a.png" sphere { material { color image a } }', "one file, found a", "color image { file a }"),
    ('sphere { material { ior image "no.png" } }', "there is no file 'no.png'", "looked for"),
    ("sphere { material { ior (n) } }", "'ior' takes a number, found a vector", "(v.x)"),
    ("sphere { material { k (u) } }", "'eta' and 'k' make a metal together", "eta 0.14 0.37 1.44"),
    ("sphere { material { thin checker { } } }", "'thin' takes no texture, but true or false", "thin true"),
    ("sphere { radius noise { } }", "'radius' takes no texture, but a number", "radius 1"),
    ("sphere { material { color u } }", "'u' is computed at each point: it needs parentheses", "color (u)"),
    ("sphere { radius (2 * v) }", "there is no 'v'", "v exists only in materials"),
    ('sphere { material { color image "wood.png" { rotate 30 } } }', "image has no property 'rotate'", "'uv_rotate'"),
    ("sphere { material { color ramp { by (u)  stop 1 red  stop 0 blue } } }", "the stops of a ramp go upwards", ""),
    ("texture checker { }", "a texture that stands alone needs a name", "texture checker pattern { … }"),
    ("texture chekcer tiles { }", "there is no texture 'chekcer'", "did you mean 'checker'?"),
    ("sky sunn { }", "there is no sky 'sunn'", "did you mean 'sun'?"),
    ("sky sun { turbidity 0 }", "'turbidity' must be between 1 and 20", ""),
    ("camera { f_number 2 }", "'f_number' needs 'focal_length'", ""),
    ("camera { focus 2  focus_on ball }", "either 'focus' or 'focus_on'", ""),
    ("camera { focus_on bal } sphere ball { center 0 0 -5 }", "there is no shape 'bal'", "did you mean 'ball'?"),
    ("camera { fov 200 }", "'fov' must be between 0.001 and 179", "projection fisheye"),
]

SCENES = {
    "patterns": """
        texture wood oak { a #c89058  b #7a4a20  scale 0.2  rotate 85 0 5 }
        sphere { center -1 0.5 0  material { color checker { a oak  b noise { a white  b navy  sort ridged }  scale 0.3 } } }
        plane { material { color ramp { by marble { a 0  b 1 }  stop 0 #102030  stop 0.5 0.2 0.4 0.3  stop 1 white } } }""",
    "formulas": """
        let k = 3
        sphere { center 1 0.5 0  material { color (hsv(k * 40 * p.y, 0.5, 0.9))  shininess (u > 0.5 ? 0.3 : 0) } }
        plane { material { color (0.5 + 0.3 * sin(k * 90 * p.x)) (0.5 - 0.2 * noise(k * p)) 0.3 } }""",
    "pictures": """
        sphere { center 1 0.5 0  material { color image "wood.png" { wrap mirror  uv_scale 3 2 } } }
        cube { center -1 0.5 0  material { color image { file "wood.png"  scale 0.5  channel red } } }
        sky gradient { zenith navy  horizon white  ground #404030  strength 0.8 }""",
    "numbers": """
        texture noise soft { a 1.2  b 1.8  scale 0.3 }
        sphere { center -1 0.5 0  material { transmission 1  ior soft  attenuation_color image "wood.png"  attenuation_distance (0.2 + u) } }
        sphere { center 1 0.5 0  material { eta (0.2, 0.5 + u, 1)  k checker { a 3 2 1  b 4  map uv }  roughness image "wood.png" } }
        sphere { center 0 0.5 -1  material { emission 0.2 0.3 0.1  emission_strength (u)  coat 1 } }
        plane { material { normal_map image "wood.png"  normal_scale (p.x)  bump soft  bump_scale (0.1 * p.z)  ior (1 + v) } }""",
    "lens": """
        camera other { position 0 2 5  look_at 0 0 0  projection fisheye  fov 200  shift 0.1 0 }
        sphere { center 1 0.5 0  material { color dots { map uv  scale 0.1 } } }""",
}


class Textures(unittest.TestCase):
    def setUp(self):
        self.place = tempfile.TemporaryDirectory()
        self.folder = pathlib.Path(self.place.name)
        self.addCleanup(self.place.cleanup)
        (self.folder / "wood.png").write_bytes(PICTURE)
        (self.folder / "broken.png").write_bytes(PICTURE[:60])

    def write(self, text, name="scene.txt"):
        path = self.folder / name
        path.parent.mkdir(exist_ok=True)
        path.write_text(text)
        return path

    def render(self, path, *more):
        done = run(path, *SMALL, *more)
        self.assertEqual(done.returncode, 0, done.stderr.decode())
        return done.stdout

    def test_a_mistake_is_told_once_and_at_its_place(self):
        for text, message, suggestion in MISTAKES:
            with self.subTest(text):
                done = run("check", "--format", "json", self.write(text))
                self.assertEqual(done.returncode, 1, done.stdout)
                told = [json.loads(line) for line in done.stdout.splitlines()]
                errors = [t for t in told if t["severity"] == "error"]
                self.assertEqual(len(errors), 1, errors)
                self.assertIn(message, errors[0]["message"])
                self.assertIn(suggestion, errors[0].get("suggestion", ""))
                self.assertEqual(errors[0]["line"], 1)

    def test_json_makes_the_same_picture(self):
        for name, text in SCENES.items():
            with self.subTest(name):
                scene = self.write(LIGHT + text)
                done = run("json", scene)
                self.assertEqual(done.returncode, 0, done.stderr.decode())
                again = self.write(done.stdout.decode(), "again.json")
                self.assertEqual(self.render(scene), self.render(again))
                self.assertEqual(self.render(scene, "--method", "path"), self.render(again, "--method", "path"))

    def test_files_of_an_included_scene_lie_beside_it(self):
        self.write('sphere { material { color image "own.png" } }', "parts/part.txt")
        (self.folder / "parts" / "own.png").write_bytes(PICTURE)
        scene = self.write(LIGHT + 'include "parts/part.txt"')
        done = run("json", scene)
        self.assertIn(b'"parts/own.png"', done.stdout)
        self.assertEqual(self.render(scene), self.render(self.write(done.stdout.decode(), "again.json")))

    def test_alpha_is_the_alpha_of_a_picture_that_has_some(self):
        (self.folder / "leaf.png").write_bytes(png(8, 8, lambda x, y: (0, 0, 0, 255 * (x % 2))))
        (self.folder / "mask.png").write_bytes(png(8, 8, lambda x, y: (255 * (x % 2),) * 3))
        scene = LIGHT + 'sphere { center 0 0.5 0  material { color 0.5  alpha image "%s" } }'
        leaf = self.render(self.write(scene % "leaf.png"))
        self.assertEqual(leaf, self.render(self.write(scene % "mask.png")))
        self.assertNotEqual(leaf, self.render(self.write(LIGHT + "sphere { center 0 0.5 0  material { color 0.5 } }")))

    def test_short_and_long_form_are_the_same(self):
        short = self.write(LIGHT + 'sphere { material { color image "wood.png" { uv_scale 2 2 } } }', "a.txt")
        long = self.write(LIGHT + 'sphere { material { color image { file "wood.png"  uv_scale 2 2 } } }', "b.txt")
        grown = self.write(LIGHT + 'sphere { material { color image "wood.png" { scale 0.5 } } }', "c.txt")
        self.assertEqual(self.render(short), self.render(long))
        self.assertEqual(self.render(short), self.render(grown))

    def test_a_formula_without_the_point_is_a_colour_as_ever(self):
        plain = self.write(LIGHT + "let u = 0.5\nsphere { material { color (u) } }", "a.txt")
        grey = self.write(LIGHT + "sphere { material { color 0.5 } }", "b.txt")
        self.assertEqual(self.render(plain), self.render(grey))

    def test_formatting_keeps_the_picture(self):
        scene = self.write(LIGHT + SCENES["pictures"])
        before = self.render(scene)
        self.assertEqual(run("fmt", scene).returncode, 0)
        self.assertEqual(before, self.render(scene))

    def test_help_knows_the_textures(self):
        for words in (["texture"], ["texture", "checker"], ["sky", "sun"]):
            done = run("help", *words)
            self.assertEqual(done.returncode, 0, done.stderr.decode())

    def test_bumps_of_an_mtl_file(self):
        """Grey heights with the height that -bm says, and normals in colour that lean as much."""
        (self.folder / "grey.png").write_bytes(png(8, 8, lambda x, y: (32 * (x % 3 + y % 2),)))
        (self.folder / "a.obj").write_text(
            "mtllib a.mtl\nusemtl m\nv -1 0 0\nv 1 0 0\nv 1 2 0\nv -1 2 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nf 1/1 2/2 3/3 4/4\n")
        own = LIGHT + 'mesh { file "a.obj"  %s }'
        for bump, words in (("-bm 0.2 grey.png", 'bump image "grey.png"  bump_scale 0.2'),
                            ("-bm 0.5 wood.png", 'normal_map image "wood.png"  normal_scale 0.5'),
                            ("wood.png", 'normal_map image "wood.png"'), ("grey.png", "")):
            with self.subTest(bump):
                (self.folder / "a.mtl").write_text(f"newmtl m\nKd 0.5 0.5 0.5\nmap_bump {bump}\n")
                told = run("check", self.write(own % "")).stderr.decode()
                self.assertEqual("does not say with -bm" in told, bump == "grey.png", told)
                self.assertEqual(self.render(self.write(own % "")), self.render(self.write(own % f"material {{ color 0.5  {words} }}")))


if __name__ == "__main__":
    unittest.main()
