"""What the program says of a scene: every mistake in one run, how a message looks, JSON, warnings."""

import json
import pathlib
import tempfile
import unittest

import program

LIT = "light { position 0 0 5 }\ncamera { position 0 0 5 }\n"
SOUND = LIT + "sphere { }\n"


def check_json(scene):
    """(exit code, the messages) of a scene's text."""
    done = program.run("check", "--format", "json", "-", stdin=scene.encode())
    return done.returncode, [json.loads(line) for line in done.stdout.decode().splitlines()]


def check_text(scene):
    data = scene if isinstance(scene, bytes) else scene.encode()
    return program.run("check", "-", stdin=data).stderr.decode()


# Each line with a mark holds one mistake, which begins at «.
TWENTY_MISTAKES = """\
// A scene for a bad day.
image { size 640 «0 }
camera { position 0 2 8  look_at 0 1 0  fov «190 }
light { position -4 6 5  intensty 1800 }
light «sopt lamp { position 0 3 0 }

material chrome { color «#e6e6e  shininess 0.8 }
material paper { colour white }

sphere { center «-2.2 1  radius 1  material chrome }
sphere { «raduis 1  center 0 1 0 }
sphere { radius «-1 }
sphere { material «chrom }
cube { size «"large" }
cube { center 0 1 «1e999 }
quad { width «wide }
«cuboid { }
plane { point 0 0 0  point 1 1 1 }
disk { normal 0 1 0 «4 }
cone { open «maybe }
torus { tube_radius }
group {
  rotate 0 30«, 0
  cylinder { base 0 0 0 top 0 2 0 radius «nan }
}
include «"nowhere.txt"
"""
# Those whose mistake begins with the word itself, to keep the marks above few.
MORE_MARKS = {"intensty": "intensty", "colour white": "colour", "point 1 1 1": "point 1 1 1", "tube_radius": "tube_radius"}


class TwentyMistakes(unittest.TestCase):
    def setUp(self):
        scene = TWENTY_MISTAKES
        for text in MORE_MARKS:
            scene = scene.replace(text, "«" + text)
        self.marked = scene
        self.places = [(number, line.index("«") + 1)
                       for number, line in enumerate(scene.split("\n"), 1) if "«" in line]
        self.scene = scene.replace("«", "")

    def test_all_are_told_in_one_run_each_at_its_place(self):
        code, messages = check_json(self.scene)
        self.assertEqual(code, 1)
        self.assertEqual([(m["line"], m["column"]) for m in messages], self.places)
        self.assertGreaterEqual(len(messages), 20)
        self.assertEqual({m["severity"] for m in messages}, {"error"})

    def test_misspelt_words_come_with_the_right_ones(self):
        _, messages = check_json(self.scene)
        suggestions = {m["line"]: m["suggestion"] for m in messages}
        lines = self.scene.split("\n")
        for wrong, right in [("intensty", "intensity"), ("sopt", "spot"), ("colour", "color"), ("raduis", "radius"),
                             ("chrom }", "chrome")]:
            line = next(number for number, text in enumerate(lines, 1) if wrong in text)
            self.assertEqual(suggestions[line], f"did you mean '{right}'?")

    def test_each_shows_its_line_and_underlines_the_words(self):
        text = check_text(self.scene)
        lines = self.scene.split("\n")
        for line, column in self.places:
            gutter = " " * len(str(line))
            begin = (f"{gutter}--> <standard input>:{line}:{column}\n"
                     f"{gutter} |\n{line} | {lines[line - 1]}\n{gutter} | " + " " * (column - 1) + "^")
            self.assertIn(begin, text)

    def test_rendering_tells_the_same_and_makes_no_picture(self):
        with tempfile.TemporaryDirectory() as folder:
            rendered = program.run("-", "-o", "out.png", stdin=self.scene.encode(), cwd=folder)
            self.assertEqual((rendered.returncode, rendered.stdout), (1, b""))
            checked = program.run("check", "-", stdin=self.scene.encode(), cwd=folder)
            self.assertEqual(rendered.stderr, checked.stderr)
            self.assertEqual(list(pathlib.Path(folder).iterdir()), [])


