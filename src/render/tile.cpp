#include "render/tile.hpp"

#include <algorithm>
#include <limits>

namespace raytracer {
namespace {

constexpr int kTileSize = 32;  // pixels along an edge
constexpr int kSquare = 4;     // of a block

float* plane(Image& image, int channel) {
  std::vector<float>* planes[] = {&image.red, &image.green, &image.blue};
  return planes[channel]->data();
}

float* lanes(ColorBlock& colors, int channel) {
  float* all[] = {colors.x, colors.y, colors.z};
  return all[channel];
}

}  // namespace

std::vector<Tile> cut_into_tiles(int width, int height) {
  std::vector<Tile> tiles;
  for (int y = 0; y < height; y += kTileSize) {
    for (int x = 0; x < width; x += kTileSize) {
      tiles.push_back({x, y, std::min(x + kTileSize, width), std::min(y + kTileSize, height)});
    }
  }
  return tiles;
}

TilePixels::TilePixels(const Tile& tile, const Image& image) {
  const std::size_t count = static_cast<std::size_t>(tile.x_end - tile.x_begin) *
                            static_cast<std::size_t>(tile.y_end - tile.y_begin);
  blocks_.resize(blocks_for(count));
  for (int y = tile.y_begin; y < tile.y_end; y += kSquare) {
    for (int x = tile.x_begin; x < tile.x_end; x += kSquare) {
      for (int v = y; v < std::min(y + kSquare, tile.y_end); ++v) {
        for (int u = x; u < std::min(x + kSquare, tile.x_end); ++u, ++size_) {
          PixelBlock& block = blocks_[size_ / kBlockSize];
          const std::size_t lane = size_ % kBlockSize;
          block.x[lane] = u;
          block.y[lane] = v;
          block.number[lane] = static_cast<std::uint32_t>(image.index(u, v));
        }
      }
    }
  }
}

TileSums::TileSums(const Tile& tile, Image& image, const Slice& slice, int samples)
    : image_(image), slice_(slice), samples_(samples), pixels_(tile, image), sums_(pixels_.blocks().size()) {
  if (slice.first_sample == 0) return;  // all is black
  for (std::size_t b = 0; b < sums_.size(); ++b) {
    const PixelBlock& pixels = pixels_.blocks()[b];
    for (int channel = 0; channel < 3; ++channel) {
      const float* from = plane(image_, channel);
      float* to = lanes(sums_[b], channel);
      for (std::size_t i = 0; i < pixels_.size_of_block(b); ++i) to[i] = from[pixels.number[i]];
    }
  }
}

float TileSums::limited(float value, float scale) const {
  const float brightest = std::numeric_limits<float>::max() / static_cast<float>(samples_);
  const float positive = value > 0 ? scale * value : 0.0F;
  return positive < brightest ? positive : brightest;
}

void TileSums::add(std::span<const ColorBlock> colors, float scale) {
  for (std::size_t b = 0; b < sums_.size(); ++b) {
    ColorBlock& sum = sums_[b];
    const ColorBlock& color = colors[b];
    for (int i = 0; i < kBlockSize; ++i) {
      sum.x[i] += limited(color.x[i], scale);
      sum.y[i] += limited(color.y[i], scale);
      sum.z[i] += limited(color.z[i], scale);
    }
  }
}

void TileSums::add(std::size_t i, const Color3f& color, float scale) {
  ColorBlock& sum = sums_[i / kBlockSize];
  const std::size_t lane = i % kBlockSize;
  sum.x[lane] += limited(color.x, scale);
  sum.y[lane] += limited(color.y, scale);
  sum.z[lane] += limited(color.z, scale);
}

void TileSums::store() {
  const float divisor = slice_.end_sample == samples_ ? static_cast<float>(samples_) : 1.0F;
  for (std::size_t b = 0; b < sums_.size(); ++b) {
    const PixelBlock& pixels = pixels_.blocks()[b];
    for (int channel = 0; channel < 3; ++channel) {
      float* from = lanes(sums_[b], channel);
      float* to = plane(image_, channel);
      for (int i = 0; i < kBlockSize; ++i) from[i] /= divisor;
      for (std::size_t i = 0; i < pixels_.size_of_block(b); ++i) to[pixels.number[i]] = from[i];
    }
  }
}

}  // namespace raytracer
