"""Runs the built program from outside, for the tests written in Python."""

import os
import pathlib
import pty
import resource
import subprocess
import unittest

PROGRAM = os.environ.get("RAYTRACER", str(pathlib.Path(__file__).parents[1] / "raytracer"))
ROOT = pathlib.Path(__file__).parents[1]


def run(*arguments, stdin=b"", cwd=None, env=None, timeout=120, **options):
    """The finished program: .returncode, .stdout and .stderr, both as bytes."""
    environment = dict(os.environ, **(env or {}))
    return subprocess.run(
        [PROGRAM, *map(str, arguments)], input=stdin, capture_output=True, cwd=cwd, env=environment,
        timeout=timeout, check=False, **options)


IS_SANITIZED = bool(os.environ.get("RAYTRACER_SANITIZED"))


def limit_memory(size):
    """For preexec_fn. The address sanitizer reserves terabytes of addresses: its builds go without."""
    if not IS_SANITIZED:
        resource.setrlimit(resource.RLIMIT_AS, (size, size))


def limit_processor_time(seconds):
    """For preexec_fn: beyond so much processor time the program is killed. Sanitized builds take many times as long."""
    if IS_SANITIZED:
        seconds *= 20
    resource.setrlimit(resource.RLIMIT_CPU, (seconds, seconds + 1))


def open_terminal():
    """The two ends of a pseudo-terminal; skips the test where there is none to be had (a bare chroot)."""
    try:
        return pty.openpty()
    except OSError as error:
        raise unittest.SkipTest(f"no pseudo-terminal: {error}") from None


def read_terminal(leader):
    """All that is written to a pseudo-terminal until its other end is closed; closes this one."""
    seen = b""
    try:
        while part := os.read(leader, 65536):
            seen += part
    except OSError:  # how Linux says that the other side is closed
        pass
    os.close(leader)
    return seen


def read_pfm(data):
    """(width, height, rows from the top of (r, g, b) tuples) of a PFM file's bytes."""
    import struct
    header, size, scale, body = data.split(b"\n", 3)
    assert header == b"PF" and float(scale) == -1.0, (header, scale)
    width, height = map(int, size.split())
    values = struct.unpack(f"<{3 * width * height}f", body)
    rows = []
    for y in reversed(range(height)):
        row = values[3 * width * y:3 * width * (y + 1)]
        rows.append([row[3 * x:3 * x + 3] for x in range(width)])
    return width, height, rows
