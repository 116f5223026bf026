"""Every number and colour of a material takes a texture of every kind, in both methods."""

import pathlib
import struct
import tempfile
import unittest
import zlib

import program
from float_pictures import read_picture, render

SIZE = ("--size", "12x12")
VIEW = "camera { position 0 0 5  look_at 0 0 0  projection orthographic  width 2 }\nsky gradient { zenith 0.2 0.4 1  horizon 1  ground 0.3 0.2 0.1 }\n"
LIGHT = "light { position 1 2 5  intensity 400 }\n"
WALL = "quad { origin -1 -1 0  width 2 0 0  height 0 2 0  material { color 0.5  @ } }\n"
# These light nothing but the eye.
LAMP = WALL.replace("color 0.5", "color 0")
SLAB = "cube { size 6 6 2  material { transmission 1  @ } }\n" + LAMP.replace("@", "emission 0.7").replace("-1 0", "-1 -1.5")

# The property with the words around it, what stands there, two values.
PROPERTIES = [
    ("color", "", WALL.replace("color 0.5", ""), "0.3", "0.9"),
    ("shininess", "", WALL, "0.2", "0.9"),
    ("roughness", "", WALL, "0.1", "0.8"),
    ("metallic", "roughness 0.3", WALL, "0.2", "0.9"),
    ("specular", "roughness 0.3", WALL, "0.2", "0.9"),
    ("coat", "", WALL, "0.2", "1"),
    ("coat_roughness", "coat 1", WALL, "0.2", "0.9"),
    ("alpha", "", WALL, "0.2", "0.9"),
    ("emission", "", LAMP, "0.2", "3"),
    ("anisotropy", "metallic 1  roughness 0.4", WALL, "-0.5", "0.8"),
    ("ior", "roughness 0.2", WALL, "1.2", "2.5"),
    ("ior", "", SLAB, "1.2", "2.5"),
    ("transmission", "thin true", WALL, "0.25", "0.75"),
    ("attenuation_color", "attenuation_distance 0.7", SLAB, "0.3", "0.8"),
    ("attenuation_distance", "attenuation_color 0.3 0.6 0.9", SLAB, "0.4", "30"),
    ("emission_strength", "emission 0.2 0.4 0.6", LAMP, "0.5", "3"),
    ("emission_strength", "emission (0.2 + 0.1 * u)", LAMP, "0.5", "3"),
    ("normal_scale", "shininess 1  normal_map (0.6, 0.55 + 0 * u, 1)", WALL, "0.5", "2"),
    ("bump_scale", "shininess 1  bump (0.1 * v)", WALL, "0.5", "2"),
    ("eta", "k 3.9 2.4 1.6", WALL, "0.2", "1.4"),
    ("k", "eta 0.2 0.9 1.1", WALL, "1.5", "4.5"),
]


def png(value):
    """A PNG of one grey pixel."""
    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
    header = struct.pack(">IIBBBBB", 1, 1, 8, 0, 0, 0, 0)
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(bytes((0, value)))) + chunk(b"IEND", b""))


def everywhere(name, value):
    """As a value, not a texture, must be written."""
    return f"{value} {value} {value}" if name in ("eta", "k") else value


