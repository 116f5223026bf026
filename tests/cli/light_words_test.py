"""The words of light from outside: what is told of slips in materials, lights and settings; which pictures are developed."""

import json
import tempfile
import pathlib
import unittest

import program

FRAME = "camera { position 0 0 5 } light { position 3 4 5 }\n"
SMALL = "image { size 16 12 }\n" + FRAME


def check(text, *options):
    done = program.run("check", "-", "--format", "json", *options, stdin=text.encode())
    return done.returncode, [json.loads(line) for line in done.stdout.decode().splitlines()]


def render(text, *options):
    done = program.run("-", "-o", "-", *options, stdin=text.encode())
    assert done.returncode == 0, done.stderr.decode()
    return done.stdout


class Messages(unittest.TestCase):
    def assert_says(self, text, line, words, severity, message, suggestion):
        code, messages = check(FRAME + text)
        self.assertEqual(code, 1 if severity == "error" else 0)
        self.assertEqual(len(messages), 1, messages)
        told = messages[0]
        self.assertEqual((told["severity"], told["message"], told["suggestion"]), (severity, message, suggestion))
        source = (FRAME + text).split("\n")[line - 1]
        self.assertEqual((told["line"], told["column"], told["end_column"]),
                         (line, source.index(words) + 1, source.index(words) + len(words) + 1))

    def test_contradictions(self):
        self.assert_says("sphere { material { metallic 1  transmission 1 } }", 2, "transmission 1", "error",
                         "a metal lets no light in: 'metallic' and 'transmission' contradict each other",
                         "remove one of them")
        self.assert_says("sphere { material { eta 0.1 0.2 0.3 } }", 2, "eta 0.1 0.2 0.3", "error",
                         "'eta' and 'k' make a metal together", "k 3.9 2.4 1.6")
        self.assert_says("sphere { } light { radiant_intensity 1 1 1  intensity 5 }", 2, "intensity 5", "error",
                         "a light has either 'radiant_intensity' or 'intensity'", "remove one of them")

    def test_albedo_over_1(self):
        self.assert_says("sphere { material { color 1.2 0 0 } }", 2, "1.2", "error",
                         "'color' must be between 0 and 1, found 1.2",
                         "1 is full strength; 0..255 is written #rrggbb")

    def test_zero_area_emitters(self):
        self.assert_says("sphere { } light area { width 2 0 0  height 1 0 0 }", 2, "width 2 0 0", "error",
                         "'width' and 'height' are parallel: they span no surface", "")

    def test_words_without_effect(self):
        self.assert_says("sphere { material { emission_strength 3 } }", 2, "emission_strength 3", "warning",
                         "'emission_strength' has no effect without 'emission'", "emission 1")
        self.assert_says("sphere { } render { exposure 1 }", 2, "exposure 1", "warning",
                         "'exposure' is for method path and has no effect in method classic",
                         "render { method path }")

    def test_words_to_come(self):
        self.assert_says("sphere { material { iridescence 1 } }", 2, "iridescence", "error",
                         "'iridescence' can't be shown yet", "a later version will; remove it")

    def test_a_misspelt_material_of_the_library(self):
        self.assert_says("sphere { material diamnod }", 2, "diamnod", "error", "there is no material 'diamnod'",
                         "did you mean 'diamond'?")

    def test_a_lamp_in_a_ball(self):
        self.assert_says("sphere { } sphere { center 9 0 0 } light { position 9 0 0 }", 2, "light", "warning",
                         "the light stands inside a closed shape, which hides it",
                         "give the shape a material with 'emission' to see it shine")

    def test_a_shining_shape_in_a_ball(self):
        self.assert_says("sphere { }\nsphere { radius 0.3  material { emission 1 } }", 3,
                         "sphere", "warning", "a shape that shines stands inside a closed shape, which hides it",
                         "give the outer shape a material with 'transmission', or move one of them")

    def test_what_nobody_can_see(self):
        eye = "camera { position 0 0 5 }\n"
        shining = "sphere { radius 0.3  material { emission 1 } }"
        lamp = "light area { origin -0.2 -0.2 0  width 0.4 0 0  height 0 0.4 0 }"
        hidden = "a shape that shines stands inside a closed shape"
        for scene, message in (
                (eye + "sphere { }" + shining, hidden), (eye + "cube { size 2 }" + lamp, hidden),
                (eye + "sphere { material glass }" + shining, None),
                ("camera { position 0 0 0.9 } sphere { }" + shining, None),  # a room
                ("camera { } light { position 0 0 9 } sphere { }", "the camera stands inside a closed shape"),
                ("camera { } light { position 0 0.5 0 } sphere { }", None),
                (eye + "render { method path } light { } sphere { material glass }", "no path finds a light without size")):
            with self.subTest(scene):
                code, messages = check(scene)
                self.assertEqual(code, 0)
                told = [m["message"] for m in messages if "inside" in m["message"] or "finds" in m["message"]]
                self.assertEqual(len(told), message is not None, told)
                self.assertTrue(all(message in m for m in told), told)

    def test_a_sun_far_below_the_horizon(self):
        self.assert_says("sky sun { elevation -30 }\nsphere {}", 2, "elevation -30", "warning",
                         "the sun is so far below the horizon that the sky is black", "elevation 10")

    def test_a_black_scene(self):
        code, messages = check("camera { position 0 0 5 } light { intensity 0 position 0 3 3 } sphere { }")
        self.assertEqual((code, [m["severity"] for m in messages]), (0, ["warning"]))
        self.assertIn("black", messages[0]["message"])

    def test_a_wrong_method(self):
        for value in ("", "phat", "Path", "1"):
            done = program.run("-", "-o", "-", "--method", value, stdin=SMALL.encode())
            self.assertEqual((done.returncode, done.stdout), (2, b""), value)
            self.assertIn(b"classic or path", done.stderr)


