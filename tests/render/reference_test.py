"""The program against an independent tracer, and against the project's reference picture where that is at hand."""

import array
import pathlib
import random
import tempfile
import unittest

import plain_tracer
import program
import reference_pictures
from float_pictures import Picture, render, render_bytes, share_of_different_pixels
from plain_tracer import Quad, Sphere

CLASSIC_POINT = program.ROOT / "tests" / "data" / "classic_point.txt"


def classic_point():
    """The scene of classic_point.txt."""
    return {
        "camera": {"position": (0, 1.6, 6), "look_at": (0, 0.8, 0), "up": (0, 1, 0), "vertical_fov": 40},
        "background": (0.1, 0.12, 0.18), "ambient": (0, 0, 0), "bounces": 4,
        "lights": [
            {"kind": "point", "position": (-3, 5, 4), "color": (3, 3, 2.8), "intensity": 255, "falloff": "linear"},
            {"kind": "point", "position": (4, 3, 3), "color": (1, 1.1, 1.4), "intensity": 255, "falloff": "linear"}],
        "shapes": [
            Quad((-30, 0, 30), (60, 0, 0), (0, 0, -60), (0.6, 0.6, 0.55), 0),
            Sphere((-1.3, 0.8, 0), 0.8, (0.8, 0.15, 0.1), 0),
            Sphere((1.4, 0.6, 0.8), 0.6, (0.15, 0.25, 0.8), 0),
            Sphere((0.5, 1, -1.6), 1, (1, 1, 1), 1)],
    }


def random_scene(seed, bounces):
    """A room's worth of spheres and quads, part mirrors among them, under lights of every kind."""
    dice = random.Random(seed)

    def point(low, high):
        return tuple(dice.uniform(a, b) for a, b in zip(low, high))

    def color():
        return point((0.1, 0.1, 0.1), (1, 1, 1))

    def shininess():
        return dice.choice((-0.5, 0, 0, 0.3, 0.6, 1, 1.5))

    shapes = [Quad((-8, 0, 8), (16, 0, 0), (0, 0, -16), color(), dice.choice((0, 0.2)))]
    for _ in range(6):
        radius = dice.uniform(0.2, 0.9)
        shapes.append(Sphere(point((-2.5, radius, -2), (2.5, 2, 2)), radius, color(), shininess()))
    shapes.append(Quad(point((-3, 0, -3), (2, 1, 0)), point((1, -0.5, -1), (2, 0.5, 1)),
                       point((-0.5, 1, -0.5), (0.5, 2, 0.5)), color(), shininess()))
    for wall in (-4, 7):  # mirrors before and behind the level camera, so that every bounce counts
        shapes.append(Quad((-6, 0, wall), (12, 0, 0), (0, 6, 0),
                           point((0.8, 0.8, 0.8), (1, 1, 1)), dice.choice((0.8, 0.9, 1))))
    high = ((-4, 3, 1), (4, 6, 5))
    lights = [
        {"kind": "point", "position": point(*high), "color": color(), "intensity": 700.0, "falloff": "linear"},
        {"kind": "", "position": point(*high), "color": color(), "intensity": 3000.0, "falloff": "quadratic"},
        {"kind": "point", "position": point(*high), "color": color(), "intensity": 60.0, "falloff": "none"},
        {"kind": "directional", "direction": point((-1, -2, -1), (1, -1, 0)), "color": color(), "intensity": 70.0},
        {"kind": "spot", "position": point(*high), "look_at": point((-1, 0, -1), (1, 1, 1)), "angle": 40.0,
         "soft_edge": dice.choice((0.0, 0.5, 1.0)), "color": color(), "intensity": 900.0,
         "falloff": dice.choice(("none", "linear", "quadratic"))},
    ]
    if lights[-1]["falloff"] == "none":
        lights[-1]["intensity"] = 150.0
    eye = dice.uniform(0.8, 1.6)
    return {
        "camera": {"position": point((-2, eye, 5), (2, eye, 6)), "look_at": point((-0.5, eye, 0), (0.5, eye, 0)),
                   "up": point((-0.3, 1, -0.3), (0.3, 1, 0.3)), "vertical_fov": dice.uniform(30, 60)},
        "background": color(), "ambient": point((0, 0, 0), (0.1, 0.1, 0.1)), "bounces": bounces,
        "lights": dice.sample(lights, 4), "shapes": shapes,
    }


class PlainTracer(unittest.TestCase):
    def check(self, scene, text, width, height):
        expected = Picture(width, height, array.array("f", plain_tracer.render(scene, width, height)))
        found = render(text, "--size", f"{width}x{height}")
        self.assertLessEqual(share_of_different_pixels(found, expected), 0.001, text)
        # Where edges do not matter the two agree far better than an 8-bit picture could show.
        differences = sorted(abs(a - b) for a, b in zip(found.values, expected.values))
        self.assertLess(differences[int(0.99 * len(differences))], 1e-5, text)

    def test_classic_point(self):
        self.check(classic_point(), CLASSIC_POINT.read_text(encoding="utf-8"), 160, 120)

    def test_random_scenes(self):
        for seed, bounces in enumerate((0, 1, 2, 3, 4, 4)):
            with self.subTest(seed=seed, bounces=bounces):
                scene = random_scene(seed, bounces)
                text = plain_tracer.text_of(scene)
                self.check(scene, text, 80, 60)
                # The scene is one in which a bounce more would not pass the comparison.
                more = render(text, "--size", "80x60", "--bounces", bounces + 1)
                self.assertGreater(share_of_different_pixels(render(text, "--size", "80x60"), more), 0.001)

    def test_large_random_scene(self):
        scene = random_scene(100, 4)
        self.check(scene, plain_tracer.text_of(scene), 160, 120)


class ReferencePicture(unittest.TestCase):
    """Compared by the reference's own script. RAYTRACER_REFERENCE names the folder with compare.py."""

    def compare(self, falloff, *options):
        scene = CLASSIC_POINT.read_text(encoding="utf-8").replace("light {", f"light {{ falloff {falloff} ")
        with tempfile.TemporaryDirectory() as folder:
            picture = pathlib.Path(folder) / "classic_point.pfm"
            picture.write_bytes(render_bytes(scene))
            done = reference_pictures.compare("classic_point", picture, *options)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertTrue(done.stdout.startswith("ok"), done.stdout)

    def test_classic_point(self):
        self.compare("linear")

    def test_classic_point_by_inverse_square(self):
        self.compare("quadratic", "--alt")


if __name__ == "__main__":
    unittest.main()
