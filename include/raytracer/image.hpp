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

/// The curve that brings bright light into the range of a display.
enum class Tone : std::uint8_t { kNone, kFilmic, kAgx, kAces };

/// How a picture of linear values becomes one of display values.
struct Development {
  bool is_linear = false;  ///< false: the values are display values already (classic), and stay as they are
  float exposure = 0;      ///< stops
  Tone tone = Tone::kNone;
  Color3f white{1};  ///< linear Rec.709 colour of the light that shall look white
};

/// The picture as a display wants it: 255 is white. Exposure, white balance, tone curve, the sRGB curve, and
/// noise of less than a step that keeps even slopes from banding, the same for the same picture.
Image develop(Image image, const Development& development);

/// A PNG of 8-bit RGB: each value clamped to 0..255 and rounded, a half upwards; NaN is 0. The same image
/// gives the same bytes for any number of threads. Throws Error for an image without pixels or with buffers
/// of the wrong size (kUsage), for too little memory and for what the format can't hold (kFile).
std::vector<std::uint8_t> encode_png(const Image& image);

/// An OpenEXR of 32-bit floats, value / 255, unclamped, linear Rec.709. Throws as encode_png does.
std::vector<std::uint8_t> encode_exr(const Image& image);

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