class Pictures(unittest.TestCase):
    SCENE = SMALL + "sphere { material { color tomato } }\n"

    def test_the_method_of_the_command_line_is_that_of_the_scene(self):
        for method in ("classic", "path"):
            said = render(f"render {{ method {method} }}\n" + self.SCENE, "--samples", "2")
            self.assertEqual(render(self.SCENE, "--method", method, "--samples", "2"), said)
            other = "path" if method == "classic" else "classic"
            self.assertEqual(render(f"render {{ method {other} }}\n" + self.SCENE, "--method", method, "--samples", "2"),
                             said)

    def test_the_seed_of_the_command_line_is_that_of_the_scene(self):
        said = render("render { seed 5 }\n" + self.SCENE, "--samples", "3")
        self.assertEqual(render(self.SCENE, "--samples", "3", "--seed", "5"), said)
        self.assertNotEqual(render(self.SCENE, "--samples", "3"), said)

    def test_floats_are_light_and_bytes_are_developed(self):
        with tempfile.TemporaryDirectory() as folder:
            def made(ending, words):
                path = pathlib.Path(folder) / f"out{ending}"
                scene = f"render {{ method path  samples 4  {words} }}\n" + self.SCENE
                done = program.run("-", "-o", path, stdin=scene.encode())
                self.assertEqual(done.returncode, 0, done.stderr)
                return path.read_bytes()
            for ending in (".pfm", ".exr"):
                self.assertEqual(made(ending, ""), made(ending, "exposure 2  tone agx  white_balance 3000"))
            for words in ("exposure 2", "tone agx", "white_balance 3000"):
                self.assertNotEqual(made(".png", ""), made(".png", words))


class Help(unittest.TestCase):
    def test_the_materials_of_the_library(self):
        page = program.run("help", "materials").stdout.decode()
        for name in ("gold", "silver", "copper", "aluminium", "chrome", "glass", "water", "plaster", "rubber", "plastic"):
            self.assertIn(f"  {name} ", page)
            shown = program.run("help", name).stdout.decode()
            body = shown[shown.index("material " + name):]
            # What help shows may be written, and is what the name stands for.
            scene = f"{SMALL}sphere {{ material {name} }}\n"
            self.assertEqual(render(body + scene), render(scene), name)


if __name__ == "__main__":
    unittest.main()
