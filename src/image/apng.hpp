// Pictures that move, as one PNG: https://wiki.mozilla.org/APNG_Specification, since 2025 part of PNG's third
// edition.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "image/zlib_pieces.hpp"
#include "raytracer/image.hpp"

namespace raytracer {

/// Put together frame by frame; plays for ever. Viewers that know nothing of it show the first frame.
class Apng {
 public:
  /// `fps`: frames per second, 0.001 … 1000.
  explicit Apng(double fps);

  /// Throws Error for a picture that has another size than the first (kUsage), or can't be encoded.
  void add(const Image& image);
  /// The frame before, once more.
  void repeat();
  /// The file. At least one frame has been added.
  std::vector<std::uint8_t> finish();

 private:
  using Bytes = std::vector<std::uint8_t>;

  void begin_file();
  void append_control();
  void append_pixels();
  void write_delay();
  void append_chunk(std::string_view type, const Bytes& content);

  std::uint16_t delay_numerator_ = 1, delay_denominator_ = 1;  // seconds per frame
  int width_ = 0, height_ = 0;
  Bytes file_;
  std::vector<ZlibPiece> pixels_;                  // of the latest frame
  std::uint32_t frames_ = 0;                       // those that have pixels of their own
  std::uint32_t sequence_ = 0;                     // the next fcTL's or fdAT's number
  std::uint32_t shown_for_ = 0;                    // how many frames long the latest is shown
  std::size_t animation_at_ = 0, control_at_ = 0;  // where in the file acTL and the latest fcTL begin
};

}  // namespace raytracer
