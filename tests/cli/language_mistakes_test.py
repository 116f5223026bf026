"""Each mistake in computing, repeating and reusing is one message at its place, and endless things end at once."""

import json
import pathlib
import resource
import tempfile
import unittest

import program

# A slip per row: what it is; the scene, with « where the message must point and » where its underline must end (left out
# where the end does not matter); words that message and suggestion must hold between them.
SLIPS = [
    # --- types ---
    ("string in a sum", "let a = 1 + «\"x\"»", ["a string"]),
    ("boolean in a product", "let a = 2 * «true»", ["true or false"]),
    ("vector plus number", "let a = «(1, 2, 3) + 1»", ["a vector", "a number"]),
    ("vector to a power", "let a = «(1, 2, 3)» ^ 2", ["a vector"]),
    ("sign of a string", "let a = -«\"x\"»", ["a string"]),
    ("number as a condition", "if «1» { }", ["true or false", "a number"]),
    ("number as a choice", "let a = «1» ? 2 : 3", ["true or false", "a number"]),
    ("not of a number", "let a = not «1»", ["true or false"]),
    ("and of a string", "let a = true and «\"x\"»", ["true or false"]),
    ("order of vectors", "let a = «(1, 2, 3)» < 2", ["a number", "a vector"]),
    ("number and string compared", "let a = «1 == \"1\"»", ["a number", "a string"]),
    ("component of a number", "let n = 1 let a = «n».x", ["a vector", "a number"]),
    ("unknown component", "let p = (1, 2, 3) let a = p.«w»", ["'w'", ".x .y .z"]),
    ("vector of a vector", "let p = (1, 2, 3) let a = («p», 1, 2)", ["a number", "a vector"]),
    ("function of a string", "let a = «sin(\"x\")»", ["sin", "a string"]),
    ("vector for a number", "sphere { radius «(1, 2, 3)» }", ["radius", "a number", "a vector"]),
    ("vector let for a number", "let p = (1, 2, 3)\nsphere { radius «p» }", ["radius", "vector"]),
    ("number let for a vector", "let p = 1\nsphere { center «p» }", ["center", "three numbers"]),
    ("string let for a colour", "let c = \"red\"\nbackground { color «c» }", ["color", "string"]),
    ("number let for a boolean", "let b = 1\ncylinder { open «b» }", ["open", "true or false"]),
    ("vector as a loop's end", "for i from 0 to «(1, 2, 3)» { }", ["a vector"]),
    ("fraction for a whole number", "render { samples «(3 / 2)» }", ["samples", "whole"]),
    # --- what can't be computed ---
    ("division by zero", "let a = 1 + «1 / 0»", ["division by zero"]),
    ("division by a let that is zero", "let n = 0\nlet a = «360 / n»", ["division by zero", "'n' is 0"]),
    ("rest of a division by zero", "let a = «5 % (2 - 2)»", ["division by zero"]),
    ("zero in a vector that divides", "let a = «1 / (1, 0, 1)»", ["division by zero"]),
    ("zero to a negative power", "let a = «0 ^ -1»", ["division by zero"]),
    ("parenthesised, divided by zero", "let a = «(1 + 2) / 0»", ["division by zero"]),
    ("within a property", "sphere { radius («1 / 0» + 1) }", ["division by zero"]),
    ("root of a negative number", "let a = 2 * «sqrt(-4)»", ["sqrt", "-4"]),
    ("logarithm of 0", "let a = «log(0)»", ["log"]),
    ("arc sine of 2", "let a = «asin(2)»", ["asin", "2"]),
    ("tangent of 90 degrees", "let a = «tan(90)»", ["tan", "90"]),
    ("rest of a division by 0 in mod", "let a = «mod(3, 0)»", ["mod", "zero"]),
    ("direction of nothing", "let a = «normalize((0, 0, 0))»", ["normalize"]),
    ("negative number to a fraction", "let n = -8 let a = «n ^ (1 / 3)»", ["-8"]),
    ("a number too large", "let a = «10 ^ 999»", ["too large"]),
    ("a temperature too low", "let a = «kelvin(100)»", ["kelvin", "100"]),
    ("a saturation above 1", "let a = «hsv(0, 2, 1)»", ["hsv", "2"]),
    # --- ranges of computed values ---
    ("negative radius by a let", "let r = -1\nsphere { radius «r» }", ["radius", "greater than 0", "-1"]),
    ("zero radius by an expression", "sphere { radius «(2 - 2)» }", ["radius", "greater than 0"]),
    ("zero radius in a later turn", "for i from 0 to 9 {\n  sphere { radius «(5 - i)» }\n}", ["radius", "greater than 0"]),
    # --- arity ---
    ("no argument", "let a = «sin()»", ["sin", "1 argument", "found 0"]),
    ("two for one", "let a = «sqrt(1, 2)»", ["sqrt", "1 argument", "found 2"]),
    ("two for three", "let a = «clamp(1, 2)»", ["clamp(x, low, high)", "found 2"]),
    ("four for three", "let a = «mix(1, 2, 3, 4)»", ["mix", "3 arguments", "found 4"]),
    ("one for at least two", "let a = «min(1)»", ["min", "at least 2"]),
    ("two components", "let a = «(1, 2)»", ["three", "found 2"]),
    ("four components", "let a = «(1, 2, 3, 4)»", ["three", "found 4"]),
    ("a list without parentheses", "let a = 1 «2 3»", ["one value", "(1, 2, 3)"]),
    ("three parameters for one number", "define d (r 1) { sphere { radius r } }\nd { r 1 «2 3» }", ["'r'", "a number"]),
    ("two numbers as a default", "define d (r «1 2») { sphere { radius r } }", ["found 2"]),
    # --- names ---
    ("unknown name", "let a = «nothing» + 1", ["'nothing'"]),
    ("misspelt name", "let count = 3\nlet a = «cuont» + 1", ["'cuont'", "did you mean 'count'?"]),
    ("misspelt name in a property", "let ring = 3\nsphere { radius (2 * «rign») }", ["did you mean 'ring'?"]),
    ("misspelt parameter in a body", "define d (size 1) { sphere { radius («szie» / 2) } }\nd { }", ["did you mean 'size'?"]),
    ("misspelt function", "let a = «sprt»(2)", ["did you mean 'sqrt'?"]),
    ("a function without parentheses", "let a = «sin» + 1", ["sin(x)"]),
    ("misspelt parameter at a use", "define d (size 1) { sphere { radius size } }\nd { «szie» 2 }", ["'szie'", "did you mean 'size'?"]),
    ("misspelt definition", "define snowman { sphere { } }\n«snowmen» { }", ["'snowmen'", "did you mean 'snowman'?"]),
    ("let used before it stands", "sphere { radius «r» }\nlet r = 2\nsphere { radius r }", ["'r'", "before"]),
    ("let used in itself", "let r = «r» + 1", ["'r'"]),
    ("definition used before it stands", "«d» { }\ndefine d { sphere { } }\nd { }", ["'d'", "before"]),
    ("let used behind its block", "group { let r = 1 sphere { radius r } }\nsphere { radius «r» }", ["'r'"]),
    ("loop's name used behind it", "for i from 1 to 2 { }\nsphere { radius «i» }", ["'i'"]),
    ("misspelt colour in an expression", "let c = «toamto»", ["did you mean 'tomato'?"]),
    # --- twice, and taken ---
    ("let twice", "let a = 1\nlet «a» = 2\nsphere { radius a }", ["'a'", "twice"]),
    ("let of a parameter's name", "define d (a 1) {\n let «a» = 2 sphere { radius a } }\nd { }", ["'a'"]),
    ("let of the loop's name", "for i from 1 to 3 {\n let «i» = 2 sphere { radius i } }", ["'i'"]),
    ("definition twice", "define d { sphere { } }\ndefine «d» { sphere { } }\nd { }", ["'d'", "twice"]),
    ("parameter twice", "define d (a 1, «a» 2) { sphere { radius a } }\nd { }", ["'a'"]),
    ("parameter given twice", "define d (a 1) { sphere { radius a } }\nd { a 1 «a 2» }", ["'a'", "twice"]),
    ("let of a function's name", "let «length» = 3", ["'length'", "built in"]),
    ("let of t", "let «t» = 3", ["'t'", "built in"]),
    ("let of pi", "let «pi» = 3", ["'pi'", "built in"]),
    ("loop over t", "for «t» from 0 to 3 { sphere { } }", ["'t'", "built in"]),
    ("definition of a sphere", "define «sphere» { cube { } }", ["'sphere'", "built in"]),
    ("parameter named translate", "define d («translate» 1) { sphere { } }", ["'translate'"]),
    ("parameter named like a function", "define d («min» 1) { sphere { } }", ["'min'"]),
    # --- form ---
    ("let without =", "let «a» 3", ["'='"]),
    ("let with ==", "let «a» == 3", ["'='"]),
    ("let with :=", "let «a» := 3", ["'='"]),
    ("let of a number", "«let» 3 = 4", ["let n = 12"]),
    ("let of two names", "let «a» b = 3", ["'='"]),
    ("assignment without let", "«a» = 3", ["let"]),
    ("operator without its right side", "let a = (1 + «)»", ["value is missing"]),
    ("operator without its left side", "let a = 1 + «*» 2", ["value is missing"]),
    ("chained comparison", "let a = 1 < 2 «<» 3", ["chained"]),
    ("C's and", "let a = true «&&» false", ["and"]),
    ("C's or", "let a = true «||» false", ["or"]),
    ("C's not", "let a = «!»true", ["not"]),
    ("Python's power", "let a = 2 «**» 3", ["^"]),
    ("Basic's not equal", "let a = 1 «<>» 2", ["!="]),
    ("one = for a comparison", "if 1 «=» 2 { }", ["=="]),
    ("index", "let p = (1, 2, 3) let a = p«[»0] + 1", [".x"]),
    ("brackets for a vector", "let a = «[»1, 2, 3]", ["(1, 2, 3)"]),
    ("decimal comma", "let a = 1«,»5", []),
    ("missing operator", "let n = 3 let a = 2 «n»", []),
    ("number with a unit", "let a = «5cm» + 1", ["'5cm'"]),
    ("number too large", "let a = «1e999» + 1", ["1e999"]),
    ("choice without its second value", "let a = (true ? 1«)»", ["':'"]),
    ("parenthesis never closed", "sphere { radius «(»1 + 2 }", ["never closed"]),
    ("parenthesis of a call never closed", "sphere { radius «(»sin(30) }", ["never closed"]),
    ("parenthesis too many", "let a = (1 + 2)«)»", []),
    ("string never closed", "let a = «\"»text", ["not closed"]),
    ("minus without parentheses", "let r = 1 sphere { center «-»r 0 0 }", ["parentheses"]),
    ("sum without parentheses", "let r = 1 sphere { radius r «+» 1 }", ["parentheses"]),
    ("for with =", "«for i = 0 to 3 { sphere { } }", ["from"]),
    ("for with in", "«for i in 0 to 3 { sphere { } }", ["from"]),
    ("for in parentheses", "«for (i from 0 to 3) { sphere { } }", ["for i from 0 to 9"]),
    ("for without a name", "«for from 0 to 3 { sphere { } }", ["for i from 0 to 9"]),
    ("for without to", "«for i from 0 { sphere { } }", ["'to'"]),
    ("for without braces", "«for i from 0 to 3 sphere { }", ["braces"]),
    ("step 0", "for i from 0 to 3 step «0» { }", ["step"]),
    ("if without braces", "«if» true sphere { }", ["braces"]),
    ("if without a condition", "if «{» sphere { } }", ["value is missing"]),
    ("else without an if", "«else» { sphere { } }", ["'else'", "'if'"]),
    ("elif", "if true { } «elif» false { }", ["else if"]),
    ("elseif", "if true { } «elseif» false { }", ["else if"]),
    ("else without braces", "if true { } «else» sphere { }", ["braces"]),
    ("while", "«while» true { sphere { } }", []),
    ("define without a name", "«define» { sphere { } }", ["define tree"]),
    ("define without braces", "«define d» sphere { }", ["braces"]),
    ("parameters without defaults", "define d («a») { sphere { } }", ["'a'", "default"]),
    ("defaults with =", "define d (a «=» 1, b = 2) { sphere { } }", []),
    ("parameters without commas", "define d (a 1 «b» 2) { sphere { } }", []),
    ("parameters never closed", "define d «(»a 1 { sphere { } }", ["never closed"]),
    ("a use called like a function", "define d (a 1) { sphere { radius a } }\n«d»(2)", []),
    ("include of a word", "«include» parts.txt", ["parts.txt"]),
    ("for in a shape", "sphere { «for» i from 0 to 3 { } }", ["'for'", "sphere"]),
    ("define in a shape", "sphere { «define» d { } }", ["'define'", "sphere"]),
    ("if in a material", "material m { «if» true { color red } }\nsphere { material m }", ["'if'", "material"]),
    ("camera in a definition", "define d { «camera» { } sphere { } }\nd { }", ["camera", "top"]),
    ("property in a loop", "group { for i from 0 to 1 { «translate» i 0 0 sphere { } } }", ["translate"]),
    ("parameter without a value", "define d (a 1) { sphere { radius a } }\nd { «a» }", ["'a'", "a number"]),
    # --- without end ---
    ("a definition that uses itself", "define d { sphere { } «d» { } }\nd { }", ["deep", "if"]),
    ("a loop too long", "«for i» from 0 to 1e18 { sphere { } }", ["turns"]),
    ("too many uses inside each other", "define d (n 300) { sphere { } if n > 0 { «d { n (n - 1) } } }\nd { }",
     ["--limit nesting=N"]),
    ("too many shapes", "«for i» from 1 to 60000000 { sphere { } }", ["50000000 shapes", "--limit shapes=N"]),
    ("too many shapes in loops", "«for i» from 1 to 8000 { group { for j from 1 to 8000 step 1 { cube { } } } }",
     ["--limit shapes=N"]),
    ("too many shapes by names", "let n = 8000\n«for i» from 1 to n { let k = n for j from n to 1 step -1 { cube { } } }",
     ["--limit shapes=N"]),
    ("definitions that double", "\n".join(
        ["define d0 { sphere { } }"] + [f"define d{i} {{ d{i - 1} {{ }} d{i - 1} {{ translate 1 0 0 }} }}" for i in range(1, 90)] +
        ["«d89» { }"]), ["--limit shapes=N"]),
    ("definitions that grow tenfold", "let n = 10\n" + "\n".join(
        ["define d0 { cube { } }"] + [f"define d{i} {{ for i from 1 to n {{ d{i - 1} {{ translate (i) 0 0 }} }} }}" for i in range(1, 12)] +
        ["«d11» { }"]), ["--limit shapes=N"]),
    # --- as other languages have it ---
    ("a comment of Python's", "«#» a comment { in \"Python's way\nsphere { }", ["comments begin with //"]),
    ("a comment of Python's behind a value", "sphere { radius 1 «#» the { size\n}", ["comments begin with //"]),
    ("a comment without a blank", "«#»comment of a sphere", ["comments begin with //"]),
    ("a colour of five digits", "background { color «#ff880» }", ["#ff8800"]),
    ("parentheses for braces", "«sphere» ( radius 1 material { color red } )", ["sphere { … }"]),
    ("a colon", "sphere { radius«:» 1 }", ["radius 1"]),
    ("colons and commas", "sphere { center«:» 0, 1, 0 }", ["center 0 1 0"]),
    ("angle brackets", "sphere { center «<»0,-1,0> radius 1 }", ["center 0 -1 0"]),
    ("an equals sign", "sphere { radius «=» 1 }", ["radius 1"]),
    ("a hexadecimal number", "sphere { radius «0x10» }", ["not a number", "decimal"]),
    ("true for a number", "mesh { vertices 0 0 0 1 0 0 0 1 0 faces 0 1 2 smooth «true» }", ["found true", "smooth 1"]),
    ("a setting in a shape", "sphere { «animation» { duration 2 } }", ["'animation' stands at the top of the scene"]),
    ("a shape in a shape", "sphere { «cube» { } }", ["put both into a group"]),
    ("a sky without a kind", "«sky» { }", ["'sky'", "known are image, gradient, sun"]),
    ("a file without a name", "sphere { material { color image «\"\"» } }", ["the name of a file is empty"]),
    ("a picture for a background", "background { color «image \"a.png\"» }", ["'color' takes no texture, but a colour"]),
]

