"""What the regression test and update_expected.py share: which scenes there are, how one is rendered small, how a PNG is
read and two pictures are compared."""

import pathlib
import re
import shlex
import struct
import zlib

import program

SCENES = program.ROOT / "scenes"
EXPECTED = pathlib.Path(__file__).parent / "expected"
SIZE = "96x72"
SAMPLES = 4

# Scenes that say little at their first moment, and the moment to look at instead.
MOMENTS = {"gallery/dominoes": 4, "tutorial/step-08": 1.6}

# Its speckles are rounding errors, which no two processors share: there is no picture to expect.
SPECKLED = SCENES / "paper" / "figure-5.txt"

# What another processor may change: roundings that decide on which side of an edge a sample falls.
FAR = 3  # of 255, in any channel
MOST_FAR_PIXELS = 0.005
MOST_MEAN_DIFFERENCE = 0.3  # of 255


def all_scenes():
    """Every scene file that no other one includes, in order."""
    files = sorted(SCENES.rglob("*.txt"))
    included = set()
    for file in files:
        for name in re.findall(r'^[^/\n]*\binclude\s+"([^"]+)"', file.read_text(), re.MULTILINE):
            included.add((file.parent / name).resolve())
    return [file for file in files if file.resolve() not in included]


def expected_pictures():
    """{path of the expected picture: its scene}."""
    return {expected_path(scene): scene for scene in all_scenes() if scene != SPECKLED}


def name_of(scene):
    """scenes/paper/cube.txt is paper/cube."""
    return scene.relative_to(SCENES).with_suffix("").as_posix()


def expected_path(scene):
    """scenes/paper/cube.txt is expected as paper-cube.png."""
    return EXPECTED / (name_of(scene).replace("/", "-") + ".png")


def arguments(scene, output, samples=SAMPLES):
    moment = ["--time-at", MOMENTS[name_of(scene)]] if name_of(scene) in MOMENTS else []
    return [scene, "-o", output, "--size", SIZE, "--samples", samples, "--quiet", *moment]


def command(scene, output, samples=SAMPLES):
    """The line that renders the picture again."""
    return shlex.join(map(str, [program.PROGRAM, *arguments(scene, output, samples)]))


def render(scene, samples=SAMPLES):
    """The bytes of the scene's small PNG; AssertionError with what the program said if it made none."""
    done = program.run(*arguments(scene, "-", samples))
    assert done.returncode == 0, f"{command(scene, '-', samples)}\nends with {done.returncode}:\n{done.stderr.decode()}"
    return done.stdout


def _unfilter(kind, line, above):
    # https://www.w3.org/TR/png-3/#9Filters, three bytes a pixel
    for i in range(len(line)):
        left = line[i - 3] if i >= 3 else 0
        up = above[i]
        corner = above[i - 3] if i >= 3 else 0
        if kind == 1:
            line[i] = (line[i] + left) & 255
        elif kind == 2:
            line[i] = (line[i] + up) & 255
        elif kind == 3:
            line[i] = (line[i] + (left + up) // 2) & 255
        elif kind == 4:
            guess = left + up - corner
            nearest = min((abs(guess - left), 0, left), (abs(guess - up), 1, up), (abs(guess - corner), 2, corner))
            line[i] = (line[i] + nearest[2]) & 255


def read_png(data):
    """(width, height, the bytes r g b r g b … from the upper left) of an 8-bit RGB PNG."""
    assert data.startswith(b"\x89PNG\r\n\x1a\n"), "not a PNG"
    position, packed, header = 8, b"", None
    while position < len(data):
        length, kind = struct.unpack_from(">I4s", data, position)
        body = data[position + 8:position + 8 + length]
        if kind == b"IHDR":
            header = struct.unpack(">IIBBBBB", body)
        elif kind == b"IDAT":
            packed += body
        position += 12 + length
    width, height, *form = header
    assert form == [8, 2, 0, 0, 0], f"not 8-bit RGB without interlace: {form}"
    rows = zlib.decompress(packed)
    stride = 3 * width
    pixels, above = bytearray(), bytearray(stride)
    for y in range(height):
        start = y * (stride + 1)
        line = bytearray(rows[start + 1:start + 1 + stride])
        _unfilter(rows[start], line, above)
        pixels += line
        above = line
    return width, height, bytes(pixels)


def difference(picture, expected):
    """What speaks against two pictures being the same, in words; empty if nothing does."""
    if picture[:2] != expected[:2]:
        return f"it is {picture[0]} x {picture[1]} pixels, not {expected[0]} x {expected[1]}"
    apart = [abs(a - b) for a, b in zip(picture[2], expected[2])]
    pixels = len(apart) // 3
    far = sum(max(apart[i:i + 3]) > FAR for i in range(0, len(apart), 3)) / pixels
    mean = sum(apart) / len(apart)
    if far <= MOST_FAR_PIXELS and mean < MOST_MEAN_DIFFERENCE:
        return ""
    return f"{100 * far:.2f} % of the pixels are off by more than {FAR}/255, the mean difference is {mean:.3f}/255"
