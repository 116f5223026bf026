"""Expressions made by chance, computed by the program and by an evaluator of its own here: the same values, and the same
mistakes at the same places."""

import itertools
import json
import math
import pathlib
import random
import struct
import tempfile
import unittest

import program

COLORS = {"red": "ff0000", "lime": "00ff00", "tomato": "ff6347", "steelblue": "4682b4", "gold": "ffd700",
          "black": "000000", "white": "ffffff"}

# --- the language, written down a second time ---------------------------------------------------------------


class Mistake(Exception):
    """At the nodes in args[0]."""


class Color(tuple):
    """A vector that was written as a display colour."""


class Node:
    def __init__(self, kind, *parts, value=None):
        self.kind, self.parts, self.value = kind, parts, value
        self.places = set()  # (begin, end) in the text, without parentheses around it and with them


def is_number(x):
    return isinstance(x, float)


def is_vector(x):
    return isinstance(x, tuple)


def require(condition, node):
    if not condition:
        raise Mistake({node})


def finite(x, node):
    require(all(map(math.isfinite, x if is_vector(x) else (x,))), node)
    return x


def each(f, *arguments):
    """f of numbers, by component where one argument is a vector."""
    if not any(map(is_vector, arguments)):
        return f(*arguments)
    spread = [a if is_vector(a) else (a,) * 3 for a in arguments]
    return tuple(f(*parts) for parts in zip(*spread))


def reduced_sine(x):
    turn = math.fmod(x, 360)
    return 0.0 if turn == 0 or abs(turn) == 180 else math.sin(math.radians(turn))


def reduced_cosine(x):
    turn = abs(math.fmod(x, 360))
    return 0.0 if turn in (90, 270) else math.cos(math.radians(turn))


def whole(f):
    return lambda x: math.copysign(float(f(x)), x) if abs(x) < 2.0**52 else x


def half_away(x):
    below = math.floor(abs(x))
    return below + 1 if abs(x) - below >= 0.5 else below


def power(x, y):
    try:
        result = math.pow(x, y)
    except (ValueError, OverflowError):
        return math.nan
    return result


MASK = (1 << 64) - 1


def mixed_bits(x):
    x = (x + 0x9E3779B97F4A7C15) & MASK
    x = (x ^ x >> 30) * 0xBF58476D1CE4E5B9 & MASK
    x = (x ^ x >> 27) * 0x94D049BB133111EB & MASK
    return x ^ x >> 31


def hashed(numbers):
    result = mixed_bits(len(numbers))
    for number in numbers:
        result = mixed_bits(result ^ struct.unpack("<Q", struct.pack("<d", number + 0.0))[0])
    return result


EDGES = [(x, y, z) for x, y, z in itertools.product((-1, 0, 1), repeat=3) if abs(x) + abs(y) + abs(z) == 2]


def gradient_noise(p):
    cell = [whole(math.floor)(x) for x in p]
    inside = [x - c for x, c in zip(p, cell)]
    shares = [f**3 * (f * (f * 6 - 15) + 10) for f in inside]
    total = 0.0
    for corner in itertools.product((0, 1), repeat=3):
        hash_bits = hashed([c + k for c, k in zip(cell, corner)])
        direction = (hash_bits >> 32) * 12 >> 32
        first, second = (0, 1) if direction < 4 else (0, 2) if direction < 8 else (1, 2)
        edge = [0, 0, 0]
        edge[first] = -1 if direction & 1 else 1
        edge[second] = -1 if direction & 2 else 1
        assert tuple(edge) in EDGES
        weight = math.prod(s if k else 1 - s for s, k in zip(shares, corner))
        total += weight * sum(e * (f - k) for e, f, k in zip(edge, inside, corner))
    return max(-1.0, min(1.0, total))


def direction(v):
    scaled = [x / max(map(abs, v)) for x in v]
    return tuple(x / math.hypot(*scaled) for x in scaled)


