"""The mesh block: files and lists of numbers, what it says of mistakes, and how it goes with the rest of the language."""

import json
import pathlib
import struct
import tempfile
import unittest
import zlib

from program import run

CUBE = [(x, y, z) for z in (-1, 1) for y in (-1, 1) for x in (-1, 1)]
FACES = [(0, 2, 1), (1, 2, 3), (4, 5, 6), (5, 7, 6), (0, 1, 4), (1, 5, 4), (2, 6, 3), (3, 6, 7), (0, 4, 2), (2, 4, 6),
         (1, 3, 5), (3, 7, 5)]
HEAD = ("image { size 64 48 }  camera { position 2 3 6  look_at 0 0 0 }  light { position 3 6 5  intensity 1500 }\n"
        "sphere { center 0 -1.5 0  radius 0.4 }\n")


def obj(material=""):
    return (material + "".join(f"v {x} {y} {z}\n" for x, y, z in CUBE)
            + "".join(f"f {a + 1} {b + 1} {c + 1}\n" for a, b, c in FACES))


def ply():
    head = ("ply\nformat binary_little_endian 1.0\nelement vertex 8\nproperty float x\nproperty float y\nproperty float z\n"
            "element face 12\nproperty list uchar int vertex_indices\nend_header\n").encode()
    return (head + b"".join(struct.pack("<3f", *v) for v in CUBE)
            + b"".join(struct.pack("<B3i", 3, *f) for f in FACES))


def stl():
    body = b"".join(struct.pack("<12fH", 0, 0, 0, *CUBE[a], *CUBE[b], *CUBE[c], 0) for a, b, c in FACES)
    return bytes(80) + struct.pack("<I", len(FACES)) + body


def inline():
    vertices = " ".join(f"{x} {y} {z}" for x, y, z in CUBE)
    faces = " ".join(f"{a} {b} {c}" for a, b, c in FACES)
    return f"vertices {vertices}  faces {faces}"


