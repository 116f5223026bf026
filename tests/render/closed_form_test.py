"""Pictures whose values or outlines follow from a formula."""

import math
import unittest

from float_pictures import place, render

# Floors that go through y = 0 under a light, as far as 30 to every side.
FLOORS = {
    "plane": "plane { MATERIAL }",
    "quad": "quad { origin -30 0 30  width 60 0 0  height 0 0 -60  MATERIAL }",
    "disk": "disk { radius 30  MATERIAL }",
    "cube": "cube { center 0 -2 0  size 60 4 60  MATERIAL }",
    "triangle": "triangle { a -60 0 60  b 60 0 60  c 0 0 -60  MATERIAL }",
    "cylinder": "cylinder { base 0 -1 0  top 0 0 0  radius 30  MATERIAL }",
    "cone": "cone { base 0 0 0  top 0 -9 0  radius 30  MATERIAL }",
    "scaled cube": "cube { size 2  scale 30 1 30  translate 0 -1 0  MATERIAL }",
}
DISTANCES = (0, 1, 2, 5)


def floor_value(distance, height=2.0, floor="plane", falloff="linear", intensity=255.0, color=1.0, scale=1.0):
    """What a camera right above sees of the floor at a distance from the point below the light."""
    material = f"material {{ color {color!r} }}"
    picture = render(f"""
        image {{ size 1 1 }}
        camera {{ position {distance * scale!r} {scale!r} 0  look_at {distance * scale!r} 0 0  up 0 0 -1 }}
        light {{ position 0 {height * scale!r} 0  intensity {intensity!r}  falloff {falloff} }}
        {FLOORS[floor].replace("MATERIAL", material)}""")
    red, green, blue = picture.at(0, 0)
    assert red == green == blue
    return red


class Light(unittest.TestCase):
    def assert_close(self, value, expected, relative=1e-5):
        self.assertLessEqual(abs(value - expected), relative * abs(expected), f"{value} is not {expected}")

    def test_paper_law_under_a_point_light(self):  # A1
        for floor in FLOORS:
            for distance, expected in zip(DISTANCES, (0.5, 0.4, 0.25, 2 / 29)):
                with self.subTest(floor=floor, distance=distance):
                    self.assert_close(floor_value(distance, floor=floor), expected)

    def test_inverse_square_law_under_a_point_light(self):  # A2
        for distance in DISTANCES:
            with self.subTest(distance=distance):
                expected = 2 / (4 + distance * distance) ** 1.5
                self.assert_close(floor_value(distance, falloff="quadratic"), expected)

    def test_no_falloff_leaves_the_cosine(self):
        for distance in DISTANCES:
            with self.subTest(distance=distance):
                self.assert_close(floor_value(distance, falloff="none"), 2 / math.sqrt(4 + distance * distance))

    def test_physical_radiance_straight_below(self):  # A3: albedo 0.5, radiant intensity 1
        self.assert_close(floor_value(0, falloff="quadratic", intensity=255 / math.pi, color=0.5), 0.5 / math.pi / 4)

    def test_doubling_every_length(self):  # A4
        for falloff, factor in (("none", 1), ("linear", 2), ("quadratic", 4)):
            for distance in DISTANCES:
                with self.subTest(falloff=falloff, distance=distance):
                    once = floor_value(distance, falloff=falloff)
                    twice = floor_value(distance, falloff=falloff, scale=2.0)
                    self.assertEqual(factor * twice, once)

    def test_ratio_of_the_two_laws(self):  # A5
        for d in (1.0, 2.0, 10.0):
            with self.subTest(distance=d):
                ratio = floor_value(0, height=d) / floor_value(0, height=d, falloff="quadratic")
                self.assert_close(ratio, d, 5e-7)  # two roundings to float

    def test_lights_add_and_colours_multiply(self):
        picture = render("""
            image { size 1 1 }
            camera { position 0 1 0  look_at 0 0 0  up 0 0 -1 }
            light { position 0 2 0  intensity 255  color 1 0.5 0 }
            light { position 0 4 0  intensity 255  color 0 0.5 1 }
            light directional { intensity 25.5 }
            light spot { position 0 8 0  intensity 255  color 0 0 1 }
            render { ambient 0 0 0.25 }
            plane { material { color 0.8 0.4 0.2 } }""")
        expected = (0.8 * (0.5 + 0.1), 0.4 * (0.25 + 0.125 + 0.1), 0.2 * (0.25 + 0.1 + 0.125 + 0.25))
        for value, wanted in zip(picture.at(0, 0), expected):
            self.assert_close(value, wanted)

    def test_facing_mirrors(self):  # F10
        # From the middle between the mirrors x = -1 and x = 1 at 45 degrees: the n-th reflection is at z = -(2n - 1).
        for n in range(1, 7):
            scene = f"""
                image {{ size 1 1 }}
                camera {{ look_at 1 0 -1 }}
                light {{ position 0 50 0 }}
                background {{ color 1 }}
                material mirror {{ color 0.8  shininess 1 }}
                quad {{ origin -1 -1 0  width 0 2 0  height 0 0 {-2 * n}  material mirror }}
                quad {{ origin 1 -1 0  width 0 2 0  height 0 0 {-2 * n}  material mirror }}"""
            with self.subTest(reflections=n):
                self.assert_close(render(scene, "--bounces", n).at(0, 0)[0], 0.8 ** n)
                self.assertEqual(render(scene, "--bounces", n - 1).at(0, 0), (0, 0, 0))

    def test_part_mirrors(self):
        # Each of the two parallel part mirrors gives (1 - s) C ambient, and s C of what the other shows.
        for bounces in (0, 1, 2, 5):
            picture = render("""
                image { size 1 1 }
                camera { }
                render { ambient 0.5 }
                material part { color 0.8  shininess 0.25 }
                plane { point 0 0 -1  normal 0 0 1  material part }
                plane { point 0 0 1  normal 0 0 1  material part }""", "--bounces", bounces)
            with self.subTest(bounces=bounces):
                expected = sum(0.75 * 0.8 * 0.5 * (0.25 * 0.8) ** k for k in range(bounces + 1))
                self.assert_close(picture.at(0, 0)[0], expected)


