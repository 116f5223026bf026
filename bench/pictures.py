"""How much two pictures differ that raytracer's own code has written."""

import itertools
import operator
import struct
import zlib


def mean_difference(path, other):
    """Over all pixels and channels, in 1/255."""
    pixels, others = read(path), read(other)
    return sum(map(abs, map(operator.sub, pixels, others))) / len(pixels)


def read(path):
    """The bytes of an 8-bit RGB PNG whose rows all have the filter Sub, the only one that encode_png uses."""
    file, at, packed = path.read_bytes(), 8, []
    while at < len(file):  # https://www.w3.org/TR/png-3/#5Chunk-layout
        length, kind = struct.unpack_from(">I4s", file, at)
        if kind == b"IHDR":
            width, = struct.unpack_from(">I", file, at + 8)
        if kind == b"IDAT":
            packed.append(file[at + 8:at + 8 + length])
        at += length + 12
    rows, stride = zlib.decompress(b"".join(packed)), 1 + 3 * width
    pixels = bytearray()
    for start in range(0, len(rows), stride):
        assert rows[start] == 1, f"{path} has a row without the filter Sub"
        row = bytearray(stride - 1)
        for channel in range(3):
            differences = rows[start + 1 + channel:start + stride:3]
            row[channel::3] = bytes(itertools.accumulate(differences, lambda left, d: (left + d) & 255))
        pixels += row
    return pixels