class Meshes(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        (self.folder / "parts").mkdir()
        (self.folder / "cube.obj").write_text(obj())
        (self.folder / "cube.ply").write_bytes(ply())
        (self.folder / "cube.stl").write_bytes(stl())

    def render(self, text, *options):
        scene = self.folder / "scene.txt"
        scene.write_text(text)
        return run("render", scene, "-q", "-o", "-", *options)

    def picture(self, text, *options):
        done = self.render(text, *options)
        self.assertEqual(done.returncode, 0, done.stderr.decode())
        return done.stdout

    def mistake(self, text, *phrases):
        scene = self.folder / "scene.txt"
        scene.write_text(text)
        done = run("check", scene)
        message = done.stderr.decode()
        self.assertEqual(done.returncode, 1, message)
        for phrase in phrases:
            self.assertIn(phrase, message)
        return message

    def test_formats_agree(self):
        place = "translate 0 0.3 0  rotate 10 20 30  material { color tomato }"
        wanted = self.picture(HEAD + f"mesh {{ {inline()}  {place} }}")
        for name in ("cube.obj", "cube.ply", "cube.stl"):
            with self.subTest(name):
                self.assertEqual(self.picture(HEAD + f'mesh {{ file "{name}"  {place} }}'), wanted)
        cube = self.picture(HEAD + f"cube {{ size 2  {place} }}")
        off = sum(a != b for a, b in zip(pixels(cube), pixels(wanted)))
        self.assertLessEqual(off, 3 * 64 * 48 // 1000)

    def test_lists_take_expressions_and_vectors(self):
        written = 'let a = -1\nlet up = (0, 1, 0)\nmesh { vertices a a 0  1 (a) 0  up  faces 0 1 2 }'
        plain = 'mesh { vertices -1 -1 0  1 -1 0  0 1 0  faces 0 1 2 }'
        self.assertEqual(self.picture(HEAD + written), self.picture(HEAD + plain))

    def test_instances_look_like_copies(self):
        uses = [f"translate {x} 0 {-x}  rotate 0 {30 * x} 0  scale 0.5  material {{ color 0.{x + 4} 0.5 0.3 }}"
                for x in (-2, 0, 2)]
        many = "".join(f'mesh {{ file "cube.ply"  {use} }}\n' for use in uses)
        copies = "".join(f"mesh {{ {inline()}  {use} }}\n" for use in uses)
        a, b = pixels(self.picture(HEAD + many)), pixels(self.picture(HEAD + copies))
        self.assertLessEqual(sum(abs(x - y) > 1 for x, y in zip(a, b)), len(a) // 500)

    def test_definitions_and_animations_take_meshes(self):
        text = HEAD + ('define pair (x 0) { mesh { file "cube.obj"  scale 0.4  translate x 0 0 }\n'
                       'for i from 0 to 20 { sphere { center x (0.1 * i) 0  radius 0.1 } } }\n'
                       'pair { x -1 } pair { x 1 } pair { x 1  translate 0 0 -2 }\n'
                       'mesh { file "cube.obj"  translate 0 (sin(90 * t)) -3 }\n'
                       'mesh { file "cube.ply"  translate 3 0 -3 }\n')
        self.picture(text)
        self.assertNotEqual(self.picture(text, "--time-at", "0"), self.picture(text, "--time-at", "1"))

    def test_an_mtl_file_gives_materials(self):
        (self.folder / "red.mtl").write_text("newmtl red\nKd 0.9 0.1 0.1\n")
        (self.folder / "red.obj").write_text(obj("mtllib red.mtl\nusemtl red\n"))
        red = self.picture(HEAD + "mesh { " + inline() + "  material { color 0.9 0.1 0.1 } }")
        self.assertEqual(self.picture(HEAD + 'mesh { file "red.obj" }'), red)
        group = 'group { material { color blue }  mesh { file "red.obj" } }'
        self.assertEqual(self.picture(HEAD + group), red)
        blue = self.picture(HEAD + 'mesh { file "red.obj"  material { color blue } }')
        self.assertEqual(blue, self.picture(HEAD + 'mesh { file "cube.obj"  material { color blue } }'))
        # Neither file is overwritten by a picture.
        (self.folder / "scene.txt").write_text(HEAD + 'mesh { file "red.obj" }')
        for name in ("red.obj", "red.mtl"):
            before = (self.folder / name).read_bytes()
            self.assertNotEqual(run(self.folder / "scene.txt", "-o", self.folder / name).returncode, 0)
            self.assertEqual((self.folder / name).read_bytes(), before)

    def test_an_mtl_file_gives_pictures(self):
        (self.folder / "green.png").write_bytes(png_of_one_color(0, 255, 0))
        (self.folder / "green.mtl").write_text("newmtl green\nKd 0.9 0.1 0.1\nmap_Kd green.png\n")
        (self.folder / "green.obj").write_text(obj("mtllib green.mtl\nusemtl green\n"))
        green = self.picture(HEAD + "mesh { " + inline() + "  material { color 0 1 0 } }")
        self.assertEqual(self.picture(HEAD + 'mesh { file "green.obj" }'), green)
        (self.folder / "green.png").unlink()
        (self.folder / "scene.txt").write_text(HEAD + 'mesh { file "green.obj" }')
        done = run("check", self.folder / "scene.txt")
        self.assertEqual(done.returncode, 0)
        self.assertIn("the picture 'green.png' can't be shown", done.stderr.decode())

    def test_an_mtl_file_cuts_out_and_bends(self):
        (self.folder / "map.obj").write_text(obj("mtllib map.mtl\nusemtl m\n"))
        mtl = self.folder / "map.mtl"

        def with_map(word, *color):
            (self.folder / "map.png").write_bytes(png_of_one_color(*color))
            mtl.write_text(f"newmtl m\nKd 0.9 0.1 0.1\n{word} map.png\n")
            return self.picture(HEAD + 'mesh { file "map.obj" }')

        mtl.write_text("newmtl m\nKd 0.9 0.1 0.1\n")
        plain = self.picture(HEAD + 'mesh { file "map.obj" }')
        empty = self.picture(HEAD)
        self.assertNotEqual(plain, empty)
        self.assertEqual(with_map("map_d", 255, 255, 255), plain)
        self.assertEqual(with_map("map_d", 0, 0, 0), empty)
        glowing = self.picture(HEAD + "mesh { " + inline() + "  material { color 0.9 0.1 0.1  emission 0 0 1 } }")
        self.assertEqual(with_map("map_Ke", 0, 0, 255), glowing)

    def test_json_says_the_same(self):
        (self.folder / "parts" / "sub.ply").write_bytes(ply())
        (self.folder / "parts" / "parts.txt").write_text(
            'mesh { file "sub.ply"  smooth 30  fit 1.5 }\nmesh { ' + inline() + '  translate 2 0 0 }')
        text = HEAD + 'include "parts/parts.txt"'
        wanted = self.picture(text)
        done = run("json", self.folder / "scene.txt")
        self.assertEqual(done.returncode, 0, done.stderr.decode())
        self.assertIn('"parts/sub.ply"', done.stdout.decode())
        json.loads(done.stdout)
        (self.folder / "scene.json").write_bytes(done.stdout)
        again = run("render", self.folder / "scene.json", "-q", "-o", "-")
        self.assertEqual(again.stdout, wanted)

    def test_resume_sees_another_mesh(self):
        (self.folder / "scene.txt").write_text(
            HEAD + 'animation { duration 0.1 }\nmesh { file "cube.ply" }')
        command = ("render", self.folder / "scene.txt", "-o", self.folder / "f##.png", "--resume")
        self.assertEqual(run(*command).returncode, 0)
        first = (self.folder / "f01.png").read_bytes()
        self.assertEqual(run(*command).returncode, 0)
        self.assertEqual((self.folder / "f01.png").read_bytes(), first)
        data = ply().replace(struct.pack("<3f", *CUBE[7]), struct.pack("<3f", 2, 2, 2))
        (self.folder / "cube.ply").write_bytes(data)
        self.assertEqual(run(*command).returncode, 0)
        self.assertNotEqual((self.folder / "f01.png").read_bytes(), first)

    def test_triangles_without_area_are_told(self):
        corners = "vertices 0 0 0  1 0 0  0 1 0  2 0 0"
        self.mistake(f"mesh {{ {corners}  faces 0 1 3  1 1 2 }}", "none of its 2 faces has an area", "scene.txt:1:45")
        self.mistake(f"mesh {{ {corners}  faces 0 1 3 }}", "its one face has no area")
        done = self.render(HEAD + f"mesh {{ {corners}  faces 0 1 2  0 1 3 }}")
        self.assertEqual(done.returncode, 0)
        self.assertIn(b"1 of 2 triangles has no area and is left out", done.stderr)
        self.assertEqual(done.stdout, self.picture(HEAD + f"mesh {{ {corners}  faces 0 1 2 }}"))

    def test_mistakes(self):
        self.mistake("mesh { }", "neither 'file' nor 'vertices'")
        self.mistake('mesh { file "nothing.ply" }', "there is no file 'nothing.ply'", "scene.txt:1:8")
        self.mistake('mesh { file "parts" }', "is not a file to read a mesh from", "it is a folder")
        self.mistake('mesh { file "/etc/passwd" }', "outside of the scene's folder")
        self.mistake('mesh { file "cube.ply"  faces 0 1 2 }', "'faces' stands in place of 'file'")
        self.mistake("mesh { vertices 0 0 0  1 0 0  0 1 0  faces 0 1 3 }", "there is no vertex 3", "scene.txt:1:48")
        self.mistake("mesh { vertices 0 0 0  1 0 0  0 1 0  faces 0 7 2  0 9 1 }", "there is no vertex 7", "scene.txt:1:46",
                     "there is no vertex 9", "scene.txt:1:53")
        self.mistake("mesh { vertices 0 0 0  1 0 0  0 1 0  faces (0, 7, 2) }", "there is no vertex 7", "scene.txt:1:44")
        self.mistake("mesh { vertices 0 0 0  1 0 0  0 1 0  faces 0 1.5 2 }", "takes whole numbers, found 1.5",
                     "scene.txt:1:46", "faces 0 1 2  0 2 3")
        self.mistake("mesh { vertices 0 0 0  1 0  faces 0 1 2 }", "three numbers for each corner, found 5")
        self.mistake("mesh { vertices 0 0 0  1 0 0  0 1 0  faces 0 1 }", "three numbers for each triangle, found 2")
        self.mistake("mesh { vertices 0 0 0  1 0 0  0 1 0  faces 0 1 2  uvs 0 0 }", "'uvs' takes 2 numbers")
        self.mistake('mesh { file "cube.ply"  smooth 200 }', "'smooth' must be")
        (self.folder / "bad.ply").write_bytes(ply()[:-20])
        self.mistake('\nmesh { file "bad.ply" }\nmesh { file "bad.ply"  translate 1 0 0 }', "'bad.ply': ",
                     "scene.txt:2:8", "scene.txt:3:8")


def png_of_one_color(*rgb):
    def chunk(kind, body):
        return struct.pack(">I", len(body)) + kind + body + struct.pack(">I", zlib.crc32(kind + body))
    rows = 4 * (b"\0" + 4 * bytes(rgb))
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", 4, 4, 8, 2, 0, 0, 0))
            + chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b""))


def pixels(png):
    """The bytes of the colours of a PNG of ours (8 bits, RGB)."""
    position, data, width = 8, b"", 0
    while position < len(png):
        size, kind = struct.unpack(">I4s", png[position:position + 8])
        body = png[position + 8:position + 8 + size]
        if kind == b"IHDR":
            width = struct.unpack(">I", body[:4])[0]
        if kind == b"IDAT":
            data += body
        position += 12 + size
    raw, stride, out = zlib.decompress(data), 3 * width, bytearray()
    above = bytearray(stride)
    for start in range(0, len(raw), stride + 1):
        row = bytearray(raw[start + 1:start + 1 + stride])
        for i in range(stride):
            a, b, c = (row[i - 3] if i >= 3 else 0), above[i], (above[i - 3] if i >= 3 else 0)
            p = a + b - c
            paeth = min((a, b, c), key=lambda x: abs(p - x))
            row[i] = (row[i] + (0, a, b, (a + b) // 2, paeth)[raw[start]]) & 255
        out += row
        above = row
    return bytes(out)


if __name__ == "__main__":
    unittest.main()