def hsv(h, s, v):
    sector = (h - 360 * math.floor(h / 360)) / 60
    chroma = v * s
    x = chroma * (1 - abs(math.fmod(sector, 2) - 1))
    rgb = [(chroma, x, 0), (x, chroma, 0), (0, chroma, x), (0, x, chroma), (x, 0, chroma), (chroma, 0, x)][int(sector) % 6]
    return Color(c + v - chroma for c in rgb)


def kelvin(temperature):
    def lobe(x, middle, below, above):
        return math.exp(-0.5 * ((x - middle) / (below if x < middle else above))**2)
    xyz = [0.0] * 3
    for nm in range(360, 831, 5):
        radiance = (nm / 560)**-5 / math.expm1(1.4387769e7 / (nm * temperature))
        xyz[0] += radiance * (1.056 * lobe(nm, 599.8, 37.9, 31.0) + 0.362 * lobe(nm, 442.0, 16.0, 26.7)
                              - 0.065 * lobe(nm, 501.1, 20.4, 26.2))
        xyz[1] += radiance * (0.821 * lobe(nm, 568.8, 46.9, 40.5) + 0.286 * lobe(nm, 530.9, 16.3, 31.1))
        xyz[2] += radiance * (1.217 * lobe(nm, 437.0, 11.8, 36.0) + 0.681 * lobe(nm, 459.0, 26.0, 13.8))
    rows = ((3.2406, -1.5372, -0.4986), (-0.9689, 1.8758, 0.0415), (0.0557, -0.2040, 1.0570))
    rgb = [max(0.0, sum(a * b for a, b in zip(row, xyz))) for row in rows]
    return tuple(c / max(rgb) for c in rgb)


def modulo(x, y):
    return x - y * whole_floor(x / y)


def whole_floor(x):
    return float(math.floor(x)) if math.isfinite(x) else x


def smoothstep(low, high, x):
    s = max(0.0, min(1.0, (x - low) / (high - low)))
    return s * s * (3 - 2 * s)


def has_zero(x):
    return 0 in (x if is_vector(x) else (x,))


def dot(v, w):
    return v[0] * w[0] + v[1] * w[1] + v[2] * w[2]


def cross(v, w):
    return (v[1] * w[2] - w[1] * v[2], v[2] * w[0] - w[2] * v[0], v[0] * w[1] - w[0] * v[1])


def least(*arguments):
    result = arguments[0]
    for x in arguments[1:]:
        result = each(lambda a, b: b if b < a else a, result, x)
    return result


def greatest(*arguments):
    result = arguments[0]
    for x in arguments[1:]:
        result = each(lambda a, b: b if a < b else a, result, x)
    return result


def seeds_of(arguments):
    return [x for a in arguments for x in (a if is_vector(a) else (a,))]


