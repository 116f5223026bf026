"""Pairs of renders that must show the same, or differ by a rule, whatever the scene is."""

import re
import unittest

from float_pictures import place, render, render_bytes, share_of_different_pixels

SIZE = "160x120"

# In the language of float_pictures.place(). Red, green and blue are never alike.
SCENES = {
    # Every kind of shape, in front of and behind others, some turned or squeezed, over an endless floor.
    "every shape": """
        camera { position @(0 2.2 7)  look_at @(0 0.8 0)  up ^(0 1 0)  vertical_fov 42 }
        light { position @(-4 5 5)  intensity ~900  color 1 0.9 0.7 }
        light { position @(5 4 2)  intensity ~~1500  color 0.5 0.7 1  falloff quadratic }
        background { color 0.1 0.2 0.4 }
        render { ambient 0.02 0.03 0.04 }
        material chrome { color 0.9 0.85 0.8  shininess 0.7 }
        plane { normal ^(0 1 0)  material { color 0.7 0.6 0.5  shininess 0.1 } }
        sphere { center @(-2.4 0.7 0)  radius @0.7  material chrome }
        sphere { center @(2.6 0.5 1.5)  radius @0.5  scale 1 0.6 1.4  %  material { color 0.9 0.3 0.2 } }
        cube { center @(-0.8 0.5 1.2)  size @0.9  rotate 0 25 0  %  material { color 0.2 0.7 0.3 } }
        quad { origin @(-4 0 -2)  width @(3 0 -0.5)  height @(0.2 2.5 0.1)  material chrome }
        disk { center @(0.4 1.9 -1.5)  normal ^(-0.2 0.3 1)  radius @0.8  material { color 0.2 0.4 0.9 } }
        cylinder { base @(0.9 0 0.3)  top @(1.2 1.3 0.1)  radius @0.35  material { color 0.8 0.8 0.2 } }
        cylinder { base @(3.2 0 -1)  top @(3.2 1.5 -1)  radius @0.5  open true  material { color 0.3 0.8 0.8 } }
        cone { base @(-1.3 0 -0.9)  top @(-1.2 1.6 -0.8)  radius @0.6  material { color 0.9 0.5 0.9 } }
        cone { base @(2.1 0 -0.6)  top @(2.1 0.9 -0.6)  radius @0.5  top_radius @0.2  material chrome }
        torus { center @(0.1 0.3 2.4)  axis ^(0.3 1 0.2)  radius @0.5  tube_radius @0.18
                material { color 0.9 0.6 0.1 } }
        triangle { a @(1.4 0.01 3)  b @(2.2 0.01 2.6)  c @(1.9 1.1 2.4)  material { color 0.4 0.9 0.4 } }
        """,
    # Light that only just skims everything flat, and what is round above its terminator.
    "grazing light": """
        camera { position @(0 3 6)  look_at @(0 0 0)  up ^(0 1 0) }
        light { position @(-9 0.05 -2)  intensity ~60000  color 1 0.8 0.6 }
        light directional { direction ^(-1 -0.004 0.2)  intensity 20000  color 0.3 0.6 0.9 }
        plane { normal ^(0 1 0)  point @(0 -0.5 0)  material { color 0.3 0.2 0.1 } }
        quad { origin @(-3 0 2)  width @(3 0 0)  height @(0 0 -4)  material { color 0.5 0.6 0.7 } }
        disk { center @(1.6 0.001 0.5)  normal ^(0 1 0)  radius @1.2  material { color 0.6 0.5 0.4 } }
        triangle { a @(0.2 0.002 -1)  b @(3 0.002 -1)  c @(1 0.002 -3)  material { color 0.4 0.5 0.6 } }
        sphere { center @(-1.5 0.05 0.5)  radius @0.05  material { color 0.9 0.3 0.3 } }
        cylinder { base @(2.6 -0.3 1.7)  top @(2.6 -0.1 1.7)  radius @0.7  material { color 0.5 0.7 0.5 } }
        """,
    # All is seen from inside, by light inside.
    "inside of everything": """
        camera { position @(0.6 0.3 1.8)  look_at @(-0.2 -0.1 -1)  up ^(0.1 1 0)  fov 80 }
        light { position @(0.3 0.9 0.4)  intensity ~400  color 1 0.9 0.8 }
        light spot { position @(-0.6 0.2 0.9)  look_at @(0 -1 -2)  angle 70  soft_edge 0.4  intensity ~900 }
        sphere { radius @9  material { color 0.5 0.7 0.9 } }
        cylinder { base @(0 0 4)  top @(0 0 -8)  radius @1.9  open true  material { color 0.8 0.7 0.6  shininess 0.4 } }
        cone { base @(0 0 -7)  top @(0 0 3)  radius @1.8  top_radius @1.7  open true  material { color 0.6 0.8 0.7 } }
        cube { center @(0 -0.2 -1)  size @(2.2 2 6)  material { color 0.7 0.7 0.9  shininess 0.3 } }
        torus { center @(0 0 -2)  axis ^(0 0 1)  radius @0.8  tube_radius @0.1  material { color 0.9 0.4 0.3 } }
        """,
    # Between mirrors, where each reflection starts on what the one before has found.
    "hall of mirrors": """
        camera { position @(0.5 1.2 2.6)  look_at @(-0.1 0.8 0)  up ^(0 1 0)  fov 60 }
        light { position @(0.4 2.6 1)  intensity ~350  color 0.9 1 0.8 }
        material mirror { color 0.95 0.9 0.85  shininess 0.9 }
        plane { normal ^(0 1 0)  material { color 0.6 0.5 0.4  shininess 0.2 } }
        plane { point @(0 3 0)  normal ^(0 1 0)  material { color 0.8 } }
        plane { point @(-2 0 0)  normal ^(1 0 0)  material mirror }
        plane { point @(2 0 0)  normal ^(1 0 0)  material mirror }
        plane { point @(0 0 -3)  normal ^(0 0 1)  material { color 0.4 0.6 0.8 } }
        plane { point @(0 0 3)  normal ^(0 0 1)  material mirror }
        sphere { center @(-0.8 0.5 -0.4)  radius @0.5  material mirror }
        cylinder { base @(0.7 0 -0.8)  top @(0.7 1.1 -0.8)  radius @0.3  material { color 0.9 0.4 0.3  shininess 0.3 } }
        torus { center @(0 0.2 0.6)  radius @0.35  tube_radius @0.15  axis ^(0 1 0)  material mirror }
        """,
}
# A cube can't be turned by numbers; its size is no point.
SCENES["inside of everything"] = SCENES["inside of everything"].replace(
    "size @(2.2 2 6) ", "size @2.2  scale 1 0.9 2.7  % ")

