"""The same scene, written by loops, definitions and time or by hand, is the same bytes."""

import math
import pathlib
import struct
import tempfile
import unittest

import program

SETTING = """image { size 96 64 }
camera { position 0 3 9 look_at 0 0.5 0 fov 45 }
light { position -4 6 5 intensity 1800 }
light { position 5 4 3 intensity 400 color 1 0.8 0.6 }
plane { point 0 -1 0 material { color 0.4 0.5 0.4 } }
"""


def number(x):
    return repr(float(x))


def vector(*xyz):
    return " ".join(map(number, xyz))


def without_words(png):
    """The file without its texts: a frame also carries the hash of its scene."""
    kept, place = [png[:8]], 8
    while place < len(png):
        length, = struct.unpack(">I", png[place:place + 4])
        if png[place + 4:place + 8] != b"tEXt":
            kept.append(png[place:place + 12 + length])
        place += 12 + length
    return b"".join(kept)


class Equal(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def picture(self, scene, *options, name="scene"):
        (self.folder / f"{name}.txt").write_text(SETTING + scene)
        done = program.run(f"{name}.txt", "-o", f"{name}.png", "--quiet", *options, cwd=self.folder)
        self.assertEqual(done.returncode, 0, done.stderr.decode())
        return (self.folder / f"{name}.png").read_bytes()

    def check(self, computed, by_hand, *options):
        found = self.picture(computed, *options)
        self.assertTrue(found == self.picture(by_hand, name="by_hand"), "the pictures differ")
        self.assertFalse(found == self.picture("", name="empty"), "nothing is in the picture")


class Loops(Equal):
    def test_a_row(self):
        self.check("for i from -3 to 3 { sphere { center i 0 0 radius 0.45 } }\n",
                   "".join(f"sphere {{ center {i} 0 0 radius 0.45 }}\n" for i in range(-3, 4)))

    def test_a_row_by_a_step(self):
        self.check("for x from -2 to 2 step 0.5 { cube { center x 0 0 size 0.3 rotate 0 (x * 30) 0 } }\n",
                   "".join(f"cube {{ center {vector(-2 + k * 0.5, 0, 0)} size 0.3 rotate 0 {number((-2 + k * 0.5) * 30)} 0 }}\n"
                           for k in range(9)))

    def test_a_grid_with_a_condition(self):
        lines = []
        for i in range(-2, 3):
            for j in range(-2, 3):
                if math.fmod(i + j, 2) == 0:
                    lines.append(f"sphere {{ center {i} 0 {j} radius 0.4 material {{ color red }} }}\n")
                else:
                    lines.append(f"cube {{ center {i} 0 {j} size 0.5 material {{ color {vector(0.2, 0.25 * (i + 2), 0.9)} }} }}\n")
        self.check("for i from -2 to 2 {\n  for j from -2 to 2 {\n    if (i + j) % 2 == 0 {\n"
                   "      sphere { center i 0 j radius 0.4 material { color red } }\n    } else {\n"
                   "      cube { center i 0 j size 0.5 material { color 0.2 (0.25 * (i + 2)) 0.9 } }\n    }\n  }\n}\n",
                   "".join(lines))

    def test_a_ring(self):
        by_hand = ""
        for i in range(12):
            a = 360 * i / 12
            s = 0.0 if math.fmod(a, 180) == 0 else math.sin(math.radians(a))
            c = 0.0 if math.fmod(a, 180) == 90 else math.cos(math.radians(a))
            by_hand += f"sphere {{ center {vector(3.5 * c, 0.4, 3.5 * s)} radius 0.4 material {{ color {vector(i / 12, 0.5, 1 - i / 12)} }} }}\n"
        self.check("let n = 12\nlet ring = 3.5\nfor i from 0 to n - 1 {\n  let a = 360 * i / n\n"
                   "  sphere { center (ring*cos(a)) 0.4 (ring*sin(a)) radius 0.4 material { color (i / n) 0.5 (1 - i / n) } }\n}\n",
                   by_hand)

    def test_settings(self):
        self.check("let n = 2\nlet tint = red\nfor i from 1 to n { sphere { center i 0 0 radius 0.4 material { color tint } } }\n",
                   "".join(f"sphere {{ center {i} 0 0 radius 0.4 material {{ color #00ff00 }} }}\n" for i in range(1, 5)),
                   "--set", "n=4", "--set", "tint=lime")


class Definitions(Equal):
    def test_a_snowman(self):
        define = ("material snow { color 0.9 }\ndefine snowman (size 1, hat black) {\n"
                  "  sphere { center 0 (0.5*size) 0 radius (0.5*size) material snow }\n"
                  "  sphere { center 0 (1.25*size) 0 radius (0.25*size) material snow }\n"
                  "  cylinder { base 0 (1.5*size) 0 top 0 (1.75*size) 0 radius (0.25*size) material { color hat } }\n}\n")
        uses = "snowman { translate 1 0 0 }\nsnowman { size 2 hat red translate -3 0 0 }\nsnowman { size 0.5 rotate 0 0 30 scale 2 1 1 }\n"

        def by_hand(size, hat, placing):
            return (f"group {{ {placing}\n  sphere {{ center 0 {0.5 * size} 0 radius {0.5 * size} material snow }}\n"
                    f"  sphere {{ center 0 {1.25 * size} 0 radius {0.25 * size} material snow }}\n"
                    f"  cylinder {{ base 0 {1.5 * size} 0 top 0 {1.75 * size} 0 radius {0.25 * size} material {{ color {hat} }} }}\n}}\n")
        self.check(define + uses, "material snow { color 0.9 }\n" + by_hand(1, "black", "translate 1 0 0")
                   + by_hand(2, "red", "translate -3 0 0") + by_hand(0.5, "black", "rotate 0 0 30 scale 2 1 1"))

    def test_a_material_for_all_of_it(self):
        self.check("material gold { color 0.9 0.7 0.2 shininess 0.4 }\ndefine pair { sphere { center -1 0 0 } sphere { center 1 0 0 material { color blue } } }\n"
                   "pair { material gold }\npair { material { color red } translate 0 2 0 scale 0.5 }\n",
                   "material gold { color 0.9 0.7 0.2 shininess 0.4 }\ngroup { material gold sphere { center -1 0 0 } sphere { center 1 0 0 material { color blue } } }\n"
                   "group { material { color red } translate 0 2 0 scale 0.5 sphere { center -1 0 0 } sphere { center 1 0 0 material { color blue } } }\n")

    def test_a_fractal(self):
        def by_hand(depth):
            inner = by_hand(depth - 1) if depth > 1 else ""
            text = "sphere { radius 0.5 }\n"
            if inner:
                text += "".join(f"group {{ translate {x} 0 0 scale 0.5 rotate 0 0 {angle}\n{inner}}}\n" for x, angle in ((-1, 30), (1, -30)))
            return text
        self.check("define tree (n 4) {\n  sphere { radius 0.5 }\n  if n > 1 {\n    tree { n (n - 1) translate -1 0 0 scale 0.5 rotate 0 0 30 }\n"
                   "    tree { n (n - 1) translate 1 0 0 scale 0.5 rotate 0 0 -30 }\n  }\n}\ntree { }\n", by_hand(4))

    def test_many_equal_uses(self):
        self.check("define d { sphere { radius 0.2 } cube { center 0 0.3 0 size 0.2 rotate 10 20 30 } torus { radius 0.3 tube_radius 0.05 } }\n"
                   "for i from -3 to 3 { for j from -3 to 3 { d { translate i 0 j rotate 0 (i * 20) 0 scale (1 + j / 10) } } }\n",
                   "".join(f"group {{ translate {i} 0 {j} rotate 0 {i * 20} 0 scale {number(1 + j / 10)} sphere {{ radius 0.2 }} "
                           f"cube {{ center 0 0.3 0 size 0.2 rotate 10 20 30 }} torus {{ radius 0.3 tube_radius 0.05 }} }}\n"
                           for i in range(-3, 4) for j in range(-3, 4)))

    def test_includes(self):
        (self.folder / "ball.txt").write_text("sphere { center x 0 0 radius (0.1 * x + 0.5) }\n")
        self.check("for x from -1 to 1 { include \"ball.txt\" }\n",
                   "".join(f"sphere {{ center {x} 0 0 radius {number(0.1 * x + 0.5)} }}\n" for x in range(-1, 2)))


class Frames(Equal):
    SCENE = ("animation { duration 0.5 fps 8 }\ncube { size 2 rotate 0 (90 * t) 0 }\nsphere { center -2 0 0 radius 0.5 }\n"
             "for i from 1 to frame { sphere { center (i - 1) 1.5 0 radius (0.3 + t / 10) } }\n")

    def setUp(self):
        super().setUp()
        if b"--frames" not in program.run("--help").stdout:
            self.skipTest("this program has no --frames")

    def frames(self, which, folder):
        (self.folder / folder).mkdir()
        (self.folder / "film.txt").write_text(SETTING + self.SCENE)
        done = program.run("film.txt", "--quiet", "--frames", which, "-o", f"{folder}/shot.####.png", cwd=self.folder)
        self.assertEqual(done.returncode, 0, done.stderr.decode())
        return {path.name: path.read_bytes() for path in (self.folder / folder).iterdir()}

    def test_alone_or_in_a_run(self):
        run = self.frames("all", "run")
        self.assertEqual(sorted(run), [f"shot.{frame:04}.png" for frame in range(1, 5)])
        self.assertEqual(len(set(run.values())), 4)
        for frame in range(1, 5):
            alone = self.frames(str(frame), f"alone{frame}")
            self.assertEqual(list(alone), [f"shot.{frame:04}.png"])
            self.assertTrue(alone[f"shot.{frame:04}.png"] == run[f"shot.{frame:04}.png"], frame)

    def test_each_is_the_still_written_by_hand(self):
        pictures = self.frames("1-4", "run")
        for frame in range(1, 5):
            with self.subTest(frame=frame):
                t = (frame - 1) / 8
                still = f"cube {{ size 2 rotate 0 {number(90 * t)} 0 }}\nsphere {{ center -2 0 0 radius 0.5 }}\n"
                still += "".join(f"sphere {{ center {i - 1} 1.5 0 radius {number(0.3 + t / 10)} }}\n" for i in range(1, frame + 1))
                run = pictures[f"shot.{frame:04}.png"]
                self.assertTrue(without_words(run) == without_words(self.picture(still, name=f"still{frame}")))

    def test_each_is_the_moment(self):
        run = self.frames("all", "run")
        for frame in range(1, 5):
            moment = self.picture(self.SCENE, "--time-at", str((frame - 1) / 8), name="moment")
            self.assertTrue(without_words(moment) == without_words(run[f"shot.{frame:04}.png"]), frame)


if __name__ == "__main__":
    unittest.main()
