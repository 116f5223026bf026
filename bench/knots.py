"""The knots of make_mesh.py as files, and what is in them."""

import array
import pathlib
import subprocess
import sys

MAKER = pathlib.Path(__file__).resolve().parent / "make_mesh.py"


def file(triangles, folder):
    """The PLY file in the folder, made when first asked for."""
    path = folder / f"knot-{triangles}.ply"
    if not path.exists():
        subprocess.run([sys.executable, MAKER, path, "--triangles", str(triangles)], check=True,
                       stdout=subprocess.DEVNULL)
    return path


def read(path):
    """(points, triangles) as lists of three numbers each."""
    head, body = path.read_bytes().split(b"end_header\n", 1)
    counts = {word.split()[1]: int(word.split()[2]) for word in head.decode().splitlines() if word.startswith("element")}
    floats = array.array("f", body[:12 * counts["vertex"]])
    points = [tuple(floats[i:i + 3]) for i in range(0, len(floats), 3)]
    rows = body[12 * counts["vertex"]:]
    triangles = [tuple(array.array("i", rows[i + 1:i + 13])) for i in range(0, 13 * counts["face"], 13)]
    return points, triangles
