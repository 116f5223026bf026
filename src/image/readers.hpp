// A reader for each kind of picture; read_picture chooses.
#pragma once

#include "image/byte_span.hpp"
#include "image/picture.hpp"

namespace raytracer {

// Of files that begin as that kind does. They throw Error (kScene) with a clause about the file.
Picture read_png(ByteSpan file);
Picture read_jpeg(ByteSpan file);
Picture read_radiance(ByteSpan file);
Picture read_exr(ByteSpan file);

/// Throws Error for a picture without texels or with more than kLargestTexels.
void check_size(std::int64_t width, std::int64_t height);

/// Throws Error unless pixels that take `raw_bytes` before compression can come from a file of that size: a
/// byte of a zlib stream becomes at most 1032 (https://zlib.net/zlib_tech.html), and the other kinds of
/// compression do not do better by much. So what little files declare takes no memory.
void check_plausible(std::size_t raw_bytes, std::size_t file_bytes);

}  // namespace raytracer
