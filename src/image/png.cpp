// Pictures as PNG. The only door to libpng, which writes the file's structure; rows are filtered and
// compressed here, on all threads.
#include <png.h>

#include <algorithm>
#include <csetjmp>
#include <cstring>
#include <new>
#include <string>
#include <utility>

#include "core/parallel.hpp"
#include "image/encode.hpp"
#include "image/png_rows.hpp"
#include "image/zlib_pieces.hpp"
#include "raytracer/error.hpp"
#include "raytracer/image.hpp"

namespace raytracer {
namespace {

/// What libpng is given to write, where it writes, and what it says when it can't.
struct PngJob {
  png_uint_32 width = 0, height = 0;
  const std::vector<ZlibPiece>& pieces;
  std::vector<std::uint8_t> file = {};
  char problem[128] = "";
};

// libpng leaves a failing call by longjmp, so none of its callbacks, nor write_chunks, may hold an object
// with a destructor when it calls libpng.
void keep_problem_and_jump(png_structp png, png_const_charp message) {
  auto* job = static_cast<PngJob*>(png_get_error_ptr(png));
  std::strncpy(job->problem, message, sizeof job->problem - 1);
  png_longjmp(png, 1);
}

void ignore_warning(png_structp, png_const_charp) {}

void append_to_file(png_structp png, png_bytep data, std::size_t size) {
  auto* job = static_cast<PngJob*>(png_get_io_ptr(png));
  bool has_memory = true;
  try {
    job->file.insert(job->file.end(), data, data + size);
  } catch (const std::bad_alloc&) {
    has_memory = false;
  }
  if (!has_memory) png_error(png, "not enough memory");
}

void nothing_to_flush(png_structp) {}

/// libpng's pair of structs.
class PngWriter {
 public:
  explicit PngWriter(PngJob& job)
      : png_(png_create_write_struct(PNG_LIBPNG_VER_STRING, &job, keep_problem_and_jump, ignore_warning)),
        info_(png_ ? png_create_info_struct(png_) : nullptr) {
    if (!info_) {
      png_destroy_write_struct(&png_, nullptr);
      throw std::bad_alloc();
    }
    png_set_write_fn(png_, &job, append_to_file, nothing_to_flush);
  }
  ~PngWriter() { png_destroy_write_struct(&png_, &info_); }
  PngWriter(const PngWriter&) = delete;
  PngWriter& operator=(const PngWriter&) = delete;

  png_structp png() const { return png_; }
  png_infop info() const { return info_; }

 private:
  png_structp png_;
  png_infop info_;
};

void set_texts(png_structp png, png_infop info) {
  static char keys[2][9] = {"Software", "Version"};
  static char values[2][sizeof("raytracer") + sizeof(RAYTRACER_VERSION)] = {"raytracer", RAYTRACER_VERSION};
  png_text texts[2] = {};
  for (int i = 0; i < 2; ++i) {
    texts[i].compression = PNG_TEXT_COMPRESSION_NONE;
    texts[i].key = keys[i];
    texts[i].text = values[i];
  }
  png_set_text(png, info, texts, 2);
}

/// False when libpng refused; then job.problem says why.
bool write_chunks(png_structp png, png_infop info, const PngJob& job) {
  if (setjmp(png_jmpbuf(png)) != 0) return false;
  png_set_user_limits(png, PNG_UINT_31_MAX, PNG_UINT_31_MAX);
  png_set_IHDR(png, info, job.width, job.height, 8, PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE,
               PNG_COMPRESSION_TYPE_BASE, PNG_FILTER_TYPE_BASE);
  set_texts(png, info);
  png_write_info(png, info);
  static constexpr png_byte kPixels[] = "IDAT", kEnd[] = "IEND";
  for (std::size_t i = 0; i < job.pieces.size(); ++i) {
    png_write_chunk(png, kPixels, job.pieces[i].bytes.data(), job.pieces[i].bytes.size());
  }
  png_write_chunk(png, kEnd, nullptr, 0);
  return true;
}

PiecePlace place_of(std::size_t i, std::size_t count) {
  if (count == 1) return PiecePlace::kOnly;
  if (i == 0) return PiecePlace::kFirst;
  return i + 1 == count ? PiecePlace::kLast : PiecePlace::kMiddle;
}

/// The rows cut into stripes, the same for any number of threads, and compressed side by side.
std::vector<ZlibPiece> compress_rows(const Image& image) {
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

std::vector<std::uint8_t> png_of(const Image& image) {
  const std::vector<ZlibPiece> pieces = compress_rows(image);
  PngJob job{static_cast<png_uint_32>(image.width), static_cast<png_uint_32>(image.height), pieces};
  const PngWriter writer(job);
  if (!write_chunks(writer.png(), writer.info(), job)) {
    throw Error(ErrorKind::kFile, std::string("can't make a PNG: ") + job.problem);
  }
  return std::move(job.file);
}

}  // namespace

std::vector<std::uint8_t> encode_png(const Image& image) {
  return encode_checked(image, [&] { return png_of(image); });
}

}  // namespace raytracer
