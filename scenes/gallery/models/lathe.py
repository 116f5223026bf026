#!/usr/bin/env python3
"""Turns outlines into the OBJ files of this folder: what a potter's wheel does, and a tree, more or less.

An outline is a list of places (distance from the axis, height) from the foot to the top, and a curve is drawn through them;
a place that stands there twice is a corner.
"""

import math
import pathlib

HERE = pathlib.Path(__file__).parent


def curve(places, pieces):
    """Places on a curve through all of them (Catmull and Rom's), with corners where two are the same."""
    drawn = []
    for i in range(len(places) - 1):
        a, b = places[i], places[i + 1]
        if a == b:
            continue
        before = places[i - 1] if i > 0 else a
        after = places[i + 2] if i + 2 < len(places) else b
        is_straight = (i == 0 or before == a) and after == b
        for k in range(1 if is_straight else pieces):
            s = k / pieces
            drawn.append(tuple(0.5 * (2 * q + (r - p) * s + (2 * p - 5 * q + 4 * r - t) * s**2 + (3 * q - p - 3 * r + t) * s**3)
                               for p, q, r, t in zip(before, a, b, after)))
    return [*drawn, places[-1]]


def lathe(name, places, around=36, pieces=3, bent=lambda x, y, z: (x, y, z)):
    outline = curve(places, pieces)
    lines = [f"# {name}, by lathe.py"]
    rings = []  # the numbers of the corners of each ring; on the axis there is only one
    count = 0
    for radius, height in outline:
        on_axis = radius < 1e-6
        ring = []
        for i in range(1 if on_axis else around):
            angle = 2 * math.pi * i / around
            x, y, z = bent(radius * math.cos(angle), height, -radius * math.sin(angle))
            lines.append(f"v {x:.3f} {y:.3f} {z:.3f}")
            count += 1
            ring.append(count)
        rings.append(ring * around if on_axis else ring)
    for low, high in zip(rings, rings[1:]):
        for i in range(around):
            k = (i + 1) % around
            corners = list(dict.fromkeys((low[i], low[k], high[k], high[i])))
            if len(corners) > 2:
                lines.append("f " + " ".join(map(str, corners)))
    (HERE / f"{name}.obj").write_text("\n".join(lines) + "\n")


def pear(x, y, z):
    """Crooked, and not quite round."""
    lean = 0.10 * max(y - 0.9, 0) ** 2
    swell = 1 + 0.035 * math.sin(3 * math.atan2(z, x) + 2 * y)
    return x * swell + lean, y, z * swell


def apple(x, y, z):
    """With five blunt edges towards its foot."""
    swell = 1 + 0.03 * math.cos(5 * math.atan2(z, x)) * max(0, 1 - y / 1.1) + 0.03 * math.sin(math.atan2(z, x) + 1)
    return x * swell, y + 0.04 * x, z * swell


def main():
    lathe("pear", [(0, 0.08), (0.2, 0.02), (0.55, 0.16), (0.76, 0.6), (0.62, 1.08), (0.36, 1.5), (0.25, 1.85), (0.12, 1.98),
                   (0, 1.95)], bent=pear)
    lathe("apple", [(0, 0.16), (0.16, 0.06), (0.36, 0.02), (0.66, 0.25), (0.8, 0.72), (0.66, 1.12), (0.36, 1.26), (0.16, 1.17),
                    (0, 1.02)], bent=apple)
    lathe("jug", [(0, 0), (0, 0), (0.55, 0), (0.55, 0), (0.6, 0.06), (0.88, 0.6), (0.9, 1.1), (0.62, 1.75), (0.42, 2.15),
                  (0.42, 2.5), (0.58, 2.82), (0.61, 2.86), (0.56, 2.86), (0.38, 2.5), (0.36, 2.15), (0.5, 1.75), (0.7, 1.1),
                  (0.7, 0.6), (0, 0.2)], around=40, pieces=2)
    lathe("bowl", [(0, 0), (0, 0), (0.8, 0), (0.8, 0), (0.82, 0.12), (1.3, 0.36), (1.72, 0.82), (1.75, 0.87), (1.69, 0.86),
                   (1.26, 0.44), (0.7, 0.2), (0, 0.16)], around=44, pieces=2)
    # A tumbler that is glass up to the line of the water, at 1.9: what is in it stands in the glass (see glass-of-water.txt).
    lathe("tumbler", [(0, 0), (0, 0), (0.78, 0), (0.84, 0.03), (0.87, 0.1), (0.87, 0.1), (1.1, 2.72), (1.1, 2.72), (1.095, 2.77),
                      (1.06, 2.79), (1.025, 2.77), (1.02, 2.72), (1.02, 2.72), (0.95, 1.9), (0.95, 1.9), (0, 1.9)],
          around=64, pieces=2)


if __name__ == "__main__":
    main()
