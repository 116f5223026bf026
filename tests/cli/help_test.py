"""`raytracer help`: every word of the scene language has a page, and what the pages show works."""

import re
import unittest

import program

FUNCTIONS = "sin cos tan asin acos atan2 sqrt exp log pow abs min max floor ceil round sign mod clamp mix smoothstep " \
            "length normalize dot cross random noise hsv kelvin".split()


def page(*words):
    done = program.run("help", *words)
    assert (done.returncode, done.stderr) == (0, b""), done
    return done.stdout.decode()


def refusal(*words):
    done = program.run("help", *words)
    assert (done.returncode, done.stdout) == (2, b""), done
    return done.stderr.decode()


class Words(unittest.TestCase):
    def test_statements(self):
        listed = page()
        for word in ("let", "for", "if", "define", "include", "raytracer"):
            self.assertRegex(listed, rf"(?m)^  {word} ")
            self.assertTrue(page(word).startswith(f"{word}: "))

    def test_every_function_is_listed_and_has_a_page(self):
        listed = page("functions")
        for word in FUNCTIONS:
            self.assertRegex(listed, rf"(?m)^  {word}\(")
            self.assertTrue(page(word).startswith(f"{word}("))

    def test_constants(self):
        for word in ("pi", "t", "frame"):
            self.assertRegex(page("functions"), rf"(?m)^  {word} ")
            self.assertTrue(page(word).startswith(f"{word}: "))

    def test_every_example_is_a_sound_scene(self):
        examples = 0
        for word in ("let", "for", "if", "define", "include", "raytracer", "t"):
            _, found, example = page(word).partition("For example:\n")
            examples += bool(found)
            done = program.run("check", "-", stdin=example.encode())
            self.assertEqual(done.returncode, 0, (word, done.stderr))
        self.assertGreaterEqual(examples, 6)

    def test_a_variant_alone(self):
        self.assertTrue(page("light", "spot").startswith("light spot: "))
        self.assertNotIn("light point", page("light", "spot"))
        self.assertIn("light spot: ", page("light"))

    def test_a_misspelt_word(self):
        self.assertIn("did you mean 'sin'?", refusal("sine"))
        self.assertIn("did you mean 'define'?", refusal("defnie"))
        self.assertIn("did you mean 'spot'?", refusal("light", "spto"))
        self.assertIn("did you mean 'light'?", refusal("lihgt", "spot"))

    def test_a_property(self):
        radius = page("radius")
        self.assertRegex(radius, r"(?m)^radius, a property of .*\bsphere\b")
        self.assertRegex(radius, r"(?m)^  radius +\S")
        self.assertIn("default 1", radius)
        self.assertEqual(page("rotate").count("\n  rotate "), 2, page("rotate"))  # of all that is placed, of skies
        self.assertIn("sky image", page("strength"))
        self.assertIn("did you mean 'radius'?", refusal("raduis"))
        self.assertIn("did you mean 'checker'?", refusal("chekcer"))

    def test_topics(self):
        for word in ("materials", "textures", "functions", "limits"):
            self.assertRegex(page(), rf"(?m)^  {word} ")
            self.assertTrue(page(word).startswith(f"{word}: "))
        self.assertRegex(page("limits"), r"(?m)^  nesting .*256")
        self.assertRegex(page("textures"), r"(?m)^  checker ")

    def test_what_all_variants_share_stands_once(self):
        self.assertEqual(page("light").count("Where it stands, all"), 1)
        self.assertEqual(page("light", "spot").count("Where it stands, all"), 1)

    def test_a_word_that_has_no_second(self):
        for words in (("sphere", "cube"), ("sin", "cos"), ("let", "n")):
            self.assertIn(f"'{' '.join(words)}'", refusal(*words))

    def test_three_words(self):
        self.assertIn("'c'", refusal("light", "spot", "c"))


class Markdown(unittest.TestCase):
    def setUp(self):
        self.text = page("--markdown")

    def test_has_every_kind_and_property(self):
        for kind in re.findall(r"(?m)^  (\w+(?: \w+)?) ", page().split("Around them")[0]):
            _, found, section = self.text.partition(f"### {kind}\n")
            self.assertTrue(found, kind)
            section = section.partition("### ")[0]
            for name in re.findall(r"(?m)^  (\w+) ", page(*kind.split()).split("Where it stands")[0]):
                if name != "material" and kind in page(*kind.split()).split(":")[0]:
                    self.assertIn(f"| `{name}` |", section, kind)

    def test_has_every_function(self):
        for name in FUNCTIONS:
            self.assertRegex(self.text, rf"(?m)^\| `{name}\(")

    def test_every_table_is_whole(self):
        columns = None
        for line in self.text.split("\n"):
            cells = len(re.findall(r"(?<!\\)\|", line))
            if not line.startswith("|"):
                columns = None
                continue
            columns = columns or cells
            self.assertEqual(cells, columns, line)

    def test_is_the_same_each_time(self):
        self.assertEqual(self.text, page("--markdown"))


if __name__ == "__main__":
    unittest.main()
