"""The command line: options and their slips, help, completions, the man page, what a terminal sees."""

import fcntl
import os
import pathlib
import re
import shutil
import struct
import subprocess
import tempfile
import termios
import unittest

import program

SCENE = b"image { size 8 8 }\nlight { position 0 0 5 }\ncamera { position 0 0 5 }\nsphere { }\n"
OPTIONS = ["--output", "--size", "--samples", "--bounces", "--camera", "--allow-path", "--threads", "--quiet",
           "--method", "--seed", "--set", "--limit", "--stats", "--format", "--help", "--version"]


class Values(unittest.TestCase):
    def render(self, *arguments):
        return program.run("-", "-o", "-", *arguments, stdin=SCENE)

    def assert_refused(self, *arguments, words=()):
        done = self.render(*arguments)
        self.assertEqual((done.returncode, done.stdout), (2, b""), (arguments, done.stderr))
        for word in (arguments[0].partition("=")[0], *words):
            self.assertIn(word, done.stderr.decode(), arguments)

    def test_bad_sizes(self):
        for value in ("0x10", "10x0", "1e3x5", "99999999999x1", "1x99999999999", "-1", "-1x5", "5x-1", "nan", "nanxnan",
                      "infx5", "", "x", "x5", "5x", "5", "5x5x5", "5 x5", " 5x5", "5x5 ", "+5x5", "1.5x5", "65537x1",
                      "0x0", "٥x٥", "5×5", "5*5", "5,5", "5x5\n", "4294967297x1"):
            self.assert_refused(f"--size={value}" if value.startswith("-") else "--size",
                                *([] if value.startswith("-") else [value]))

    def test_good_sizes(self):
        for value, size in (("5x7", (5, 7)), ("5X7", (5, 7)), ("010x010", (10, 10)), ("1x1", (1, 1))):
            done = self.render("--size", value)
            self.assertEqual(done.returncode, 0, done)
            self.assertEqual(struct.unpack(">II", done.stdout[16:24]), size)

    def test_bad_whole_numbers(self):
        for option in ("--samples", "--bounces", "--threads"):
            for value in ("", "x", "1.5", "1e3", "0x10", "nan", "inf", "99999999999", "-1", "+1", " 1", "1 ", "1,000",
                          "1_0", "٣", "18446744073709551617"):
                self.assert_refused(f"{option}={value}" if value.startswith("-") else option,
                                    *([] if value.startswith("-") else [value]))

    def test_limits(self):
        for option, least, beyond in (("--samples", 1, 1000001), ("--threads", 1, 100000), ("--bounces", 0, 1000000)):
            self.assertEqual(self.render(option, least).returncode, 0)
            self.assert_refused(option, str(beyond))
            if least > 0:
                self.assert_refused(option, str(least - 1))

    def test_a_number_with_a_leading_zero_is_decimal(self):
        self.assertEqual(self.render("--samples", "010").stdout, self.render("--samples", "10").stdout)

    def test_a_value_that_is_missing(self):
        for option in ("--size", "--samples", "--bounces", "--camera", "--allow-path", "--threads", "--output", "-o"):
            done = program.run("scene.txt", option)
            self.assertEqual((done.returncode, done.stdout), (2, b""), option)
            self.assertIn("--output" if option == "-o" else option, done.stderr.decode())
            self.assertNotIn("TEXT", done.stderr.decode())

    def test_a_value_for_a_switch(self):
        for word in ("--quiet=3", "--quiet=false"):
            self.assert_refused(word)

    def test_given_twice(self):
        for option, value in (("--size", "8x8"), ("--samples", "1"), ("--bounces", "1"), ("--threads", "1")):
            self.assert_refused(option, value, option, value, words=["twice"])
        done = program.run("-", "-o", "a.png", "--output", "b.png", stdin=SCENE, cwd="/")
        self.assertEqual(done.returncode, 2)
        self.assertIn(b"twice", done.stderr)

    def test_the_value_behind_an_equals_sign(self):
        self.assertEqual(self.render("--size=5x7").stdout, self.render("--size", "5x7").stdout)
        done = program.run("-", "--output=-", "--samples=2", stdin=SCENE)
        self.assertEqual(done.stdout, self.render("--samples", "2").stdout)

    def test_options_before_and_behind_the_scene(self):
        first = program.run("--size", "5x7", "-o", "-", "-", stdin=SCENE)
        self.assertEqual((first.returncode, first.stdout), (0, self.render("--size", "5x7").stdout))

    def test_the_command_line_overrules_the_scene(self):
        in_scene = program.run("-", "-o", "-", stdin=b"render { samples 3 bounces 0 }\n" + SCENE.replace(b"8 8", b"9 7"))
        self.assertEqual(self.render("--size", "9x7", "--samples", "3", "--bounces", "0").stdout, in_scene.stdout)

    def test_a_scene_whose_name_begins_with_a_dash(self):
        with tempfile.TemporaryDirectory() as folder:
            (pathlib.Path(folder) / "-scene.txt").write_bytes(SCENE)
            done = program.run("-o", "-", "--", "-scene.txt", cwd=folder)
            self.assertEqual((done.returncode, done.stdout), (0, self.render().stdout))
            self.assertEqual(program.run("check", "--", "-scene.txt", cwd=folder).returncode, 0)
            self.assertEqual(program.run("check", "./-scene.txt", cwd=folder).returncode, 0)

    def test_a_scene_with_the_name_of_a_command(self):
        with tempfile.TemporaryDirectory() as folder:
            (pathlib.Path(folder) / "check").write_bytes(SCENE)
            self.assertEqual(program.run("render", "check", "-o", "-", cwd=folder).stdout, self.render().stdout)
            self.assertEqual(program.run("./check", "-o", "-", cwd=folder).stdout, self.render().stdout)

    def test_the_camera_of_that_name(self):
        scene = b"camera left { position -5 0 0 look_at 0 0 0 }\ncamera right { position 5 1 0 look_at 0 0 0 }\n" \
                b"light { position 9 9 0 }\nsphere { }\n"
        def render(*arguments):
            return program.run("-", "-o", "-", "--size", "16x16", *arguments, stdin=scene).stdout
        self.assertEqual(render(), render("--camera", "left"))
        self.assertNotEqual(render("--camera", "right"), render("--camera", "left"))
        done = program.run("-", "-o", "-", "--camera", "middle", stdin=scene)
        self.assertEqual((done.returncode, done.stdout), (2, b""))
        for word in (b"middle", b"left", b"right"):
            self.assertIn(word, done.stderr)


