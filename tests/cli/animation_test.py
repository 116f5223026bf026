"""Frames, films and moments: --frames, --time-at, --resume, names with #, APNG, and what goes through ffmpeg."""

import fcntl
import os
import pathlib
import re
import shutil
import signal
import struct
import subprocess
import tempfile
import termios
import time
import unittest
import zlib

import program

# Twelve frames; the ball moves in every one, the material only at every third.
SCENE = """image { size 15 9 }
animation { duration 1 fps 12 }
camera { position 0 0 6 }
light { position 3 5 5 intensity 2000 }
sphere { center (2*cos(360*t)) 0 0 material { color (hsv(90*floor(4*t), 0.8, 1)) } }
"""
HELD = SCENE.replace("cos(360*t)", "cos(90*floor(4*t))")
FFMPEG = shutil.which("ffmpeg")


def chunks_of(data):
    """[(type, content)] of a PNG, every checksum checked."""
    assert data[:8] == b"\x89PNG\r\n\x1a\n"
    chunks, at = [], 8
    while at < len(data):
        size, kind = struct.unpack(">I4s", data[at:at + 8])
        content = data[at + 8:at + 8 + size]
        assert struct.unpack(">I", data[at + 8 + size:at + 12 + size])[0] == zlib.crc32(kind + content)
        chunks.append((kind, content))
        at += 12 + size
    return chunks


def texts_of(data):
    return dict(content.split(b"\0", 1) for kind, content in chunks_of(data) if kind == b"tEXt")


def pixels_of(data):
    """The filtered rows of a PNG's own picture."""
    return zlib.decompress(b"".join(content for kind, content in chunks_of(data) if kind == b"IDAT"))


def frames_of_apng(data):
    """[(filtered rows, (delay's numerator, denominator))]"""
    frames, sequence = [], 0
    for kind, content in chunks_of(data):
        if kind in (b"fcTL", b"fdAT"):
            assert struct.unpack(">I", content[:4])[0] == sequence
            sequence += 1
        if kind == b"fcTL":
            frames.append([b"", struct.unpack(">HH", content[20:24])])
        elif kind == b"IDAT":
            frames[-1][0] += content
        elif kind == b"fdAT":
            frames[-1][0] += content[4:]
    return [(zlib.decompress(rows), delay) for rows, delay in frames]


