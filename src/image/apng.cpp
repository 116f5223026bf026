#include "image/apng.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <tuple>
#include <utility>

#include "image/encode.hpp"
#include "image/png_pixels.hpp"
#include "raytracer/error.hpp"

namespace raytracer {
namespace {

using Bytes = std::vector<std::uint8_t>;

constexpr std::size_t kChunkHead = 8;        // length and type
constexpr std::size_t kDelayInControl = 20;  // where in an fcTL's content the delay stands
constexpr std::uint32_t kLargestDelay = std::numeric_limits<std::uint16_t>::max();

void put(Bytes& out, std::uint32_t number, int bytes) {
  for (int shift = 8 * (bytes - 1); shift >= 0; shift -= 8)
    out.push_back(static_cast<std::uint8_t>(number >> shift));
}

void overwrite(Bytes& file, std::size_t at, const Bytes& with) {
  std::copy(with.begin(), with.end(), file.begin() + static_cast<std::ptrdiff_t>(at));
}

// A chunk's checksum covers its type and its content.
void renew_checksum(Bytes& file, std::size_t chunk_at, std::size_t content_size) {
  Bytes checksum;
  put(checksum, crc32_of(file.data() + chunk_at + 4, 4 + content_size), 4);
  overwrite(file, chunk_at + kChunkHead + content_size, checksum);
}

// The fraction nearest to x whose halves fit 16 bits, by its continued fraction; the simplest one that is
// equal to twelve digits where there is one, so that 1/24 stays 1/24.
std::pair<std::uint16_t, std::uint16_t> fraction_of(double x) {
  std::uint32_t last[2] = {0, 1}, best[2] = {1, 0};  // numerator and denominator
  double rest = x;
  for (int i = 0; i < 32; ++i) {
    const double whole = std::floor(rest);
    if (whole > kLargestDelay) break;
    const auto n = static_cast<std::uint32_t>(whole);
    const std::uint64_t next[2] = {std::uint64_t{n} * best[0] + last[0],
                                   std::uint64_t{n} * best[1] + last[1]};
    if (next[0] > kLargestDelay || next[1] > kLargestDelay) break;
    for (const int half : {0, 1}) {
      last[half] = std::exchange(best[half], static_cast<std::uint32_t>(next[half]));
    }
    if (std::abs(best[0] / (best[1] * x) - 1) < 1e-12) break;
    rest = 1 / (rest - whole);
  }
  return {static_cast<std::uint16_t>(best[0]), static_cast<std::uint16_t>(best[1])};
}

}  // namespace

Apng::Apng(double fps) { std::tie(delay_numerator_, delay_denominator_) = fraction_of(1 / fps); }

void Apng::add(const Image& image) {
  if (frames_ > 0 && (image.width != width_ || image.height != height_)) {
    throw Error(ErrorKind::kUsage,
                fmt::format("a film's pictures have one size: this one is {}x{}, the first is {}x{}",
                            image.width, image.height, width_, height_));
  }
  encode_checked(image, [&] {
    pixels_ = compress_pixels(image);
    return Bytes();
  });
  width_ = image.width;
  height_ = image.height;
  if (frames_ == 0) begin_file();
  append_control();
  append_pixels();
}

void Apng::repeat() {
  if ((shown_for_ + 1) * delay_numerator_ <= kLargestDelay) {
    ++shown_for_;
    return write_delay();
  }
  append_control();
  append_pixels();
}

std::vector<std::uint8_t> Apng::finish() {
  Bytes count;
  put(count, frames_, 4);
  overwrite(file_, animation_at_ + kChunkHead, count);
  renew_checksum(file_, animation_at_, 8);
  append_chunk("IEND", {});
  return std::move(file_);
}

void Apng::begin_file() {
  file_ = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1A, '\n'};
  Bytes header;
  put(header, static_cast<std::uint32_t>(width_), 4);
  put(header, static_cast<std::uint32_t>(height_), 4);
  header.insert(header.end(), {8, 2, 0, 0, 0});  // 8 bits of RGB, the standard methods, not interlaced
  append_chunk("IHDR", header);
  for (const std::string_view text :
       {std::string_view("Software\0raytracer", 18),
        std::string_view("Version\0" RAYTRACER_VERSION, 7 + sizeof RAYTRACER_VERSION)}) {
    append_chunk("tEXt", {text.begin(), text.end()});
  }
  animation_at_ = file_.size();
  append_chunk("acTL", Bytes(8));  // the number of frames, known in the end, and of plays: 0, without end
}

void Apng::append_control() {
  control_at_ = file_.size();
  Bytes control;
  put(control, sequence_++, 4);
  put(control, static_cast<std::uint32_t>(width_), 4);
  put(control, static_cast<std::uint32_t>(height_), 4);
  control.resize(kDelayInControl + 6);  // at 0 0; the delay; nothing is kept of the frame before
  append_chunk("fcTL", control);
  ++frames_;
  shown_for_ = 1;
  write_delay();
}

// The first frame is the PNG's own picture.
void Apng::append_pixels() {
  for (const ZlibPiece& piece : pixels_) {
    if (frames_ == 1) {
      append_chunk("IDAT", piece.bytes);
      continue;
    }
    Bytes content;
    put(content, sequence_++, 4);
    content.insert(content.end(), piece.bytes.begin(), piece.bytes.end());
    append_chunk("fdAT", content);
  }
}

void Apng::write_delay() {
  Bytes delay;
  put(delay, shown_for_ * delay_numerator_, 2);
  put(delay, delay_denominator_, 2);
  overwrite(file_, control_at_ + kChunkHead + kDelayInControl, delay);
  renew_checksum(file_, control_at_, kDelayInControl + 6);
}

void Apng::append_chunk(std::string_view type, const Bytes& content) {
  const std::size_t start = file_.size();
  put(file_, static_cast<std::uint32_t>(content.size()), 4);
  file_.insert(file_.end(), type.begin(), type.end());
  file_.insert(file_.end(), content.begin(), content.end());
  put(file_, 0, 4);
  renew_checksum(file_, start, content.size());
}

}  // namespace raytracer
