// Pictures from PNG files of every kind, by libpng.
#include <fmt/format.h>
#include <png.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <csetjmp>
#include <cstring>
#include <new>
#include <optional>

#include "image/readers.hpp"
#include "raytracer/error.hpp"

namespace raytracer {
namespace {

struct PngSource {
  ByteSpan file;
  std::size_t position = 0;
  char problem[128] = "";
};

// libpng leaves a failing call by longjmp; nothing with a destructor may stand in its callbacks, nor in what
// calls it after setjmp.
void keep_problem_and_jump(png_structp png, png_const_charp message) {
  auto* source = static_cast<PngSource*>(png_get_error_ptr(png));
  std::strncpy(source->problem, message, sizeof source->problem - 1);
  png_longjmp(png, 1);
}

void ignore_warning(png_structp, png_const_charp) {}

void read_bytes(png_structp png, png_bytep out, std::size_t count) {
  auto* source = static_cast<PngSource*>(png_get_io_ptr(png));
  if (count > source->file.size() - source->position) png_error(png, "the file ends too early");
  std::memcpy(out, source->file.data() + source->position, count);
  source->position += count;
}

/// libpng's pair of structs.
class PngReader {
 public:
  explicit PngReader(PngSource& source)
      : png_(png_create_read_struct(PNG_LIBPNG_VER_STRING, &source, keep_problem_and_jump, ignore_warning)),
        info_(png_ ? png_create_info_struct(png_) : nullptr) {
    if (!info_) {
      png_destroy_read_struct(&png_, nullptr, nullptr);
      throw std::bad_alloc();
    }
    png_set_read_fn(png_, &source, read_bytes);
  }
  ~PngReader() { png_destroy_read_struct(&png_, &info_, nullptr); }
  PngReader(const PngReader&) = delete;
  PngReader& operator=(const PngReader&) = delete;

  png_structp png() const { return png_; }
  png_infop info() const { return info_; }

 private:
  png_structp png_;
  png_infop info_;
};

/// What the file says before its pixels, and how many passes they take.
struct PngHead {
  png_uint_32 width = 0, height = 0;
  int bits = 0, color_type = 0, passes = 1;
  int channels = 0;         // once expanded
  std::size_t raw_row = 0;  // bytes of a row in the file
  double gamma = 0;         // 0: none said, or overruled by an sRGB or ICC chunk
};

/// False when libpng refused; then the source says why. Palettes and small greys become 8-bit channels,
/// transparent colours an alpha channel; 16 bits stay.
bool read_head(png_structp png, png_infop info, PngHead& head) {
  if (setjmp(png_jmpbuf(png)) != 0) return false;
  png_set_user_limits(png, PNG_UINT_31_MAX, PNG_UINT_31_MAX);
  png_set_chunk_malloc_max(png, png_alloc_size_t{1} << 22U);  // what remarks and profiles may unpack to
  png_set_chunk_cache_max(png, 16);
  png_read_info(png, info);
  png_get_IHDR(png, info, &head.width, &head.height, &head.bits, &head.color_type, nullptr, nullptr, nullptr);
  head.raw_row = png_get_rowbytes(png, info);
  int intent = 0;
  if (png_get_sRGB(png, info, &intent) == 0 && png_get_valid(png, info, PNG_INFO_iCCP) == 0) {
    if (png_get_gAMA(png, info, &head.gamma) == 0) head.gamma = 0;
  }
  png_set_expand(png);
  if (std::endian::native == std::endian::little) png_set_swap(png);
  head.passes = png_set_interlace_handling(png);
  png_read_update_info(png, info);
  head.channels = png_get_channels(png, info);
  return true;
}

bool read_pixels(png_structp png, png_infop info, const PngHead& head, Picture& picture) {
  if (setjmp(png_jmpbuf(png)) != 0) return false;
  if (png_get_rowbytes(png, info) != picture.row_bytes())
    png_error(png, "rows of another size than declared");
  for (int pass = 0; pass < head.passes; ++pass) {
    for (int y = 0; y < picture.height; ++y) png_read_row(png, picture.row(y), nullptr);
  }
  png_read_end(png, nullptr);
  return true;
}

Error broken(const char* why) { return {ErrorKind::kScene, fmt::format("the PNG is broken: {}", why)}; }

// libpng takes, and clears, as much memory as a chunk says that it is long: up to 2 GiB.
void check_chunks(ByteSpan file) {
  constexpr std::size_t kSignature = 8, kAround = 12;  // length, name and checksum
  for (std::size_t at = kSignature; at < file.size();) {
    const std::size_t left = file.size() - at;
    if (left < kAround || png_get_uint_32(file.data() + at) > left - kAround) {
      throw broken("it ends within a chunk");
    }
    at += kAround + png_get_uint_32(file.data() + at);
    if (std::memcmp(file.data() + at - kSignature, "IEND", 4) == 0) return;
  }
  throw broken("it ends before its last chunk");
}

// A gamma of 1 / 2.2 is what writers say who mean sRGB.
void set_curve(Picture& picture, double gamma) {
  if (gamma < 0.01 || gamma > 100 || std::abs(gamma - 0.45455) < 0.005) return;
  picture.exponent = static_cast<float>(1 / gamma);
  picture.curve = std::abs(gamma - 1) < 0.005 ? PictureCurve::kLinear : PictureCurve::kPower;
}

}  // namespace

Picture read_png(ByteSpan file) {
  check_chunks(file);
  PngSource source{file};
  const PngReader reader(source);
  PngHead head;
  if (!read_head(reader.png(), reader.info(), head)) throw broken(source.problem);
  check_size(head.width, head.height);
  check_plausible(head.raw_row * std::size_t{head.height}, file.size());
  Picture picture(static_cast<int>(head.width), static_cast<int>(head.height), head.channels,
                  head.bits == 16 ? TexelType::kShort : TexelType::kByte, PictureCurve::kSrgb);
  set_curve(picture, head.gamma);
  // Interlaced pixels are put into what was there before, which must be something.
  if (head.passes > 1) std::memset(picture.data.get(), 0, picture.bytes());
  if (!read_pixels(reader.png(), reader.info(), head, picture)) throw broken(source.problem);
  return picture;
}

}  // namespace raytracer
