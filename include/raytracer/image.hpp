// Pictures in memory and their way into a file.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "raytracer/vector3f.hpp"

namespace raytracer {

/// Three planar buffers of width x height floats, row by row from the top left. 255 is white; values are
/// neither clamped nor rounded.
struct Image {
  int width = 0, height = 0;
  std::vector<float> red, green, blue;

  Image() = default;
  /// Black. Throws Error for a negative size (kUsage) or too little memory (kFile).
  Image(int width, int height);

  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
  }
  Color3f at(int x, int y) const { return {red[index(x, y)], green[index(x, y)], blue[index(x, y)]}; }
  void set(int x, int y, const Color3f& c) {
    red[index(x, y)] = c.x;
    green[index(x, y)] = c.y;
    blue[index(x, y)] = c.z;
  }
};

/// A PNG of 8-bit RGB: each value clamped to 0..255 and rounded, a half upwards; NaN is 0. The same image
/// gives the same bytes for any number of threads. Throws Error for an image without pixels or with buffers
/// of the wrong size (kUsage), for too little memory and for what the format can't hold (kFile).
std::vector<std::uint8_t> encode_png(const Image& image);

/// A little-endian colour PFM of value / 255, unclamped, bottom row first
/// (http://netpbm.sourceforge.net/doc/pfm.html). Throws as encode_png does.
std::vector<std::uint8_t> encode_pfm(const Image& image);

/// Puts `bytes` at `path` whole or not at all: written beside its place, flushed to the disk, renamed;
/// whatever stood there survives every failure, and its permissions and a link to it survive success. A
/// `path` that is not a regular file (/dev/stdout) is written directly. Throws Error (kFile) naming the path
/// and the reason.
void write_file(const std::string& path, const std::vector<std::uint8_t>& bytes);

/// Does nothing when write_file would find its place, else throws what it would throw: for a missing folder,
/// a path that is a folder, a lack of permission. Asked before rendering, it saves a picture from having
/// nowhere to go.
void check_writable(const std::string& path);

}  // namespace raytracer
