#!/usr/bin/env python3
"""Writes a large mesh for the benchmarks: a knotted tube with bumps, closed, as a binary PLY file.

    make_mesh.py knot.ply [--triangles 872002] [--normals]

The tube follows a torus knot that winds 2 times one way and 3 times the other. Around it lie rows of points; the number
of triangles is the nearest that full rows allow. Standard library only."""

import argparse
import array
import math
import pathlib
import sys

TURNS, WINDINGS = 2, 3
TUBE_RADIUS = 0.35
BUMPS_ALONG, BUMPS_AROUND, BUMP_HEIGHT = 90, 7, 0.06


def knot_point(t):
    radius = 2 + math.cos(WINDINGS * t)
    return radius * math.cos(TURNS * t), radius * math.sin(TURNS * t), math.sin(WINDINGS * t)


def cross(a, b):
    return a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]


def unit(a):
    length = math.sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2])
    return a[0] / length, a[1] / length, a[2] / length


def frame(t):
    """The point of the knot and two directions across it. They come from the curve's tangent and the direction from the
    torus' middle circle outward, so that they meet themselves after one round."""
    step = 1e-4
    before, here, after = knot_point(t - step), knot_point(t), knot_point(t + step)
    tangent = unit(tuple(b - a for a, b in zip(before, after)))
    middle = (2 * math.cos(TURNS * t), 2 * math.sin(TURNS * t), 0.0)
    across = unit(cross(tangent, tuple(h - m for h, m in zip(here, middle))))
    return here, cross(across, tangent), across


def positions(rows, columns):
    """Row after row around the tube, x y z each."""
    turn = 2 * math.pi / columns
    around = [(math.cos(j * turn), math.sin(j * turn), math.sin(BUMPS_AROUND * j * turn)) for j in range(columns)]
    points = array.array("f")
    for i in range(rows):
        t = 2 * math.pi * i / rows
        (px, py, pz), (ux, uy, uz), (vx, vy, vz) = frame(t)
        height = BUMP_HEIGHT * math.sin(BUMPS_ALONG * t)
        row = []
        for c, s, bump in around:
            radius = TUBE_RADIUS + height * bump
            a, b = radius * c, radius * s
            row += (px + a * ux + b * vx, py + a * uy + b * vy, pz + a * uz + b * vz)
        points.extend(row)
    return points


def normals(points, rows, columns):
    """Across the two lines through a point's neighbours; outward."""
    result = array.array("f")
    width = 3 * columns
    for i in range(rows):
        here, before, after = i * width, (i - 1) % rows * width, (i + 1) % rows * width
        row = []
        for j in range(columns):
            left, right, at = (j - 1) % columns * 3, (j + 1) % columns * 3, 3 * j
            ax, ay, az = (points[here + right + k] - points[here + left + k] for k in range(3))
            bx, by, bz = (points[after + at + k] - points[before + at + k] for k in range(3))
            x, y, z = ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx
            scale = 1 / math.sqrt(x * x + y * y + z * z)
            row += (scale * x, scale * y, scale * z)
        result.extend(row)
    return result


def little_endian(numbers):
    if sys.byteorder == "big":
        numbers.byteswap()
    return numbers.tobytes()


def faces(rows, columns):
    """Two triangles between four neighbours, each "3" and three indices; one row's bytes at a time."""
    for i in range(rows):
        here, after = i * columns, (i + 1) % rows * columns
        indices = array.array("I")
        for j in range(columns):
            k = (j + 1) % columns
            indices.extend((here + j, here + k, after + j, here + k, after + k, after + j))
        assert indices.itemsize == 4
        corners = little_endian(indices)
        yield b"".join(b"\x03" + corners[n:n + 12] for n in range(0, len(corners), 12))


def write_knot(path, triangles, with_normals):
    """Returns how many triangles there are."""
    columns = max(3, round(math.sqrt(triangles / 2 / 18)))  # the knot is about 18 times as long as around
    rows = max(3, round(triangles / 2 / columns))
    points = positions(rows, columns)
    names = ["x", "y", "z"] + (["nx", "ny", "nz"] if with_normals else [])
    header = ["ply", "format binary_little_endian 1.0", f"element vertex {rows * columns}",
              *(f"property float {name}" for name in names), f"element face {2 * rows * columns}",
              "property list uchar int vertex_indices", "end_header\n"]
    if with_normals:
        directions = normals(points, rows, columns)
        both = array.array("f", bytes(8 * len(points)))
        for axis in range(3):
            both[axis::6], both[axis + 3::6] = points[axis::3], directions[axis::3]
        points = both
    with open(path, "wb") as file:
        file.write("\n".join(header).encode() + little_endian(points))
        for row in faces(rows, columns):
            file.write(row)
    return 2 * rows * columns


def main():
    parser = argparse.ArgumentParser(description="Writes a closed, bumpy knot as a binary PLY file.")
    parser.add_argument("file", type=pathlib.Path)
    parser.add_argument("--triangles", type=int, default=872002)
    parser.add_argument("--normals", action="store_true")
    arguments = parser.parse_args()
    count = write_knot(arguments.file, arguments.triangles, arguments.normals)
    print(f"{arguments.file}: {count} triangles, {arguments.file.stat().st_size} bytes")


if __name__ == "__main__":
    main()