class UnknownWords(unittest.TestCase):
    def assert_says(self, arguments, *words):
        done = program.run(*arguments)
        self.assertEqual((done.returncode, done.stdout), (2, b""), arguments)
        for word in words:
            self.assertIn(word, done.stderr.decode(), arguments)

    def test_a_misspelt_option(self):
        for wrong, right in (("--sampels", "--samples"), ("--ouput", "--output"), ("--szie", "--size"),
                             ("--Threads", "--threads"), ("--allow_path", "--allow-path"), ("--verison", "--version")):
            self.assert_says(["scene.txt", wrong, "3"], f"'{wrong}'", f"did you mean '{right}'?")
            self.assert_says(["scene.txt", f"{wrong}=3"], f"'{wrong}'", f"did you mean '{right}'?")

    def test_the_beginning_of_an_option(self):
        self.assert_says(["--vers"], "'--vers'", "did you mean '--version'?")
        self.assert_says(["scene.txt", "--out", "a.png"], "'--out'", "did you mean '--output'?")

    def test_one_dash_too_few(self):
        self.assert_says(["-help"], "'-help'", "did you mean '--help'?")
        self.assert_says(["scene.txt", "-samples", "3"], "'-samples'", "did you mean '--samples'?")

    def test_an_unknown_option(self):
        self.assert_says(["scene.txt", "--frobnicate"], "--frobnicate", "--help")
        self.assert_says(["scene.txt", "-z"], "-z", "--help")

    def test_an_option_of_another_command(self):
        self.assert_says(["check", "scene.txt", "--threads", "3"], "--threads", "check")
        self.assert_says(["scene.txt", "--format", "json"], "--format")
        for command in ("check", "fmt"):
            self.assert_says([command, "scene.txt", "-o", "x"], f"{command} has no option '-o'")

    def test_a_folder_that_is_none(self):
        self.assert_says(["check", "-", "--allow-path", "/no/such/folder"], "--allow-path", "no '/no/such/folder'")
        self.assert_says(["check", "-", "--allow-path", __file__], "--allow-path takes a folder", __file__)

    def test_a_misspelt_command(self):
        self.assert_says(["chekc", "scene.txt"], "'chekc'", "did you mean 'check'?")
        self.assert_says(["hlep", "sphere"], "'hlep'", "did you mean 'help'?")

    def test_a_format_that_is_none(self):
        self.assert_says(["check", "scene.txt", "--format", "xml"], "xml", "text", "json")

    def test_a_topic_that_is_none(self):
        self.assert_says(["help", "spehre"], "'spehre'", "did you mean 'sphere'?")
        self.assert_says(["help", "zzzzzzz"], "'zzzzzzz'", "help")
        self.assert_says(["help", "sphere", "cube"], "cube")

    def test_a_shell_without_completions(self):
        self.assert_says(["help", "--completions", "powershell"], "powershell", "bash")

    def test_words_do_not_steer_the_terminal(self):
        for arguments in (["--\x1b[31m"], ["help", "\x1b[31m"], ["check", "a\x1b[31m"], ["a", "-o", "\x1b[31m.bmp"]):
            self.assertNotIn(b"\x1b", program.run(*arguments).stderr, arguments)


