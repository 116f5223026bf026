// A piece of the picture, and what is seen in it.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/lanes.hpp"
#include "raytracer/image.hpp"

namespace raytracer {

/// The pixels from (x_begin, y_begin) to, but without, (x_end, y_end).
struct Tile {
  int x_begin, y_begin, x_end, y_end;
};

std::vector<Tile> cut_into_tiles(int width, int height);

/// Sixteen pixels side by side; what is not used of the last block holds zeros.
struct alignas(64) PixelBlock {
  std::int32_t x[kBlockSize], y[kBlockSize];
  std::uint32_t number[kBlockSize];  ///< Image::index()

  glm::ivec2 at(int lane) const { return {x[lane], y[lane]}; }
};

/// The pixels of a tile, squares of sixteen one after the other: rays that go the same way.
class TilePixels {
 public:
  TilePixels(const Tile& tile, const Image& image);

  std::size_t size() const { return size_; }
  std::span<const PixelBlock> blocks() const { return blocks_; }
  std::size_t size_of_block(std::size_t block) const {
    return std::min<std::size_t>(kBlockSize, size_ - block * kBlockSize);
  }
  glm::ivec2 at(std::size_t i) const { return blocks_[i / kBlockSize].at(static_cast<int>(i % kBlockSize)); }

 private:
  std::vector<PixelBlock> blocks_;
  std::size_t size_ = 0;
};

/// A part of the time that the shutter is open, of which its middle stands for the whole, and the samples
/// that fall in it.
struct Slice {
  double time;
  int first_sample, end_sample;
};

/// The sums of a tile's pixels while its samples are rendered. Between slices of time the image holds sums.
class TileSums {
 public:
  /// Of the `slice` of as many samples.
  TileSums(const Tile& tile, Image& image, const Slice& slice, int samples);

  const TilePixels& pixels() const { return pixels_; }

  /// What is brighter than a picture can hold counts as bright as that; what is no number, or less than
  /// nothing, as nothing.
  void add(std::span<const ColorBlock> colors, float scale);
  /// Likewise to pixel i alone.
  void add(std::size_t i, const Color3f& color, float scale);

  /// After the last of all samples the sums become means.
  void store();

 private:
  float limited(float value, float scale) const;

  Image& image_;
  Slice slice_;
  int samples_;
  TilePixels pixels_;
  std::vector<ColorBlock> sums_;
};

}  // namespace raytracer
