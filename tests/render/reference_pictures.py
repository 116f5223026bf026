"""The project's reference pictures and the script that compares with them, where they are at hand: RAYTRACER_REFERENCE names
the folder with compare.py."""

import os
import pathlib
import subprocess
import sys
import unittest
import venv

import program

REFERENCE = pathlib.Path(os.environ.get("RAYTRACER_REFERENCE", program.ROOT.parent / "shared" / "reference"))


def python_with(*packages):
    """A Python that has the packages of PyPI: this one, or one beside the program. Skips where there is none."""
    check = "import numpy, PIL, OpenEXR"
    if subprocess.run([sys.executable, "-c", check], capture_output=True, check=False).returncode == 0:
        return sys.executable
    home = pathlib.Path(program.PROGRAM).resolve().parent / "reference-venv"
    python = home / "bin" / "python"
    if python.exists() and subprocess.run([python, "-c", check], capture_output=True, check=False).returncode == 0:
        return python
    install = [python, "-m", "pip", "install", "--quiet", "--disable-pip-version-check", "--retries", "0",
               "--timeout", "15", *packages]
    try:
        venv.create(home, with_pip=True)
        subprocess.run(install, capture_output=True, check=True, timeout=300)
    except (subprocess.SubprocessError, OSError) as failure:
        raise unittest.SkipTest(f"no {', '.join(packages)} here, and PyPI gives none ({failure})") from failure
    return python


def compare(name, picture, *options):
    """compare.py's finished run for the reference of that name; skips the test where there is none."""
    script = REFERENCE / "compare.py"
    if not script.exists():
        raise unittest.SkipTest(f"no reference pictures in {REFERENCE}")
    python = python_with("numpy", "pillow", "OpenEXR")
    return subprocess.run([python, script, REFERENCE / name, picture, "--no-flip", *options],
                          capture_output=True, text=True, check=False, timeout=120)
