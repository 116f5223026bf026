// Pictures as PNG. The only door to libpng, which writes the file's structure.
#include <png.h>

#include <csetjmp>
#include <cstring>
#include <new>
#include <string>
#include <utility>

#include "image/encode.hpp"
#include "image/png_pixels.hpp"
#include "image/png_text.hpp"
#include "raytracer/error.hpp"
#include "raytracer/image.hpp"

namespace raytracer {
namespace {

/// What libpng is given to write, where it writes, and what it says when it can't.
struct PngJob {
  png_uint_32 width = 0, height = 0;
  const std::vector<ZlibPiece>& pieces;
  std::vector<png_text> texts = {};
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

/// False when libpng refused; then job.problem says why.
bool write_chunks(png_structp png, png_infop info, const PngJob& job) {
  if (setjmp(png_jmpbuf(png)) != 0) return false;
  png_set_user_limits(png, PNG_UINT_31_MAX, PNG_UINT_31_MAX);
  png_set_IHDR(png, info, job.width, job.height, 8, PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE,
               PNG_COMPRESSION_TYPE_BASE, PNG_FILTER_TYPE_BASE);
  // The values are a display's; gAMA and cHRM say so to readers that don't know sRGB.
  png_set_sRGB_gAMA_and_cHRM(png, info, PNG_sRGB_INTENT_PERCEPTUAL);
  png_set_text(png, info, job.texts.data(), static_cast<int>(job.texts.size()));
  png_write_info(png, info);
  static constexpr png_byte kPixels[] = "IDAT", kEnd[] = "IEND";
  for (std::size_t i = 0; i < job.pieces.size(); ++i) {
    png_write_chunk(png, kPixels, job.pieces[i].bytes.data(), job.pieces[i].bytes.size());
  }
  png_write_chunk(png, kEnd, nullptr, 0);
  return true;
}

// libpng reads the text, and takes it by a pointer that could write.
png_text as_png_text(std::string& key, std::string& value) {
  png_text text = {};
  text.compression = PNG_TEXT_COMPRESSION_NONE;
  text.key = key.data();
  text.text = value.data();
  return text;
}

std::vector<std::uint8_t> png_of(const Image& image, std::vector<PngText> texts) {
  const std::vector<ZlibPiece> pieces = compress_pixels(image);
  PngJob job{static_cast<png_uint_32>(image.width), static_cast<png_uint_32>(image.height), pieces};
  texts.insert(texts.begin(), {{"Software", "raytracer"}, {"Version", RAYTRACER_VERSION}});
  for (PngText& text : texts) job.texts.push_back(as_png_text(text.keyword, text.text));
  const PngWriter writer(job);
  if (!write_chunks(writer.png(), writer.info(), job)) {
    throw Error(ErrorKind::kFile, std::string("can't make a PNG: ") + job.problem);
  }
  return std::move(job.file);
}

}  // namespace

std::vector<std::uint8_t> encode_png_with(const std::vector<PngText>& texts, const Image& image) {
  return encode_checked(image, [&] { return png_of(image, texts); });
}

std::vector<std::uint8_t> encode_png(const Image& image) { return encode_png_with({}, image); }

}  // namespace raytracer