class Help(unittest.TestCase):
    def page(self, *arguments):
        done = program.run(*arguments)
        self.assertEqual((done.returncode, done.stderr), (0, b""), arguments)
        return done.stdout.decode()

    def test_fits_a_screen(self):
        lines = self.page("--help").rstrip("\n").split("\n")
        self.assertLessEqual(len(lines), 34)
        self.assertLessEqual(max(map(len, lines)), 80)

    def test_shows_all_options_and_an_example(self):
        page = self.page("--help")
        for option in OPTIONS:
            self.assertIn(option, page)
        self.assertIn("raytracer scene.txt", page)

    def test_short_and_long_with_any_command(self):
        for arguments in (["-h"], ["check", "--help"], ["help", "--help"], ["--help", "--size", "8x8"]):
            self.assertEqual(self.page(*arguments), self.page("--help"))

    def test_version(self):
        self.assertRegex(self.page("--version"), r"^raytracer \d+\.\d+\.\d+\n$")

    def kinds(self):
        return re.findall(r"^  (\w+(?: \w+)?)", self.page("help"), re.MULTILINE)

    def test_lists_the_kinds(self):
        kinds = self.kinds()
        for kind in ("image camera render light material background group include sphere quad cube plane disk "
                     "cylinder cone torus triangle").split():
            self.assertIn(kind, [listed.split()[0] for listed in kinds])

    def test_every_kind_listed_has_a_page_of_its_own(self):
        for kind in self.kinds():
            page = self.page("help", *kind.split())
            self.assertTrue(page.startswith(kind), kind)
            self.assertLessEqual(max(map(len, page.split("\n"))), 120)

    def test_a_kind_shows_its_properties_with_unit_range_and_default(self):
        page = self.page("help", "sphere")
        for word in ("center", "radius", "scene units", "greater than 0", "default 1", "material", "translate"):
            self.assertIn(word, page)

    def test_every_default_that_help_shows_may_be_written(self):
        for kind in self.kinds():
            page = self.page("help", *kind.split()).split("Where it stands")[0]
            for name, value in re.findall(r"^  (\w+) .*\n.*default ([-\d. ]+|[a-z]+)$", page, re.MULTILINE):
                picture = 'file "tests/render/expected/first.png" '
                needed = {"animation": "duration 4 ", "sky image": picture, "texture image": picture,
                          "texture ramp": "stop 0 red  stop 1 blue ",
                          "mesh": "vertices 0 0 0  1 0 0  0 1 0  faces 0 1 2 "}.get(kind, "")
                named = f"{kind} used" if kind.split()[0] in ("material", "texture") else kind
                scene = f"{named} {{ {needed}{name} {value} }}\n"
                done = program.run("check", "-", stdin=scene.encode(), cwd=program.ROOT)
                self.assertEqual(done.returncode, 0, scene + done.stderr.decode())


