"""Texts made to hurt: nesting, includes, floods, cuts. The program answers with 0 or 1, within bounds on processor time
and memory that the system enforces, so that nothing here depends on a clock."""

import pathlib
import random
import resource
import tempfile
import unittest

import program

SCENE = pathlib.Path(__file__).parents[2] / "scenes" / "showcase.txt"
GIB = 1 << 30


def limits(seconds, memory):
    """For preexec_fn: beyond its processor time the program is killed, beyond its memory it gets none."""
    def limit():
        program.limit_processor_time(seconds)
        program.limit_memory(memory)
        resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    return limit


class Hostile(unittest.TestCase):
    def check(self, scene, expected=(0, 1), seconds=2, memory=2 * GIB, **options):
        data = scene if isinstance(scene, bytes) else scene.encode()
        done = program.run("check", "-", stdin=data, preexec_fn=limits(seconds, memory), **options)
        self.assertIn(done.returncode, expected, (data[:80], done.stderr[-500:]))
        self.assertEqual(done.stdout, b"")
        self.assertEqual(done.returncode == 1, b"error: " in done.stderr)
        return done


class Nesting(Hostile):
    def test_ten_thousand_deep(self):
        for opening in ("group {", "group g {", "sphere {", "sphere { material {", "{", "(", "sphere { radius (", "/*",
                        "light spot {", "material m {"):
            for text in (opening * 10000, opening * 10000 + "}" * 10000, opening * 10000 + "*/" * 10000):
                self.check(text)

    def test_a_million_deep(self):
        for opening in ("group {\n", "{", "(", "/*"):
            self.check(opening * 1000000)

    def test_closing_a_million_times(self):
        for closing in ("}\n", ")\n", "*/\n"):
            self.check(closing * 1000000, expected=[1])

    def test_the_limit_is_told_where_it_is_reached(self):
        done = self.check("group {\n" * 2000 + "}\n" * 2000, expected=[1])
        self.assertIn(b"deep", done.stderr)
        self.assertEqual(done.stderr.count(b"error: "), 1)