class GrazingLight(unittest.TestCase):
    """No pixel of a lone flat surface is in shadow, however low the light, however large and turned the scene."""

    WIDTH, HEIGHT = 64, 48
    SURFACES = {
        "plane": "plane { point @(0 0 0)  normal ^(0 1 0) }",
        "quad": "quad { origin @(-9 0 9)  width @(18 0 0)  height @(0 0 -18) }",
        "disk": "disk { center @(0 0 0)  normal ^(0 1 0)  radius @12 }",
        "triangle": "triangle { a @(-30 0 12)  b @(30 0 12)  c @(0 0 -40) }",
        "cube": "cube { center @(0 -0.5 0)  size @1  scale 18 1 18 % }",
        "cylinder": "cylinder { base @(0 -1 0)  top @(0 0 0)  radius @12 }",
        "cone": "cone { base @(0 0 0)  top @(0 -5 0)  radius @12 }",
    }

    def expected(self, light_height):
        """The value of each pixel for the white 0.8 surface y = 0 of any extent, where it is hit."""
        tangent = math.tan(math.radians(25))
        for row in range(self.HEIGHT):
            for column in range(self.WIDTH):
                # Camera at (0, 3, 4), looking at the origin: forward (0, -0.6, -0.8), up (0, 0.8, -0.6).
                a = (2 * (column + 0.5) / self.WIDTH - 1) * tangent
                b = (1 - 2 * (row + 0.5) / self.HEIGHT) * tangent * self.HEIGHT / self.WIDTH
                t = 3 / (0.6 - 0.8 * b)
                x, z = t * a, 4 + t * (-0.8 - 0.6 * b)
                yield 0.8 * light_height / ((x + 4) ** 2 + (z - 1) ** 2 + light_height ** 2)

    def test_no_speckles(self):
        for light_height in (0.5, 0.01):
            expected = list(self.expected(light_height))
            for name, surface in self.SURFACES.items():
                for scale in (1e-3, 1.0, 1e3, 1e6):
                    for axis, degrees in (((0, 1, 0), 0), ((1, 1, 1), 37), ((3, -1, 2), 123)):
                        with self.subTest(surface=name, scale=scale, turned=degrees, light_height=light_height):
                            picture = render(place(f"""
                                image {{ size {self.WIDTH} {self.HEIGHT} }}
                                camera {{ position @(0 3 4)  look_at @(0 0 0)  up ^(0 1 0)  fov 50 }}
                                light {{ position @(-4 {light_height} 1)  intensity ~255 }}
                                {surface}""", scale, axis, degrees))
                            # A float rounds the place of light and point by 1e-6 of the scene: so much is the
                            # height above the surface off, at a distance of at least 1.
                            worst = max(abs(v - e) for v, e in zip(picture.values[::3], expected))
                            self.assertLess(worst, 1e-4 * max(expected) + 5e-6)


def outline(picture):
    """(area, centre x, centre y, semi-axis along x, along y) of what is white, in pixels, by its moments."""
    area = sum_x = sum_y = sum_xx = sum_yy = 0.0
    for y in range(picture.height):
        row = picture.values[3 * picture.width * y:3 * picture.width * (y + 1):3]
        for x, value in enumerate(row):
            if value:
                area += value
                sum_x += value * (x + 0.5)
                sum_y += value * (y + 0.5)
                sum_xx += value * (x + 0.5) ** 2
                sum_yy += value * (y + 0.5) ** 2
    x, y = sum_x / area, sum_y / area
    return area, x, y, 2 * math.sqrt(sum_xx / area - x * x), 2 * math.sqrt(sum_yy / area - y * y)