SAMPLES = (1, 4)


def picture(scene, *options):
    return render(scene, "--size", SIZE, *options)


class Relations(unittest.TestCase):
    def assert_same(self, a, b):
        self.assertLessEqual(share_of_different_pixels(a, b), 0.001)

    def for_all(self, check):
        for name, template in SCENES.items():
            for samples in SAMPLES:
                with self.subTest(scene=name, samples=samples):
                    check(template, ("--samples", samples))

    def test_the_scenes_show_something(self):
        for name, template in SCENES.items():
            with self.subTest(scene=name):
                values = picture(place(template)).values
                bright = sum(v > 0.1 for v in values) / len(values)
                self.assertGreater(bright, 0.25)
                self.assertLess(sum(v > 1 for v in values) / len(values), 0.25)

    def test_size(self):  # M1
        def check(template, options):
            as_written = picture(place(template), *options)
            for scale in (1e-3, 1e3, 1e6):
                with self.subTest(scale=scale):
                    self.assert_same(picture(place(template, scale=scale), *options), as_written)
        self.for_all(check)

    def test_size_by_a_group(self):  # M1
        for name, template in SCENES.items():
            as_written = picture(place(template))
            for scale in (1e-3, 1e3, 1e6):
                with self.subTest(scene=name, scale=scale):
                    self.assert_same(picture(in_group(template, f"scale {scale!r}", scale=scale)), as_written)

    def test_turn(self):  # M3
        def check(template, options):
            as_written = picture(place(template), *options)
            for axis in ((0, 1, 0), (1, 1, 1)):
                for degrees in (90, 37):
                    with self.subTest(axis=axis, degrees=degrees):
                        turned = picture(place(template, axis=axis, degrees=degrees), *options)
                        self.assert_same(turned, as_written)
        self.for_all(check)

    def test_turn_by_a_group(self):  # M3
        for name, template in SCENES.items():
            as_written = picture(place(template))
            for axis in ("0 1 0", "1 1 1"):
                for degrees in (90, 37):
                    with self.subTest(scene=name, axis=axis, degrees=degrees):
                        turned = in_group(template, f"rotate_axis {axis} {degrees}  pivot 0 0 0")
                        self.assert_same(picture(turned), as_written)

    def test_place_far_from_the_origin(self):
        # The scenes are some ten units large; out there a float is off by up to 6e-5 of them, which moves a few edges.
        for name, template in SCENES.items():
            with self.subTest(scene=name):
                far = picture(in_group(template, "translate 1024 -512 256"))
                self.assertLessEqual(share_of_different_pixels(far, picture(place(template))), 0.005)

    def test_twice_the_light(self):  # M5
        def check(template, options):
            scene = place(template)
            once = picture(scene, *options)
            twice = picture(times_two(scene), *options)
            self.assertEqual([2 * v for v in once.values], list(twice.values))
        self.for_all(check)

    def test_red_and_blue_swapped(self):  # M7
        def check(template, options):
            scene = place(template)
            once = picture(scene, *options)
            swapped = picture(swap_red_and_blue(scene), *options)
            self.assertNotEqual(once.values, swapped.values)
            self.assertEqual(once.values[0::3], swapped.values[2::3])
            self.assertEqual(once.values[1::3], swapped.values[1::3])
            self.assertEqual(once.values[2::3], swapped.values[0::3])
        self.for_all(check)

    def test_cube_made_of_other_things(self):  # M8
        around = """
            camera { position 2.5 2 3.5  look_at 0 0 0  fov 40 }
            light { position 3 4 2  intensity 900  color 1 0.9 0.8 }
            background { color 0.1 0.2 0.3 }
            plane { point 0 -0.7 0  material { color 0.7  shininess 0.2 } }
            sphere { center 1.2 0 -0.4  radius 0.4 }
            """
        for shininess in (0, 0.5):
            for samples in SAMPLES:
                pictures = {name: picture(f"""{around}
                    group {{
                      rotate 20 30 40
                      material {{ color 0.8 0.5 0.3  shininess {shininess} }}
                      {body}
                    }}""", "--samples", samples) for name, body in CUBES.items()}
                for name, other in pictures.items():
                    with self.subTest(made_of=name, shininess=shininess, samples=samples):
                        self.assert_same(pictures["cube"], other)
                without = picture(around, "--samples", samples)
                self.assertGreater(share_of_different_pixels(pictures["cube"], without), 0.1)

    def test_black_triangle_far_behind_the_camera(self):  # M11
        def check(template, options):
            scene = place(template)
            far = "triangle { a 0 0 1e7  b 1e6 0 1e7  c 0 1e6 1e7  material { color 0 } }"
            self.assert_same(picture(scene, *options), picture(scene + far, *options))
        self.for_all(check)

    def test_threads(self):  # M13
        def check(template, options):
            scene = place(template)
            for ending in (".pfm", ".png"):
                files = {threads: render_bytes(scene, "--size", SIZE, "--threads", threads, *options, ending=ending)
                         for threads in (1, 2, 3, 8)}
                files["again"] = render_bytes(scene, "--size", SIZE, *options, ending=ending)
                with self.subTest(ending=ending):
                    self.assertEqual(len(set(files.values())), 1)
        self.for_all(check)