class Recovery(unittest.TestCase):
    def messages(self, scene):
        code, messages = check_json(scene)
        self.assertEqual(code, 1)
        return [(m["line"], m["column"]) for m in messages]

    def test_a_group_with_a_mistake_still_has_its_children_checked(self):
        self.assertEqual(self.messages("group {\n scael 2\n sphere {\n raduis 1 } }\n"), [(2, 2), (4, 2)])

    def test_a_block_left_open_does_not_blame_the_blocks_behind_it(self):
        self.assertEqual(self.messages("sphere { radius 1\n" + LIT + "cube { }\ngroup { sphere { } }\n"), [(1, 8)])

    def test_a_brace_never_opened_is_one_mistake(self):
        self.assertEqual(self.messages("sphere\n  radius 1\n}\n" + LIT), [(1, 1)])

    def test_one_brace_too_many_does_not_hide_what_follows(self):
        self.assertEqual(self.messages("sphere { } }\nsphere { raduis 1 }\n"), [(1, 12), (2, 10)])

    def test_a_material_with_a_mistake_is_known_all_the_same(self):
        self.assertEqual(self.messages("material red { colr red }\nsphere { material red }\n"), [(1, 16)])

    def test_each_use_of_an_unknown_material_is_told(self):
        self.assertEqual(self.messages("sphere { material m }\ncube { material m }\n"), [(1, 19), (2, 17)])

    def test_several_mistakes_in_one_block_come_in_their_order(self):
        self.assertEqual(self.messages("sphere { raduis 1 center 1 2 material m tranlsate 0 0 0 }"),
                         [(1, 10), (1, 26), (1, 39), (1, 41)])

    def test_a_flood_of_mistakes_ends_in_a_count(self):
        code, messages = check_json("sphere { raduis 1 }\n" * 5000)
        self.assertEqual(code, 1)
        self.assertLess(len(messages), 1001)
        self.assertRegex(messages[-1]["message"], r"\d+ more errors")


