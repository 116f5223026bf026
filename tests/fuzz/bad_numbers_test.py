"""Bad numbers everywhere: in each property of each kind that the program itself lists, at each place of its values.
The answer is a message or a picture of finite values, never a crash."""

import json
import math
import pathlib
import re
import resource
import tempfile
import unittest

import program

NUMBERS = ["nan", "inf", "-inf", "1e999", "-1e999", "1e300", "-1e300", "3.5e38", "1e30", "1e18", "-1e18", "1e10", "-1e10", "-1",
           "0", "-0", "1e-10", "1e-18", "1e-30", "1e-45", "1e-300", "1e-999", "0.5", "4294967296", "0x1p3"]
SURELY_WRONG = {"nan", "inf", "-inf", "1e999", "-1e999", "0x1p3"}
FRAME = {"camera": "camera { position 0.5 1 6 look_at 0 0 0 }", "light": "light { position 2 5 6 }"}


PICTURE = '"tests/render/expected/first.png"'
# What these kinds can't be without.
NEEDED = {"triangle": {"a": "0 0 0", "b": "1 0 0", "c": "0 1 0"}, "animation": {"duration": "4"},
          "sky image": {"file": PICTURE}, "texture image": {"file": PICTURE},
          "texture ramp": {"by": "0.5", "stop": "0 0.1 0.2 0.3"},
          "mesh": {"vertices": "0 0 0  1 0 0  0 1 0", "faces": "0 1 2"}}
# What a single property can't be without.
ALONG = {"eta": " k 3.9 2.4 1.6", "k": " eta 0.14 0.37 1.44", "focal_length": " f_number 2.8", "f_number": " focal_length 0.05"}
# All kinds share the code that places them: these stand for all.
PLACED = {"sphere", "camera", "light spot", "group", "plane"}


def kinds():
    """(kind, {property: sound values}) for each kind of help."""
    listed = re.findall(r"^  (\w+(?: \w+)?)  ", program.run("help").stdout.decode(), re.MULTILINE)
    for kind in listed:
        page = program.run("help", kind.split()[0]).stdout.decode()
        section = re.search(rf"^{kind}:.*?(?=^\w+(?: \w+)?: |\Z)", page, re.MULTILINE | re.DOTALL)[0]
        if kind not in PLACED:
            section = section.partition("Where it stands")[0]
        yield kind, {name: values for name, values in numeric_properties(section) if name != "stop"}  # a number and a colour


def numeric_properties(page):
    counts = {"a number": 1, "a whole number": 1, "two whole numbers": 2, "three numbers": 3, "one number or three": 3,
              "a colour": 3, "an axis x y z and an angle": 4, "twelve numbers": 12}
    for name, facts in re.findall(r"^  (\w+) +\S.*\n {10,}(\S.*)$", page, re.MULTILINE):
        for words, count in counts.items():
            if re.match(words + r"\b", facts):
                default = re.search(r"default ((?:[-\d.]+ *)+)$", facts)
                values = default[1].split() if default else []
                sound = ["4"] if words == "a whole number" else (["0.25", "0.75", "0.5", "1"] * 3)[:count]
                yield name, values if len(values) == count else sound


def block(kind, name, values):
    properties = f"{name} {' '.join(values)}"
    properties += ALONG.get(name, "") + "".join(f" {other} {value}" for other, value in NEEDED.get(kind, {}).items() if other != name)
    if kind == "material":
        return f"sphere {{ material {{ {properties} }} }}"
    if kind.startswith("texture "):
        return f"sphere {{ material {{ color {kind.split()[1]} {{ {properties} }} }} }}"
    if kind == "group":
        return f"group {{ {properties} sphere {{ }} cube {{ center 1 1 0 }} }}"
    return f"{kind} {{ {properties} }}"


def scene_around(kind, one_block):
    frame = "".join(text + "\n" for word, text in FRAME.items() if word != kind)
    shapes = "" if kind in ("sphere", "group", "material", "texture") else "sphere { material { shininess 0.5 } }\n"
    return f"{frame}{one_block}\n{shapes}plane {{ point 0 -2 0 }}\n"


def limit():
    program.limit_processor_time(5)
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))


