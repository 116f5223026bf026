"""What the command line changes in a scene and tells of it: --set, --limit, params, --stats."""

import json
import pathlib
import tempfile
import unittest

import program

FRAME = "image { size 8 8 }\nlight { position 0 0 5 }\ncamera { position 0 0 5 }\n"
SCENE = FRAME + "let n = 1\nlet hat = red\nlet spot = (0, 0, 0)\nlet word = \"a=b\"\n" \
                "for i from 1 to n { sphere { center (spot + (0, i - 1, 0)) material { color hat } } }\n"


def run(*arguments, scene=SCENE):
    return program.run(*arguments, stdin=scene.encode())


class InAScene(unittest.TestCase):
    def assert_usage(self, done, *words):
        self.assertEqual((done.returncode, done.stdout), (2, b""), done.stderr)
        for word in words:
            self.assertIn(word, done.stderr.decode())


class Set(InAScene):
    def params(self, *arguments):
        done = run("params", "-", *arguments)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done.stdout.decode().splitlines()

    def test_params_lists_them_in_their_order(self):
        self.assertEqual(self.params(), ["n = 1", "hat = #ff0000", "spot = (0, 0, 0)", 'word = "a=b"'])

    def test_a_value_takes_the_place_of_the_let(self):
        self.assertEqual(self.params("--set", "n=3")[0], "n = 3")
        self.assertEqual(self.params("--set=n=-3")[0], "n = -3")
        self.assertEqual(self.params("--set", "hat=#00ff00")[1], "hat = #00ff00")
        self.assertEqual(self.params("--set", "spot=1,2,3")[2], "spot = (1, 2, 3)")

    def test_a_colour_as_the_language_has_it(self):
        for value, like in (("0.5", "0.5 0.5 0.5"), ("1 0 0.25", "1 0 0.25"), ("0.2,0.4,1", "0.2 0.4 1")):
            for method in ("classic", "path"):
                options = ("-o", "-", "--method", method, "--samples", "1")
                self.assertEqual(run("-", *options, "--set", f"hat={value}").stdout,
                                 run("-", *options, scene=SCENE.replace("color hat", f"color {like}")).stdout, value)
        self.assertEqual(self.params("--set", "spot=1 -2 3")[2], "spot = (1, -2, 3)")
        self.assertEqual(self.params("--set", "word=1 2 3")[3], 'word = "1 2 3"')
        self.assert_usage(run("check", "-", "--set", "hat=tomatoe"), "'hat' is a colour", "did you mean 'tomato'?")
        self.assert_usage(run("check", "-", "--set", "n=red"), "'n' is a number")

    def test_several_of_them(self):
        self.assertEqual(self.params("--set", "n=3", "--set", "hat=blue")[:2], ["n = 3", "hat = #0000ff"])

    def test_a_value_may_hold_an_equals_sign(self):
        self.assertEqual(self.params("--set", "word=c=d")[3], 'word = "c=d"')

    def test_the_picture_follows(self):
        self.assertNotEqual(run("-", "-o", "-").stdout, run("-", "-o", "-", "--set", "hat=blue").stdout)
        self.assertEqual(run("-", "-o", "-", "--set", "hat=blue").stdout,
                         run("-", "-o", "-", scene=SCENE.replace("= red", "= blue")).stdout)

    def test_no_name_or_no_value(self):
        for value in ("n", "=3", "", "n="):
            self.assert_usage(run("-", "-o", "-", "--set", value), "--set")

    def test_a_name_that_the_scene_has_not(self):
        self.assert_usage(run("-", "-o", "-", "--set", "m=3"), "m", "n, hat, spot, word")
        self.assert_usage(run("check", "-", "--set", "hta=red"), "did you mean 'hat'?")

    def test_params_of_a_wrong_scene(self):
        done = run("params", "-", scene="let n = 1\nsphere { raduis 1 }")
        self.assertEqual((done.returncode, done.stdout), (1, b""))
        self.assertIn(b"raduis", done.stderr)

    def test_params_of_a_scene_without_any(self):
        self.assertEqual(run("params", "-", scene=FRAME + "sphere { }").stdout, b"")