class TexturedNumbers(unittest.TestCase):
    def setUp(self):
        place = tempfile.TemporaryDirectory()
        self.addCleanup(place.cleanup)
        self.folder = pathlib.Path(place.name)
        (self.folder / "half.png").write_bytes(png(128))

    def picture(self, method, around, words):
        scene = self.folder / "scene.txt"
        scene.write_text(f"render {{ method {method}  samples 4 }}\n" + VIEW + LIGHT + around.replace("@", words))
        out = self.folder / "out.pfm"
        done = program.run(scene, "-o", out, "--quiet", *SIZE)
        self.assertEqual((done.returncode, done.stderr), (0, b""), words)
        return read_picture(out.read_bytes())

    def test_each_half_is_as_if_it_were_all(self):
        for method in ("path", "classic"):
            for name, more, around, low, high in PROPERTIES:
                with self.subTest(method=method, name=name):
                    halves = self.picture(method, around, f"{more}  {name} (p.x < 0 ? {low} : {high})")
                    left = self.picture(method, around, f"{more}  {name} {everywhere(name, low)}")
                    right = self.picture(method, around, f"{more}  {name} {everywhere(name, high)}")
                    if (method, name) not in (("classic", "anisotropy"), ("classic", "coat_roughness")):
                        self.assertGreater(max(abs(a - b) for a, b in zip(left.values, right.values)), 2e-3)
                    for y in range(12):
                        for x in (0, 1, 2, 3, 4, 7, 8, 9, 10, 11):
                            wanted = (left if x < 6 else right).at(x, y)
                            for a, b in zip(halves.at(x, y), wanted):
                                self.assertAlmostEqual(a, b, delta=2e-4 + 1e-3 * b, msg=f"at {x} {y}")

    def test_every_kind_of_texture(self):
        for name, more, around, low, high in PROPERTIES:
            with self.subTest(name):
                once = self.picture("path", around, f"{more}  {name} {everywhere(name, low)}")
                for texture in (f"checker {{ a {low}  b {low}  scale 0.2 }}", f"({low} + 0 * v)",
                                f'ramp {{ by image "half.png" {{ curve linear }}  stop 0 0  stop {128 / 255:.9f} {low}  stop 1 9 }}'):
                    if low.startswith("-") and not texture.startswith("("):
                        continue  # patterns mix colours, of which none is negative
                    again = self.picture("path", around, f"{more}  {name} {texture}")
                    for a, b in zip(once.values, again.values):
                        self.assertAlmostEqual(a, b, delta=2e-4 + 1e-3 * a, msg=texture)

    def test_a_glass_ball_of_many_indices_gains_and_loses_no_light(self):
        ball = "camera { position 0 0 5  look_at 0 0 0  fov 30 }\nbackground { color 1 }\nsphere { material { transmission 1  ior @ } }"
        for ior in ("(1.2 + u)", "noise { a 1  b 3  scale 0.3 }"):
            values = render("render { method path  samples 64 }\n" + ball.replace("@", ior), *SIZE).values
            self.assertAlmostEqual(sum(values) / len(values), 1, delta=2e-3)

    def test_light_is_found_by_its_textured_strength(self):
        scene = """camera { position 0 2 5  look_at 0 0 0  fov 40 }
            plane { material { color 0.8 } }
            quad { origin -1 1 1  width 2 0 0  height 0 0 -2  material { emission 2 1 1  emission_strength (u < 0.2 ? 9 : 0.1) } }"""
        sums = {}
        for sampling in ("lights", "materials"):
            picture = render(f"render {{ method path  samples 256  sampling {sampling} }}\n" + scene, *SIZE)
            sums[sampling] = sum(picture.values)
        self.assertAlmostEqual(sums["lights"] / sums["materials"], 1, delta=0.03)

    def test_a_camera_in_glass_sees_through_what_its_wall_says(self):
        def seen(color):
            ball = "sphere { material { transmission 1  ior 1  attenuation_distance 1  attenuation_color @ } }"
            scene = "camera { position 0 0 0  look_at 0 0 -1  fov 30 }\nbackground { color 1 }\n" + ball.replace("@", color)
            with tempfile.TemporaryDirectory() as folder:
                out = pathlib.Path(folder) / "out.pfm"
                done = program.run("-", "-o", out, "--quiet", *SIZE, "--method", "path", stdin=scene.encode(), cwd=folder)
                self.assertEqual(done.returncode, 0, done.stderr)
                return read_picture(out.read_bytes()).at(6, 6)
        for a, b in zip(seen("(p.z < 0 ? 0.25 : 0.75)"), seen("0.25")):
            self.assertAlmostEqual(a, b, delta=1e-4)


if __name__ == "__main__":
    unittest.main()
