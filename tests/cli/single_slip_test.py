"""One slip in a scene is one message, at its place, with what would be right."""

import json
import tempfile
import pathlib
import unittest

import program

# A slip per row: what it is; the scene, with « where the message must point and » where its underline must end (left
# out where the end does not matter); words that message and suggestion must hold between them.
SLIPS = [
    # --- misspelt words ---
    ("property", "sphere { «raduis» 2 }", ["sphere", "'raduis'", "did you mean 'radius'?"]),
    ("property of a long name", "camera { «vertcal_fov» 40 }", ["did you mean 'vertical_fov'?"]),
    ("property in capitals", "sphere { «Radius» 2 }", ["did you mean 'radius'?"]),
    ("property common to all shapes", "cube { «tranlsate» 1 2 3 }", ["did you mean 'translate'?"]),
    ("material as a property", "cube { «materail» { color red } }", ["did you mean 'material'?"]),
    ("property of another kind", "cube { «radius» 1 }", ["cube", "'radius'", "size"]),
    ("kind", "«spehre» { radius 1 }", ["'spehre'", "did you mean 'sphere'?"]),
    ("kind in capitals", "«Sphere» { radius 1 }", ["did you mean 'sphere'?"]),
    ("kind in a group", "group {\n  «cubee» { }\n}", ["did you mean 'cube'?"]),
    ("unknown kind far from all", "«zzzzzzzz» { }", ["'zzzzzzzz'", "help"]),
    ("enumerated word", "light { falloff «lineer» }", ["falloff", "'lineer'", "did you mean 'linear'?"]),
    ("method", "render { method «clasic» }", ["did you mean 'classic'?"]),
    ("colour name", "background { color «toamto» }", ["'toamto'", "did you mean 'tomato'?"]),
    ("boolean", "cylinder { open «ture» }", ["'ture'", "did you mean 'true'?"]),
    ("boolean as a number", "cylinder { open «1» }", ["true or false"]),
    ("material name", "material chrome { }\nsphere { material «crome» }", ["'crome'", "did you mean 'chrome'?"]),
    ("light variant", "light «spto» lamp { }", ["did you mean 'spot'?"]),
    ("include", "«inlcude» \"parts.txt\"", ["did you mean 'include'?"]),
    ("version word", "«raytracr» 1\nsphere { }", ["did you mean 'raytracer'?"]),
    # --- values ---
    ("no value", "sphere { «radius» }", ["radius", "a number"]),
    ("no value before the next property", "sphere { «radius» center 0 1 0 }", ["radius", "a number"]),
    ("no value before a line end", "sphere {\n  «center»\n  radius 1\n}", ["center", "three numbers"]),
    ("too few values", "sphere { center «1 2» }", ["center", "three numbers"]),
    ("too many values", "sphere { center 1 2 3 «4» }", ["center", "three numbers"]),
    ("far too many values", "sphere { radius 1 «2 3 4» }", ["radius", "a number"]),
    ("two numbers for a size", "cube { size «1 2» }", ["size", "one number or three"]),
    ("two numbers for a colour", "background { color «1 0» }", ["color"]),
    ("two colours", "background { color red «blue» }", ["color"]),
    ("eleven numbers for a matrix", "cube { matrix «1 0 0 0 0 1 0 0 0 0 1» }", ["twelve"]),
    ("axis without its angle", "cube { rotate_axis «0 1 0» }", ["rotate_axis", "angle"]),
    ("string for a number", "sphere { radius «\"2\"» }", ["radius", "a number"]),
    ("word for a number", "sphere { radius «big» }", ["'big'"]),
    ("colour for a number", "sphere { radius «#ff0000» }", ["radius", "a number"]),
    ("word for a vector", "sphere { center «origin» }", ["'origin'"]),
    ("string for a colour", "background { color «\"red\"» }", ["color", "a colour"]),
    ("number for a word", "light { falloff «2» }", ["falloff", "linear"]),
    ("number for a material", "sphere { material «7» }", ["material"]),
    ("block for a number", "sphere { «radius» { } }", ["radius", "a number"]),
    ("block for a colour", "background { «color» { } }", ["color", "a colour"]),
    ("fraction for a whole number", "render { samples «1.5» }", ["samples", "whole number"]),
    ("fraction for a pixel", "image { size 640 «480.5» }", ["size", "whole"]),
    ("colour with too few digits", "background { color «#ff» }", ["'#ff'", "#ff8800"]),
    ("colour with a letter too far", "background { color «#00ff0g» }", ["'#00ff0g'"]),
    ("colour with eight digits", "background { color «#11223344» }", ["'#11223344'"]),
    # --- ranges ---
    ("radius 0", "sphere { radius «0» }", ["radius", "greater than 0"]),
    ("negative radius", "sphere { radius «-1» }", ["radius", "greater than 0", "-1"]),
    ("minus zero", "sphere { radius «-0» }", ["radius", "greater than 0"]),
    ("one edge of three 0", "cube { size 1 «0» 1 }", ["size", "greater than 0"]),
    ("colour above 1", "material m { color 0.5 «255» 0.5 }\nsphere { material m }", ["color", "between 0 and 1"]),
    ("negative colour", "background { color «-0.1» 0 0 }", ["color"]),
    ("field of view 180", "camera { fov «180» }", ["fov", "179"]),
    ("no pixels", "image { size «0» 10 }", ["size", "1"]),
    ("too many pixels", "image { size 10 «100000» }", ["size", "65536"]),
    ("no samples", "render { samples «0» }", ["samples"]),
    ("negative bounces", "render { bounces «-1» }", ["bounces"]),
    ("negative epsilon", "render { epsilon «-0.1» }", ["epsilon"]),
    ("negative intensity", "light { intensity «-5» }", ["intensity"]),
    ("a number no double holds", "sphere { radius «1e999» }", ["1e999", "too large"]),
    ("a negative one", "sphere { center 0 «-1e999» 0 }", ["-1e999", "too large"]),
    ("a number no float bears", "sphere { center «1e30» 0 0 }", ["center", "1e+18"]),
    ("scale 0", "sphere { «scale 0» }", ["scale", "0"]),
    ("one scale of three 0", "sphere { «scale 1 0 1» }", ["scale", "0"]),
    # --- words that look like numbers ---
    ("nan", "sphere { radius «nan» }", ["'nan'"]),
    ("NaN within a vector", "sphere { center 0 «NaN» 0 }", ["NaN"]),
    ("inf", "sphere { radius «inf» }", ["'inf'"]),
    ("-inf", "sphere { radius «-»inf }", ["-"]),
    ("hexadecimal", "sphere { radius «0x10» }", ["'0x10'", "not a number"]),
    ("two points", "sphere { radius «1.2.3» }", ["'1.2.3'", "not a number"]),
    ("a number with a unit", "sphere { radius «5cm» }", ["'5cm'", "not a number"]),
    ("an exponent without digits", "sphere { radius «1e» }", ["'1e'", "not a number"]),
    ("decimal comma", "sphere { radius 1«,»5 }", ["','"]),
    ("commas between numbers", "sphere { center 1«,» 2, 3 }", ["','", "spaces"]),
    ("equals sign", "sphere { radius «=» 2 }", ["'='"]),
    ("colon", "sphere { radius«:» 2 }", ["':'"]),
    ("semicolon", "sphere { radius 2«;» center 0 0 0 }", ["';'"]),
    ("commas left out in parentheses", "sphere { center (1 «2» 3) }", ["'2'", "expression"]),
    ("brackets", "sphere { center «[»1 2 3] }", ["'['"]),
    ("angle brackets", "sphere { center «<»1, 2, 3> }", ["'<'"]),
    ("two signs", "sphere { center 0 «-»-1 0 }", ["'-'"]),
    # --- structure ---
    ("brace never closed", "sphere «{» radius 1", ["'{'", "sphere", "never closed"]),
    ("inner brace never closed", "group «{»\n  sphere { radius 1 }\n", ["'{'", "group", "never closed"]),
    ("string never closed", "include «\"»parts.txt\nsphere { }", ["string", "not closed"]),
    ("comment never closed", "sphere { }\n«/*» the rest\n", ["comment", "never closed"]),
    ("nested comment never closed", "sphere { }\n«/*» a /* b */\n", ["comment", "never closed"]),
    ("comment closed once too often", "sphere { } /* */ «*/»\n", ["'*/'"]),
    ("stray closing brace", "sphere { }\n«}»\n", ["'}'", "closes nothing"]),
    ("stray opening brace", "«{» radius 1 }", ["'{'"]),
    ("block without braces", "«sphere»\n", ["sphere", "braces"]),
    ("value without a property", "sphere { «3» radius 1 }", ["belongs to no property"]),
    ("string without a property", "sphere { «\"x\"» }", ["belongs to no property"]),
    ("property outside of a block", "«radius» 2\nsphere { }", ["radius", "outside"]),
    ("number outside of a block", "«42»\nsphere { }", ["42"]),
    ("include without a name", "«include» { }\nsphere { }", ["include", "parts.txt"]),
    ("include of a word", "«include» parts\nsphere { }", ["include", "parts.txt"]),
    ("include within a shape", "sphere { «include» \"parts.txt\" }", ["include"]),
    ("shape in a shape", "sphere { «cube» { } }", ["sphere", "cube", "group"]),
    ("shape in a material", "material m { «sphere» { } }\nsphere { material m }", ["material", "sphere"]),
    ("image in a group", "group { «image» { size 8 8 } sphere { } }", ["image", "group", "top"]),
    ("material without a name", "«material» { color red }\nsphere { }", ["material", "name"]),
    ("material in place with a name", "sphere { «material red» { } }", ["material", "name"]),
    ("two names", "sphere «left right» { }", ["sphere"]),
    ("name of a number", "sphere «1» { }", ["1"]),
    ("name in quotation marks", "sphere «\"ball\"» { }", ["\"ball\""]),
    ("another version", "raytracer «2»\nsphere { }", ["version", "raytracer 1"]),
    ("version without a number", "«raytracer»\nsphere { }", ["version", "raytracer 1"]),
    ("version not at the beginning", "sphere { }\n«raytracer» 1", ["beginning"]),
    # --- twice ---
    ("property twice", "sphere { radius 1\n «radius 2» }", ["radius", "twice"]),
    ("material twice", "sphere { material { }\n «material» { } }", ["material", "twice"]),
    ("pivot twice", "sphere { pivot 0 0 0 «pivot 1 1 1» }", ["pivot", "twice"]),
    ("image twice", "image { }\n«image» { }\nsphere { }", ["second", "image"]),
    ("camera twice", "camera { }\n«camera» { }\nsphere { }", ["second", "camera"]),
    ("shape name twice", "sphere a { }\n«sphere a» { }", ["second", "'a'"]),
    ("material name twice", "material a { }\n«material a» { }\nsphere { material a }", ["second", "'a'"]),
    ("fov and vertical_fov", "camera { fov 40 «vertical_fov 30» }", ["fov", "vertical_fov"]),
    ("matrix beside another transform", "cube { translate 1 0 0 «matrix 1 0 0 0 0 1 0 0 0 0 1 0» }", ["matrix"]),
    ("look_at and direction", "light spot { look_at 0 0 -1 «direction 0 0 1» }", ["look_at", "direction"]),
    # --- what spans nothing ---
    ("parallel edges", "quad { «width 1 0 0» height 2 0 0 }", ["width", "height", "parallel"]),
    ("edge of no length", "quad { «width 0 0 0» }", ["width"]),
    ("corners on a line", "triangle { «a 0 0 0» b 1 1 1 c 2 2 2 }", ["line"]),
    ("two corners alike", "triangle { «a 0 0 0» b 1 0 0 c 1 0 0 }", ["triangle"]),
    ("missing corner", "«triangle» { a 0 0 0 b 1 0 0 }", ["triangle", "'c'"]),
    ("normal of no length", "plane { «normal 0 0 0» }", ["normal"]),
    ("axis of no length", "torus { «axis 0 0 0» }", ["axis"]),
    ("base on top", "cylinder { «base 0 1 0» }", ["base", "top"]),
    ("cone without radii", "cone { «radius 0» }", ["radius"]),
    ("turn about nothing", "cube { «rotate_axis 0 0 0 45» }", ["rotate_axis"]),
    ("flat matrix", "cube { «matrix 1 0 0 0  0 1 0 0  0 0 0 0» }", ["matrix", "flat"]),
    ("up along the view", "camera { position 0 5 0 look_at 0 0 0 «up 0 1 0» }", ["up"]),
    ("default up along the view", "«camera» { position 0 5 0 look_at 0 0 0 }", ["up"]),
    ("up of no length", "camera { «up 0 0 0» }", ["up"]),
    ("look_at the eye", "camera { position 1 2 3 «look_at 1 2 3» }", ["look_at", "position"]),
    ("direction of no length", "light directional { «direction 0 0 0» }", ["direction"]),
    ("scale of a camera", "camera { «scale 2» }", ["scale", "camera"]),
    ("scale of a light", "light { «scale 2» }", ["scale", "light"]),
    # --- names ---
    ("material used before it stands", "sphere { material «m» }\nmaterial m { }", ["'m'", "before"]),
    ("material never defined", "sphere { material «m» }", ["'m'", "material"]),
    ("file that is not there", "include «\"missing.txt\"»", ["missing.txt"]),
    ("file outside of the folder", "include «\"../outside.txt\"»", ["outside", "--allow-path"]),
    ("file by its full name", "include «\"/etc/passwd\"»", ["outside", "--allow-path"]),
    ("folder as a file", "include «\".\"»", ["folder"]),
    ("file of no name", "include «\"\"»", []),
    # --- characters ---
    ("letter beyond ASCII", "sphere { «größe» 2 }", ["größe"]),
    ("no-break space", "sphere {«\u00a0»radius 1 }", []),
    ("typographic quotation marks", "include «“parts.txt”»\nsphere { }", ["“"]),
    ("typographic minus", "sphere { center «−1» 0 0 }", ["−"]),
    ("escape character", "sphere { «\x1b» radius 1 }", ["0x1b"]),
    ("backspace", "sphere { radius«\b» 1 }", ["0x08"]),
    ("column behind wide characters", "/* 漢字 €µ */ sphere { «raduis» 2 }", ["'raduis'"]),
    ("column behind characters of four bytes", "/* 🎨🎨 */ sphere { «raduis» 2 }", ["'raduis'"]),
    ("column behind a tab", "\tsphere {\t«raduis»\t2 }", ["'raduis'"]),
    ("line behind CRLF", "sphere { }\r\nsphere { «raduis» 2 }\r\n", ["'raduis'"]),
    ("line behind CR", "sphere { }\rsphere { «raduis» 2 }\r", ["'raduis'"]),
    ("column behind a byte-order mark", "\ufeffsphere { «raduis» 2 }", ["'raduis'"]),
    ("line behind a long comment", "/*\n\n\n*/ sphere { «raduis» 2 }", ["'raduis'"]),
]


