"""The same scene is the same bytes: for any number of threads, in any locale, however the text is written down."""

import os
import pathlib
import struct
import subprocess
import tempfile
import unittest
import zlib

import program

SCENE = """\
raytracer 1
// Numbers with points, a string, a colour and every kind of white space
image { size 120 70 }
render { samples 3 bounces 4 }
camera { position 0 1.25 6.5  look_at 0 0.5 0  fov 47.5 }
light { position -4.5 6 5  intensity 1800.25 }
light spot { position 3 4 1 look_at 0 0 0 angle 50 soft_edge 0.25 intensity 600 }
background { color #102030 }
material chrome { color 0.9 0.85 0.8 shininess 0.75 }
include "parts.txt"
plane { point 0 -1 0 material { color wheat } }
"""
PARTS = """\
group {
  rotate 0 22.5 0
  sphere { center -1.1 0 0 radius .9 material chrome }
  torus { center 1.2 0 0 axis 0 1 1 radius 0.75 tube_radius 2.5e-1 }
}
"""


def png_chunks(data):
    """[(type, content)] of a PNG file, its checksums verified."""
    assert data.startswith(b"\x89PNG\r\n\x1a\n"), data[:8]
    chunks, offset = [], 8
    while offset < len(data):
        length, kind = struct.unpack(">I4s", data[offset:offset + 8])
        content = data[offset + 8:offset + 8 + length]
        (checksum,) = struct.unpack(">I", data[offset + 8 + length:offset + 12 + length])
        assert checksum == zlib.crc32(kind + content), kind
        chunks.append((kind.decode(), content))
        offset += 12 + length
    return chunks


class SameBytes(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.folder = pathlib.Path(folder.name)
        cls.write(SCENE.encode(), PARTS.encode())
        cls.expected = cls.render()

    @classmethod
    def write(cls, scene, parts):
        (cls.folder / "scene.txt").write_bytes(scene)
        (cls.folder / "parts.txt").write_bytes(parts)

    @classmethod
    def render(cls, *arguments, **options):
        done = program.run("scene.txt", "-o", "-", *arguments, cwd=cls.folder, **options)
        assert (done.returncode, done.stderr) == (0, b""), done
        return done.stdout

    def setUp(self):
        self.write(SCENE.encode(), PARTS.encode())

    def test_twice(self):
        self.assertEqual(self.render(), self.expected)

    def test_for_any_number_of_threads(self):
        for threads in (1, 2, 3, 8):
            self.assertEqual(self.render("--threads", threads), self.expected, threads)

    def test_unclamped_floats_for_any_number_of_threads(self):
        def floats(threads):
            self.render_to("out.pfm", "--threads", threads)
            return (self.folder / "out.pfm").read_bytes()
        self.assertEqual(floats(1), floats(8))

    def render_to(self, name, *arguments):
        done = program.run("scene.txt", "-o", name, *arguments, cwd=self.folder)
        self.assertEqual((done.returncode, done.stderr), (0, b""))

    def test_into_a_file_or_to_standard_output(self):
        self.render_to("out.png")
        self.assertEqual((self.folder / "out.png").read_bytes(), self.expected)

    def test_from_another_folder(self):
        done = program.run(self.folder / "scene.txt", "-o", "-", cwd="/")
        self.assertEqual((done.returncode, done.stdout), (0, self.expected))

    def test_on_another_day(self):
        os.utime(self.folder / "scene.txt", (1, 1))
        self.assertEqual(self.render(env={"TZ": "Asia/Tokyo", "SOURCE_DATE_EPOCH": "1"}), self.expected)

    def test_in_a_locale_with_decimal_commas(self):
        self.assertEqual(self.render(env={"LC_ALL": "de_DE.UTF-8", "LANG": "de_DE.UTF-8"}), self.expected)
        self.assertEqual(self.render(env={"LC_ALL": "tr_TR.UTF-8"}), self.expected)

    def test_in_a_generated_locale_with_decimal_commas(self):
        made = subprocess.run(["localedef", "-i", "de_DE", "-f", "UTF-8", self.folder / "de_DE.UTF-8"],
                              capture_output=True, check=False)
        if made.returncode > 1 or not (self.folder / "de_DE.UTF-8").exists():
            self.skipTest("no German locale can be made here")
        environment = {"LOCPATH": str(self.folder), "LC_ALL": "de_DE.UTF-8"}
        self.assertEqual(self.render(env=environment), self.expected)

    def test_with_other_line_ends(self):
        for end in ("\r\n", "\r", "\n\n", "\f", "\v"):
            self.write(SCENE.replace("//", "/*").replace("space\n", "space*/\n").replace("\n", end).encode(),
                       PARTS.replace("\n", end).encode())
            self.assertEqual(self.render(), self.expected, repr(end))

    def test_line_comments_end_at_any_line_end(self):
        for end in ("\r\n", "\r"):
            self.write(SCENE.replace("\n", end).encode(), PARTS.replace("\n", " // remark" + end).encode())
            self.assertEqual(self.render(), self.expected, repr(end))

    def test_with_a_byte_order_mark(self):
        self.write(b"\xef\xbb\xbf" + SCENE.encode(), b"\xef\xbb\xbf" + PARTS.encode())
        self.assertEqual(self.render(), self.expected)

    def test_with_tabs(self):
        self.write(SCENE.replace(" ", "\t\t").encode(), PARTS.replace(" ", "\t").encode())
        self.assertEqual(self.render(), self.expected)

    def test_without_any_space_that_is_not_needed(self):
        self.write(SCENE.replace(" { ", "{").replace(" }", "}").replace("}\n", "}").encode(), PARTS.encode())
        self.assertEqual(self.render(), self.expected)

    def test_without_a_last_line_end(self):
        self.write(SCENE.rstrip("\n").encode(), PARTS.rstrip("\n").encode())
        self.assertEqual(self.render(), self.expected)

    def test_with_nested_comments(self):
        self.write(SCENE.replace(" }", "/* a /* b */ c } */ }").encode(), PARTS.replace(" ", "/**/ ").encode())
        self.assertEqual(self.render(), self.expected)


class Png(unittest.TestCase):
    def chunks(self):
        done = program.run("-", "-o", "-", "--size", "21x13",
                           stdin=b"light { position 0 9 0 }\ncamera { position 0 0 5 }\nsphere { }\n")
        self.assertEqual((done.returncode, done.stderr), (0, b""))
        return png_chunks(done.stdout)

    def test_is_eight_bit_rgb_of_the_size_asked_for(self):
        kind, header = self.chunks()[0]
        self.assertEqual(kind, "IHDR")
        self.assertEqual(struct.unpack(">IIBBBBB", header), (21, 13, 8, 2, 0, 0, 0))

    def test_tells_the_software_and_its_version(self):
        version = program.run("--version").stdout.decode().split()[1]
        texts = dict(content.split(b"\0", 1) for kind, content in self.chunks() if kind == "tEXt")
        self.assertIn(b"Software", texts)
        self.assertIn(version.encode(), b" ".join(texts.values()))

    def test_has_no_date(self):
        kinds = {kind for kind, _ in self.chunks()}
        self.assertNotIn("tIME", kinds)
        self.assertFalse([content for kind, content in self.chunks() if b"date" in content.lower() and kind == "tEXt"])

    def test_holds_all_rows(self):
        data = zlib.decompress(b"".join(content for kind, content in self.chunks() if kind == "IDAT"))
        self.assertEqual(len(data), 13 * (1 + 3 * 21))

    def test_ends(self):
        self.assertEqual(self.chunks()[-1], ("IEND", b""))


if __name__ == "__main__":
    unittest.main()