class BadNumbers(unittest.TestCase):
    def test_the_properties_are_found(self):
        found = dict(kinds())
        self.assertGreaterEqual(len(found), 17)
        self.assertEqual(found["sphere"]["radius"], ["1"])
        self.assertEqual(len(found["group"]["matrix"]), 12)
        self.assertIn("fov", found["camera"])
        self.assertIn("soft_edge", found["light spot"])

    def test_the_sound_scenes_are_sound(self):
        for kind, properties in kinds():
            for name, values in properties.items():
                scene = scene_around(kind.split()[0], block(kind, name, values))
                done = program.run("check", "-", stdin=scene.encode(), cwd=program.ROOT)
                self.assertEqual(done.returncode, 0, scene + done.stderr.decode())

    def test_each_property_with_each_number(self):
        for kind, properties in kinds():
            for name, sound in properties.items():
                for number in NUMBERS:
                    for values in self.variants(sound, number):
                        self.try_out(kind, name, values, number)

    def variants(self, sound, number):
        yield [number] * len(sound)
        if len(sound) > 1 and number in ("nan", "1e999", "-1e18", "1e-45", "0"):
            place = NUMBERS.index(number) % len(sound)
            yield sound[:place] + [number] + sound[place + 1:]

    def try_out(self, kind, name, values, number):
        scene = scene_around(kind.split()[0], block(kind, name, values))
        done = program.run("-", "-o", "-", "--size", "6x4", "--threads", "1", "--samples", "1", stdin=scene.encode(),
                           preexec_fn=limit, cwd=program.ROOT)
        self.assertIn(done.returncode, (0, 1), scene + done.stderr.decode())
        if number in SURELY_WRONG:
            self.assertEqual(done.returncode, 1, scene)
        if done.returncode == 0:
            self.assertTrue(done.stdout.startswith(b"\x89PNG") and done.stdout.endswith(b"IEND\xaeB`\x82"), scene)
        else:
            self.assertEqual(done.stdout, b"")
            self.assertIn(b":3:" if kind.split()[0] not in FRAME else b":2:", done.stderr)


def floats_of(path):
    _, _, rows = program.read_pfm(path.read_bytes())
    return [value for row in rows for pixel in row for value in pixel]


class FinitePictures(unittest.TestCase):
    """Where a picture comes out, its floats are finite: NaN and infinity would show up in whatever reads them."""

    def test_extreme_scenes(self):
        with tempfile.TemporaryDirectory() as folder:
            for number in ("1e18", "-1e18", "1e12", "1e-10", "1e-30", "1e-45", "1e-300", "0"):
                for line in (f"sphere {{ center {number} 0 0 }}", f"sphere {{ center 0 0 {number} radius 1 }}",
                             f"cube {{ center 0 {number} 0 }}", f"light {{ position 0 0 {number} }}",
                             f"light {{ position {number} {number} {number} falloff quadratic }}",
                             f"plane {{ point 0 {number} 0 }}", f"torus {{ center 0 0 {number} }}",
                             f"light directional {{ direction 0 {number} -1 }}", f"cone {{ translate 0 {number} 0 }}",
                             f"sphere {{ material {{ shininess {number} }} }}", f"render {{ epsilon {number.lstrip('-')} }}",
                             f"disk {{ normal 0 {number} 1 }}", f"quad {{ origin 0 0 {number} }}"):
                    scene = "\n".join(FRAME.values()) + f"\n{line}\nsphere {{ material {{ shininess 0.5 }} }}\n"
                    path = pathlib.Path(folder) / "out.pfm"
                    done = program.run("-", "-o", path, "--size", "6x4", "--threads", "1", stdin=scene.encode(), preexec_fn=limit)
                    self.assertIn(done.returncode, (0, 1), scene + done.stderr.decode())
                    if done.returncode == 0:
                        self.assertTrue(all(map(math.isfinite, floats_of(path))), scene)


    def test_light_beyond_what_a_picture_holds(self):
        glare = "light { position 0 0.001 0  radiant_intensity 1e32 }  plane { material { color 0.5 } }"
        bright = "sphere { material { color 0  emission 1e30 } }  plane { material { color 0.5  shininess 0.5 } }"
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "out.pfm"
            for scene in (glare, bright):
                for method in ("classic", "path"):
                    text = (f"render {{ method {method}  samples 4 }}\n"
                            f"camera {{ position 0 0.01 0  look_at 0 0 -0.001 }}\n{scene}")
                    done = program.run("-", "-o", path, "--size", "8x8", stdin=text.encode(), preexec_fn=limit)
                    self.assertEqual(done.returncode, 0, done.stderr)
                    self.assertTrue(all(math.isfinite(value) and value >= 0 for value in floats_of(path)), text)


class Messages(unittest.TestCase):
    def test_a_bad_number_among_many_good_ones_is_one_message(self):
        for kind, properties in kinds():
            for name, sound in properties.items():
                scene = scene_around(kind.split()[0], block(kind, name, ["1e999"] + sound[1:]))
                done = program.run("check", "--format", "json", "-", stdin=scene.encode(), cwd=program.ROOT)
                messages = [json.loads(line) for line in done.stdout.decode().splitlines()]
                self.assertEqual((done.returncode, len(messages)), (1, 1), scene)
                self.assertIn("1e999", messages[0]["message"])


if __name__ == "__main__":
    unittest.main()