def unmarked(marked):
    """(scene, (line, column) of «, (line, column) of » or None)"""
    def place(text):
        lines = text.split("\n")
        return len(lines), len(lines[-1]) + 1
    before, rest = marked.split("«")
    inside, closed, after = rest.partition("»")
    return before + inside + after, place(before), place(before + inside) if closed else None


class Mistakes(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def messages(self, text, **files):
        """What `check` says about main.txt, beside which the others lie."""
        (self.folder / "main.txt").write_text(text)
        for name, other in files.items():
            (self.folder / f"{name}.txt").write_text(other)
        done = program.run("check", "--format", "json", "main.txt", cwd=self.folder)
        self.assertEqual(done.returncode, 1, done)
        self.assertEqual(done.stderr, b"")
        return [json.loads(line) for line in done.stdout.decode().splitlines()]

    def test_each_slip_is_one_message_at_its_place(self):
        for what, marked, words in SLIPS:
            with self.subTest(what, scene=marked):
                scene, begin, end = unmarked(marked)
                found = self.messages(scene + "\nsphere { }\n")
                self.assertEqual(len(found), 1, [(m["line"], m["column"], m["message"]) for m in found])
                message = found[0]
                self.assertEqual(message["severity"], "error")
                self.assertEqual((message["line"], message["column"]), begin, message)
                if end:
                    self.assertEqual((message["end_line"], message["end_column"]), end, message)
                for word in words:
                    self.assertIn(word, message["message"] + " " + message["suggestion"])

    def test_all_are_told_in_one_run(self):
        """The slips that leave the rest of the text alone, one below the other."""
        text, wanted = "", []
        for _, marked, _ in SLIPS[:44]:
            scene, begin, _ = unmarked(marked)
            if "\n" in scene or scene.startswith(("render", "background")):
                continue
            line = text.count("\n") + 1
            text += f"group {{ {scene} }}\n"
            wanted.append((line, begin[1] + len("group { ")))
        self.assertGreater(len(wanted), 30)
        self.assertEqual([(m["line"], m["column"]) for m in self.messages(text)], wanted)

    def test_an_unfinished_let_is_told_where_the_value_is_missing(self):
        for text in ("let a =\nsphere { }\n", "let a = 1 +\nsphere { }\n", "let a =", "let a = 1 +"):
            with self.subTest(text):
                found = self.messages(text)
                self.assertEqual(len(found), 1, [(m["line"], m["column"], m["message"]) for m in found])

    def test_a_mistake_in_a_definition_shows_where_it_was_used_from(self):
        found = self.messages("define d (r 1) {\n  sphere { radius r }\n}\ndefine e (s 1) {\n  d { r s }\n}\n\n  e { s -1 }\n")
        self.assertEqual([(m["line"], m["column"]) for m in found], [(2, 19)])
        self.assertEqual([(n["line"], n["column"]) for n in found[0]["notes"]], [(5, 3), (8, 3)])

    def test_a_mistake_in_an_include_shows_where_it_was_included(self):
        found = self.messages("sphere { }\ninclude \"a.txt\"\n", a="sphere { }\n  include \"b.txt\"\n", b="\nsphere { raduis 1 }\n")
        self.assertEqual([(m["file"], m["line"], m["column"]) for m in found], [("b.txt", 2, 10)])
        self.assertEqual([(n["file"], n["line"], n["column"]) for n in found[0]["notes"]], [("a.txt", 2, 3), ("main.txt", 2, 1)])

    def test_a_mistake_in_a_definition_of_an_include(self):
        found = self.messages("include \"a.txt\"\nlet x = 0\nball { r x }\n", a="define ball (r 1) {\n  sphere { radius (1 / r) }\n}\n")
        self.assertEqual([(m["file"], m["line"], m["column"]) for m in found], [("a.txt", 2, 19)])
        self.assertIn(("main.txt", 3, 1), [(n["file"], n["line"], n["column"]) for n in found[0]["notes"]])

    def test_a_mistake_in_a_loop_is_told_once(self):
        found = self.messages("for i from 1 to 1000 {\n  sphere { raduis i }\n  sphere { radius (1 / 0) }\n}\n")
        self.assertEqual([(m["line"], m["column"]) for m in found], [(2, 12), (3, 19)])

    def test_nothing_follows_from_a_wrong_value(self):
        found = self.messages("let a = 1 / 0\nlet b = a * 2\nlet c = sin(b) + (a, b, a).x\nfor i from a to b { sphere { radius c } }\n"
                              "if a > b { sphere { } }\ndefine d (r a) { sphere { radius (r + a) } }\nd { r b } d { }\nsphere { center a b c }\n")
        self.assertEqual([(m["line"], m["column"]) for m in found], [(1, 9)])

    def test_a_definition_that_nothing_uses_is_checked_too(self):
        text = "define d { sphere { raduis 1 } }\n"
        found = self.messages(text + "sphere { }\n")
        self.assertEqual([(m["line"], m["column"]) for m in found], [(1, text.index("raduis") + 1)])


def limited():
    """For preexec_fn: a second of processor time, little memory."""
    program.limit_processor_time(1)
    program.limit_memory(400 << 20)
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))


