"""What the scene reads, at whatever time, is never overwritten, and no file that is written takes the place of another."""

import os
import pathlib
import tempfile
import unittest

import program

HEAD = ("animation { duration 1 fps 4 }\nimage { size 20 10 }\ncamera { position 0 0 6 }\nlight { position 3 4 5 }\n"
        "sphere { center t 0 0 }\n")
LATER = 'if t > 0.3 { sphere { center 0 2 0 material { color image "NAME" } } }\n'
OBJ = "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl a\nf 1 2 3\n"


class InAFolder(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.write("scene.txt", HEAD)
        self.run_here("-o", "picture.png")
        self.picture = (self.folder / "picture.png").read_bytes()
        (self.folder / "picture.png").unlink()

    def write(self, name, text):
        (self.folder / name).parent.mkdir(exist_ok=True)
        (self.folder / name).write_text(text)

    def put_picture(self, name):
        (self.folder / name).write_bytes(self.picture)

    def run_here(self, *arguments):
        return program.run("scene.txt", "-q", *arguments, cwd=self.folder)

    def assert_refused(self, *arguments, code=3, keeps=(), says=""):
        before = {name: (self.folder / name).read_bytes() for name in keeps}
        there = sorted(path.name for path in self.folder.iterdir())
        done = self.run_here(*arguments)
        self.assertEqual((done.returncode, done.stdout), (code, b""), done)
        self.assertIn(says, done.stderr.decode())
        self.assertEqual({name: (self.folder / name).read_bytes() for name in keeps}, before)
        self.assertEqual(sorted(path.name for path in self.folder.iterdir()), there)  # not even a first frame


class LaterReads(InAFolder):
    def refuse_all(self, name):
        """However the picture's place is named: a film of PNG, numbered frames, a still at another moment."""
        self.put_picture(name)
        self.assert_refused("--frames", "all", "-o", name, keeps=[name], says=f"'{name}'")
        self.assert_refused("-o", name, keeps=[name], says=f"'{name}'")
        self.assert_refused("-o", name, "--time-at", "0.75", keeps=[name], says=f"'{name}'")

    def test_a_picture_in_a_branch(self):
        self.write("scene.txt", HEAD + LATER.replace("NAME", "tex.png"))
        self.refuse_all("tex.png")

    def test_a_picture_in_the_other_branch(self):
        self.write("scene.txt", HEAD + "if t < 0.3 { } else if t > 5 { } else { sky image \"tex.png\" }\n")
        self.refuse_all("tex.png")

    def test_a_picture_among_the_frames(self):
        self.write("scene.txt", HEAD + LATER.replace("NAME", "s.0002.png"))
        self.put_picture("s.0002.png")
        self.assert_refused("-o", "s.####.png", keeps=["s.0002.png"], says="'s.0002.png'")
        self.assertEqual(self.run_here("-o", "s.####.png", "--frames", "3-4").returncode, 0)

    def test_a_picture_that_a_frame_would_make(self):
        self.write("scene.txt", HEAD + LATER.replace("NAME", "s.0001.png"))
        self.assert_refused("-o", "s.####.png", says="'s.0001.png'")

    def test_names_that_are_values(self):
        for text in ('let a = "tex.png"\nif t > 0.3 { sky image { file a } }\n',
                     'let a = t > 0.3 ? "tex.png" : "other.png"\nsphere { material { color image { file a } } }\n',
                     'define d (a "tex.png") { sphere { material { color image { file a } } } }\nif t > 0.3 { d { } }\n',
                     'define d (a "other.png") { sphere { material { color image { file a } } } }\nif t > 0.3 { d { a "tex.png" } }\n'):
            self.put_picture("other.png")
            self.write("scene.txt", HEAD + text)
            self.refuse_all("tex.png")

    def test_a_name_from_the_command_line(self):
        self.put_picture("tex.png")
        self.put_picture("other.png")
        self.write("scene.txt", HEAD + 'let a = "other.png"\nif t > 0.3 { sky image { file a } }\n')
        self.assert_refused("-o", "tex.png", "--set", "a=tex.png", keeps=["tex.png"])

    def test_a_definition_that_is_used_later(self):
        self.write("scene.txt", HEAD + 'define d { sphere { material { color image "tex.png" } } }\nif t > 0.3 { d { } }\n')
        self.refuse_all("tex.png")

    def test_an_include_that_is_used_later(self):
        (self.folder / "parts").mkdir()
        self.write("parts/a.txt", 'include "b.txt"\n')
        self.write("parts/b.txt", 'sphere { material { color image "tex.png" } }\n')
        self.write("scene.txt", HEAD + 'if t > 0.3 { include "parts/a.txt" }\n')
        self.refuse_all("parts/tex.png")
        self.assert_refused("-o", "parts/../parts/tex.png")
        self.write("scene.txt", HEAD + 'if t > 0.3 { include "parts/c.png" }\n')
        self.write("parts/c.png", "cube { }\n")
        self.assert_refused("-o", "parts/c.png", keeps=["parts/c.png"])

    def test_a_mesh_that_is_used_later(self):
        self.write("a.mtl", "newmtl a\nmap_Kd tex.png\n")
        self.write("a.obj", OBJ)
        self.put_picture("tex.png")
        self.write("scene.txt", HEAD + 'if t > 0.3 { mesh { file "a.obj" } }\n')
        self.refuse_all("tex.png")
        for name in ("a.obj", "a.mtl"):
            os.link(self.folder / name, self.folder / f"{name}.png")
            self.assert_refused("-o", f"{name}.png", keeps=[name])

    def test_a_picture_that_is_left_out(self):
        self.write("a.mtl", "newmtl a\nmap_Kd tex.png\n")
        self.write("a.obj", OBJ)
        self.write("tex.png", "this is none")
        self.write("scene.txt", HEAD + 'mesh { file "a.obj" }\n')
        self.assert_refused("-o", "tex.png", keeps=["tex.png"])

    def test_by_a_link(self):
        self.write("scene.txt", HEAD + LATER.replace("NAME", "tex.png"))
        self.put_picture("tex.png")
        (self.folder / "soft.png").symlink_to("tex.png")
        os.link(self.folder / "tex.png", self.folder / "hard.png")
        for name in ("soft.png", "hard.png"):
            self.assert_refused("-o", name, keeps=["tex.png"])

    def test_in_json(self):
        self.put_picture("tex.png")
        self.write("scene.txt", HEAD + LATER.replace("NAME", "tex.png"))
        done = program.run("json", "scene.txt", "-o", "tex.png", cwd=self.folder)
        self.assertEqual(done.returncode, 3)
        done = program.run("json", "scene.txt", "--time-at", "0.5", cwd=self.folder)
        self.write("scene.txt", done.stdout.decode())
        self.assert_refused("-o", "tex.png", keeps=["tex.png"])

    def test_what_the_scene_never_names_is_free(self):
        self.write("scene.txt", HEAD + LATER.replace("NAME", "tex.png"))
        self.put_picture("tex.png")
        (self.folder / "elsewhere").mkdir()
        self.put_picture("elsewhere/tex.png")
        for name in ("scene.png", "elsewhere/tex.png", "/dev/null"):
            done = self.run_here("-o", name)
            self.assertEqual((done.returncode, done.stderr), (0, b""), name)


class Statistics(InAFolder):
    def test_not_onto_the_picture(self):
        self.put_picture("x.png")
        self.assert_refused("-o", "x.png", "--stats", "x.png", keeps=["x.png"], says="'x.png'")
        self.assert_refused("-o", "x.png", "--stats", "./x.png", keeps=["x.png"])
        self.assert_refused("-o", "new.png", "--stats", "new.png", says="'new.png'")
        self.assert_refused("--stats", "scene.png", says="'scene.png'")
        self.assert_refused("-o", "f.##.png", "--stats", "f.03.png", says="'f.03.png'")

    def test_not_onto_what_is_read(self):
        self.put_picture("tex.png")
        self.write("scene.txt", HEAD + LATER.replace("NAME", "tex.png"))
        for name in ("scene.txt", "tex.png"):
            self.assert_refused("-o", "x.png", "--stats", name, keeps=["scene.txt", "tex.png"], says=f"'{name}'")

    def test_standard_output(self):
        done = self.run_here("-o", "x.png", "--stats", "-")
        self.assertEqual((done.returncode, done.stderr), (0, b""))
        self.assertTrue(done.stdout.startswith(b'{"load": '), done.stdout)
        self.assertFalse((self.folder / "-").exists())
        self.assert_refused("-o", "-", "--stats", "-", code=2, says="--stats")

    def test_devices_are_no_files(self):
        self.assertEqual(self.run_here("-o", "/dev/null", "--stats", "/dev/null").returncode, 0)


if __name__ == "__main__":
    unittest.main()