# name: argument types ("n"umber, "v"ector, "a"ny of them; "*" repeats the last), where it is defined, what it is
FUNCTIONS = {
    "sin": ("n", None, reduced_sine),
    "cos": ("n", None, reduced_cosine),
    "tan": ("n", lambda x: reduced_cosine(x) != 0, lambda x: reduced_sine(x) / reduced_cosine(x)),
    "asin": ("n", lambda x: abs(x) <= 1, lambda x: math.degrees(math.asin(x))),
    "acos": ("n", lambda x: abs(x) <= 1, lambda x: math.degrees(math.acos(x))),
    "atan2": ("nn", None, lambda y, x: math.degrees(math.atan2(y, x))),
    "sqrt": ("n", lambda x: x >= 0, math.sqrt),
    "exp": ("n", lambda x: x < 709.7, math.exp),  # above lies a border that no test should walk on

    "log": ("n", lambda x: x > 0, math.log),
    "pow": ("nn", None, power),
    "abs": ("a", None, lambda x: each(abs, x)),
    "min": ("aa*", None, least),
    "max": ("aa*", None, greatest),
    "floor": ("a", None, lambda x: each(whole(math.floor), x)),
    "ceil": ("a", None, lambda x: each(whole(math.ceil), x)),
    "round": ("a", None, lambda x: each(whole(lambda y: math.copysign(half_away(y), y)), x)),
    "sign": ("a", None, lambda x: each(lambda y: float((y > 0) - (y < 0)), x)),
    "mod": ("aa", lambda x, y: not has_zero(y), lambda x, y: each(modulo, x, y)),
    "clamp": ("aaa", None, lambda x, low, high: least(greatest(x, low), high)),
    "mix": ("aaa", None, lambda x, y, share: each(lambda a, b, s: a * (1 - s) + b * s, x, y, share)),
    "smoothstep": ("aaa", lambda low, high, x: not has_zero(each(lambda a, b: a - b, low, high)),
                   lambda low, high, x: each(smoothstep, low, high, x)),
    "length": ("v", None, lambda v: math.hypot(*v)),
    "normalize": ("v", lambda v: any(v), direction),
    "dot": ("vv", None, dot),
    "cross": ("vv", None, cross),
    "random": ("a*", None, lambda *seeds: (hashed(seeds_of(seeds)) >> 11) / 2.0**53),
    "noise": ("a", None, lambda p: gradient_noise(p if is_vector(p) else (p, 0.0, 0.0))),
    "hsv": ("nnn", lambda h, s, v: 0 <= s <= 1 and 0 <= v <= 1, hsv),
    "kelvin": ("n", lambda k: 800 <= k <= 40000, kelvin),
}
# Whose last bits are not the same for each library and compiler; of the others every bit is given.
ROUGH = set(FUNCTIONS) - {"sqrt", "abs", "min", "max", "floor", "ceil", "round", "sign", "clamp", "random"}


def blurred(x, size, dice):
    """x as a rounding more or less could have left it."""
    if is_vector(x):
        return type(x)(blurred(part, size, dice) for part in x)
    if x in (0.0, 1.0, -1.0) and size == 0:
        return x
    return x + dice.choice((-1, 0, 1)) * 4e-16 * max(abs(x), size)