class Limit(InAScene):
    def test_a_lower_limit_refuses_and_a_higher_one_admits(self):
        refused = run("check", "-", "--limit", "shapes=5", "--set", "n=9")
        self.assertEqual(refused.returncode, 1)
        self.assertIn(b"shapes", refused.stderr)
        self.assertEqual(run("check", "-", "--limit", "shapes=20", "--set", "n=9").returncode, 0)

    def test_what_is_shared_counts_once(self):
        """20 leaves a twig, 1000 twigs a tree, 1000 trees: the first use of each is built where it stands, the second once
        more to be shared, and all others are places."""
        text = """raytracer 1
define twig { for i from 1 to 20 { sphere { center (i) 0 0 radius 0.3 } } }
define tree { for i from 1 to 1000 { twig { translate 0 (i) 0 } } }
for i from 1 to 1000 { tree { translate 0 0 (i) } }
"""
        made = (20 + 20 + 999) + 1000 * 20 + 999
        self.assertEqual(run("check", "-", "--limit", f"shapes={made}", scene=text).returncode, 0)
        self.assertEqual(run("check", "-", "--limit", f"shapes={made - 1}", scene=text).returncode, 1)

    def test_several_of_them(self):
        self.assertEqual(run("check", "-", "--limit", "shapes=5", "--limit", "steps=3").returncode, 1)

    def test_an_unknown_name_lists_the_known_ones(self):
        for value in ("shape=5", "=5", "5", ""):
            self.assert_usage(run("check", "-", "--limit", value), "includes, nesting, shapes, steps")

    def test_bad_numbers(self):
        for number in ("", "x", "-1", "0", "1e3", "1.5", "99999999999999999999"):
            self.assert_usage(run("check", "-", "--limit", f"shapes={number}"), "--limit shapes")
        self.assert_usage(run("check", "-", "--limit", "shapes"), "--limit shapes=N")


class Statistics(unittest.TestCase):
    SCENE = FRAME + "let n = 1\nfor i from 1 to n { sphere { } }\n"
    STAGES = ["load", "build", "render", "encode", "write"]

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        (self.folder / "scene.txt").write_text(self.SCENE)

    def run_here(self, *arguments):
        return program.run("scene.txt", *arguments, cwd=self.folder)

    def test_one_flat_object_of_numbers(self):
        done = self.run_here("--stats", "s.json", "--set", "n=3")
        self.assertEqual((done.returncode, done.stdout, done.stderr), (0, b"", b""))
        told = json.loads((self.folder / "s.json").read_text())
        self.assertEqual(set(told), {*self.STAGES, "total", "rays", "mrays_per_second", "peak_mb", "picture_mb", "shapes"})
        for stage in self.STAGES:
            self.assertGreaterEqual(told[stage], 0)
        self.assertAlmostEqual(told["total"], sum(told[stage] for stage in self.STAGES), delta=1e-5)
        self.assertEqual(told["shapes"], 3)
        self.assertGreaterEqual(told["rays"], 64)
        self.assertGreater(told["peak_mb"], 1)

    def test_the_picture_stays_the_same(self):
        self.run_here("-o", "a.png")
        self.run_here("-o", "b.png", "--stats", "s.json")
        self.assertEqual((self.folder / "a.png").read_bytes(), (self.folder / "b.png").read_bytes())

    def test_a_place_where_nothing_can_be_written_is_told_before_rendering(self):
        for place in ("missing/s.json", "scene.txt"):
            self.assertEqual(self.run_here("--stats", place).returncode, 3)
        self.assertEqual((self.folder / "scene.txt").read_text(), self.SCENE)
        self.assertFalse((self.folder / "scene.png").exists())


if __name__ == "__main__":
    unittest.main()