class Completions(unittest.TestCase):
    def script(self, shell):
        done = program.run("help", "--completions", shell)
        self.assertEqual((done.returncode, done.stderr), (0, b""))
        return done.stdout.decode()

    def complete(self, *words):
        """What bash offers for the last of the words."""
        quoted = " ".join(f"'{word}'" for word in words)
        commands = self.script("bash") + f'COMP_WORDS=({quoted}); COMP_CWORD={len(words) - 1}; _raytracer; ' \
                                         'printf "%s\\n" "${COMPREPLY[@]}"'
        with tempfile.TemporaryDirectory() as folder:
            (pathlib.Path(folder) / "scene.txt").write_text("")
            done = subprocess.run(["bash", "--norc", "-c", commands], capture_output=True, cwd=folder, check=False)
        self.assertEqual(done.stderr, b"")
        return done.stdout.decode().split()

    @unittest.skipUnless(shutil.which("bash"), "no bash here")
    def test_bash(self):
        subprocess.run(["bash", "-n"], input=self.script("bash").encode(), check=True)
        self.assertEqual(self.complete("raytracer", "ch"), ["check"])
        self.assertEqual(self.complete("raytracer", "sc"), ["scene.txt"])
        self.assertEqual(self.complete("raytracer", "check", "sc"), ["scene.txt"])
        self.assertEqual(self.complete("raytracer", "scene.txt", "--si"), ["--size"])
        self.assertEqual(self.complete("raytracer", "help", "sph"), ["sphere"])
        self.assertEqual(self.complete("raytracer", "check", "--format", "j"), ["json"])
        listed = set(re.findall(r"^ .*?(--[a-z-]+)", program.run("--help").stdout.decode(), re.MULTILINE))
        self.assertEqual(set(self.complete("raytracer", "scene.txt", "--")) - listed, set())
        self.assertEqual(self.complete("raytracer", "check", "--form"), ["--format"])

    @unittest.skipUnless(shutil.which("bash"), "no bash here")
    def test_bash_offers_only_what_the_command_takes(self):
        self.assertNotIn("--threads", self.complete("raytracer", "check", "--"))
        self.assertNotIn("--format", self.complete("raytracer", "scene.txt", "--"))

    @unittest.skipUnless(shutil.which("zsh"), "no zsh here")
    def test_zsh(self):
        subprocess.run(["zsh", "-n"], input=self.script("zsh").encode(), check=True)

    @unittest.skipUnless(shutil.which("fish"), "no fish here")
    def test_fish(self):
        subprocess.run(["fish", "--no-execute"], input=self.script("fish").encode(), check=True)

    def test_every_shell_knows_every_option_and_kind(self):
        for shell in ("bash", "zsh", "fish"):
            script = self.script(shell)
            for option in OPTIONS:
                word = option if shell != "fish" else f"-l {option[2:]}"
                self.assertIn(word, script, shell)
            for word in ("render", "check", "help", "sphere", "torus", "include"):
                self.assertIn(word, script, shell)


