#!/usr/bin/env python3
"""Renders the pictures of the manual and the README into docs/images/ anew. Look at them before committing.

  docs/render_pictures.py                      all, with ./raytracer
  docs/render_pictures.py city step-10         some
  RAYTRACER=build/raytracer docs/render_pictures.py
"""

import os
import pathlib
import struct
import subprocess
import sys
import tempfile
import zlib

ROOT = pathlib.Path(__file__).resolve().parents[1]
PROGRAM = os.environ.get("RAYTRACER", str(ROOT / "raytracer"))
IMAGES = ROOT / "docs" / "images"

sys.path += [str(ROOT / "tests"), str(ROOT / "tests" / "render")]

from pictures import read_png

SMALL = ["--size", "400x250", "--samples", "16"]
LIT = [*SMALL[:3], "192"]  # of method path, which takes more to be without noise

PICTURES = {  # name: (its scene, what else the command line says)
    "first": ("first", ["--size", "800x450", "--samples", "16"]),
    "showcase": ("showcase", ["--size", "960x540"]),
    **{f"step-{n:02}": (f"tutorial/step-{n:02}", SMALL) for n in range(1, 11)},
    "step-08": ("tutorial/step-08", [*SMALL, "--time-at", "1.6"]),
    "step-09": ("tutorial/step-09", [*SMALL, "--set", "night=true"]),
    **{name: (f"gallery/{name}", SMALL) for name in ("staircase", "city", "clock", "forest", "sphereflake", "periodic-table")},
    "dominoes": ("gallery/dominoes", [*SMALL, "--time-at", "4"]),
    **{name: (f"gallery/{name}", LIT)
       for name in ("cornell-box", "materials", "glass-of-water", "watch", "product-shot", "still-life")},
    # textures, skies and lenses, by method path
    **{name: (f"gallery/{name}", ["--size", "400x250", "--samples", samples])
       for name, samples in (("kitchen-shelf", "144"), ("chess", "144"), ("morning-room", "256"), ("macro", "400"))},
    "panorama": ("gallery/panorama", ["--size", "400x200", "--samples", "144"]),
}


def palette_of(colors, size=256):
    """That many colours for a picture's: boxes of colours, the widest cut in two until there are enough (median cut)."""
    def sides(box):
        return [max(c[i] for c in box) - min(c[i] for c in box) for i in range(3)]

    boxes = [(max(sides(colors)) * len(colors) ** 0.5, colors)]
    while len(boxes) < size and max(boxes)[0] > 0:
        widest = max(boxes)
        boxes.remove(widest)
        box = widest[1]
        side = sides(box)
        box.sort(key=lambda c: c[side.index(max(side))])
        for half in (box[:len(box) // 2], box[len(box) // 2:]):
            boxes.append((max(sides(half)) * len(half) ** 0.5, half))
    return [tuple(round(sum(c[i] for c in box) / len(box)) for i in range(3)) for _, box in boxes]


def dithered(width, height, pixels, palette):
    """Rows of places in the palette; what one pixel is off is made up for by its neighbours (Floyd and Steinberg)."""
    nearest, rows = {}, b""
    carried = [[0.0] * 3 for _ in range(width + 2)]
    for y in range(height):
        below = [[0.0] * 3 for _ in range(width + 2)]
        row = bytearray()
        for x in range(width):
            wanted = [pixels[3 * (y * width + x) + i] + carried[x + 1][i] for i in range(3)]
            cell = tuple(round(value / 4) for value in wanted)
            if cell not in nearest:
                nearest[cell] = min(range(len(palette)), key=lambda k: sum((4 * c - p) ** 2 for c, p in zip(cell, palette[k])))
            row.append(nearest[cell])
            for i in range(3):
                off = (wanted[i] - palette[row[-1]][i]) / 16
                carried[x + 2][i] += 7 * off
                below[x][i] += 3 * off
                below[x + 1][i] += 5 * off
                below[x + 2][i] += off
        rows += b"\0" + row
        carried = below
    return rows


def with_palette(data):
    """The PNG with 256 colours, which halves its size."""
    def chunk(kind, body):
        return struct.pack(">I", len(body)) + kind + body + struct.pack(">I", zlib.crc32(kind + body))

    width, height, pixels = read_png(data)
    palette = palette_of([tuple(pixels[i:i + 3]) for i in range(0, len(pixels), 3)])
    header = struct.pack(">IIBBBBB", width, height, 8, 3, 0, 0, 0)
    rows = dithered(width, height, pixels, palette)
    return (data[:8] + chunk(b"IHDR", header) + chunk(b"PLTE", bytes(value for color in palette for value in color))
            + chunk(b"IDAT", zlib.compress(rows, 9)) + chunk(b"IEND", b""))


def render(scene, arguments):
    with tempfile.TemporaryDirectory() as folder:
        picture = pathlib.Path(folder) / "picture.png"
        subprocess.run([PROGRAM, ROOT / "scenes" / f"{scene}.txt", "-o", picture, *arguments, "--quiet"], check=True)
        return picture.read_bytes()


def main():
    wanted = sys.argv[1:] or list(PICTURES)
    unknown = [name for name in wanted if name not in PICTURES]
    if unknown:
        sys.exit(f"no such picture: {', '.join(unknown)}; there are {', '.join(PICTURES)}")
    for name in wanted:
        scene, arguments = PICTURES[name]
        picture = IMAGES / f"{name}.png"
        data = render(scene, arguments)
        picture.write_bytes(with_palette(data) if arguments[1].startswith("400x") else data)
        print(f"{picture.relative_to(ROOT)}  {picture.stat().st_size // 1000} kB")


if __name__ == "__main__":
    main()
