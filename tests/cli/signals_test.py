"""Ctrl-C and its kin end the program at once, and leave the terminal as it was."""

import os
import pathlib
import signal
import subprocess
import tempfile
import unittest

import program

SCENE = b"light { position 3 5 5 }\ncamera { position 0 1 5 look_at 0 0 0 }\nsphere { }\n"
CLEAR_LINE = b"\r\x1b[K"


class Signals(unittest.TestCase):
    def interrupted(self, number, wait_for, *arguments, **options):
        """(exit code, what stood on the terminal) of a rendering of hours that gets a signal once `wait_for` is seen."""
        leader, follower = program.open_terminal()
        with tempfile.TemporaryDirectory() as folder:
            (pathlib.Path(folder) / "scene.txt").write_bytes(SCENE)
            process = subprocess.Popen([program.PROGRAM, "scene.txt", *arguments], cwd=folder, stderr=follower,
                                       stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, **options)
            os.close(follower)
            seen = b""
            while wait_for not in seen:
                seen += os.read(leader, 65536)
            process.send_signal(number)
            try:
                while part := os.read(leader, 65536):
                    seen += part
            except OSError:  # how Linux says that the other side is closed
                pass
            os.close(leader)
            code = process.wait()
            self.assertEqual(os.listdir(folder), ["scene.txt"])
        return code, seen

    def test_one_signal_ends_it_and_clears_the_bar(self):
        for number, code in ((signal.SIGINT, 130), (signal.SIGTERM, 143), (signal.SIGHUP, 129)):
            ended, seen = self.interrupted(number, b"left", "--size", "4000x4000", "--samples", "1000")
            self.assertEqual(ended, code)
            self.assertTrue(seen.endswith(CLEAR_LINE), seen[-200:])



if __name__ == "__main__":
    unittest.main()
