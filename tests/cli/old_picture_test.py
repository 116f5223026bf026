"""The picture appears whole or not at all: an old one survives whatever goes wrong, and nothing is left lying about."""

import os
import pathlib
import random
import resource
import signal
import subprocess
import tempfile
import time
import unittest

import program

SCENE = b"""light { position 3 5 5 }
camera { position 0 1 5 look_at 0 0 0 }
sphere { material { color tomato shininess 0.5 } }
plane { point 0 -1 0 }
"""
OLD = b"the old picture"


class OldPicture(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        (self.folder / "scene.txt").write_bytes(SCENE)
        self.picture = self.folder / "scene.png"
        self.picture.write_bytes(OLD)

    def assert_untouched(self):
        self.assertEqual(self.picture.read_bytes(), OLD)
        self.assert_nothing_else_left()

    def assert_nothing_else_left(self):
        self.assertEqual(sorted(path.name for path in self.folder.iterdir()), ["scene.png", "scene.txt"])

    def start(self, *arguments, **options):
        return subprocess.Popen([program.PROGRAM, "scene.txt", "--quiet", *arguments], cwd=self.folder,
                                stdout=subprocess.PIPE, stderr=subprocess.PIPE, **options)

    def start_long_rendering(self, *arguments):
        """A process that is sure to be rendering, and would go on for hours."""
        process = self.start("--size", "4000x4000", *arguments)
        ticks = 0
        while ticks < 0.2 * os.sysconf("SC_CLK_TCK"):
            self.assertIsNone(process.poll())
            time.sleep(0.01)
            ticks = int(pathlib.Path(f"/proc/{process.pid}/stat").read_text().rpartition(")")[2].split()[11])
        return process

    def test_survives_a_wrong_scene(self):
        (self.folder / "scene.txt").write_bytes(b"sphere { raduis 1 }")
        self.assertEqual(program.run("scene.txt", cwd=self.folder).returncode, 1)
        self.assert_untouched()

    def test_survives_a_limit_on_file_sizes(self):
        def limit():
            resource.setrlimit(resource.RLIMIT_FSIZE, (512, 512))
        for name in ("scene.png", "scene.pfm"):
            done = program.run("scene.txt", "-o", name, "--size", "200x200", cwd=self.folder, preexec_fn=limit)
            self.assertEqual(done.returncode, 3, done)
            self.assertIn(b"File too large", done.stderr)
            self.assertIn(name.encode(), done.stderr)
            self.assert_untouched()

    def test_survives_a_full_disk(self):
        disk = self.folder / "disk"
        disk.mkdir()
        mounted = subprocess.run(["mount", "-t", "tmpfs", "-o", "size=16k", "none", disk], capture_output=True,
                                 check=False) if os.geteuid() == 0 else None
        if mounted is None or mounted.returncode != 0:
            disk.rmdir()
            self.skipTest("a small disk to fill can't be mounted here")
        try:
            (disk / "scene.png").write_bytes(OLD)
            done = program.run("scene.txt", "-o", disk / "scene.png", "--size", "400x400", cwd=self.folder)
            self.assertEqual(done.returncode, 3, done)
            self.assertIn(b"No space left on device", done.stderr)
            self.assertEqual((disk / "scene.png").read_bytes(), OLD)
            self.assertEqual([path.name for path in disk.iterdir()], ["scene.png"])
        finally:
            subprocess.run(["umount", disk], check=True)
            disk.rmdir()
        self.assert_untouched()

    @unittest.skipIf(program.IS_SANITIZED, "the memory of a sanitized build can't be limited")
    def test_survives_too_little_memory(self):
        def limit():
            program.limit_memory(4 << 30)
            resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
        done = program.run("scene.txt", "--size", "65536x65536", cwd=self.folder, preexec_fn=limit)
        self.assertEqual(done.returncode, 3, done)
        self.assertIn(b"memory", done.stderr)
        self.assert_untouched()

    def test_survives_being_interrupted_while_rendering(self):
        for number in (signal.SIGINT, signal.SIGTERM):
            process = self.start_long_rendering("--samples", "10000")
            process.send_signal(number)
            out, error = process.communicate(timeout=60)
            self.assertEqual((process.returncode, out, error), (128 + number, b"", b""))
            self.assert_untouched()

    def test_interrupted_twice_it_stops_at_once(self):
        process = self.start_long_rendering("--samples", "1000000")
        process.send_signal(signal.SIGINT)
        time.sleep(0.1)
        if process.poll() is None:
            process.send_signal(signal.SIGTERM)
        self.assertIn(self.exit_code(process), (130, 143))
        self.assert_untouched()

    def test_one_interrupt_is_enough_however_long_a_pixel_takes(self):
        process = self.start_long_rendering("--samples", "1000000")
        self.addCleanup(process.kill)
        process.send_signal(signal.SIGINT)
        process.communicate(timeout=10)
        self.assertEqual(process.returncode, 130)
        self.assert_untouched()

    def test_is_either_old_or_new_whenever_a_signal_comes(self):
        whole = program.run("scene.txt", "-o", "-", "--size", "300x200", cwd=self.folder).stdout
        moments = random.Random(1)
        for i in range(40):
            number = (signal.SIGKILL, signal.SIGINT, signal.SIGTERM)[i % 3]
            self.picture.write_bytes(OLD)
            process = self.start("--size", "300x200")
            time.sleep(moments.uniform(0, 0.05))
            process.send_signal(number)
            code = self.exit_code(process)
            content = self.picture.read_bytes()
            self.assertIn(content, (OLD, whole), (number, code))
            self.assertIn(code, (0, -9) if number == signal.SIGKILL else (0, 128 + number, -number))
            if code == 0:
                self.assertEqual(content, whole)
            if number == signal.SIGKILL:  # nobody can tidy up after that one
                self.assertLessEqual(len(list(self.folder.iterdir())), 3)
                for path in self.folder.iterdir():
                    if path.name not in ("scene.png", "scene.txt"):
                        path.unlink()
            self.assert_nothing_else_left()

    def test_an_ignored_interrupt_stays_ignored(self):
        def ignore():
            signal.signal(signal.SIGINT, signal.SIG_IGN)
        process = self.start("--size", "300x200", preexec_fn=ignore)
        for _ in range(20):
            process.send_signal(signal.SIGINT)
            time.sleep(0.002)
        self.assertEqual(self.exit_code(process), 0)

    def test_two_at_once_make_one_whole_picture(self):
        whole = program.run("scene.txt", "-o", "-", "--size", "300x200", cwd=self.folder).stdout
        processes = [self.start("--size", "300x200") for _ in range(4)]
        self.assertEqual([self.exit_code(process) for process in processes], [0] * 4)
        self.assertEqual(self.picture.read_bytes(), whole)
        self.assert_nothing_else_left()

    def exit_code(self, process):
        process.communicate(timeout=60)
        return process.returncode


if __name__ == "__main__":
    unittest.main()
