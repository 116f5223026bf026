"""Few samples see the same far texture as many: its average."""

import math
import pathlib
import struct
import tempfile
import unittest
import zlib

import float_pictures

CHECKER = """
camera { position 0 1.6 6  look_at 0 0.6 0  fov 45 }
render { ambient 1 }
background { color 0.5 }
plane { material { color checker { a 1  b 0  rotate 0 %d 0 } } }
"""

# Lit from everywhere alike, so that nothing but the texture differs between samples.
GRAZING = """
camera { position 0 1 0  look_at 0 0.1 -2.6  fov 50 }
render { method path  bounces 1 }
background { color 1 }
plane { material { color image { file "%s"  uv_scale 0.7 0.7 } } }
"""


def photograph(x, y):
    """Slow waves with fine ones upon them, and grain."""
    wave = math.sin(0.05 * x) * math.cos(0.04 * y) + 0.3 * math.sin(0.4 * x + 0.3 * y)
    return int(120 + 60 * wave + (x * 7919 + y * 104729 + x * y * 31) % 23)


def black_and_white_noise(x, y):
    return 255 * (zlib.crc32(struct.pack("<II", x, y)) & 1)


def write_picture(path, value, size=256):
    def chunk(name, content):
        return struct.pack(">I", len(content)) + name + content + struct.pack(">I", zlib.crc32(name + content))

    rows = b"".join(b"\0" + bytes(value(x, y) for x in range(size)) for y in range(size))
    path.write_bytes(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", size, size, 8, 0, 0, 0, 0)) +
                     chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b""))


def mean_difference(scene, *options, samples=256):
    few = float_pictures.render(scene, "--size", "360x200", "--samples", "4", *options)
    many = float_pictures.render(scene, "--size", "360x200", "--samples", str(samples), *options)
    return sum(abs(a - b) for a, b in zip(few.values, many.values)) / len(many.values)


PATTERN = """
camera { position 0 1 5  look_at 0 0.6 0  fov 50 }
render { ambient 1 }
background { color 0.5 }
plane { material { color %s { a 1  b 0  scale %s } } }
"""


class Far(unittest.TestCase):
    def test_patterns_are_their_averages(self):
        for pattern in (("dots", 0.5), ("wood", "0.2  rotate 90 0 0"), ("brick", 0.5), ("cells", 0.5)):
            with self.subTest(pattern):
                self.assertLess(mean_difference(PATTERN % pattern, samples=64), 2 / 255)

    def test_a_checker_to_the_horizon_is_its_average(self):
        for turn in (0, 30):
            with self.subTest(turn):
                self.assertLess(mean_difference(CHECKER % turn), 1 / 255)

    def test_a_picture_at_a_grazing_angle_is_its_average(self):
        for value, most in ((photograph, 0.25), (black_and_white_noise, 2)):
            with self.subTest(value.__name__), tempfile.TemporaryDirectory() as folder:
                path = pathlib.Path(folder) / "a.png"
                write_picture(path, value)
                self.assertLess(mean_difference(GRAZING % path, "--allow-path", folder), most / 255)


if __name__ == "__main__":
    unittest.main()
