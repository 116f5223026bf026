"""Pairs of path-traced pictures that must show the same, or differ by a rule."""

import math
import re
import unittest

from float_pictures import Picture, place, render, render_bytes

ROOM = """
    camera { position @(0 1 3.9)  look_at @(0 1 0)  up ^(0 1 0)  vertical_fov 39 }
    quad { origin @(-1 0 1)  width @(2 0 0)  height @(0 0 -2)  material { color 0.73 } }
    quad { origin @(-1 2 -1)  width @(2 0 0)  height @(0 0 2)  material { color 0.73 } }
    quad { origin @(-1 0 -1)  width @(2 0 0)  height @(0 2 0)  material { color 0.7 0.72 0.6 } }
    quad { origin @(-1 0 1)  width @(0 0 -2)  height @(0 2 0)  material { color 0.65 0.05 0.1 } }
    quad { origin @(1 0 -1)  width @(0 0 2)  height @(0 2 0)  material { color 0.12 0.45 0.15 } }
    sphere { center @(0.4 0.45 0.3)  radius @0.4  material { color 1 0.9 0.8  transmission 1  ior 1.5 } }
    sphere { center @(-0.45 0.4 -0.35)  radius @0.4  material { color 0.9 0.6 0.3  metallic 1  roughness 0.4 } }
    light area { origin @(-0.4 1.99 -0.4)  width @(0.8 0 0)  height @(0 0 0.8)  radiance 9 8 6 }
    """
SKY = "background { color 0.3 0.4 0.6 }\n"
SIZE = "32x32"


def path(scene, samples=64, *options, size=SIZE):
    return render(f"render {{ method path  samples {samples} }}\n" + scene, "--size", size, *options)


def path_bytes(scene, samples=16, *options):
    return render_bytes(f"render {{ method path  samples {samples} }}\n" + scene, "--size", SIZE, *options)


def blocks(picture, side=8):
    """Means of each channel over blocks of side x side pixels."""
    result = []
    for y in range(0, picture.height, side):
        for x in range(0, picture.width, side):
            cells = [picture.at(x + i, y + j) for i in range(side) for j in range(side)]
            result += [sum(cell[c] for cell in cells) / len(cells) for c in range(3)]
    return result


def mirror_image(picture):
    values = [v for y in range(picture.height) for x in reversed(range(picture.width)) for v in picture.at(x, y)]
    return Picture(picture.width, picture.height, values)


def block_difference(a, b):
    """compare.py's block_rel: the root mean square of the relative differences of 8 x 8 blocks."""
    first, second = blocks(a), blocks(b)
    floor = 0.05 * sum(second) / len(second)
    squares = [min(abs(x - y) / (y + floor), 1) ** 2 for x, y in zip(first, second)]
    return math.sqrt(sum(squares) / len(squares))


def swapped(text):
    """Red and blue exchanged in every colour of ROOM and SKY."""
    return re.sub(r"(color|radiance) ([\d.]+) ([\d.]+) ([\d.]+)", r"\1 \4 \3 \2", text)


