// A picture's pixels as the zlib stream of a PNG.
#pragma once

#include <vector>

#include "image/zlib_pieces.hpp"
#include "raytracer/image.hpp"

namespace raytracer {

/// The rows, filtered and compressed on all threads, as pieces that follow each other in IDAT chunks. The
/// same for any number of threads. Throws Error (kFile) for a picture too wide.
std::vector<ZlibPiece> compress_pixels(const Image& image);

}  // namespace raytracer
