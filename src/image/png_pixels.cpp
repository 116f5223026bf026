#include "image/png_pixels.hpp"

#include <algorithm>
#include <string>

#include "core/parallel.hpp"
#include "image/png_rows.hpp"
#include "raytracer/error.hpp"

namespace raytracer {
namespace {

PiecePlace place_of(std::size_t i, std::size_t count) {
  if (count == 1) return PiecePlace::kOnly;
  if (i == 0) return PiecePlace::kFirst;
  return i + 1 == count ? PiecePlace::kLast : PiecePlace::kMiddle;
}

}  // namespace

std::vector<ZlibPiece> compress_pixels(const Image& image) {
  // Stripes are the same for any number of threads.
  constexpr int kStripeBytes = 1 << 16, kMaxWidth = 1 << 28;
  if (image.width > kMaxWidth) {
    throw Error(ErrorKind::kFile,
                "a PNG wider than " + std::to_string(kMaxWidth) + " pixels can't be written");
  }
  const int stripe_rows = std::max(1, kStripeBytes / (3 * image.width + 1));
  const auto count = static_cast<std::size_t>((image.height - 1) / stripe_rows + 1);
  std::vector<ZlibPiece> pieces(count);
  parallel_for(count, [&](std::size_t i) {
    const int first = static_cast<int>(i) * stripe_rows;
    const int end = std::min(image.height - first, stripe_rows) + first;
    pieces[i] = compress_piece(filtered_rows(image, first, end), place_of(i, count));
  });
  append_checksum(pieces);
  return pieces;
}

}  // namespace raytracer
