"""raytracer fmt: its exit codes, what it writes and what it leaves alone; and no picture changes by it."""

import pathlib
import shutil
import tempfile
import unittest

from program import ROOT, run

UGLY = b"\xef\xbb\xbfsphere   ball{center 0 1 0 radius   1}  // c\r\n"
NEAT = b"sphere ball { center 0 1 0  radius 1 }  // c\n"


class Formatting(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.ugly, self.neat = self.folder / "ugly.txt", self.folder / "neat.txt"
        self.ugly.write_bytes(UGLY)
        self.neat.write_bytes(NEAT)

    def test_prints(self):
        done = run("fmt", self.ugly)
        self.assertEqual((done.returncode, done.stdout, done.stderr), (0, NEAT, b""))
        self.assertEqual(self.ugly.read_bytes(), UGLY)
        self.assertEqual(run("fmt", "-", stdin=UGLY).stdout, NEAT)

    def test_check(self):
        done = run("fmt", "--check", self.ugly, self.neat)
        self.assertEqual((done.returncode, done.stdout), (1, f"{self.ugly}\n".encode()))
        done = run("fmt", "--check", self.neat)
        self.assertEqual((done.returncode, done.stdout, done.stderr), (0, b"", b""))
        self.assertEqual(self.ugly.read_bytes(), UGLY)

    def test_in_place(self):
        before = self.neat.stat()
        done = run("fmt", "--in-place", self.ugly, self.neat)
        self.assertEqual((done.returncode, done.stdout, done.stderr), (0, b"", b""))
        self.assertEqual(self.ugly.read_bytes(), NEAT)
        after = self.neat.stat()
        self.assertEqual((after.st_ino, after.st_mtime_ns), (before.st_ino, before.st_mtime_ns))
        self.assertEqual(sorted(p.name for p in self.folder.iterdir()), ["neat.txt", "ugly.txt"])

    def test_mistakes_are_told_and_nothing_is_written(self):
        bad = self.folder / "bad.txt"
        bad.write_bytes(b"sphere {\n  radius (1 +)\n")
        for option in ([], ["--check"], ["--in-place"]):
            done = run("fmt", *option, bad)
            self.assertEqual((done.returncode, done.stdout), (1, b""))
            self.assertIn(f"{bad}:2:".encode(), done.stderr)
        self.assertEqual(bad.read_bytes(), b"sphere {\n  radius (1 +)\n")

    def test_usage(self):
        self.assertEqual(run("fmt").returncode, 2)
        self.assertEqual(run("fmt", "--check", "--in-place", self.ugly).returncode, 2)
        self.assertEqual(run("fmt", "--in-place", "-", stdin=UGLY).returncode, 2)
        self.assertEqual(run("fmt", self.folder / "none.txt").returncode, 3)
        self.assertEqual(self.ugly.read_bytes(), UGLY)

    def test_no_picture_changes(self):
        copy = self.folder / "scenes"
        shutil.copytree(ROOT / "scenes", copy)
        scenes = sorted(path.relative_to(copy) for path in copy.rglob("*.txt"))
        self.assertGreater(len(scenes), 10)
        self.assertEqual(run("fmt", "--in-place", *scenes, cwd=copy).stderr, b"")
        for scene in scenes:
            with self.subTest(scene=str(scene)):
                options = ("--size", "32x18", "--samples", "1", "-q", "-o", "-")
                before = run(scene, *options, cwd=ROOT / "scenes")
                after = run(scene, *options, cwd=copy)
                self.assertEqual(after.stdout, before.stdout)
                self.assertEqual(after.returncode, before.returncode)


if __name__ == "__main__":
    unittest.main()