class ManPage(unittest.TestCase):
    def setUp(self):
        done = program.run("help", "--man")
        self.assertEqual((done.returncode, done.stderr), (0, b""))
        self.page = done.stdout

    def test_tells_every_option_and_exit_code(self):
        plain = self.page.decode().replace("\\", "")
        for word in OPTIONS + ["EXIT STATUS", "130", "143", "EXAMPLES"]:
            self.assertIn(word, plain)

    @unittest.skipUnless(shutil.which("groff"), "no groff here")
    def test_groff_has_nothing_to_say_against_it(self):
        done = subprocess.run(["groff", "-man", "-Tascii", "-wall", "-rLL=78n"], input=self.page, capture_output=True,
                              check=False)
        self.assertEqual((done.returncode, done.stderr), (0, b""))

    @unittest.skipUnless(shutil.which("man"), "no man here")
    def test_man_has_nothing_to_say_against_it(self):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "raytracer.1"
            path.write_bytes(self.page)
            done = subprocess.run(["man", "--warnings", "-l", path], capture_output=True, check=False,
                                  env=dict(os.environ, MANPAGER="cat", MANWIDTH="80", LC_ALL="C.UTF-8"))
        if done.returncode != 0:
            self.skipTest("man shows nothing here")
        self.assertEqual(done.stderr, b"")


class Terminal(unittest.TestCase):
    """What a person sees: standard error is a pseudo-terminal."""

    def on_terminal(self, *arguments, columns=80, **options):
        leader, follower = program.open_terminal()
        fcntl.ioctl(follower, termios.TIOCSWINSZ, struct.pack("HHHH", 24, columns, 0, 0))
        with tempfile.TemporaryDirectory() as folder:
            (pathlib.Path(folder) / "scene.txt").write_bytes(SCENE)
            process = subprocess.Popen([program.PROGRAM, *arguments], cwd=folder, stderr=follower,
                                       **{"stdin": subprocess.DEVNULL, "stdout": subprocess.DEVNULL, **options})
            os.close(follower)
            seen = program.read_terminal(leader)
            return process.wait(), seen.decode()

    def test_a_bar_with_the_time_left_then_one_line_of_summary(self):
        code, seen = self.on_terminal("scene.txt", "--size", "1200x1200", "--samples", "16")
        self.assertEqual(code, 0)
        bars = [part for part in re.split("\r", seen) if "left" in part]
        self.assertGreater(len(bars), 0, seen)
        for bar in bars:
            self.assertRegex(bar, r"\[#* *\] +\d+ %  .* left")
            self.assertLess(len(re.sub(r"\x1b\[\w", "", bar)), 80)
        summary = seen.rpartition("\x1b[K")[2]
        self.assertEqual(summary.count("\n"), 1)
        for word in ("scene.png", "1200 x 1200", " s", "rays", "MB"):
            self.assertIn(word, summary)

    def test_a_picture_done_at_once_shows_no_bar(self):
        code, seen = self.on_terminal("scene.txt")
        self.assertEqual((code, seen.count("\n")), (0, 1))
        self.assertNotIn("left", seen)

    def test_quiet_says_nothing(self):
        for option in ("--quiet", "-q"):
            self.assertEqual(self.on_terminal("scene.txt", option), (0, ""))

    def test_quiet_still_tells_problems(self):
        code, seen = self.on_terminal("missing.txt", "--quiet")
        self.assertEqual(code, 3)
        self.assertIn("missing.txt", seen)

    def test_check_shows_neither(self):
        self.assertEqual(self.on_terminal("check", "scene.txt"), (0, ""))

    def test_a_picture_is_not_written_onto_a_terminal(self):
        leader, follower = program.open_terminal()
        try:
            code, seen = self.on_terminal("scene.txt", "-o", "-", stdout=follower)
        finally:
            os.close(leader)
            os.close(follower)
        self.assertEqual(code, 2)
        self.assertIn("terminal", seen)

    def test_without_a_terminal_there_is_nothing_but_problems(self):
        done = program.run("-", "-o", "-", "--size", "600x600", "--samples", "4", stdin=SCENE)
        self.assertEqual((done.returncode, done.stderr), (0, b""))


if __name__ == "__main__":
    unittest.main()