class Places(unittest.TestCase):
    def test_both_places_of_a_double_are_shown(self):
        text = check_text("sphere a { }\ncube { }\nsphere a { }\n")
        self.assertIn(":3:1\n", text)
        self.assertIn("note:", text)
        self.assertIn(":1:1\n", text)

    def test_a_use_before_the_definition_names_the_place_of_both(self):
        text = check_text("sphere { material m }\nmaterial m { }\n")
        self.assertIn(":1:19\n", text)
        self.assertIn(":2:1\n", text)

    def test_a_mistake_in_an_included_file_is_told_with_its_name(self):
        with tempfile.TemporaryDirectory() as folder:
            parts = pathlib.Path(folder) / "parts"
            parts.mkdir()
            (parts / "inner.txt").write_text("sphere { }\nsphere { raduis 1 }\n")
            (pathlib.Path(folder) / "main.txt").write_text('include "parts/inner.txt"\n')
            text = program.run("check", "main.txt", cwd=folder).stderr.decode()
            self.assertIn("--> parts/inner.txt:2:10\n", text)
            text = program.run("check", f"{folder}/main.txt").stderr.decode()
            self.assertIn(f"--> {folder}/parts/inner.txt:2:10\n", text)

    def test_an_included_file_is_told_once_however_often_it_is_included(self):
        with tempfile.TemporaryDirectory() as folder:
            (pathlib.Path(folder) / "a.txt").write_text('group { include "b.txt" }\ngroup { include "b.txt" }\n')
            (pathlib.Path(folder) / "b.txt").write_text("sphere { center 1, 2 }\n")
            text = program.run("check", "a.txt", cwd=folder).stderr.decode()
            self.assertEqual(text.count("error:"), 1, text)

    def test_paths_of_includes_are_relative_to_the_including_file(self):
        with tempfile.TemporaryDirectory() as folder:
            parts = pathlib.Path(folder) / "parts"
            parts.mkdir()
            (pathlib.Path(folder) / "main.txt").write_text(LIT + 'include "parts/a.txt"\n')
            (parts / "a.txt").write_text('include "b.txt"\ninclude "../c.txt"\n')
            (parts / "b.txt").write_text("sphere { }\n")
            (pathlib.Path(folder) / "c.txt").write_text("cube { }\n")
            done = program.run("check", f"{folder}/main.txt", cwd="/")
            self.assertEqual((done.returncode, done.stderr), (0, b""))

    def test_a_missing_file_of_standard_input_is_missing_not_forbidden(self):
        with tempfile.TemporaryDirectory() as folder:
            done = program.run("check", "-", stdin=b'include "missing.txt"\n', cwd=folder)
            self.assertEqual(done.returncode, 1)
            self.assertIn(b"there is no file 'missing.txt'", done.stderr)

    def test_a_link_out_of_the_folder_is_refused_and_allow_path_opens_it(self):
        with tempfile.TemporaryDirectory() as folder:
            inside, outside = pathlib.Path(folder) / "in", pathlib.Path(folder) / "out"
            inside.mkdir()
            outside.mkdir()
            (outside / "parts.txt").write_text("sphere { }\n")
            (inside / "link.txt").symlink_to("../out/parts.txt")
            (inside / "main.txt").write_text(LIT + 'include "link.txt"\n')
            refused = program.run("check", inside / "main.txt")
            self.assertEqual(refused.returncode, 1)
            self.assertIn(f"--allow-path {outside}".encode(), refused.stderr)
            allowed = program.run("check", inside / "main.txt", "--allow-path", outside)
            self.assertEqual((allowed.returncode, allowed.stderr), (0, b""))

    def test_a_folder_whose_name_begins_alike_is_still_outside(self):
        with tempfile.TemporaryDirectory() as folder:
            for name in ("scene", "scenery"):
                (pathlib.Path(folder) / name).mkdir()
            (pathlib.Path(folder) / "scenery" / "parts.txt").write_text("sphere { }\n")
            (pathlib.Path(folder) / "scene" / "main.txt").write_text(LIT + 'include "../scenery/parts.txt"\n')
            done = program.run("check", f"{folder}/scene/main.txt")
            self.assertEqual(done.returncode, 1)
            self.assertIn(b"outside", done.stderr)

    def test_a_device_or_a_pipe_is_no_file_to_include(self):
        for path in ("/dev/zero", "/dev/stdin", "/proc/self/mem"):
            done = program.run("check", "--allow-path", "/", "-", stdin=f'include "{path}"\n'.encode())
            self.assertEqual(done.returncode, 1, path)
            self.assertIn(path.encode(), done.stderr)

    def test_a_name_too_long_for_the_system_is_told(self):
        done = program.run("check", "-", stdin=b'include "' + b"a" * 5000 + b'"\n')
        self.assertEqual(done.returncode, 1)
        self.assertRegex(done.stderr.lower(), b"name too long|can't be the name of a file")


