// Pictures from JPEG files. The only door to libjpeg.
#include <cstddef>
#include <cstdio>
// libjpeg's header wants those two before it.
#include <fmt/format.h>
#include <jerror.h>
#include <jpeglib.h>

#include <algorithm>
#include <csetjmp>
#include <string>
#include <string_view>
#include <utility>

#include "image/orientation.hpp"
#include "image/readers.hpp"
#include "raytracer/error.hpp"

namespace raytracer {
namespace {

// A file with many scans over few bytes takes for ever; no writer makes as many.
constexpr int kMostScans = 200;

constexpr int kExifMarker = JPEG_APP0 + 1;

/// libjpeg's errors, which leave by longjmp as libpng's do.
struct JpegErrors {
  jpeg_error_mgr base;  // first: libjpeg knows only this part
  std::jmp_buf exit;
  char problem[JMSG_LENGTH_MAX];
};

[[noreturn]] void keep_problem_and_jump(j_common_ptr jpeg) {
  auto* errors = reinterpret_cast<JpegErrors*>(jpeg->err);
  errors->base.format_message(jpeg, errors->problem);
  std::longjmp(errors->exit, 1);
}

// Where pixels are missing libjpeg only warns, and invents them; here that is an error. Other warnings leave
// a picture that every viewer shows.
void judge_message(j_common_ptr jpeg, int level) {
  if (level < 0 && jpeg->err->msg_code == JWRN_JPEG_EOF) keep_problem_and_jump(jpeg);
}

void limit_scans(j_common_ptr jpeg) {
  const auto* input = reinterpret_cast<j_decompress_ptr>(jpeg);
  if (input->input_scan_number <= kMostScans) return;
  jpeg->err->msg_code = JERR_BAD_PROGRESSION;
  keep_problem_and_jump(jpeg);
}

/// libjpeg's struct and what it points to.
class JpegReader {
 public:
  JpegReader() {
    jpeg_.err = jpeg_std_error(&errors_.base);
    errors_.base.error_exit = keep_problem_and_jump;
    errors_.base.emit_message = judge_message;
    errors_.base.output_message = [](j_common_ptr) {};
  }
  ~JpegReader() { jpeg_destroy_decompress(&jpeg_); }
  JpegReader(const JpegReader&) = delete;
  JpegReader& operator=(const JpegReader&) = delete;

  /// False when libjpeg refused; then problem() says why. So for the next one.
  bool read_head(ByteSpan file) {
    if (setjmp(errors_.exit) != 0) return false;
    jpeg_create_decompress(&jpeg_);
    progress_.progress_monitor = limit_scans;
    jpeg_.progress = &progress_;
    jpeg_save_markers(&jpeg_, kExifMarker, 0xFFFF);
    jpeg_mem_src(&jpeg_, file.data(), static_cast<unsigned long>(file.size()));
    jpeg_read_header(&jpeg_, TRUE);
    if (jpeg_.jpeg_color_space == JCS_YCCK) jpeg_.out_color_space = JCS_CMYK;
    jpeg_calc_output_dimensions(&jpeg_);
    return true;
  }

  /// Into rows of the output's own components.
  bool read_pixels(std::uint8_t* pixels, std::size_t row_bytes) {
    if (setjmp(errors_.exit) != 0) return false;
    jpeg_start_decompress(&jpeg_);
    while (jpeg_.output_scanline < jpeg_.output_height) {
      JSAMPROW row = pixels + row_bytes * jpeg_.output_scanline;
      jpeg_read_scanlines(&jpeg_, &row, 1);
    }
    jpeg_finish_decompress(&jpeg_);
    return true;
  }

  /// How a camera was held that wrote the file; known between the two.
  Orientation orientation() const {
    constexpr std::string_view kName("Exif\0\0", 6);
    for (const jpeg_saved_marker_ptr* next = &jpeg_.marker_list; *next != nullptr; next = &(*next)->next) {
      const jpeg_marker_struct& marker = **next;
      const std::string_view text(reinterpret_cast<const char*>(marker.data), marker.data_length);
      if (marker.marker != kExifMarker || !text.starts_with(kName)) continue;
      return exif_orientation(ByteSpan(marker.data, marker.data_length).subspan(kName.size()));
    }
    return {};
  }

  const jpeg_decompress_struct& jpeg() const { return jpeg_; }
  Error problem() const {
    return {ErrorKind::kScene, fmt::format("the JPEG is broken: {}", errors_.problem)};
  }

 private:
  jpeg_decompress_struct jpeg_ = {};
  jpeg_progress_mgr progress_ = {};
  JpegErrors errors_ = {};
};

// Inks, which files hold as Adobe does, 255 being none of it, unless they say that they are not Adobe's.
Picture rgb_from_cmyk(const Picture& cmyk, bool is_inverted) {
  Picture rgb(cmyk.width, cmyk.height, 3, TexelType::kByte, PictureCurve::kSrgb);
  const std::uint8_t* ink = cmyk.row(0);
  const auto paper = [&](std::size_t c) { return is_inverted ? ink[c] : 255 - ink[c]; };
  for (std::uint8_t* out = rgb.row(0); out != rgb.row(rgb.height); out += 3, ink += 4) {
    for (std::size_t c = 0; c < 3; ++c) out[c] = static_cast<std::uint8_t>((paper(c) * paper(3) + 127) / 255);
  }
  return rgb;
}

}  // namespace

Picture read_jpeg(ByteSpan file) {
  JpegReader reader;
  if (!reader.read_head(file)) throw reader.problem();
  const jpeg_decompress_struct& jpeg = reader.jpeg();
  const auto channels = static_cast<std::size_t>(jpeg.output_components);
  check_size(jpeg.output_width, jpeg.output_height);
  check_plausible(std::size_t{jpeg.output_width} * jpeg.output_height * channels, file.size());
  Picture picture(static_cast<int>(jpeg.output_width), static_cast<int>(jpeg.output_height),
                  jpeg.output_components, TexelType::kByte, PictureCurve::kSrgb);
  const Orientation orientation = reader.orientation();
  if (!reader.read_pixels(picture.row(0), picture.row_bytes())) throw reader.problem();
  if (jpeg.out_color_space == JCS_CMYK) picture = rgb_from_cmyk(picture, jpeg.saw_Adobe_marker != 0);
  if (picture.channels == 1 || picture.channels == 3) return turned(std::move(picture), orientation);
  throw Error(ErrorKind::kScene, fmt::format("the JPEG has {} channels, which are no colours", channels));
}

}  // namespace raytracer