class Evaluator:
    """Values of nodes; `dice` blurs what is rough, to find the expressions that hang on a rounding."""

    def __init__(self, names, dice=None):
        self.names, self.dice = names, dice

    def all_of(self, nodes):
        """The values of all the nodes, or the mistakes in all of them."""
        values, wrong = [], set()
        for node in nodes:
            try:
                values.append(self.value(node))
            except Mistake as mistake:
                wrong |= mistake.args[0]
        if wrong or len(values) < len(nodes):
            raise Mistake(wrong)
        return values

    def value(self, node):
        return getattr(self, "of_" + node.kind)(node)

    def of_constant(self, node):
        return node.value

    def of_name(self, node):
        value = self.names[node.value]
        if value is None:
            raise Mistake(set())  # was wrong where it was made, and has been reported there
        return value

    def of_unknown_name(self, node):
        raise Mistake({node})

    def of_vector(self, node):
        parts, wrong = [], set()
        for part in node.parts:
            try:
                parts.append(self.value(part))
                if not is_number(parts[-1]):
                    wrong.add(part)
            except Mistake as mistake:
                wrong |= mistake.args[0]
        if wrong or len(parts) < 3:
            raise Mistake(wrong)
        return tuple(parts)

    def of_sign(self, node):
        x = self.value(node.parts[0])
        require(is_number(x) or is_vector(x), node.parts[0])
        if node.value == "+":
            return x
        return -x if is_number(x) else tuple(-c for c in x)

    def of_binary(self, node):
        x, y = self.all_of(node.parts)
        for value, part in zip((x, y), node.parts):
            require(is_number(value) or is_vector(value), part)
        if node.value == "^":
            require(is_number(x), node.parts[0])
            require(is_number(y), node.parts[1])
            return finite(power(x, y), node)
        if node.value in "/%":
            require(not has_zero(y), node)
        if node.value in "+-":
            require(is_number(x) == is_number(y), node)
        operation = {"+": lambda a, b: a + b, "-": lambda a, b: a - b, "*": lambda a, b: a * b,
                     "/": lambda a, b: a / b, "%": math.fmod}[node.value]
        return finite(each(operation, x, y), node)

    def of_comparison(self, node):
        x, y = self.all_of(node.parts)
        if node.value in ("==", "!="):
            require(type(x) is type(y) or (is_vector(x) and is_vector(y)), node)
            return (tuple(x) == tuple(y) if is_vector(x) else x == y) == (node.value == "==")
        require(is_number(x), node.parts[0])
        require(is_number(y), node.parts[1])
        return {"<": x < y, "<=": x <= y, ">": x > y, ">=": x >= y}[node.value]

    def of_not(self, node):
        x = self.value(node.parts[0])
        require(isinstance(x, bool), node.parts[0])
        return not x

    def of_logic(self, node):
        x = self.value(node.parts[0])
        require(isinstance(x, bool), node.parts[0])
        if x == (node.value == "or"):
            return x
        y = self.value(node.parts[1])
        require(isinstance(y, bool), node.parts[1])
        return y

    def of_choice(self, node):
        condition = self.value(node.parts[0])
        require(isinstance(condition, bool), node.parts[0])
        return self.value(node.parts[1 if condition else 2])

    def of_member(self, node):
        x = self.value(node.parts[0])
        require(is_vector(x), node.parts[0])
        return x["xyz".find(node.value) if node.value in "xyz" else "rgb".find(node.value)]

    def of_call(self, node):
        arguments = self.all_of(node.parts)
        types, domain, function = FUNCTIONS[node.value]
        types = types[:-1] + types[-2] * len(arguments) if types.endswith("*") else types
        for x, kind in zip(arguments, types):
            fits = {"n": is_number(x), "v": is_vector(x), "a": is_number(x) or is_vector(x)}[kind]
            require(fits, node)
        require(domain is None or domain(*arguments), node)
        result = finite(function(*arguments), node)
        if self.dice and node.value in ROUGH:
            numbers = seeds_of(arguments)
            exact = all(abs(x) < 1e6 and x * 1024 == int(x * 1024) for x in numbers) and node.value in ("mod", "dot", "cross")
            size = max(map(abs, numbers)) if node.value in ("mod", "mix", "cross", "dot", "noise", "hsv") else 0
            return result if exact else blurred(result, size, self.dice)
        return result


# --- expressions by chance ----------------------------------------------------------------------------------

LEVELS = {"choice": 0, "or": 1, "and": 2, "not": 3, "comparison": 4, "+": 5, "-": 5, "*": 6, "/": 6, "%": 6, "sign": 7,
          "^": 8, "member": 9}
COMPARISONS = ("==", "!=", "<", "<=", ">", ">=")


def level_of(node):
    return LEVELS.get(node.value if node.kind in ("logic", "binary") else node.kind, 10)


