"""Path-traced pictures whose values follow from a formula."""

import math
import unittest

from float_pictures import render

PATH = "render { method path  samples %d  %s }\n"


def mean(picture):
    """The mean of each channel."""
    count = len(picture.values) // 3
    return [sum(picture.values[c::3]) / count for c in range(3)]


def path(scene, samples=64, size="8x8", bounces=None, words=""):
    options = ["--size", size] + (["--bounces", str(bounces)] if bounces is not None else [])
    return render(PATH % (samples, words) + scene, *options)


def floor_radiance(lights, albedo=0.5, samples=1024, bounces=1, words=""):
    """What the point (0, 0, 0) of a floor facing up returns, seen from the side through a narrow camera."""
    return mean(path(f"""camera {{ position 6 0.5 0  look_at 0 0 0  fov 0.01 }}
        quad {{ origin -0.5 0 0.5  width 1 0 0  height 0 0 -1  material {{ color {albedo} }} }}
        {lights}""", samples, "4x4", bounces, words))


class Furnace(unittest.TestCase):
    """A scene that absorbs nothing, in light that is the same from everywhere, can't be seen (row B1)."""

    SKY = "background { color 1 }\ncamera { position 0 0 5  look_at 0 0 0  fov 50 }\n"

    def check(self, shapes, tolerance, samples=64):
        for value in mean(path(self.SKY + shapes, samples, "24x24")):
            self.assertLessEqual(abs(value - 1), tolerance, shapes)

    def test_white(self):
        self.check("sphere { material { color 1 } }\ncube { center 1.6 0 0  material { color 1 } }", 1e-6)

    def test_mirror(self):
        self.check("sphere { material { color 1  shininess 1 } }\ntorus { radius 1.6  material { color 1  shininess 1 } }", 1e-6)

    def test_half_mirror(self):
        self.check("sphere { material { color 1  shininess 0.5 } }", 1e-5)

    def test_clear_glass(self):
        self.check("sphere { material { color 1  transmission 1  ior 1.5 } }", 1e-3, 256)
        self.check("cube { size 1.5  rotate 20 30 0  material { color 1  transmission 1  ior 1.33 } }", 1e-3, 256)

    def test_glass_in_glass(self):
        self.check("""sphere { material { color 1  transmission 1  ior 1.5 } }
                      sphere { radius 0.5  material { color 1  transmission 1  ior 1 } }""", 1e-3, 256)

    def test_thin_glass(self):
        self.check("sphere { material { color 1  transmission 1  thin true } }", 1e-3, 256)

    def test_rough_metal(self):  # E5
        for roughness in (0.2, 0.5, 1):
            self.check(f"sphere {{ material {{ color 1  metallic 1  roughness {roughness} }} }}", 0.01, 256)

    def test_glass_with_holes(self):
        """Who comes in by a hole goes out by one: else its light would be squeezed on one of the ways only."""
        self.check("sphere { material { color 1  transmission 1  ior 1.5  alpha 0.5 } }", 1e-3, 256)
        self.check("cube { material { color 1  transmission 1  alpha checker { a 1  b 0  scale 0.3 } } }", 1e-3, 256)

    def test_rough_glass(self):
        for roughness in (0.3, 0.7):
            self.check(f"sphere {{ material {{ color 1  transmission 1  roughness {roughness} }} }}", 0.01, 256)

    # Light is long on its way in there: neither what its albedo lacks on each bounce nor the roulette may add up.
    def test_rough_diamond(self):
        ball = "sphere { material { color 1  transmission 1  ior 2.4  roughness 0.6 } }"
        picture = path(self.SKY.replace("fov 50", "fov 14") + ball, 256, "24x24")
        average = mean(picture)[0]
        self.assertLess(abs(average - 1), 0.006)
        spread = math.sqrt(sum((value - average) ** 2 for value in picture.values) / len(picture.values))
        self.assertLess(spread, 0.08)

    def test_coloured_ball(self):  # B2
        picture = path("background { color 1 }\ncamera { position 0 0 5  look_at 0 0 0  fov 10 }\n"
                       "sphere { material { color 0.2 0.5 0.8 } }", 16, "16x16")
        for value, albedo in zip(mean(picture), (0.2, 0.5, 0.8)):
            self.assertLessEqual(abs(value - albedo), 1e-3)


class Enclosed(unittest.TestCase):
    def test_shining_sphere_from_inside(self):  # B3
        for emission, albedo, expected in ((0.5, 0.5, 1), (1, 0.9, 10)):
            picture = path(f"camera {{ position 0.3 0.2 0.1  look_at 1 0 0 }}\n"
                           f"sphere {{ material {{ color {albedo}  emission {emission} }} }}", 256)
            for value in mean(picture):
                self.assertLessEqual(abs(value / expected - 1), 0.01)

    def test_point_light_in_a_sphere(self):  # B5
        picture = path("camera { position 0.3 0.2 0.1  look_at 1 0 0 }\nsphere { material { color 0.5 } }\n"
                       f"light {{ radiant_intensity {math.pi} {math.pi} {math.pi} }}", 1024)
        for value in mean(picture):
            self.assertLessEqual(abs(value - 1), 0.025)

    # No light is ever lost there: paths end for another reason.
    def test_closed_white_rooms_come_to_an_end(self):
        lit = mean(path("""camera { position 0 0 0  look_at 0 0 1 }
                           sphere { material { color 1 } }
                           light point { position 0 0.5 0  color 1 1 1 }""", 16))
        self.assertTrue(all(10 < value < 1e4 for value in lit), lit)

    # In there paths split more often than they end: there are more of them than there were at first.
    def test_paths_that_become_many(self):
        render(PATH % (2, "") + """camera { position 0 0 5  look_at 0 0 0 }
            sphere { radius 10  material { color 1 } }
            sphere { material { color 1  transmission 1  ior 4  roughness 0.6 } }
            light point { position 0 8 0 }""", "--size", "8x8")

    def test_bounces_are_counted(self):
        """In a closed sphere under a point light at its middle every scattering adds albedo times what came before."""
        scene = ("camera { position 0.3 0.2 0.1  look_at 1 0 0 }\nsphere { material { color 0.5 } }\n"
                 f"light {{ radiant_intensity {math.pi} {math.pi} {math.pi} }}")
        for bounces in range(4):
            expected = sum(0.5 ** n for n in range(1, bounces + 1))
            self.assertLessEqual(abs(mean(path(scene, 256, bounces=bounces))[0] - expected), 0.01, bounces)


