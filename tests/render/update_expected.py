#!/usr/bin/env python3
"""Renders the expected pictures of the scenes anew, after a change that was meant to change them. Look at what it wrote
before committing it.

  tests/render/update_expected.py              with ./raytracer
  RAYTRACER=build/raytracer tests/render/update_expected.py
"""

import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))

import pictures


def main():
    pictures.EXPECTED.mkdir(exist_ok=True)
    wanted = pictures.expected_pictures()
    for path in set(pictures.EXPECTED.glob("*.png")) - set(wanted):
        path.unlink()
        print("removed", path.name)
    for path, scene in wanted.items():
        data = pictures.render(scene)
        if path.exists() and pictures.difference(pictures.read_png(data), pictures.read_png(path.read_bytes())) == "":
            continue  # as good as the same: not worth a change in the repository
        path.write_bytes(data)
        print("written", path.name)


if __name__ == "__main__":
    main()
