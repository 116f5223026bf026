"""Few samples see the same far texture as many: its average."""

import unittest

import float_pictures

CHECKER = """
camera { position 0 1.6 6  look_at 0 0.6 0  fov 45 }
render { ambient 1 }
background { color 0.5 }
plane { material { color checker { a 1  b 0  rotate 0 %d 0 } } }
"""


def mean_difference(scene, *options):
    few = float_pictures.render(scene, "--size", "360x200", "--samples", "4", *options)
    many = float_pictures.render(scene, "--size", "360x200", "--samples", "100", *options)
    return sum(abs(a - b) for a, b in zip(few.values, many.values)) / len(many.values)


class Far(unittest.TestCase):
    def test_a_checker_to_the_horizon_is_its_average(self):
        for turn in (0, 30):
            with self.subTest(turn):
                self.assertLess(mean_difference(CHECKER % turn), 4 / 255)


if __name__ == "__main__":
    unittest.main()