class Writer:
    """Writes a node down with few parentheses, and notes where everything stands."""

    def __init__(self, dice):
        self.dice, self.text = dice, ""

    def put(self, text):
        self.text += text

    def space(self, always=False):
        self.put(" " * self.dice.choice((1, 1, 2)) if always else self.dice.choice(("", "", " ", " ", " /* , */ ")))

    def write(self, node, least_level):
        parenthesised = level_of(node) < least_level or self.dice.random() < 0.1
        begin = len(self.text)
        if parenthesised:
            self.put("(")
            self.space()
        inner = len(self.text)
        getattr(self, "write_" + node.kind)(node)
        node.places.add((inner, len(self.text)))
        if parenthesised:
            self.space()
            self.put(")")
            node.places.add((begin, len(self.text)))

    def write_constant(self, node):
        x = node.value
        if isinstance(x, bool):
            self.put("true" if x else "false")
        elif isinstance(x, str):
            self.put(f'"{x}"')
        elif is_vector(x):
            digits = "".join(f"{round(c * 255):02x}" for c in x)
            names = [name for name, known in COLORS.items() if known == digits]
            self.put(self.dice.choice(names) if names and self.dice.random() < 0.5 else "#" + digits)
        else:
            self.put(self.dice.choice((repr(x), f"{x:g}", f"{x:e}")) if x == float(f"{x:g}") else repr(x))

    def write_name(self, node):
        self.put(node.value)

    write_unknown_name = write_name

    def write_vector(self, node):
        self.put("(")
        self.write_list(node)
        self.put(")")

    def write_list(self, node):
        for i, part in enumerate(node.parts):
            if i:
                self.put(",")
                self.space()
            self.write(part, 0)
        self.space()

    def write_sign(self, node):
        self.put(node.value)
        self.space()
        self.write(node.parts[0], 7)

    def write_pair(self, node, left, right, symbol, words=False):
        self.write(node.parts[0], left)
        self.space(words)
        self.put(symbol)
        self.space(words)
        self.write(node.parts[1], right)

    def write_binary(self, node):
        level = level_of(node)
        left, right = (9, 7) if level == 8 else (level, level + 1)
        self.write_pair(node, left, right, node.value)

    def write_comparison(self, node):
        self.write_pair(node, 5, 5, node.value)

    def write_logic(self, node):
        self.write_pair(node, level_of(node), level_of(node) + 1, node.value, words=True)

    def write_not(self, node):
        self.put("not")
        self.space(True)
        self.write(node.parts[0], 3)

    def write_choice(self, node):
        self.write(node.parts[0], 1)
        self.space()
        self.put("?")
        self.space()
        self.write(node.parts[1], 0)
        self.space(True)
        self.put(":")
        self.space()
        self.write(node.parts[2], 0)

    def write_member(self, node):
        base = node.parts[0]
        self.write(base, 11 if base.kind == "constant" and is_number(base.value) else 9)
        self.put("." + node.value)

    def write_call(self, node):
        self.put(node.value)
        self.space()
        self.put("(")
        self.write_list(node)
        self.put(")")


