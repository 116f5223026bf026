"""Scene texts in, pictures of floats out; what closed_form_test, relations_test and reference_test share."""

import array
import math
import pathlib
import re
import sys
import tempfile

import program


class Picture:
    """A picture of floats, 1 is white: .values holds r, g, b of every pixel, row by row from the top left."""

    def __init__(self, width, height, values):
        self.width, self.height, self.values = width, height, values

    def at(self, x, y):
        i = 3 * (self.width * y + x)
        return tuple(self.values[i:i + 3])


def read_picture(data):
    """The Picture in the bytes of a PFM file."""
    header, size, scale, body = data.split(b"\n", 3)
    assert header == b"PF" and float(scale) == -1.0, (header, scale)
    width, height = map(int, size.split())
    values = array.array("f", body)
    if sys.byteorder == "big":
        values.byteswap()
    rows = [values[3 * width * y:3 * width * (y + 1)] for y in reversed(range(height))]
    return Picture(width, height, array.array("f", [v for row in rows for v in row]))


def render_bytes(scene, *options, ending=".pfm"):
    """The file that the program makes of a scene's text."""
    with tempfile.TemporaryDirectory() as folder:
        out = pathlib.Path(folder) / ("out" + ending)
        done = program.run("-", "-o", out, "--quiet", *options, stdin=scene.encode(), cwd=folder)
        assert done.returncode == 0 and not done.stderr, (
            f"exit code {done.returncode}: {done.stderr.decode()}\noptions {options}, scene:\n{scene}")
        return out.read_bytes()


def render(scene, *options):
    return read_picture(render_bytes(scene, *options))


def share_of_different_pixels(a, b, tolerance=1 / 255):
    """How many of the pixels differ by more than the tolerance in a channel, each value clamped to 0..1."""
    assert (a.width, a.height) == (b.width, b.height)
    different = set()
    for i, (x, y) in enumerate(zip(a.values, b.values)):
        if not abs(min(max(x, 0.0), 1.0) - min(max(y, 0.0), 1.0)) <= tolerance:
            different.add(i // 3)
    return len(different) / (a.width * a.height)


def rotation(axis, degrees):
    """The matrix, three rows, that turns counter-clockwise seen from the axis' tip."""
    length = math.sqrt(sum(a * a for a in axis))
    x, y, z = (a / length for a in axis)
    s, c = math.sin(math.radians(degrees)), math.cos(math.radians(degrees))
    t = 1 - c
    return ((t * x * x + c, t * x * y - s * z, t * x * z + s * y),
            (t * x * y + s * z, t * y * y + c, t * y * z - s * x),
            (t * x * z - s * y, t * y * z + s * x, t * z * z + c))


def place(template, scale=1.0, axis=(0, 1, 0), degrees=0.0):
    """A scene in another size and turned about the origin. In the template stand

        @(x y z)  a point          ^(x y z)  a direction      @1.5  a length
        ~1.5      the intensity of a light with falloff linear, ~~1.5 of one with falloff quadratic
        %         among the properties of a shape that can't be turned by its numbers
    """
    matrix = rotation(axis, degrees) if degrees else ((1, 0, 0), (0, 1, 0), (0, 0, 1))

    def number(value):
        return repr(float(value))

    def vector(match):
        v = [float(part) for part in match[2].split()]
        factor = scale if match[1] == "@" else 1.0
        return " ".join(number(factor * sum(m * part for m, part in zip(row, v))) for row in matrix)

    turn = f"rotate_axis {axis[0]} {axis[1]} {axis[2]} {degrees}" if degrees else ""
    text = re.sub(r"([@^])\(([^)]*)\)", vector, template)
    text = re.sub(r"@(-?[\d.]+)", lambda m: number(scale * float(m[1])), text)
    text = re.sub(r"~~([\d.]+)", lambda m: number(scale * scale * float(m[1])), text)
    text = re.sub(r"~([\d.]+)", lambda m: number(scale * float(m[1])), text)
    return text.replace("%", turn)