class InAFolder(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.write(SCENE)

    def write(self, text, name="scene.txt"):
        (self.folder / name).write_text(text)

    def run_here(self, *arguments, **options):
        return program.run(*arguments, cwd=self.folder, **options)

    def render(self, *arguments, **options):
        done = self.run_here("scene.txt", *arguments, **options)
        self.assertEqual((done.returncode, done.stderr), (0, b""), arguments)
        return done.stdout

    def read(self, name):
        return (self.folder / name).read_bytes()

    def files(self):
        return sorted(path.name for path in self.folder.iterdir() if path.name != "scene.txt")

    def assert_refused(self, code, arguments, *words, **options):
        before = self.files()
        done = self.run_here("scene.txt", *arguments, **options)
        self.assertEqual((done.returncode, done.stdout), (code, b""), (arguments, done.stderr))
        for word in words:
            self.assertIn(word, done.stderr.decode(), arguments)
        self.assertEqual(self.files(), before)


class Frames(InAFolder):
    def test_a_number_in_the_name_asks_for_all_frames(self):
        self.render("-o", "shot.####.png")
        self.assertEqual(self.files(), [f"shot.{n:04}.png" for n in range(1, 13)])

    def test_the_number_is_as_long_as_its_place(self):
        self.render("-o", "a#.png", "--frames", "9-11")
        self.render("-o", "b##.png", "--frames", "9-11")
        self.assertEqual(self.files(), ["a10.png", "a11.png", "a9.png", "b09.png", "b10.png", "b11.png"])

    def test_lists(self):
        for text, numbers in (("all", range(1, 13)), ("3", [3]), ("2-4", [2, 3, 4]), ("1-12x5", [1, 6, 11]),
                              ("3,7,10-20", [3, 7, 10, 11, 12]), ("11-900", [11, 12])):
            self.render("-o", "f##.png", "--frames", text)
            self.assertEqual(self.files(), [f"f{n:02}.png" for n in numbers], text)
            for name in self.files():
                (self.folder / name).unlink()

    def test_nonsense(self):
        for text in ("", "x", "0x3", "1-", "3-1", "1.5", "1-4x0", "1,,2"):
            self.assert_refused(2, ["--frames", text, "-o", "f#.png"], "--frames")

    def test_an_empty_list_tells_how_many_there_are(self):
        self.assert_refused(2, ["--frames", "13-20", "-o", "f#.png"], "12 frames")
        self.assert_refused(2, ["--frames", "0", "-o", "f#.png"], "12 frames")

    def test_the_frames_are_the_moments(self):
        self.render("-o", "f##.png")
        for n in (1, 4, 12):
            self.render("-o", "still.png", "--time-at", repr((n - 1) / 12))
            self.assertEqual(pixels_of(self.read(f"f{n:02}.png")), pixels_of(self.read("still.png")), n)
        self.assertNotEqual(pixels_of(self.read("f01.png")), pixels_of(self.read("f04.png")))

    def test_alone_or_in_a_run_the_same_bytes(self):
        self.write(HELD.replace("image { size 15 9 }", "image { size 15 9 }\nrender { samples 3 }") + """
define heap (n 1) { for i from 1 to 20 { sphere { center (i - 10) (n - 2) -5 radius 0.4 material { color tomato } } } }
if t > 0.2 { heap { } heap { } heap { translate 0 1 0 } }
cube { size 0.5 material { color (0.2, t, 0.5) } }
""")
        self.render("-o", "run##.png")
        for n in (1, 2, 5, 12):
            self.render("-o", "alone##.png", "--frames", str(n))
            self.assertEqual(self.read(f"alone{n:02}.png"), self.read(f"run{n:02}.png"), n)
        self.render("-o", "plain.png", "--frames", "5")
        self.assertEqual(self.read("plain.png"), self.read("run05.png"))
        self.assertEqual(self.render("-o", "-", "--frames", "5"), self.read("run05.png"))

    def test_any_number_of_threads_the_same_bytes(self):
        self.render("-o", "a##.png", "--threads", "1")
        self.render("-o", "b##.png", "--threads", "3")
        for n in range(1, 13):
            self.assertEqual(self.read(f"a{n:02}.png"), self.read(f"b{n:02}.png"))

    def test_a_frame_like_the_one_before_is_a_copy(self):
        self.write(HELD)
        self.render("-o", "f##.png", "--stats", "stats.json")
        frames = [self.read(f"f{n:02}.png") for n in range(1, 13)]
        self.assertEqual(len(set(frames)), 4)
        for n in range(12):
            self.assertEqual(frames[n], frames[n - n % 3])
        copied = re.search(rb'"rays": (\d+)', self.read("stats.json"))[1]
        self.render("-o", "g##.png", "--frames", "1-12x3", "--stats", "stats.json")
        self.assertEqual(re.search(rb'"rays": (\d+)', self.read("stats.json"))[1], copied)

    def test_without_a_name_the_frames_are_numbered(self):
        self.render("--frames", "2,3")
        self.assertEqual(self.files(), ["scene.0002.png", "scene.0003.png"])

    def test_without_any_of_it_the_still_at_0(self):
        self.render()
        self.render("-o", "first.png", "--time-at", "0")
        self.assertEqual(self.read("scene.png"), self.read("first.png"))
        self.assertNotIn(b"Scene-Hash", texts_of(self.read("scene.png")))

    def test_frames_as_pfm(self):
        self.render("-o", "f#.pfm", "--frames", "1,2")
        self.assertNotEqual(self.read("f1.pfm"), self.read("f2.pfm"))
        self.assert_refused(2, ["-o", "f.pfm", "--frames", "1,2"], "f.pfm", "####")

    def test_a_second_place_for_the_number(self):
        self.assert_refused(2, ["-o", "a#b#.png"], "a#b#.png")

    def test_a_number_sign_in_a_folder_means_nothing(self):
        (self.folder / "a#b").mkdir()
        self.render("-o", "a#b/still.png")
        self.assertEqual([path.name for path in (self.folder / "a#b").iterdir()], ["still.png"])

    def test_a_scene_without_an_animation(self):
        self.write(SCENE.replace("animation { duration 1 fps 12 }", ""))
        for arguments in (["--frames", "all"], ["-o", "f#.png"], ["-o", "film.mp4"]):
            self.assert_refused(2, arguments, "animation { duration")

    def test_the_scene_is_never_overwritten(self):
        self.write('include "f2.png"', "f2.png")
        self.write(SCENE + 'include "f2.txt"\n')
        self.write("cube { }", "f2.txt")
        os.link(self.folder / "f2.txt", self.folder / "f07.png")
        self.assert_refused(3, ["-o", "f##.png"], "f07.png")

    def test_the_seed_may_follow_the_frame(self):
        noisy = HELD.replace("animation", "render { samples 2 seed SEED }\nanimation")
        self.write(noisy.replace("SEED", "7"))
        self.render("-o", "a#.png", "--frames", "1,2")
        self.assertEqual(self.read("a1.png"), self.read("a2.png"))
        self.write(noisy.replace("SEED", "(6 + frame)"))
        self.render("-o", "b#.png", "--frames", "1,2")
        self.assertEqual(pixels_of(self.read("b1.png")), pixels_of(self.read("a1.png")))
        self.assertNotEqual(pixels_of(self.read("b2.png")), pixels_of(self.read("b1.png")))


class Moments(InAFolder):
    def test_any_scene_has_them(self):
        self.write(SCENE.replace("animation { duration 1 fps 12 }", "").replace("90*floor(4*t)", "10*frame"))
        self.render("-o", "a.png", "--time-at", "0.25")
        self.write(SCENE.replace("360*t", "360*0.25").replace("animation { duration 1 fps 12 }", "")
                   .replace("90*floor(4*t)", "10*7"))  # 24 frames a second
        self.render("-o", "b.png")
        self.assertEqual(self.read("a.png"), self.read("b.png"))

    def test_beyond_the_animation(self):
        self.render("-o", "a.png", "--time-at", "1000.125")

    def test_what_is_no_time(self):
        for text in ("", "x", "1s", "-1", "nan", "inf", "1e9", " 1", "0x1"):
            self.assert_refused(2, [f"--time-at={text}", "-o", "a.png"], "--time-at")

    def test_frames_are_something_else(self):
        self.assert_refused(2, ["--time-at", "1", "--frames", "1"], "--time-at", "--frames")
        self.assert_refused(2, ["--time-at", "1", "-o", "f#.png"], "--time-at", "f#.png")
        self.assert_refused(2, ["--time-at", "1", "-o", "f.mp4"], "--time-at", "f.mp4")
        self.assert_refused(2, ["--time-at", "1", "-o", "a.png", "--resume"], "--resume")


class WrongLater(InAFolder):
    def setUp(self):
        super().setUp()
        self.write(SCENE + "sphere { radius (0.4 - t) }\n")

    def test_frames_before_stay_and_the_message_names_the_frame(self):
        done = self.run_here("scene.txt", "-o", "f##.png")
        self.assertEqual((done.returncode, done.stdout), (1, b""))
        for word in ("frame 6", "t = 0.4", "scene.txt:6:", "radius"):
            self.assertIn(word, done.stderr.decode())
        self.assertEqual(self.files(), [f"f{n:02}.png" for n in range(1, 6)])

    def test_a_film_does_not_appear(self):
        for name in ["film.png"] + (["film.mp4", "film.gif"] if FFMPEG else []):
            self.assert_refused(1, ["-o", name, "--frames", "all"], "frame 6")

    def test_a_moment(self):
        self.assert_refused(1, ["-o", "a.png", "--time-at", "0.5"], "t = 0.5", "radius")
        self.render("-o", "a.png", "--time-at", "0.25")

    def test_a_mistake_at_once_is_told_as_ever(self):
        self.write(SCENE + "sphere { raduis 1 }\n")
        done = self.run_here("scene.txt", "-o", "f##.png")
        self.assertEqual(done.returncode, 1)
        self.assertTrue(done.stderr.startswith(b"error: "), done.stderr)

    def test_a_size_that_changes(self):
        self.write(SCENE.replace("15 9", "(15 + frame) 9"))
        self.render("-o", "f##.png", "--frames", "1,2")
        self.assertEqual([self.read(f"f{n:02}.png")[16:20] for n in (1, 2)], [b"\0\0\0\x10", b"\0\0\0\x11"])
        for name in ["film.png"] + (["film.mp4"] if FFMPEG else []):
            self.assert_refused(2, ["-o", name, "--frames", "all"], "frame 2", "17x9", "16x9")


class Resume(InAFolder):
    def times(self):
        return {path.name: path.stat().st_mtime_ns for path in self.folder.glob("*.png")}

    def render_again(self, *arguments):
        """The numbers of the frames that were written."""
        before = self.times()
        for name in before:  # so that a new file differs however coarse the clock is
            os.utime(self.folder / name, ns=(0, 0))
        self.render("-o", "f##.png", "--resume", *arguments)
        return [int(name[1:3]) for name, time_written in sorted(self.times().items()) if time_written != 0]

    def test_only_what_is_missing(self):
        self.render("-o", "f##.png")
        first = {name: self.read(name) for name in self.files()}
        self.assertEqual(self.render_again(), [])
        for n in (3, 4, 12):
            (self.folder / f"f{n:02}.png").unlink()
        self.assertEqual(self.render_again(), [3, 4, 12])
        self.assertEqual({name: self.read(name) for name in self.files()}, first)

    def test_without_it_everything_is_made_anew(self):
        self.render("-o", "f##.png")
        os.utime(self.folder / "f03.png", ns=(0, 0))
        self.render("-o", "f##.png")
        self.assertNotEqual(self.times()["f03.png"], 0)

    def test_what_changed_in_the_scene(self):
        self.render("-o", "f##.png")
        self.write("// a remark\n" + SCENE.replace("\n", "\n\n"))
        self.assertEqual(self.render_again(), [])
        self.write(SCENE + "if t > 0.7 { sphere { center 0 1 0 } }\n")
        self.assertEqual(self.render_again(), [10, 11, 12])
        self.write(SCENE.replace("intensity 2000", "intensity 2001"))
        self.assertEqual(self.render_again("--frames", "2-4"), [2, 3, 4])

    def test_what_changed_in_a_file_that_it_reads(self):
        self.write("cube { }", "part.txt")
        self.write(SCENE + 'include "part.txt"\n')
        self.render("-o", "f##.png", "--frames", "1-3")
        self.assertEqual(self.render_again("--frames", "1-3"), [])
        self.write("cube { size 1.01 }", "part.txt")
        self.assertEqual(self.render_again("--frames", "1-3"), [1, 2, 3])

    def test_a_longer_animation_keeps_its_beginning(self):
        self.render("-o", "f##.png")
        self.write(SCENE.replace("duration 1", "duration 1.25"))
        self.assertEqual(self.render_again(), [13, 14, 15])

    def test_options_that_change_pixels(self):
        def frame_keys(*arguments):
            self.render("-o", "g##.png", "--frames", "3", *arguments)
            return texts_of(self.read("g03.png"))[b"Scene-Hash"]
        same = frame_keys()
        self.assertEqual(frame_keys("--threads", "2"), same)
        self.assertEqual(frame_keys("--size", "15x9"), same)
        keys = {same}
        for arguments in (["--size", "9x15"], ["--samples", "2"], ["--bounces", "1"], ["--size", "16x9"]):
            keys.add(frame_keys(*arguments))
        self.assertEqual(len(keys), 5)

    def test_every_property_counts(self):
        """Whatever is written into the scene at the second frame makes it another one."""
        base = SCENE + "material spare { } camera second { position 0 1 9 }\n"
        variants = ["sphere { }", "sphere { radius 0.5 }", "torus { }",
                    "sphere { translate 0 0 1e-9 }", "group { translate 0 0 1e-9 sphere { } }", "sphere { material spare }",
                    "sphere { material { } }", "sphere { material { shininess 1e-9 } }", "light { }",
                    "light { falloff none }", "light directional { }", "background { color 0 0 1e-9 }",
                    "render { epsilon 1e-9 }", "render { seed 1 }", "render { ambient 0.1 }",
                    "group { material spare sphere { } }", "group { rotate 0 1e-9 0 sphere { } }"]
        keys = set()
        for variant in ["", *variants]:
            self.write(base + variant + "\n")
            done = self.run_here("scene.txt", "-o", "g##.png", "--frames", "2")
            self.assertEqual(done.returncode, 0, done.stderr)
            keys.add(texts_of(self.read("g02.png"))[b"Scene-Hash"])
        self.assertEqual(len(keys), len(variants) + 1)
        self.run_here("scene.txt", "-o", "g##.png", "--frames", "2", "--camera", "second")
        self.assertNotIn(texts_of(self.read("g02.png"))[b"Scene-Hash"], keys)

    def test_a_damaged_frame_is_made_anew(self):
        self.render("-o", "f##.png", "--frames", "1-3")
        (self.folder / "f02.png").write_bytes(self.read("f02.png")[:-5])
        (self.folder / "f03.png").write_bytes(b"")
        self.assertEqual(self.render_again("--frames", "1-3"), [2, 3])

    def test_another_programs_picture_is_made_anew(self):
        self.render("-o", "f01.png")
        self.assertEqual(self.render_again("--frames", "1"), [1])

    def test_damaged_pixels_are_made_anew(self):
        self.render("-o", "f##.png")
        whole = self.read("f05.png")
        begin = whole.index(b"IDAT") + 4
        for place in (begin, (begin + len(whole)) // 2, len(whole) - 17, 30):
            damaged = bytearray(whole)
            damaged[place] ^= 0x10
            (self.folder / "f05.png").write_bytes(damaged)
            self.assertEqual(self.render_again(), [5], place)
            self.assertEqual(self.read("f05.png"), whole)

    def test_a_blurred_frame_is_made_anew_when_only_its_motion_changed(self):
        scene = ("image {{ size 24 16 }} render {{ samples 8 }} animation {{ duration 1 fps 4 }}\n"
                 "camera {{ position 0 0 5 shutter 1 }} light {{ position 0 3 5 }}\n"
                 "sphere {{ center ({} * t) 0 0 radius 0.5 }}\n")
        self.write(scene.format(2))
        self.render("-o", "f#.png", "--frames", "1")
        first = self.read("f1.png")
        self.write(scene.format(6))
        self.render("-o", "f#.png", "--frames", "1", "--resume")
        self.assertNotEqual(self.read("f1.png"), first)

    def test_a_single_frame(self):
        self.render("-o", "a.png", "--frames", "3")
        os.utime(self.folder / "a.png", ns=(0, 0))
        self.render("-o", "a.png", "--frames", "3", "--resume")
        self.assertEqual(self.times()["a.png"], 0)
        self.render("-o", "a.png", "--frames", "4", "--resume")
        self.assertNotEqual(self.times()["a.png"], 0)

    def test_films_and_stills_can_not_be_gone_on_with(self):
        for arguments in (["-o", "f.mp4"], ["-o", "f.webm"], ["-o", "f.gif"], ["-o", "f.png", "--frames", "all"],
                          ["-o", "f#.pfm"], ["-o", "-", "--frames", "1"], ["-o", "f.png"], []):
            self.assert_refused(2, [*arguments, "--resume"], "--resume", "shot.####.png")


class MovingPng(InAFolder):
    def test_all_frames_in_one_file(self):
        self.render("-o", "film.png", "--frames", "all")
        self.render("-o", "f##.png")
        frames = frames_of_apng(self.read("film.png"))
        self.assertEqual(frames, [(pixels_of(self.read(f"f{n:02}.png")), (1, 12)) for n in range(1, 13)])
        chunks = dict(chunks_of(self.read("film.png")))
        self.assertEqual(struct.unpack(">II", chunks[b"acTL"]), (12, 0))

    def test_frames_alike_are_one_that_lasts(self):
        self.write(HELD)
        self.render("-o", "film.png", "--frames", "all")
        frames = frames_of_apng(self.read("film.png"))
        self.assertEqual([delay for _, delay in frames], [(3, 12)] * 4)

    def test_to_standard_output(self):
        self.render("-o", "film.png", "--frames", "2-4")
        self.assertEqual(self.render("-o", "-", "--frames", "2-4"), self.read("film.png"))

    def test_one_frame_is_a_plain_png(self):
        self.render("-o", "film.png", "--frames", "2")
        self.assertNotIn(b"acTL", dict(chunks_of(self.read("film.png"))))


class MissingFfmpeg(InAFolder):
    def test_is_told_before_rendering(self):
        empty = {"PATH": str(self.folder)}
        for name in ("film.mp4", "film.webm", "film.gif", "FILM.MP4"):
            self.assert_refused(3, ["-o", name, "--size", "20000x20000"], "ffmpeg", "install", name, env=empty, timeout=60)

    def test_in_a_path_that_is_not_set(self):
        environment = {name: value for name, value in os.environ.items() if name != "PATH"}
        done = subprocess.run([program.PROGRAM, "scene.txt", "-o", "film.mp4"], cwd=self.folder, env=environment,
                              capture_output=True, check=False)
        self.assertIn(done.returncode, (0, 3), done.stderr)


class FakeFfmpeg(InAFolder):
    """What happens around ffmpeg, with a shell script in its place."""

    def fake(self, script):
        tools = self.folder / "tools"
        tools.mkdir(exist_ok=True)
        path = tools / "ffmpeg"
        path.write_text("#!/bin/sh\nfor film do :; done\nfilm=${film#file:}\n" + script)
        path.chmod(0o755)
        return {"PATH": f"{tools}:{os.environ['PATH']}"}

    def film(self, script, **options):
        return self.run_here("scene.txt", "-o", "film.mp4", env=self.fake(script), **options)

    def test_it_gets_every_frame_in_bytes(self):
        done = self.film('echo "$@" > said; cat > "$film"')
        self.assertEqual((done.returncode, done.stdout, done.stderr), (0, b"", b""))
        self.assertEqual(len(self.read("film.mp4")), 12 * 16 * 10 * 3)  # even numbers
        words = self.read("said").decode().split()
        for option, value in (("-framerate", "12"), ("-video_size", "16x10"), ("-pixel_format", "rgb24")):
            self.assertEqual(words[words.index(option) + 1], value)

    def test_frames_alike_are_sent_again(self):
        self.write(HELD)
        self.film('cat > "$film"')
        data, size = self.read("film.mp4"), 16 * 10 * 3
        frames = [data[i:i + size] for i in range(0, len(data), size)]
        self.assertEqual((len(frames), len(set(frames))), (12, 4))

    def test_its_last_words_when_it_fails(self):
        for script in ('echo "no such codec" >&2; exit 1', 'cat > "$film"; echo "no such codec" >&2; exit 9',
                       'echo "no such codec" >&2; kill -9 $$', 'exec 0<&-; echo "no such codec" >&2; exit 2',
                       'yes noise | head -c 100000 >&2; echo "no such codec" >&2; exit 1'):
            self.fake("")
            self.assert_refused(3, ["-o", "film.mp4"], "ffmpeg", "film.mp4", "no such codec", env=self.fake(script))

    def test_an_old_film_survives_a_failure(self):
        (self.folder / "film.mp4").write_bytes(b"old")
        self.assertEqual(self.film('cat > "$film"; exit 1').returncode, 3)
        self.assertEqual(self.read("film.mp4"), b"old")
        self.assertEqual(self.files(), ["film.mp4", "tools"])

    def test_an_old_film_is_replaced_and_keeps_its_permissions(self):
        (self.folder / "film.mp4").write_bytes(b"old")
        (self.folder / "film.mp4").chmod(0o640)
        self.assertEqual(self.film('cat > "$film"').returncode, 0)
        self.assertEqual((self.folder / "film.mp4").stat().st_mode & 0o777, 0o640)
        self.assertNotEqual(self.read("film.mp4"), b"old")

    def test_nowhere_to_write(self):
        environment = self.fake('cat > "$film"')
        self.assert_refused(3, ["-o", "missing/film.mp4"], "missing", env=environment)
        os.mkfifo(self.folder / "pipe.mp4")
        self.assert_refused(3, ["-o", "pipe.mp4"], "pipe.mp4", env=environment)

    def test_a_signal_leaves_nothing_behind(self):
        for number in (signal.SIGINT, signal.SIGTERM):
            self.write(SCENE.replace("animation", "render { samples (frame == 1 ? 1 : 100000) }\nanimation"))
            environment = dict(os.environ, **self.fake('echo $$ > process; exec cat > "$film"'))
            process = subprocess.Popen([program.PROGRAM, "scene.txt", "-o", "film.mp4", "--size", "400x300"],
                                       cwd=self.folder, env=environment, stderr=subprocess.DEVNULL)
            while not (self.folder / "process").exists() or not self.read("process").endswith(b"\n"):
                self.assertIsNone(process.poll())
                time.sleep(0.01)
            process.send_signal(number)
            self.assertEqual(process.wait(timeout=60), 128 + number)
            ffmpeg = int(self.read("process"))
            (self.folder / "process").unlink()
            self.assertEqual(self.files(), ["tools"])
            self.assert_ends(ffmpeg)

    def assert_ends(self, process):
        for _ in range(1000):
            try:
                state = pathlib.Path(f"/proc/{process}/stat").read_text().rpartition(")")[2].split()[0]
            except (FileNotFoundError, ProcessLookupError):
                return
            if state in "ZX":
                return
            time.sleep(0.01)
        self.fail("ffmpeg is still there")


@unittest.skipUnless(FFMPEG, "no ffmpeg here")
class RealFfmpeg(InAFolder):
    def decode(self, name):
        """The film's frames as bytes of RGB, and their size."""
        done = subprocess.run([FFMPEG, "-v", "error", "-i", name, "-f", "image2pipe", "-c:v", "ppm", "-"], cwd=self.folder,
                              capture_output=True, check=True)
        frames, data = [], done.stdout
        while data:
            match = re.match(rb"P6\n(\d+) (\d+)\n255\n", data)
            width, height = int(match[1]), int(match[2])
            end = match.end() + 3 * width * height
            frames.append((width, height, data[match.end():end]))
            data = data[end:]
        return frames

    def test_films_show_the_frames(self):
        # Broad areas of one colour, which no codec spoils.
        self.write("""image { size 61 31 }
animation { duration 0.5 fps 10 }
render { ambient 1 }
light { intensity 0 }
camera { position 0 0 5 }
background { color (frame / 5) 0.25 0.5 }
sphere { center 900 0 0 }
""")
        for name, size in (("film.mp4", (62, 32)), ("film.webm", (61, 31)), ("film.gif", (61, 31))):
            done = self.run_here("scene.txt", "-o", name)
            if done.returncode == 3 and b"Unknown encoder" in done.stderr:
                continue  # a build of ffmpeg without it
            self.assertEqual(done.returncode, 0, done.stderr)
            frames = self.decode(name)
            self.assertEqual(len(frames), 5, name)
            for number, (width, height, pixels) in enumerate(frames, start=1):
                self.assertEqual((width, height), size)
                middle = 3 * (width * (height // 2) + width // 2)
                expected = (51 * number, 64, 128)
                for found, wanted in zip(pixels[middle:middle + 3], expected):
                    self.assertLessEqual(abs(found - wanted), 6, (name, number, pixels[middle:middle + 3], expected))

    def test_its_complaint_is_passed_on(self):
        (self.folder / "tools").mkdir()
        wrapper = self.folder / "tools" / "ffmpeg"
        wrapper.write_text(f'#!/bin/sh\nexec {FFMPEG} "$@" -no_such_option\n')
        wrapper.chmod(0o755)
        self.assert_refused(3, ["-o", "film.mp4"], "no_such_option",
                            env={"PATH": f"{self.folder / 'tools'}:{os.environ['PATH']}"})


class Terminal(InAFolder):
    def test_the_bar_tells_the_frame(self):
        leader, follower = program.open_terminal()
        fcntl.ioctl(follower, termios.TIOCSWINSZ, struct.pack("HHHH", 24, 80, 0, 0))
        process = subprocess.Popen([program.PROGRAM, "scene.txt", "-o", "f##.png", "--frames", "7,8", "--size", "900x600",
                                    "--samples", "16"], cwd=self.folder, stderr=follower, stdin=subprocess.DEVNULL)
        os.close(follower)
        seen = program.read_terminal(leader)
        self.assertEqual(process.wait(), 0)
        bars = [part for part in seen.decode().split("\r") if "left" in part]
        self.assertGreater(len(bars), 0, seen)
        for bar in bars:
            self.assertRegex(bar, r"\[#* *\] +\d+ %  .* left, frame [78]$")
        self.assertRegex(seen.decode(), r"f##.png: 2 frames of 900 x 600 in ")


if __name__ == "__main__":
    unittest.main()
