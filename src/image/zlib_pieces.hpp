// A zlib stream (RFC 1950) put together from pieces that threads compress apart from each other. The only
// door to zlib.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace raytracer {

struct ZlibPiece {
  std::vector<std::uint8_t> bytes;  // its part of the stream; the parts in order are the stream
  std::uint32_t checksum = 0;       // Adler-32 of what went in
  std::size_t raw_size = 0;         // how many bytes went in
};

enum class PiecePlace { kOnly, kFirst, kMiddle, kLast };

/// Compresses at most 1 GiB. Only runs of equal bytes are sought, which suits filtered rows of rendered
/// pictures.
ZlibPiece compress_piece(const std::vector<std::uint8_t>& raw, PiecePlace place);

/// Ends the last piece with the checksum of all.
void append_checksum(std::vector<ZlibPiece>& pieces);

/// The CRC-32 of PNG's chunks.
std::uint32_t crc32_of(const std::uint8_t* bytes, std::size_t count);

}  // namespace raytracer