class Text(unittest.TestCase):
    def test_a_message_looks_as_the_language_page_shows(self):
        with tempfile.TemporaryDirectory() as folder:
            (pathlib.Path(folder) / "demo.txt").write_text("\n" * 11 + "  sphere { raduis 2  center 0 1 0 }\n")
            done = program.run("check", "demo.txt", cwd=folder)
            self.assertEqual(done.stderr.decode().strip("\n"), """\
error: sphere has no property 'raduis'
  --> demo.txt:12:12
   |
12 |   sphere { raduis 2  center 0 1 0 }
   |            ^^^^^^ did you mean 'radius'?""")
            self.assertEqual(done.stdout, b"")

    def test_columns_count_characters(self):
        for before in ("é", "漢", "🎨", "e\u0301x"):
            code, messages = check_json(f"/*{before}*/ sphere {{ raduis 1 }}\n")
            self.assertEqual((code, messages[0]["column"]), (1, len(before) + 15), before)

    def test_a_tab_counts_one_and_the_underline_keeps_it(self):
        text = check_text("\tsphere {\traduis 1 }\n")
        self.assertIn(":1:11\n", text)
        self.assertIn("| \tsphere {\traduis 1 }\n", text)
        self.assertIn("| \t        \t^^^^^^", text)

    def test_a_very_long_line_is_shown_in_part(self):
        scene = "sphere { } " * 20000 + "sphere { raduis 1 } " + "sphere { } " * 20000
        text = check_text(scene)
        self.assertIn(":1:220010\n", text)
        self.assertLess(max(map(len, text.split("\n"))), 200)
        shown, underline = text.split("\n")[3:5]
        self.assertEqual(shown[underline.index("^"):][:6], "raduis")

    def test_a_very_long_word_does_not_fill_the_screen(self):
        self.assertLess(len(check_text("sphere { " + "a" * 100000 + " 1 }")), 2000)
        self.assertLess(len(check_text("sphere { radius " + "1" * 100000 + "x }")), 2000)
        self.assertLess(len(check_text('sphere { radius "' + "x" * 100000 + '" }')), 2000)

    def test_nothing_in_a_scene_steers_the_terminal(self):
        for scene in (b"sphere { \x1b[31m radius 1 }\n", b"/* \x1b]0;x\x07 */ sphere { raduis 1 }\n",
                      b'include "\x1b[2J.txt"\n', b"sphere { radius \x9b31m }\n", b"sphere \xc2\x9b { raduis 1 }\n",
                      b'sphere { radius "\x1b[31m" }\n', b"# \x7f\x08\x0e\n"):
            shown = program.run("check", "-", stdin=scene)
            listed = program.run("check", "--format", "json", "-", stdin=scene)
            self.assertEqual((shown.returncode, listed.returncode), (1, 1))
            for output in (shown.stderr.decode(), listed.stdout.decode()):
                steering = [c for c in output if (ord(c) < 32 and c not in "\n\t") or 127 <= ord(c) < 160]
                self.assertEqual(steering, [], scene)

    def test_a_file_name_does_not_steer_the_terminal_either(self):
        with tempfile.TemporaryDirectory() as folder:
            name = "evil\x1b[31m.txt"
            (pathlib.Path(folder) / name).write_text("sphere { raduis 1 }\n")
            done = program.run("check", name, cwd=folder)
            self.assertEqual(done.returncode, 1)
            self.assertNotIn(b"\x1b", done.stderr)
            self.assertNotIn(b"\x1b", program.run("check", "no\x1b[31m.txt", cwd=folder).stderr)

    def test_bytes_that_are_no_utf8_are_replaced_and_counted(self):
        code, messages = check_json_bytes(b"/* \xff\xfe */ sphere { raduis 1 }\n")
        self.assertEqual((code, len(messages), messages[0]["column"]), (1, 1, 19))


def check_json_bytes(scene):
    done = program.run("check", "--format", "json", "-", stdin=scene)
    return done.returncode, [json.loads(line) for line in done.stdout.decode().splitlines()]


class Json(unittest.TestCase):
    FIELDS = {"file", "line", "column", "end_column", "severity", "message", "suggestion"}

    def test_one_object_a_line_with_the_documented_fields(self):
        code, messages = check_json("sphere { raduis 1 }\nsphere { radius nan }\n")
        self.assertEqual((code, len(messages)), (1, 2))
        for message in messages:
            self.assertLessEqual(self.FIELDS, set(message))
            self.assertIsInstance(message["line"], int)
        self.assertEqual((messages[0]["column"], messages[0]["end_column"]), (10, 16))
        self.assertEqual(messages[0]["suggestion"], "did you mean 'radius'?")

    def test_quotation_marks_backslashes_and_tabs_survive(self):
        code, messages = check_json('sphere { radius "a\\"b\\\\c\td" }\n')
        self.assertEqual((code, len(messages)), (1, 1))
        self.assertIn('"a\\"b\\\\c\td"', messages[0]["message"])

    def test_nothing_on_standard_error(self):
        for scene in (SOUND, "sphere { }", "sphere { raduis 1 }"):
            self.assertEqual(program.run("check", "--format", "json", "-", stdin=scene.encode()).stderr, b"")

    def test_a_sound_scene_says_nothing(self):
        self.assertEqual(check_json(SOUND), (0, []))

    def test_warnings_carry_their_severity(self):
        code, messages = check_json("sphere { }")
        self.assertEqual(code, 0)
        self.assertEqual({m["severity"] for m in messages}, {"warning"})