class Relations(unittest.TestCase):
    def test_scale(self):  # M1
        once = path(SKY + place(ROOM), 256)
        for scale in (1e-3, 1e3, 1e6):
            self.assertLess(block_difference(path(SKY + place(ROOM, scale), 256), once), 0.02, scale)

    def test_turning(self):  # M3: lights are quads, so that they turn with their numbers
        once = path(SKY + place(ROOM), 256)
        for axis, degrees in (((0, 1, 0), 90), ((0, 1, 0), 37), ((1, 1, 1), 37)):
            turned = path(SKY + place(ROOM, axis=axis, degrees=degrees), 256)
            self.assertLess(block_difference(turned, once), 0.02, (axis, degrees))

    def test_mirrored(self):
        """A room, its lamp and what lies on its walls, mirrored, are the mirror image of the picture."""
        camera, things = place(ROOM).split("\n", 2)[1:]
        things += """triangle { a -0.9 0.2 0.5  b -0.6 0.9 0.5  c -0.9 0.2 -0.2
                                 material { color (0.5 + n.y, 0.5, 0.5 - n.y) } }
            quad { origin -0.9 1 0.5  width 0 0 -0.8  height 0 0.8 0  material { color 0.8  bump dots { scale 0.2 } } }"""
        for method in ("path", "classic"):
            def show(text):
                return render(f"render {{ method {method}  samples 64 }}\n" + SKY + camera + text, "--size", SIZE)
            expected = mirror_image(show(things))
            for mirrored in (f"group {{ scale -1 1 1\n{things} }}",
                             f"define room() {{\n{things} }}\nroom {{ scale -1 1 1 }}"):
                self.assertLess(block_difference(show(mirrored), expected), 0.02, (method, mirrored))

    def test_both_sides_of_an_open_surface(self):
        """What has no inside looks alike from both sides, in both methods."""
        for words in ("color 0 roughness 0.5 ior 2.4", "color 0.5 coat 1", "color 0.5 roughness 0.3",
                      "metallic 1 roughness 0.5 eta 0.143 0.375 1.442 k 3.983 2.386 1.603",
                      "transmission 1 thin true roughness 0.5"):
            shown = [render(f"""camera {{ position 0 0 5  look_at 0 0 0  fov 1 }}
                         render {{ method {method}  samples 16  bounces 1 }}
                         disk {{ normal 0 0 {side}  radius 2  material {{ {words} }} }}
                         light directional {{ direction 0.5 -0.5 -1 }}""", "--size", "4x4").at(1, 1)
                     for method in ("path", "classic") for side in (1, -1)]
            self.assertGreater(max(shown[0]), 0.005, words)
            for other in (shown[1], shown[2], shown[3]):
                for a, b in zip(shown[0], other):
                    self.assertLessEqual(abs(a - b), 1e-4 + 0.01 * a, (words, shown))

    def test_twice_the_light(self):  # M5
        once = path(SKY + place(ROOM), 16)
        twice = path(SKY.replace("0.3 0.4 0.6", "0.6 0.8 1.2") + place(ROOM).replace("radiance 9 8 6", "radiance 18 16 12"), 16)
        self.assertEqual([2 * v for v in once.values], list(twice.values))

    def test_red_and_blue_exchanged(self):  # M7
        scene = SKY + place(ROOM)
        once, other = path(scene, 16), path(swapped(scene), 16)
        for c, d in ((0, 2), (1, 1), (2, 0)):
            self.assertEqual(once.values[c::3], other.values[d::3])

    def test_black_triangles_far_behind(self):  # M11
        once = path(SKY + place(ROOM), 16)
        more = path(SKY + place(ROOM) + "triangle { a -1 0 9e5  b 1 0 9e5  c 0 1 9e5  material { color 0 } }", 16)
        self.assertLess(block_difference(more, once), 0.001)

    def test_threads(self):  # M13
        once = path_bytes(SKY + place(ROOM), 8, "--threads", "1")
        for threads in ("2", "3", "8"):
            self.assertEqual(path_bytes(SKY + place(ROOM), 8, "--threads", threads), once)
        self.assertEqual(path_bytes(SKY + place(ROOM), 8, "--threads", "1"), once)

    def test_glass_of_index_1_is_not_there(self):  # M16
        scene = SKY + place(ROOM)
        ball = "sphere { center 0 1.2 0.5  radius 0.4  material { color 1  transmission 1  ior 1 } }"
        self.assertLess(block_difference(path(scene + ball, 256), path(scene, 256)), 0.04)

    def test_water_that_reaches_into_the_glass(self):
        """A tank of glass with water in it, that overlaps its walls a little, and the same as glass with a body of water in it."""
        scene = """camera { position 0 0.6 8  look_at 0 0 0  fov 30 }
            background { color 0.4 0.5 0.6 }
            quad { origin -9 -9 -4  width 9 0 0  height 0 18 0  material { color 0.9 0.2 0.1 } }
            quad { origin 0 -9 -4  width 9 0 0  height 0 18 0  material { color 0.1 0.3 0.9 } }
            light { position 3 5 6  intensity 900 }
            """
        corners = "(-S,-S,-S) (S,-S,-S) (S,S,-S) (-S,S,-S) (-S,-S,S) (S,-S,S) (S,S,S) (-S,S,S) "
        tank = f"""mesh {{ material glass  vertices {corners.replace("S", "1.2")} {corners}
            faces 0 2 1 0 3 2  4 5 6 4 6 7  0 1 5 0 5 4  3 7 6 3 6 2  0 4 7 0 7 3  1 2 6 1 6 5
                  8 9 10 8 10 11  12 14 13 12 15 14  8 13 9 8 12 13  11 14 15 11 10 14  8 15 12 8 11 15  9 14 10 9 13 14 }}
            cube {{ size 2.02  material water }}""".replace("S", "1")
        bodies = "cube { size 2.4  material glass }\ncube { size 2  material water }"
        overlapping, nested = (path(scene + f"group {{ rotate 0 30 0\n{inside} }}", 64) for inside in (tank, bodies))
        self.assertLess(block_difference(overlapping, nested), 0.03)

    def test_light_and_material_sampling(self):  # M24
        scene = SKY + place(ROOM).replace("transmission 1  ior 1.5", "roughness 0.5")

        def runs(sampling):
            text = f"render {{ method path  samples 64  sampling {sampling} }}\n" + scene
            return [render(text, "--size", SIZE, "--seed", str(seed)) for seed in range(4)]

        pictures = {name: runs(name) for name in ("both", "lights", "materials")}
        total = {name: [sum(blocks(p)) for p in some] for name, some in pictures.items()}
        for name in ("lights", "materials"):
            mean, both = sum(total[name]) / 4, sum(total["both"]) / 4
            self.assertLess(abs(mean / both - 1), 0.02, (name, total))

        def variance(some):
            values = [blocks(p, 4) for p in some]
            result = 0
            for cell in zip(*values):
                middle = sum(cell) / len(cell)
                result += sum((v - middle) ** 2 for v in cell)
            return result

        better = min(variance(pictures["lights"]), variance(pictures["materials"]))
        self.assertLess(variance(pictures["both"]), 1.5 * better)


if __name__ == "__main__":
    unittest.main()
