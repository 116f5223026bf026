"""What the program answers: exit codes, which stream says what, where the picture goes."""

import os
import pathlib
import tempfile
import unittest

import program

SCENE = b"image { size 8 8 }\nlight { position 0 0 5 }\ncamera { position 0 0 5 }\nsphere { }\n"
PNG = b"\x89PNG\r\n\x1a\n"


def without_privileges():
    """Options of run() under which permissions count: those of a user who is not root."""
    if os.geteuid() != 0:
        return {}
    options = {"user": 65534, "group": 65534, "extra_groups": []}
    try:
        if program.run("--version", cwd="/", **options).returncode == 0:
            return options
    except (PermissionError, program.subprocess.SubprocessError):
        pass
    raise unittest.SkipTest("this is root, and others may not run the program where it stands")


class InAFolder(unittest.TestCase):
    """Every test has a folder of its own with a sound scene in it."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.folder.chmod(0o755)
        (self.folder / "scene.txt").write_bytes(SCENE)

    def run_here(self, *arguments, **options):
        return program.run(*arguments, cwd=self.folder, **options)

    def files(self):
        return sorted(path.name for path in self.folder.iterdir())

    def assert_fails(self, done, code, *words):
        """The exit code, a message of one line or more on standard error, nothing on standard output."""
        self.assertEqual(done.returncode, code, done)
        self.assertEqual(done.stdout, b"")
        for word in words:
            self.assertIn(word, done.stderr.decode())
        self.assertTrue(done.stderr.endswith(b"\n"), done.stderr)


class Success(InAFolder):
    def test_the_picture_has_the_name_of_the_scene_in_the_current_folder(self):
        elsewhere = self.folder / "elsewhere"
        elsewhere.mkdir()
        done = program.run("../scene.txt", cwd=elsewhere)
        self.assertEqual((done.returncode, done.stdout, done.stderr), (0, b"", b""))
        self.assertEqual([path.name for path in elsewhere.iterdir()], ["scene.png"])
        self.assertEqual(self.files(), ["elsewhere", "scene.txt"])

    def test_only_the_last_ending_of_the_scene_is_replaced(self):
        for scene, picture in (("a.b.txt", "a.b.png"), ("plain", "plain.png"), (".hidden", ".hidden.png")):
            (self.folder / scene).write_bytes(SCENE)
            self.assertEqual(self.run_here(scene).returncode, 0)
            self.assertTrue((self.folder / picture).read_bytes().startswith(PNG), picture)

    def test_render_may_be_said(self):
        self.assertEqual(self.run_here("render", "scene.txt", "-o", "a.png").returncode, 0)
        self.assertEqual(self.run_here("scene.txt", "-o", "b.png").returncode, 0)
        self.assertEqual((self.folder / "a.png").read_bytes(), (self.folder / "b.png").read_bytes())

    def test_standard_input_to_standard_output(self):
        self.run_here("scene.txt")
        done = self.run_here("-", "-o", "-", stdin=SCENE)
        self.assertEqual((done.returncode, done.stderr), (0, b""))
        self.assertEqual(done.stdout, (self.folder / "scene.png").read_bytes())
        self.assertEqual(self.files(), ["scene.png", "scene.txt"])

    def test_pfm_by_its_ending(self):
        done = self.run_here("scene.txt", "-o", "out.pfm")
        self.assertEqual((done.returncode, done.stderr), (0, b""))
        width, height, _ = program.read_pfm((self.folder / "out.pfm").read_bytes())
        self.assertEqual((width, height), (8, 8))

    def test_endings_in_capitals(self):
        self.assertEqual(self.run_here("scene.txt", "-o", "OUT.PNG").returncode, 0)
        self.assertEqual(self.run_here("scene.txt", "-o", "OUT.PFM").returncode, 0)
        self.assertTrue((self.folder / "OUT.PNG").read_bytes().startswith(PNG))
        self.assertTrue((self.folder / "OUT.PFM").read_bytes().startswith(b"PF\n"))

    def test_names_with_blanks_and_letters_beyond_ascii(self):
        (self.folder / "my scène.txt").write_bytes(SCENE)
        self.assertEqual(self.run_here("my scène.txt").returncode, 0)
        self.assertIn("my scène.png", self.files())

    def test_check_renders_nothing(self):
        done = self.run_here("check", "scene.txt")
        self.assertEqual((done.returncode, done.stdout, done.stderr), (0, b"", b""))
        self.assertEqual(self.files(), ["scene.txt"])

    def test_an_empty_scene_is_a_picture_with_warnings(self):
        (self.folder / "empty.txt").write_bytes(b"")
        done = self.run_here("empty.txt", "--size", "8x8")
        self.assertEqual((done.returncode, done.stdout), (0, b""))
        self.assertIn(b"warning:", done.stderr)
        self.assertIn("empty.png", self.files())

    def test_an_old_picture_is_replaced_and_keeps_its_permissions(self):
        picture = self.folder / "scene.png"
        picture.write_bytes(b"old")
        picture.chmod(0o640)
        self.assertEqual(self.run_here("scene.txt").returncode, 0)
        self.assertTrue(picture.read_bytes().startswith(PNG))
        self.assertEqual(picture.stat().st_mode & 0o777, 0o640)

    def test_a_new_picture_obeys_the_umask(self):
        self.assertEqual(self.run_here("scene.txt", umask=0o027).returncode, 0)
        self.assertEqual((self.folder / "scene.png").stat().st_mode & 0o777, 0o640)

    def test_a_link_to_a_picture_stays_a_link(self):
        (self.folder / "real").mkdir()
        (self.folder / "scene.png").symlink_to("real/picture.png")
        self.assertEqual(self.run_here("scene.txt").returncode, 0)
        self.assertTrue((self.folder / "scene.png").is_symlink())
        self.assertTrue((self.folder / "real" / "picture.png").read_bytes().startswith(PNG))


class WrongScene(InAFolder):
    def test_a_mistake(self):
        (self.folder / "wrong.txt").write_text("sphere { raduis 1 }")
        for command in ("render", "check"):
            self.assert_fails(self.run_here(command, "wrong.txt"), 1, "raduis")
        self.assertEqual(self.files(), ["scene.txt", "wrong.txt"])

    def test_a_missing_file_that_it_names(self):
        (self.folder / "wrong.txt").write_text('include "missing.txt"')
        self.assert_fails(self.run_here("wrong.txt"), 1, "missing.txt")

    def test_a_file_that_it_names_and_nobody_may_read(self):
        options = without_privileges()
        (self.folder / "secret.txt").write_text("sphere { }")
        (self.folder / "secret.txt").chmod(0)
        (self.folder / "wrong.txt").write_text('include "secret.txt"')
        self.assert_fails(self.run_here("check", "wrong.txt", **options), 1, "secret.txt", "Permission denied")


class WrongUse(InAFolder):
    def test_no_scene(self):
        self.assert_fails(self.run_here(), 2, "raytracer")
        self.assert_fails(self.run_here("check"), 2, "scene")
        self.assert_fails(self.run_here("-o", "out.png"), 2, "scene")

    def test_two_scenes(self):
        self.assert_fails(self.run_here("scene.txt", "scene.txt"), 2, "scene.txt")

    def test_an_ending_that_is_no_picture(self):
        for name in ("out.bmp", "out.jpg", "out.txt", "out.png.bak"):
            self.assert_fails(self.run_here("scene.txt", "-o", name), 2, name, ".png", ".pfm")
        self.assertEqual(self.files(), ["scene.txt"])

    def test_no_name_for_the_picture_of_standard_input(self):
        self.assert_fails(self.run_here("-", stdin=SCENE), 2, "-o")

    def test_a_camera_that_is_not_there(self):
        self.assert_fails(self.run_here("scene.txt", "--camera", "front"), 2, "front")

    def test_wrong_use_is_told_before_a_wrong_scene(self):
        (self.folder / "wrong.txt").write_text("sphere { raduis 1 }")
        self.assert_fails(self.run_here("wrong.txt", "-o", "out.bmp"), 2, "out.bmp")


class NotReadNotWritten(InAFolder):
    def test_a_scene_that_is_not_there(self):
        for command in ("render", "check"):
            self.assert_fails(self.run_here(command, "missing.txt"), 3, "missing.txt", "No such file")

    def test_a_folder_as_a_scene(self):
        self.assert_fails(self.run_here("."), 3, "folder")
        self.assert_fails(self.run_here("check", "."), 3, "folder")

    def test_a_scene_of_no_name(self):
        self.assert_fails(self.run_here("check", ""), 3)

    def test_a_scene_that_is_no_text(self):
        for content in (b"\x7fELF\0\0\0", PNG + b"\0\0\0\rIHDR", b"\0", SCENE + b"\0", "sphere { }".encode("utf-16")):
            (self.folder / "binary.txt").write_bytes(content)
            self.assert_fails(self.run_here("check", "binary.txt"), 3, "binary.txt", "text")

    def test_an_endless_scene(self):
        self.assert_fails(self.run_here("check", "/dev/zero"), 3, "/dev/zero")

    def test_a_scene_that_nobody_may_read(self):
        options = without_privileges()
        (self.folder / "scene.txt").chmod(0)
        self.assert_fails(self.run_here("check", "scene.txt", **options), 3, "Permission denied")

    def test_a_missing_folder_for_the_picture(self):
        self.assert_fails(self.run_here("scene.txt", "-o", "missing/out.png"), 3, "missing")
        self.assertEqual(self.files(), ["scene.txt"])

    def test_a_folder_as_the_picture(self):
        (self.folder / "out.png").mkdir()
        self.assert_fails(self.run_here("scene.txt", "-o", "out.png"), 3, "folder")
        self.assert_fails(self.run_here("scene.txt", "-o", "./"), 3, "folder")

    def test_a_file_as_the_folder_of_the_picture(self):
        self.assert_fails(self.run_here("scene.txt", "-o", "scene.txt/out.png"), 3, "scene.txt")
        self.assertEqual((self.folder / "scene.txt").read_bytes(), SCENE)

    def test_a_folder_where_nothing_may_be_written(self):
        options = without_privileges()
        (self.folder / "locked").mkdir()
        (self.folder / "locked").chmod(0o500)
        self.assert_fails(self.run_here("scene.txt", "-o", "locked/out.png", **options), 3, "locked")

    def test_a_picture_with_a_name_too_long(self):
        self.assert_fails(self.run_here("scene.txt", "-o", "x" * 300 + ".png"), 3, "name too long")
        self.assertEqual(self.files(), ["scene.txt"])

    def test_the_longest_name_is_none_too_long(self):
        name = "x" * 251 + ".png"
        self.assertEqual(self.run_here("scene.txt", "-o", name).returncode, 0)
        self.assertEqual(self.files(), ["scene.txt", name])

    def test_standard_output_that_takes_nothing(self):
        with open("/dev/full", "wb") as full:
            for arguments in (["scene.txt", "-o", "-"], ["help"], ["help", "light"], ["--help"], ["--version"]):
                done = program.subprocess.run([program.PROGRAM, *arguments], cwd=self.folder, stdout=full,
                                              stderr=program.subprocess.PIPE, check=False)
                self.assertEqual(done.returncode, 3, arguments)
                self.assertIn(b"No space left on device", done.stderr)

    def test_standard_error_that_takes_nothing_changes_no_exit_code(self):
        (self.folder / "wrong.txt").write_text("sphere { raduis 1 }")
        (self.folder / "warned.txt").write_text("sphere { }")
        with open("/dev/full", "wb") as full:
            for arguments, code in ((["check", "wrong.txt"], 1), (["--nonsense"], 2), (["check", "missing.txt"], 3),
                                    (["warned.txt", "--size", "8x8"], 0)):
                done = program.subprocess.run([program.PROGRAM, *arguments], cwd=self.folder, stderr=full, check=False)
                self.assertEqual(done.returncode, code, arguments)

    def test_closed_streams_change_no_exit_code_and_spoil_no_file(self):
        (self.folder / "wrong.txt").write_text("sphere { raduis 1 }")
        for command, code in (("check wrong.txt >&- 2>&-", 1), ("--nonsense 2>&-", 2), ("missing.txt 2>&-", 3),
                              ("check scene.txt <&- >&- 2>&-", 0), ("scene.txt <&- >&- 2>&-", 0)):
            done = program.subprocess.run(["sh", "-c", f'"$0" {command}', program.PROGRAM], cwd=self.folder, check=False)
            self.assertEqual(done.returncode, code, command)
        self.assertEqual((self.folder / "scene.png").read_bytes(), self.run_here("scene.txt", "-o", "-").stdout)

    def test_a_reader_that_goes_away_is_no_crash(self):
        done = program.subprocess.run(["sh", "-c", '{ "$0" help light; echo $? >&2; } | true', program.PROGRAM],
                                      stderr=program.subprocess.PIPE, check=False)
        self.assertIn(int(done.stderr.split()[-1]), (0, 3, 141), done.stderr)


class OntoWhatIsRead(InAFolder):
    """The picture never overwrites a file that the scene reads."""

    def setUp(self):
        super().setUp()
        (self.folder / "scene.png").write_bytes(SCENE + b'include "parts.png"\n')
        (self.folder / "parts.png").write_bytes(b"cube { }\n")
        (self.folder / "folder").mkdir()
        self.before = {name: (self.folder / name).read_bytes() for name in ("scene.png", "parts.png")}

    def assert_refused(self, output):
        done = self.run_here("scene.png", "-o", output)
        self.assert_fails(done, 3, str(output))
        for name, content in self.before.items():
            self.assertEqual((self.folder / name).read_bytes(), content)

    def test_by_name(self):
        self.assert_refused("scene.png")
        self.assert_refused("parts.png")

    def test_by_default(self):
        self.assert_fails(self.run_here("scene.png"), 3, "scene.png")

    def test_by_a_winding_path(self):
        self.assert_refused("folder/../scene.png")
        self.assert_refused(self.folder / "parts.png")

    def test_through_a_symbolic_link(self):
        for target in self.before:
            (self.folder / f"link-{target}").symlink_to(target)
            self.assert_refused(f"link-{target}")

    def test_through_a_hard_link(self):
        for target in self.before:
            os.link(self.folder / target, self.folder / f"hard-{target}")
            self.assert_refused(f"hard-{target}")

    def test_through_a_linked_folder(self):
        (self.folder / "folder" / "loop").symlink_to("..")
        self.assert_refused("folder/loop/scene.png")


if __name__ == "__main__":
    unittest.main()