class Maker:
    def __init__(self, dice, names, slips):
        self.dice, self.names, self.slips = dice, names, slips

    def make(self, kind, depth):
        if self.slips and self.dice.random() < 0.02:
            if self.dice.random() < 0.2:
                return Node("unknown_name", value="q" + self.dice.choice("wxz") * 7)
            kind = self.dice.choice("nvbs")  # of the wrong type, it may be
        if depth <= 0 or self.dice.random() < 0.1:
            return self.leaf(kind)
        return self.dice.choice({"n": (self.sum, self.sum, self.sum, self.sign, self.call, self.call, self.call, self.choice,
                                       self.member),
                                 "v": (self.sum, self.sum, self.vector, self.vector, self.sign, self.call, self.choice),
                                 "b": (self.comparison, self.comparison, self.logic, self.negation, self.choice),
                                 "s": (self.choice,)}[kind])(kind, depth - 1)

    def leaf(self, kind):
        fitting = [name for name, (known, _) in self.names.items() if known == kind]
        if fitting and self.dice.random() < 0.3:
            return Node("name", value=self.dice.choice(fitting))
        if kind == "n":
            value = self.dice.choice((float(self.dice.randint(0, 3)), float(self.dice.randint(0, 400)),
                                      self.dice.randint(0, 64) / 8, self.dice.uniform(0, 2), self.dice.uniform(0, 1000),
                                      10.0**self.dice.randint(-3, 3)))
            if self.slips and self.dice.random() < 0.05:
                value = 10.0**self.dice.randint(150, 300)
            return Node("constant", value=value)
        if kind == "v":
            if self.dice.random() < 0.5:
                return Node("vector", *(self.leaf("n") for _ in range(3)))
            digits = self.dice.choice((*COLORS.values(), f"{self.dice.getrandbits(24):06x}"))
            return Node("constant", value=Color(int(digits[i:i + 2], 16) / 255 for i in (0, 2, 4)))
        if kind == "b":
            return Node("constant", value=self.dice.random() < 0.5)
        return Node("constant", value=self.dice.choice(("", "a", "b", "sphere { }", "//", "ä")))

    def sum(self, kind, depth):
        operator = self.dice.choice("++--**/%^" if kind == "n" else "+-*/%")
        kinds = [kind, kind]
        if kind == "v" and operator in "*/%":
            kinds = self.dice.choice((["v", "v"], ["v", "n"], ["n", "v"]))
        if operator == "^" and self.dice.random() < 0.7:
            return Node("binary", self.make("n", depth), Node("constant", value=float(self.dice.randint(0, 3))), value="^")
        return Node("binary", *(self.make(k, depth) for k in kinds), value=operator)

    def sign(self, kind, depth):
        return Node("sign", self.make(kind, depth), value=self.dice.choice("--+"))

    def vector(self, _, depth):
        return Node("vector", *(self.make("n", depth) for _ in range(3)))

    def member(self, _, depth):
        return Node("member", self.make("v", depth), value=self.dice.choice("xyzrgb"))

    def call(self, kind, depth):
        gives_vector = ("normalize", "cross", "hsv", "kelvin")
        takes_any = [name for name, row in FUNCTIONS.items() if "a" in row[0] and name not in ("random", "noise")]
        if kind == "v":
            name = self.dice.choice((*gives_vector, *takes_any))
        else:
            name = self.dice.choice([n for n in FUNCTIONS if n not in gives_vector])
        types = FUNCTIONS[name][0]
        if types.endswith("*"):
            types = types[:-1] + types[-2] * self.dice.randint(0, 2)
        kinds = [("n" if t == "n" else "v" if t == "v" else self.dice.choice("nv")) for t in types]
        if name in takes_any:  # vector in, vector out
            kinds = ["n" if kind == "n" else self.dice.choice("nv") for _ in types]
            kinds[self.dice.randrange(len(kinds))] = kind
        arguments = [self.make(k, depth) for k in kinds]
        if name == "kelvin" and self.dice.random() < 0.8:
            arguments = [Node("constant", value=float(self.dice.randint(800, 40000)))]
        if name in ("hsv", "mix", "asin", "acos") and self.dice.random() < 0.8:
            arguments[1 if name == "hsv" else 0:] = [Node("constant", value=self.dice.randint(0, 16) / 16)
                                                     for _ in arguments[1 if name == "hsv" else 0:]]
        return Node("call", *arguments, value=name)

    def choice(self, kind, depth):
        return Node("choice", self.make("b", depth), self.make(kind, depth), self.make(kind, depth))

    def comparison(self, _, depth):
        operator = self.dice.choice(COMPARISONS)
        kind = self.dice.choice("nnvbs") if operator in ("==", "!=") else "n"
        return Node("comparison", self.make(kind, depth), self.make(kind, depth), value=operator)

    def logic(self, _, depth):
        return Node("logic", self.make("b", depth), self.make("b", depth), value=self.dice.choice(("and", "or")))

    def negation(self, _, depth):
        return Node("not", self.make("b", depth))


def outcome(node, names, dice=None):
    """(value, None), or (None, the nodes with mistakes)."""
    try:
        return Evaluator(names, dice).value(node), None
    except Mistake as mistake:
        return None, mistake.args[0]


def near(x, y, tolerance):
    if is_vector(x) and is_vector(y):
        return all(near(a, b, tolerance) for a, b in zip(x, y))
    if is_number(x) and is_number(y):
        return abs(x - y) <= tolerance * max(abs(x), abs(y)) + 1e-300
    return x == y and type(x) is type(y)


def is_steady(node, names, value, mistakes, dice):
    """Whether no rounding decides what comes out."""
    for _ in range(4):
        other, other_mistakes = outcome(node, names, dice)
        if other_mistakes != mistakes or (mistakes is None and not near(value, other, 2e-13)):
            return False
    return True