class Outlines(unittest.TestCase):
    def check_sphere(self, offset, words):
        # The cone around a sphere cuts the picture's plane in an ellipse; f pixels are the distance of that plane.
        f = 384 / 2 / math.tan(math.radians(30))
        distance = math.hypot(offset, 4)
        sin_g, sin_b, cos_b = 1 / distance, offset / distance, 4 / distance
        cos_g = math.sqrt(1 - sin_g ** 2)
        q = cos_b ** 2 - sin_g ** 2
        along, across, center = f * sin_g * cos_g / q, f * sin_g / math.sqrt(q), f * sin_b * cos_b / q
        area, x, y, semi_x, semi_y = outline(render(f"""
            image {{ size 512 384 }}
            camera {{ vertical_fov 60 }}
            render {{ ambient 1 }}
            sphere {{ center {offset} 0 -4  material {{ color 1 }} {words} }}"""))
        self.assertAlmostEqual(x, 256 + center, delta=0.5)
        self.assertAlmostEqual(y, 192, delta=0.5)
        self.assertAlmostEqual(semi_x, along, delta=0.5)
        self.assertAlmostEqual(semi_y, across, delta=0.5)
        self.assertLess(abs(area / (math.pi * along * across) - 1), 0.003)
        return along, across, center

    def test_sphere_in_the_middle(self):  # F1
        along, across, center = self.check_sphere(0, "")
        self.assertAlmostEqual(along, 85.865, delta=1e-3)
        self.assertAlmostEqual(across, 85.865, delta=1e-3)
        self.assertEqual(center, 0)

    def test_sphere_aside(self):  # F2
        along, across, center = self.check_sphere(1.5, "")
        self.assertAlmostEqual(along, 92.08, delta=1e-3)
        self.assertAlmostEqual(across, 85.865, delta=1e-3)
        self.assertAlmostEqual(256 + center, 389.022, delta=1e-3)

    def test_turned_sphere_is_the_same(self):
        self.check_sphere(1.5, "rotate 10 20 30")

    def test_squeezed_sphere_is_its_shadow(self):
        # Far away an ellipsoid shows its own semi-axes: f / 4000 pixels a unit.
        f = 384 / 2 / math.tan(math.radians(30))
        area, x, y, semi_x, semi_y = outline(render("""
            image { size 512 384 }
            camera { vertical_fov 60 }
            render { ambient 1 }
            sphere { center 0 0 -4000  scale 1200 600 10  material { color 1 } }"""))
        self.assertAlmostEqual(x, 256, delta=0.5)
        self.assertAlmostEqual(y, 192, delta=0.5)
        self.assertAlmostEqual(semi_x, f * 0.3, delta=0.5)
        self.assertAlmostEqual(semi_y, f * 0.15, delta=0.5)
        self.assertLess(abs(area / (math.pi * f * 0.3 * f * 0.15) - 1), 0.003)

    def test_horizon_of_an_endless_floor(self):  # F4
        for height in (100, 101):
            for unit in (1e-3, 1.0, 1e6):
                picture = render(f"""
                    image {{ size 16 {height} }}
                    camera {{ position 0 {1.6 * unit!r} 0 }}
                    render {{ ambient 1 }}
                    plane {{ material {{ color 1 }} }}""")
                for y in range(height):
                    row = {picture.at(x, y) for x in range(picture.width)}
                    with self.subTest(height=height, unit=unit, row=y):
                        if y + 1 <= height / 2 - 0.5:
                            self.assertEqual(row, {(0, 0, 0)})
                        if y >= height / 2 + 0.5:
                            self.assertEqual(row, {(1, 1, 1)})

    def test_edge_of_a_half_plane(self):  # F6
        size = 64
        picture = render(f"""
            image {{ size {size} {size} }}
            camera {{ }}
            render {{ ambient 1  samples 1024 }}
            group {{
              rotate 0 0 30
              quad {{ origin -100 -100 -4  width 200 0 0  height 0 100 0  material {{ color 1 }} }}
            }}""")
        red = picture.values[::3]
        self.assertAlmostEqual(sum(red) / len(red), 0.5, delta=1e-3)
        # Pixels that the line through the centre crosses; both signs stand at their corners.
        edge = []
        slope = math.tan(math.radians(30))
        for y in range(size):
            for x in range(size):
                sides = [(size / 2 - b) - slope * (a - size / 2) for a in (x, x + 1) for b in (y, y + 1)]
                if min(sides) < 0 < max(sides):
                    edge.append(red[size * y + x])
                else:
                    self.assertEqual(red[size * y + x], 1 if max(sides) <= 0 else 0)
        self.assertGreater(len(edge), size)
        self.assertAlmostEqual(sum(edge) / len(edge), 0.5, delta=1e-3)


if __name__ == "__main__":
    unittest.main()