def in_group(template, words, scale=1.0):
    """The scene with all its objects and lights in a group; the camera is placed by itself."""
    scene = re.sub(r"~~?([\d.]+)", lambda m: repr(float(m[1]) * (scale ** 2 if m[0][1] == "~" else scale)), template)
    scene = place(scene)
    settings = re.findall(r"^\s*(?:background|render) .*$", scene, re.MULTILINE)
    camera = re.search(r"^\s*camera \{(.*)\}$", scene, re.MULTILINE)
    inside = "\n".join(line for line in scene.splitlines()
                       if not re.match(r"\s*(camera|background|render|material \w+) ", line))
    materials = re.findall(r"^\s*material \w+ .*$", scene, re.MULTILINE)
    if words.startswith("scale"):
        camera_line = re.search(r"^\s*camera .*$", place(template, scale=scale), re.MULTILINE)[0]
    else:
        camera_line = f"camera {{ {camera[1]} {words} }}"
    return "\n".join([camera_line, *settings, *materials, f"group {{ {words}", inside, "}"])


def times_two(scene):
    """All that shines in the scene twice as strong."""
    def twice(match):
        return match[1] + " ".join(repr(2 * float(v)) for v in match[2].split())
    scene = re.sub(r"(intensity )([\d.e+]+)", twice, scene)
    scene = re.sub(r"(background \{ color )([\d. ]+)", twice, scene)
    return re.sub(r"(ambient )([\d. ]+)", twice, scene)


def swap_red_and_blue(scene):
    return re.sub(r"((?:color|ambient) )([\d.]+) ([\d.]+) ([\d.]+)", r"\1\4 \3 \2", scene)


def words(vector):
    return " ".join(map(str, vector))


def quad(origin, width, height):
    return f"quad {{ origin {words(origin)}  width {words(width)}  height {words(height)} }}"


def two_triangles(origin, width, height):
    b, c, d = ([sum(parts) for parts in zip(origin, *edges)] for edges in ([width], [width, height], [height]))
    return (f"triangle {{ a {words(origin)}  b {words(b)}  c {words(c)} }}\n"
            f"triangle {{ a {words(origin)}  b {words(c)}  c {words(d)} }}")


FACES = (  # origin, width, height of the cube's six
    ((-.5, -.5, .5), (1, 0, 0), (0, 1, 0)), ((.5, -.5, -.5), (-1, 0, 0), (0, 1, 0)),
    ((.5, -.5, .5), (0, 0, -1), (0, 1, 0)), ((-.5, -.5, -.5), (0, 0, 1), (0, 1, 0)),
    ((-.5, .5, .5), (1, 0, 0), (0, 0, -1)), ((-.5, -.5, -.5), (1, 0, 0), (0, 0, 1)))
CUBES = {
    "cube": "cube { }",
    "six quads": "\n".join(quad(*face) for face in FACES),
    "twelve triangles": "\n".join(two_triangles(*face) for face in FACES),
}


if __name__ == "__main__":
    unittest.main()