def expressions(seed, count, slips):
    """Yields (name, node, text, value, mistakes): all sound, or all with a mistake."""
    dice = random.Random(seed)
    names, values = {}, {}
    while count:
        kind = dice.choice("nnnvvbs")
        node = Maker(dice, names, slips).make(kind, dice.randint(1, 6))
        value, mistakes = outcome(node, values)
        if mistakes is not None and not mistakes or bool(mistakes) != slips:
            continue
        if not is_steady(node, values, value, mistakes, dice):
            continue
        writer = Writer(dice)
        writer.write(node, 0)
        count -= 1
        name = f"v{count}"
        if not slips and (not is_number(value) or abs(value) < 1e6):
            kind = "n" if is_number(value) else "v" if is_vector(value) else "b" if isinstance(value, bool) else "s"
            names[name], values[name] = (kind, None), value
        yield name, node, writer.text, value, mistakes


def read_value(text):
    """A value as the program prints it."""
    if text in ("true", "false"):
        return text == "true"
    if text.startswith('"'):
        return text[1:-1].replace('\\"', '"').replace("\\\\", "\\")
    if text.startswith("#"):
        return Color(int(text[i:i + 2], 16) / 255 for i in (1, 3, 5))
    if text.startswith("("):
        return tuple(map(float, text[1:-1].split(",")))
    return float(text)


class Expressions(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.path = pathlib.Path(folder.name) / "fuzz.txt"

    def write(self, rows):
        self.path.write_text("".join(f"let {name} = {text}\n" for name, _, text, _, _ in rows) + "sphere { }\n")

    def test_sound_ones_have_the_same_values(self):
        for seed in range(3):
            rows = list(expressions(seed, 500, slips=False))
            self.write(rows)
            done = program.run("params", self.path)
            self.assertEqual(done.returncode, 0, done.stderr.decode()[:2000])
            lines = done.stdout.decode().splitlines()
            self.assertEqual(len(lines), len(rows))
            for (name, _, text, value, _), line in zip(rows, lines):
                with self.subTest(expression=text, seed=seed):
                    found_name, _, found = line.partition(" = ")
                    self.assertEqual(found_name, name)
                    tolerance = 1e-7 if found.startswith("#") else 1e-12
                    self.assertTrue(near_enough(read_value(found), value, tolerance), (found, value))
                    if isinstance(value, Color) and near(value, Color(round(c * 255) / 255 for c in value), 1e-12):
                        self.assertRegex(found, "^#", "a display colour stays one")
                    elif not isinstance(value, Color):
                        self.assertNotRegex(found, "^#", "what was computed with is no display colour")

    def test_mistakes_are_told_at_their_places(self):
        for seed in range(8):
            rows = []
            for row in expressions(100 + seed, 60, slips=True):
                if sum(len(r[4]) for r in rows) + len(row[4]) <= 90:  # the program shows a hundred
                    rows.append(row)
            self.write(rows)
            done = program.run("check", "--format", "json", self.path)
            self.assertEqual(done.returncode, 1, done.stderr.decode()[:2000])
            found = {}
            for message in map(json.loads, done.stdout.decode().splitlines()):
                self.assertEqual(message["severity"], "error", message)
                self.assertEqual(message["line"], message["end_line"], message)
                found.setdefault(message["line"], []).append(message)
            for line, (name, _, text, _, mistakes) in enumerate(rows, 1):
                with self.subTest(scene=f"let {name} = {text}", seed=seed):
                    self.check_places(len(f"let {name} = ") + 1, mistakes, found.get(line, []))

    def check_places(self, first_column, mistakes, messages):
        told = {(m["column"] - first_column, m["end_column"] - first_column): m["message"] for m in messages}
        for place, message in told.items():
            self.assertTrue(any(place in node.places for node in mistakes), (place, message, [n.places for n in mistakes]))
        for node in mistakes:
            self.assertTrue(node.places & set(told), (node.kind, node.value, node.places, told))


def near_enough(x, y, tolerance):
    if is_vector(x) and is_vector(y):
        size = max(map(abs, y))
        return all(abs(a - b) <= tolerance * max(size, 1e-300) for a, b in zip(x, y))
    return near(x, y, tolerance)


if __name__ == "__main__":
    unittest.main()