class Warnings(unittest.TestCase):
    def warnings(self, scene):
        code, messages = check_json(scene)
        self.assertEqual(code, 0, messages)
        self.assertEqual({m["severity"] for m in messages} - {"warning"}, set())
        return [m["message"] for m in messages]

    def test_none_for_a_sound_scene(self):
        self.assertEqual(self.warnings(SOUND), [])

    def test_no_camera(self):
        warnings = self.warnings("light { position 3 4 5 }\nsphere { }\n")
        self.assertEqual(len(warnings), 1)
        self.assertIn("camera", warnings[0])

    def test_no_light(self):
        warnings = self.warnings("camera { position 0 0 5 }\nsphere { }\n")
        self.assertEqual(len(warnings), 1)
        self.assertIn("light", warnings[0])

    def test_ambient_light_is_light(self):
        self.assertEqual(self.warnings("render { ambient 1 }\ncamera { position 0 0 5 }\nsphere { }\n"), [])

    def test_unused_material_at_its_place(self):
        code, messages = check_json(SOUND + "material spare { }\n")
        self.assertEqual((code, len(messages)), (0, 1))
        self.assertEqual((messages[0]["line"], messages[0]["column"]), (4, 1))
        self.assertIn("spare", messages[0]["message"])

    def test_a_material_used_by_a_group_is_used(self):
        self.assertEqual(self.warnings(LIT + "material m { }\ngroup { material m sphere { } }\n"), [])

    def test_a_material_of_a_shape_out_of_view_is_used(self):
        self.assertEqual(self.warnings(SOUND + "material m { }\nsphere { center 0 0 99 material m }\n"), [])

    def test_nothing_in_view(self):
        for scene in (LIT, LIT + "sphere { center 0 0 50 }\n", LIT + "sphere { center 500 0 0 }\n",
                      LIT + "plane { point 0 0 99 normal 0 0 1 }\n"):
            warnings = self.warnings(scene)
            self.assertEqual(len(warnings), 1, scene)
            self.assertIn("in view", warnings[0])

    def test_something_in_view_is_no_warning(self):
        for shape in ("sphere { radius 100 }", "plane { point 0 -1 0 }", "sphere { center 2.5 0 0 }",
                      "quad { origin -50 -50 0 width 100 0 0 height 0 100 0 }", "cube { size 1000 }"):
            self.assertEqual(self.warnings(LIT + shape), [], shape)

    def test_no_warning_beside_an_error(self):
        code, messages = check_json("material spare { }\nsphere { raduis 1 }\n")
        self.assertEqual((code, [m["severity"] for m in messages]), (1, ["error"]))

    def test_warnings_do_not_stop_the_picture(self):
        done = program.run("-", "-o", "-", "--size", "8x8", stdin=b"sphere { }")
        self.assertEqual(done.returncode, 0)
        self.assertTrue(done.stdout.startswith(b"\x89PNG"))
        self.assertIn(b"warning:", done.stderr)

    def test_a_misspelt_variant_of_a_light_is_not_taken_for_its_name(self):
        for word in ("spto", "Spot", "directonal", "aera"):
            code, messages = check_json(LIT + f"light {word} {{ }}\nsphere {{ }}\n")
            self.assertEqual([(m["line"], m["column"]) for m in messages], [(3, 7)], word)


if __name__ == "__main__":
    unittest.main()