class Irradiance(unittest.TestCase):
    """Radiance of a Lambert floor below a light: albedo / pi times the irradiance."""

    def check(self, lights, irradiance, samples=1024):
        for value in floor_radiance(lights, samples=samples):
            self.assertLessEqual(abs(value / (0.5 / math.pi * irradiance) - 1), 0.005, lights)

    def test_point_light(self):  # A3
        self.check("light { position 0 2 0  radiant_intensity 1 1 1 }", 0.25, 1)

    def test_disk(self):  # C1
        for h, expected in ((0.5, 2.51327), (1, 1.5708), (2, 0.628319), (4, 0.1848)):
            self.check(f"disk {{ center 0 {h} 0  material {{ color 0  emission 1 }} }}", expected)

    def test_sphere(self):  # C3
        for d, expected in ((1, 0.785398), (3, 0.0872665), (10, 0.00785398)):
            self.check(f"sphere {{ center 0 {d} 0  radius 0.5  material {{ color 0  emission 1 }} }}", expected)

    def test_rectangle(self):  # C4
        for a, b, h, expected in ((2, 2, 1, 1.74084), (1, 1, 1, 0.752275), (4, 1, 2, 0.621067)):
            self.check(f"light area {{ origin {-a / 2} {h} {-b / 2}  width {a} 0 0  height 0 0 {b}  radiance 1 1 1 }}",
                       expected)

    def test_rectangle_shines_on_its_own_side_only(self):
        self.assertEqual(floor_radiance("light area { origin -1 1 1  width 2 0 0  height 0 0 -2  radiance 1 1 1 }"),
                         [0, 0, 0])

    def test_light_that_is_there_in_part(self):
        for material, share in (("emission 1  alpha 0.4", 0.4), ("emission 1  alpha 0", 0),
                                ("emission 1  alpha (0.5 * u)", 0.25), ("emission (u)  alpha 0.5", 0.25)):
            scene = f"quad {{ origin -1 1 -1  width 2 0 0  height 0 0 2  material {{ color 0  {material} }} }}"
            for sampling in ("both", "lights", "materials"):
                with self.subTest(material=material, sampling=sampling):
                    value = floor_radiance(scene, samples=4096, words="sampling " + sampling)[0]
                    self.assertLessEqual(abs(value - share * 0.5 / math.pi * 1.74084), 0.002)

    def test_scaled_shapes(self):
        self.check("sphere { center 0 3 0  radius 0.25  scale 2  material { color 0  emission 1 } }", 0.0872665)
        self.check("disk { center 0 2 0  radius 0.5  scale 2 1 2  material { color 0  emission 1 } }", 0.628319)

    def test_area_light_as_a_shape_and_as_two_triangles(self):
        two = """triangle { a -1 1 -1  b 1 1 -1  c 1 1 1  material { color 0  emission 1 } }
                 triangle { a -1 1 -1  b 1 1 1  c -1 1 1  material { color 0  emission 1 } }"""
        self.check(two, 1.74084, 4096)


class Glass(unittest.TestCase):
    def test_reflectance_straight_on(self):  # D1: black behind the glass, white before it
        for ior in (1.33, 1.5, 2.42):
            scene = f"""camera {{ position 0 0 3  look_at 0 0 0  fov 1 }}
                background {{ color 1 }}
                cube {{ center 0 0 -2  size 2 2 2  material {{ color 1  transmission 1  ior {ior} }} }}
                quad {{ origin -50 -50 -2  width 100 0 0  height 0 100 0  material {{ color 0 }} }}"""
            expected = ((ior - 1) / (ior + 1)) ** 2
            for value in mean(path(scene, 1024, "8x8")):
                self.assertLessEqual(abs(value - expected), 0.02 * expected + 2e-4, ior)

    def test_absorption(self):
        """A slab of thickness 2 whose light halves with every unit; looked through straight on."""
        scene = """camera { position 0 0 5  look_at 0 0 0  fov 1 }
            background { color 1 }
            cube { size 4 4 2  material { color 1  transmission 1  ior 1
                                           attenuation_color 0.5 0.25 1  attenuation_distance 1 } }"""
        for value, expected in zip(mean(path(scene, 16)), (0.25, 0.0625, 1)):
            self.assertLessEqual(abs(value - expected), 1e-4)


if __name__ == "__main__":
    unittest.main()