def unmarked(marked):
    """(scene, (line, column) of «, (line, column) of » or None)"""
    def place(text):
        lines = text.replace("\r\n", "\n").replace("\r", "\n").removeprefix("\ufeff").split("\n")
        return len(lines), len(lines[-1]) + 1
    before, rest = marked.split("«")
    inside, closed, after = rest.partition("»")
    return before + inside + after, place(before), place(before + inside) if closed else None


class SingleSlip(unittest.TestCase):
    def test_each_slip_is_one_message_at_its_place(self):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "scenes" / "slip.txt"
            path.parent.mkdir()
            (pathlib.Path(folder) / "outside.txt").write_text("sphere { }\n")
            for what, marked, words in SLIPS:
                with self.subTest(what, scene=marked):
                    scene, begin, end = unmarked(marked)
                    path.write_bytes(scene.encode())
                    self.check_one_message(path, begin, end, words)

    def check_one_message(self, path, begin, end, words):
        done = program.run("check", "--format", "json", "slip.txt", cwd=path.parent)
        self.assertEqual(done.returncode, 1, done)
        self.assertEqual(done.stderr, b"")
        messages = [json.loads(line) for line in done.stdout.decode().splitlines()]
        self.assertEqual(len(messages), 1, [m["message"] for m in messages])
        message = messages[0]
        self.assertEqual(message["severity"], "error")
        self.assertEqual(message["file"], "slip.txt")
        self.assertEqual((message["line"], message["column"]), begin, message)
        if end:
            self.assertEqual((message["end_line"], message["end_column"]), end, message)
        for word in words:
            self.assertIn(word, message["message"] + " " + message["suggestion"])


if __name__ == "__main__":
    unittest.main()