class Endless(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def refused(self, text, most_messages=1, **files):
        for name, other in {"main": text, **files}.items():
            (self.folder / f"{name}.txt").write_text(other)
        done = program.run("check", "main.txt", cwd=self.folder, preexec_fn=limited)
        self.assertEqual(done.returncode, 1, done.stderr[-500:])
        self.assertLessEqual(done.stderr.count(b"error: "), most_messages, done.stderr.decode())
        self.assertLess(len(done.stderr), 5000)

    def test_loops(self):
        for head in ("from 0 to 1e18", "from 0 to 1 step 1e-18", "from 0 to -1e300 step -1", "from -1e308 to 1e308"):
            with self.subTest(head):
                self.refused(f"for i {head} {{ sphere {{ }} }}")
                self.refused(f"for i {head} {{ }}")

    def test_definitions_that_use_themselves(self):
        for body in ("d { }", "sphere { } d { }", "d { } d { }", "group { d { } }", "if true { d { } }", "d { n (n + 1) }",
                     "for i from 0 to 9 { d { n i } }", "let m = n + 1 d { n m } d { n m }"):
            with self.subTest(body):
                self.refused(f"define d (n 0) {{ {body} }}\nd {{ }}\n")

    def test_definitions_that_use_themselves_in_deep_groups(self):
        for opening in ("group { ", "if true { ", "for i from 0 to 0 { "):
            with self.subTest(opening):
                self.refused("define d (n 0) { " + opening * 200 + "d { n (n + 1) } " + "} " * 200 + "}\nd { }\n")

    def test_a_definition_inside_itself(self):
        self.refused("define d (n 0) { define e { d { n (n + 1) } } e { } }\nd { }\n")

    def test_files_that_include_themselves(self):
        self.refused("include \"main.txt\"\n")
        self.refused("include \"main.txt\"\ninclude \"main.txt\"\n")
        self.refused("for i from 0 to 9 { include \"main.txt\" }\n")
        self.refused("group { include \"main.txt\" }\n")
        self.refused("include \"a.txt\"", a="include \"main.txt\"")
        self.assertIn(b"--limit includes=N", program.run("check", "main.txt", cwd=self.folder).stderr)

    def test_a_definition_that_includes_itself(self):
        self.refused("include \"a.txt\"\nd { }\n", a="define d { include \"b.txt\" }\n", b="include \"a.txt\"\nd { }\n")

    def test_ten_files_that_include_the_next_ten_times(self):
        names = "abcdefghij"
        files = {name: f"include \"{following}.txt\"\n" * 10 for name, following in zip(names, names[1:])}
        self.refused("include \"a.txt\"\n", j="sphere { }\n", **files)

    def test_expressions_that_are_too_deep_or_too_long(self):
        for text in ("(" * 100000, "-" * 100000, "not " * 100000, "sin(" * 100000, "2 ^ " * 100000, "true ? 1 : " * 100000):
            with self.subTest(text[:12]):
                self.refused("let a = " + text + "1\nsphere { }\n")
        for term in (" + 1", " * 1", ".x", " and true"):
            with self.subTest(term):
                text = "let a = true" if "and" in term else "let a = (1, 2, 3)" if ".x" in term else "let a = 1"
                (self.folder / "main.txt").write_text(text + term * 100000 + "\nsphere { }\n")
                done = program.run("check", "main.txt", cwd=self.folder, preexec_fn=limited)
                self.assertIn(done.returncode, (0, 1), done.stderr[-500:])
                self.assertLessEqual(done.stderr.count(b"error: "), 1)


if __name__ == "__main__":
    unittest.main()