class Includes(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def refused(self, **files):
        """The messages for a.txt, which must be refused within a second of processor time and little memory."""
        for name, text in files.items():
            (self.folder / f"{name}.txt").write_text(text)
        done = program.run("check", "a.txt", cwd=self.folder, preexec_fn=limits(1, GIB))
        self.assertEqual(done.returncode, 1, done)
        self.assertIn(b"include", done.stderr)
        return done.stderr.decode()

    def test_itself(self):
        self.assertEqual(self.refused(a='include "a.txt"').count("error:"), 1)

    def test_itself_twice(self):
        self.refused(a='include "a.txt"\ninclude "a.txt"\n')

    def test_itself_under_other_names(self):
        (self.folder / "b.txt").symlink_to("a.txt")
        self.refused(a='include "./b.txt"\ninclude "../' + self.folder.name + '/b.txt"\n')

    def test_each_other(self):
        self.assertEqual(self.refused(a='include "b.txt"', b='include "a.txt"').count("error:"), 1)

    def test_each_other_in_groups(self):
        self.refused(a='group { include "b.txt" }', b='group { include "a.txt" sphere { } }')

    def test_a_chain_that_never_ends(self):
        names = [f"f{i}" for i in range(2000)]
        files = {name: f'include "{following}.txt"\n' for name, following in zip(names, names[1:])}
        self.refused(a='include "f0.txt"', f1999="sphere { }", **files)

    def test_tenfold_ten_times_over(self):
        names = "abcdefghij"
        files = {name: f'include "{following}.txt"\n' * 10 for name, following in zip(names, names[1:])}
        self.refused(j="sphere { }\n" * 10, **files)

    def test_tenfold_with_mistakes_at_the_bottom(self):
        names = "abcdefghij"
        files = {name: f'include "{following}.txt"\n' * 10 for name, following in zip(names, names[1:])}
        text = self.refused(j="sphere { raduis 1 }\n" * 10, **files)
        self.assertEqual(text.count("raduis'"), 10)

    def test_a_thousand_includes_of_one_file_are_fine(self):
        (self.folder / "b.txt").write_text("sphere { }\n")
        (self.folder / "a.txt").write_text('include "b.txt"\n' * 1000)
        done = program.run("check", "a.txt", cwd=self.folder, preexec_fn=limits(1, GIB))
        self.assertEqual(done.returncode, 0, done)


class Floods(Hostile):
    """Twice the text may take twice the time, not four times: quadratic work runs into the limit."""

    def test_of_sound_things(self):
        self.check("sphere { center 0 1 0 radius 2 }\n" * 200000, expected=[0], seconds=4)
        self.check("".join(f"sphere a{i} {{ }}\n" for i in range(100000)), expected=[0], seconds=4)
        self.check("".join(f"material m{i} {{ }}\nsphere {{ material m{i} }}\n" for i in range(50000)), expected=[0],
                   seconds=4)
        self.check("sphere { " + "translate 0 0 0 " * 100000 + "}", expected=[0])

    def test_of_mistakes(self):
        for text in ("sphere { raduis 1 }\n" * 50000, "spehre { }\n" * 50000, "sphere { material nowhere }\n" * 20000,
                     "sphere a { }\n" * 50000, '"\n' * 500000, "\x01\n" * 200000, "sphere 1 { }\n" * 50000):
            self.check(text, expected=[1], seconds=3)

    def test_of_mistakes_on_one_line(self):
        for text in ("sphere { raduis 1 } " * 100000, "sphere " * 300000, "sphere {" * 300000, "} " * 500000,
                     "/*" + "x" * 5000000 + "*/" + "sphere { raduis 1 } " * 200, "ä " * 500000):
            self.check(text, expected=[1], seconds=3)

    def test_of_properties_in_one_block(self):
        for values in ("radius 1 ", "radius center ", "raduis 1 ", "rotate 1 2 3 scale 0 "):
            self.check("sphere { " + values * 100000 + "}", expected=[1], seconds=3)

    def test_of_values(self):
        for value in ("1 ", '"a" ', "#fff ", "( ", "1e999 ", ", "):
            self.check("sphere { radius " + value * 500000 + "}", expected=[1], seconds=3)

    def test_of_unknown_materials_beside_known_ones(self):
        self.check("".join(f"material mat{i} {{ }}\n" for i in range(10000)) + "sphere { material mtanowhere }\n" * 10000,
                   expected=[1], seconds=3)

    def test_of_comments_between_words(self):
        self.check(("a /*" + "x" * 50000 + "*/\n") * 200, expected=[1], seconds=2)

    def test_words_that_never_end(self):
        for text in ("z" * 3000000, "1" * 3000000, "#" + "f" * 3000000, '"' + "x" * 3000000, "-" * 3000000,
                     "sphere { radius " + "9" * 3000000 + " }", "sphere { radius 0." + "0" * 3000000 + "1 }",
                     "sphere { radius 1e" + "9" * 3000000 + " }"):
            self.check(text, seconds=2)


class Programs(Hostile):
    """Loops, definitions and expressions always end, and within bounds."""

    def test_chains_of_operators(self):
        for link in ("(", "-", "not ", "1 + ", "2 ^ ", "true ? 1 : ", "true ? ", "sin(", "true and ", "1 < "):
            self.check("let x = " + link * 100000 + "1\n", expected=[1], seconds=3)
        self.check("let x = (1, 2, 3)" + ".x" * 100000 + "\n", expected=[1], seconds=3)

    def test_loops_that_would_not_end(self):
        for loop in ("for i from 0 to 1e18 { }", "for i from 0 to 1/0 { }", "for i from 0 to 5 step 0 { }",
                     "for i from 0 to 1 step 1e-300 { }", "for i from 0 to 1e300 { sphere { } }"):
            done = self.check(loop, expected=[1])
            self.assertEqual(done.stderr.count(b"error: "), 1)
            self.assertLess(len(done.stderr), 400)

    def test_definitions_that_use_themselves(self):
        for text in ("define a () { a { } }\na { }\n", "define a (n 1) { a { n (n + 1) } }\na { }\n"):
            done = self.check(text, expected=[1])
            self.assertEqual(done.stderr.count(b"error: "), 1)

    def test_mistakes_and_warnings_in_loops_are_told_once(self):
        for body in ("sphere { raduis 1 }", "sphere { radius (0 - i) }", "sphere { material m }", 'include "missing.txt"'):
            done = self.check(f"for i from 1 to 100000 {{ {body} }}\n", expected=[1])
            self.assertEqual(done.stderr.count(b"error: "), 1, body)
        done = self.check("for i from 1 to 100000 { material m { } }\nsphere { }\n", expected=[0])
        self.assertLess(done.stderr.count(b"warning: "), 5)

    def test_floods_of_warnings_end_in_a_count(self):
        done = self.check("".join(f"let a{i} = {i}\n" for i in range(20000)) + "sphere { }\n", expected=[0])
        self.assertLess(done.stderr.count(b"warning: "), 1000)


class Broken(Hostile):
    """A sample of what the unit tests do with every byte: here the whole program reads it."""

    def test_cut_anywhere(self):
        scene = SCENE.read_bytes()
        for length in range(0, len(scene), max(1, len(scene) // 100)):
            self.check(scene[:length])
            self.check(scene[length:])

    def test_bytes_changed(self):
        dice = random.Random(7)
        scene = SCENE.read_bytes()
        for _ in range(200):
            broken = bytearray(scene)
            for _ in range(dice.randint(1, 20)):
                broken[dice.randrange(len(broken))] = dice.randint(1, 255)
            self.check(bytes(broken))

    def test_noise(self):
        dice = random.Random(8)
        for _ in range(100):
            self.check(bytes(dice.randint(1, 255) for _ in range(dice.randint(0, 3000))))

    def test_zero_bytes_are_no_text(self):
        done = program.run("check", "-", stdin=SCENE.read_bytes() + b"\0")
        self.assertEqual(done.returncode, 3)


if __name__ == "__main__":
    unittest.main()
