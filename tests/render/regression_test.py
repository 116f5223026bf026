"""Every scene still renders as it did. A picture that should change is renewed by update_expected.py."""

import pathlib
import unittest

import pictures
import program

FAILURES = pathlib.Path(program.PROGRAM).resolve().parent / "render-failures"


def keep_failure(name, data):
    FAILURES.mkdir(exist_ok=True)
    path = FAILURES / name
    path.write_bytes(data)
    return path


class Regression(unittest.TestCase):
    def test_every_scene_looks_as_expected(self):
        expected = pictures.expected_pictures()
        self.assertGreater(len(expected), 20)
        for path, scene in expected.items():
            with self.subTest(pictures.name_of(scene)):
                self.check(scene, path)

    def check(self, scene, path):
        self.assertTrue(path.exists(), f"{path} is missing: tests/render/update_expected.py makes it")
        data = pictures.render(scene)
        problem = pictures.difference(pictures.read_png(data), pictures.read_png(path.read_bytes()))
        if problem:
            kept = keep_failure(path.name, data)
            self.fail(f"{problem}\nexpected: {path}\nrendered: {kept}\nagain:    {pictures.command(scene, kept)}")

    def test_nothing_is_expected_of_scenes_that_are_gone(self):
        self.assertEqual(set(pictures.EXPECTED.glob("*.png")) - set(pictures.expected_pictures()), set())


class Speckles(unittest.TestCase):
    """Figure 5 is figure 6 but for surfaces that shadow themselves here and there."""

    def test_without_an_epsilon_many_lit_points_are_dark(self):
        bare = pictures.read_png(pictures.render(pictures.SPECKLED, samples=1))[2]
        mended = pictures.read_png(pictures.render(pictures.SPECKLED.with_name("figure-6.txt"), samples=1))[2]
        lit = [i for i in range(0, len(mended), 3) if max(mended[i:i + 3]) > 60]
        dark = [i for i in lit if max(bare[i:i + 3]) == 0]
        self.assertGreater(len(lit), 2000)
        self.assertGreater(len(dark), 0.01 * len(lit))
        self.assertLess(len(dark), 0.8 * len(lit))


class Comparison(unittest.TestCase):
    """The comparison itself: what it must refuse, and what it must let pass."""

    def setUp(self):
        self.picture = pictures.read_png(pictures.render(pictures.SCENES / "shapes" / "sphere.txt"))

    def changed(self, change):
        width, height, pixels = self.picture
        pixels = bytearray(pixels)
        change(pixels, width)
        return width, height, bytes(pixels)

    def test_the_same_picture_passes(self):
        self.assertEqual(pictures.difference(self.picture, self.picture), "")

    def test_a_picture_moved_by_a_pixel_is_refused(self):
        def move(pixels, width):
            pixels[:] = pixels[3:] + pixels[:3]
        self.assertIn("% of the pixels", pictures.difference(self.changed(move), self.picture))

    def test_a_slightly_brighter_picture_is_refused(self):
        def brighten(pixels, width):
            pixels[:] = bytes(min(value + 1, 255) for value in pixels)
        self.assertIn("mean difference", pictures.difference(self.changed(brighten), self.picture))

    def test_swapped_channels_are_refused(self):
        def swap(pixels, width):
            pixels[0::3], pixels[2::3] = pixels[2::3], pixels[0::3]
        self.assertNotEqual(pictures.difference(self.changed(swap), self.picture), "")

    def test_another_size_is_refused(self):
        width, height, pixels = self.picture
        self.assertIn("pixels, not", pictures.difference((width, height - 1, pixels[:-3 * width]), self.picture))

    def test_a_few_roundings_pass(self):
        def round_otherwise(pixels, width):
            for i in range(0, len(pixels), 7):
                pixels[i] ^= 1
            for y in range(0, 20):  # samples on the other side of an edge
                pixels[3 * (y * width + y)] ^= 64
        self.assertEqual(pictures.difference(self.changed(round_otherwise), self.picture), "")


if __name__ == "__main__":
    unittest.main()
