#include "image/read_image.hpp"

#include <jpeglib.h>
#include <png.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "catch.hpp"
#include "image/readers.hpp"
#include "raytracer/error.hpp"
#include "raytracer/image.hpp"
#include "unit/temporary_folder.hpp"

using raytracer::ByteSpan;
using raytracer::Error;
using raytracer::Picture;
using raytracer::PictureCurve;
using raytracer::read_picture;
using raytracer::TexelType;

namespace {

using Bytes = std::vector<std::uint8_t>;

void put(Bytes& out, const std::string& text) { out.insert(out.end(), text.begin(), text.end()); }

// --- PNG
// -----------------------------------------------------------------------------------------------------

struct PngKind {
  int color_type = PNG_COLOR_TYPE_RGB, bits = 8;
  bool is_interlaced = false, has_transparent = false;
  double gamma = 0;
  bool has_srgb = false;
};

/// A sample of the pattern that png_of writes, in the file's own bits; of a palette the index.
int sample(const PngKind& kind, int x, int y, int c) {
  return (x * 5 + y * 3 + c * 7) % (1 << std::min(kind.bits, 15));
}

int channels_of(const PngKind& kind) {
  switch (kind.color_type) {
    case PNG_COLOR_TYPE_GRAY_ALPHA:
      return 2;
    case PNG_COLOR_TYPE_RGB:
      return 3;
    case PNG_COLOR_TYPE_RGB_ALPHA:
      return 4;
    default:
      return 1;
  }
}

Bytes packed_row(const PngKind& kind, int width, int y) {
  Bytes row((static_cast<std::size_t>(width * channels_of(kind) * kind.bits) + 7) / 8);
  int bit = 0;
  for (int x = 0; x < width; ++x) {
    for (int c = 0; c < channels_of(kind); ++c) {
      const int value = sample(kind, x, y, c);
      for (int b = kind.bits - 1; b >= 0; --b, ++bit) {
        if ((value >> b & 1) != 0)
          row[static_cast<std::size_t>(bit / 8)] |= static_cast<std::uint8_t>(0x80 >> bit % 8);
      }
    }
  }
  return row;
}

png_color palette_entry(int index) {
  return {static_cast<png_byte>(index * 3), static_cast<png_byte>(255 - index), static_cast<png_byte>(index)};
}

Bytes png_of(const PngKind& kind, int width, int height) {
  Bytes out;
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
  png_infop info = png_create_info_struct(png);
  png_set_write_fn(
      png, &out,
      [](png_structp p, png_bytep data, std::size_t size) {
        auto* bytes = static_cast<Bytes*>(png_get_io_ptr(p));
        bytes->insert(bytes->end(), data, data + size);
      },
      nullptr);
  png_set_IHDR(png, info, static_cast<png_uint_32>(width), static_cast<png_uint_32>(height), kind.bits,
               kind.color_type, kind.is_interlaced ? PNG_INTERLACE_ADAM7 : PNG_INTERLACE_NONE,
               PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  std::vector<png_color> palette;
  for (int i = 0; i < 1 << std::min(kind.bits, 8); ++i) palette.push_back(palette_entry(i));
  if (kind.color_type == PNG_COLOR_TYPE_PALETTE)
    png_set_PLTE(png, info, palette.data(), static_cast<int>(palette.size()));
  png_byte alphas[] = {0, 100};
  png_color_16 clear = {};
  if (kind.has_transparent) png_set_tRNS(png, info, alphas, 2, &clear);
  if (kind.gamma > 0) png_set_gAMA(png, info, kind.gamma);
  if (kind.has_srgb) png_set_sRGB(png, info, PNG_sRGB_INTENT_PERCEPTUAL);
  png_write_info(png, info);
  std::vector<Bytes> rows;
  std::vector<png_bytep> pointers;
  for (int y = 0; y < height; ++y) rows.push_back(packed_row(kind, width, y));
  for (Bytes& row : rows) pointers.push_back(row.data());
  png_write_image(png, pointers.data());
  png_write_end(png, nullptr);
  png_destroy_write_struct(&png, &info);
  return out;
}

float stored(const Picture& picture, int x, int y, int c) {
  return raytracer::stored_value(picture,
                                 picture.row(y) + picture.texel_bytes() * static_cast<std::size_t>(x), c);
}

void check_png(const PngKind& kind) {
  CAPTURE(kind.color_type, kind.bits, kind.is_interlaced, kind.has_transparent);
  const int width = 13, height = 11;
  const Picture picture = raytracer::read_png(png_of(kind, width, height));
  const bool is_palette = kind.color_type == PNG_COLOR_TYPE_PALETTE;
  const int colors = is_palette ? 3 : channels_of(kind);
  REQUIRE(picture.width == width);
  REQUIRE(picture.height == height);
  REQUIRE(picture.channels == colors + (kind.has_transparent ? 1 : 0));
  REQUIRE((picture.type == TexelType::kShort) == (kind.bits == 16));
  bool is_equal = true;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const int index = sample(kind, x, y, 0);
      const png_color entry = palette_entry(index);
      const float from_palette[] = {entry.red / 255.0f, entry.green / 255.0f, entry.blue / 255.0f};
      bool is_clear = true;
      for (int c = 0; c < colors; ++c) {
        is_clear = is_clear && sample(kind, x, y, c) == 0;
        const float expected =
            is_palette ? from_palette[c]
                       : static_cast<float>(sample(kind, x, y, c)) / static_cast<float>((1 << kind.bits) - 1);
        is_equal = is_equal && std::abs(stored(picture, x, y, c) - expected) < 1e-6f;
      }
      if (!kind.has_transparent) continue;
      const float alpha = is_palette ? (index == 0   ? 0.0f
                                        : index == 1 ? 100 / 255.0f
                                                     : 1.0f)
                          : is_clear ? 0.0f
                                     : 1.0f;
      is_equal = is_equal && stored(picture, x, y, colors) == alpha;
    }
  }
  CHECK(is_equal);
}

// --- others
// --------------------------------------------------------------------------------------------------

Bytes jpeg_of(int width, int height, int channels, const std::function<int(int, int, int)>& value) {
  jpeg_compress_struct jpeg = {};
  jpeg_error_mgr errors = {};
  jpeg.err = jpeg_std_error(&errors);
  jpeg_create_compress(&jpeg);
  unsigned char* buffer = nullptr;
  unsigned long size = 0;
  jpeg_mem_dest(&jpeg, &buffer, &size);
  jpeg.image_width = static_cast<JDIMENSION>(width);
  jpeg.image_height = static_cast<JDIMENSION>(height);
  jpeg.input_components = channels;
  jpeg.in_color_space = channels == 1 ? JCS_GRAYSCALE : channels == 3 ? JCS_RGB : JCS_CMYK;
  jpeg_set_defaults(&jpeg);
  jpeg_set_quality(&jpeg, 98, TRUE);
  if (height % 2 == 0) jpeg_simple_progression(&jpeg);
  jpeg_start_compress(&jpeg, TRUE);
  for (int y = 0; y < height; ++y) {
    Bytes row;
    for (int i = 0; i < width * channels; ++i)
      row.push_back(static_cast<std::uint8_t>(value(i / channels, y, i % channels)));
    JSAMPROW pointer = row.data();
    jpeg_write_scanlines(&jpeg, &pointer, 1);
  }
  jpeg_finish_compress(&jpeg);
  Bytes out(buffer, buffer + size);
  jpeg_destroy_compress(&jpeg);
  free(buffer);
  return out;
}

Bytes radiance_of(const std::string& size_line, const Bytes& pixels, const std::string& more = {}) {
  Bytes out;
  put(out, "#?RADIANCE\n# a remark\nFORMAT=32-bit_rle_rgbe\nEXPOSURE=1\n" + more + "\n" + size_line + "\n");
  out.insert(out.end(), pixels.begin(), pixels.end());
  return out;
}

/// A JPEG's marker with the tag Orientation behind one that says nothing about it.
Bytes exif_of(int orientation, bool is_big_endian) {
  Bytes tiff;
  const auto number = [&](std::uint32_t value, std::size_t size) {
    for (std::size_t i = 0; i < size; ++i) {
      const std::size_t byte = is_big_endian ? size - 1 - i : i;
      tiff.push_back(static_cast<std::uint8_t>(value >> 8 * byte));
    }
  };
  put(tiff, is_big_endian ? "MM" : "II");
  number(42, 2);
  number(8, 4);
  number(2, 2);
  for (const auto& [tag, value] : {std::pair<std::uint32_t, int>{0x0103, 6}, {0x0112, orientation}}) {
    number(tag, 2);
    number(3, 2);
    number(1, 4);
    number(static_cast<std::uint32_t>(value), 2);
    number(0, 2);
  }
  number(0, 4);
  const std::size_t length = tiff.size() + 8;
  Bytes out = {0xFF, 0xE1, static_cast<std::uint8_t>(length >> 8U),
               static_cast<std::uint8_t>(length & 0xFFU)};
  put(out, std::string("Exif\0\0", 6));
  out.insert(out.end(), tiff.begin(), tiff.end());
  return out;
}

std::string error_of(const std::function<void()>& read) {
  try {
    read();
  } catch (const Error& error) {
    CHECK(error.kind() == raytracer::ErrorKind::kScene);
    return error.what();
  }
  return "no error";
}

std::string error_of_file(const std::string& name, const Bytes& bytes) {
  const TemporaryFolder folder;
  raytracer::write_file(folder / name, bytes);
  return error_of([&] { read_picture(folder / name); });
}

using raytracer::Image;

Image slope(int width, int height) {
  Image image(width, height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) image.set(x, y, raytracer::Color3f(255 * x, -255 * y, 1));
  }
  return image;
}

}  // namespace

TEST_CASE("PNG of every kind is read") {
  for (const bool is_interlaced : {false, true}) {
    for (const bool has_transparent : {false, true}) {
      for (const int bits : {1, 2, 4, 8, 16})
        check_png({PNG_COLOR_TYPE_GRAY, bits, is_interlaced, has_transparent});
      for (const int bits : {8, 16}) check_png({PNG_COLOR_TYPE_RGB, bits, is_interlaced, has_transparent});
      for (const int bits : {1, 2, 4, 8})
        check_png({PNG_COLOR_TYPE_PALETTE, bits, is_interlaced, has_transparent});
    }
    for (const int bits : {8, 16}) {
      check_png({PNG_COLOR_TYPE_GRAY_ALPHA, bits, is_interlaced});
      check_png({PNG_COLOR_TYPE_RGB_ALPHA, bits, is_interlaced});
    }
  }
}

TEST_CASE("a PNG's curve is sRGB unless its gamma alone says otherwise") {
  const auto read = [](double gamma, bool has_srgb) {
    PngKind kind;
    kind.gamma = gamma;
    kind.has_srgb = has_srgb;
    return raytracer::read_png(png_of(kind, 2, 2));
  };
  CHECK(read(0, false).curve == PictureCurve::kSrgb);
  CHECK(read(0.45455, false).curve == PictureCurve::kSrgb);
  CHECK(read(0, true).curve == PictureCurve::kSrgb);
  CHECK(read(1, false).curve == PictureCurve::kLinear);
  const Picture other = read(0.5, false);
  CHECK(other.curve == PictureCurve::kPower);
  CHECK(other.exponent == Approx(2));
  const float value = stored(other, 1, 1, 0);
  CHECK(raytracer::to_floats(other)[9] == Approx(value * value));
}

TEST_CASE("JPEG is read in grey, colours and inks, and progressive") {
  for (const int channels : {1, 3, 4}) {
    for (const int height : {15, 16}) {
      CAPTURE(channels, height);
      // Slow enough for the format's rounding; inks without black.
      const auto value = [&](int x, int y, int c) { return c == 3 ? 255 : 40 + 6 * x + 3 * y + 20 * c; };
      const Picture picture = raytracer::read_jpeg(jpeg_of(21, height, channels, value));
      REQUIRE(picture.width == 21);
      REQUIRE(picture.height == height);
      REQUIRE(picture.channels == std::min(channels, 3));
      float worst = 0;
      for (int y = 0; y < height; ++y) {
        for (int x = 0; x < 21; ++x) {
          for (int c = 0; c < picture.channels; ++c) {
            worst = std::max(worst,
                             std::abs(255 * stored(picture, x, y, c) - static_cast<float>(value(x, y, c))));
          }
        }
      }
      CHECK(worst < 8);
    }
  }
}

TEST_CASE("Radiance HDR is read as flat pixels, as old runs and as new runs") {
  const Picture flat = raytracer::read_radiance(radiance_of("-Y 1 +X 2", {128, 64, 32, 129, 0, 0, 0, 0}));
  REQUIRE(flat.width == 2);
  REQUIRE(flat.type == TexelType::kRgbe);
  CHECK(raytracer::to_floats(flat) == std::vector<float>{1, 0.5f, 0.25f, 0, 0, 0});

  // One pixel, then 3 more of it, and another row of it once and then 256 + 2 times.
  Bytes old_runs = {128, 64, 32, 129, 1, 1, 1, 3};
  const Picture runs = raytracer::read_radiance(radiance_of("-Y 1 +X 4", old_runs));
  CHECK(raytracer::to_floats(runs)[9] == 1);
  old_runs = {128, 64, 32, 129, 1, 1, 1, 2, 1, 1, 1, 1};
  CHECK(raytracer::to_floats(raytracer::read_radiance(radiance_of("-Y 1 +X 259", old_runs)))[258 * 3] == 1);

  // Eight pixels, component by component: a run, literals, both, a run.
  const Bytes new_runs = {2, 2, 0, 8, 136, 128, 8, 1, 2, 3, 4, 5, 6, 7, 8, 132, 0, 4, 9, 9, 9, 64, 136, 129};
  const Picture newer = raytracer::read_radiance(radiance_of("-Y 1 +X 8", new_runs));
  CHECK(stored(newer, 7, 0, 0) == 1);
  CHECK(stored(newer, 7, 0, 1) == 8 / 128.0f);
  CHECK(stored(newer, 7, 0, 2) == 0.5f);
  CHECK(stored(newer, 3, 0, 2) == 0);
}

TEST_CASE("Radiance HDR is read from every side") {
  // Six pixels whose red is 1, 2 … 6 in the order of the file, two scanlines of three.
  Bytes pixels;
  for (int i = 1; i <= 6; ++i) {
    for (const int byte : {i, 0, 0, 136}) pixels.push_back(static_cast<std::uint8_t>(byte));
  }
  const auto reds = [&](const std::string& line) {
    const Picture picture = raytracer::read_radiance(radiance_of(line, pixels));
    std::string result = std::to_string(picture.width) + ":";
    for (int y = 0; y < picture.height; ++y) {
      for (int x = 0; x < picture.width; ++x)
        result += std::to_string(static_cast<int>(stored(picture, x, y, 0)));
    }
    return result;
  };
  CHECK(reds("-Y 2 +X 3") == "3:123456");
  CHECK(reds("-Y 2 -X 3") == "3:321654");
  CHECK(reds("+Y 2 +X 3") == "3:456123");
  CHECK(reds("+Y 2 -X 3") == "3:654321");
  CHECK(reds("+X 2 -Y 3") == "2:142536");
  CHECK(reds("-X 2 -Y 3") == "2:415263");
  CHECK(reds("+X 2 +Y 3") == "2:362514");
  CHECK(reds("-X 2 +Y 3") == "2:635241");
}

TEST_CASE("what Radiance HDR's pixels were multiplied with is undone") {
  const Bytes pixel = {128, 64, 32, 129};
  const auto read = [&](const std::string& more) {
    return raytracer::to_floats(raytracer::read_radiance(radiance_of("-Y 1 +X 1", pixel, more)));
  };
  CHECK(read("PIXASPECT=2\nVIEW=-vtv -vh 45\n") == std::vector<float>{1, 0.5f, 0.25f});
  CHECK(read("EXPOSURE=4\n") == std::vector<float>{0.25f, 0.125f, 0.0625f});
  CHECK(read("EXPOSURE= 4.0e0\nEXPOSURE=0.5\n") == std::vector<float>{0.5f, 0.25f, 0.125f});
  CHECK(read("COLORCORR=0.5 1 2\nEXPOSURE=2\n") == std::vector<float>{1, 0.25f, 0.0625f});
  for (const char* wrong : {"EXPOSURE=0\n", "EXPOSURE=\n", "EXPOSURE=-1\n", "EXPOSURE=nan\n",
                            "EXPOSURE=1e-40\n", "EXPOSURE=inf\n", "COLORCORR=1 1\n"}) {
    const std::string name(wrong, std::string(wrong).find('='));
    const std::string told = error_of([&] { read(wrong); });
    INFO(told);
    CHECK(told.find("'" + name) != std::string::npos);
  }
}

TEST_CASE("a photograph stands upright however the camera was held") {
  // Flat fields, which the format keeps: the picture upright is 16 x 8, bright to the right, less so upwards.
  const auto upright = [](int x, int y) { return (x < 8 ? 40 : 160) + (y < 4 ? 60 : 0); };
  // Of each orientation the stored place of the picture's (x, y), as in the tables of the standard.
  using Place = std::array<int, 2>;
  const std::function<Place(int, int)> picture_at[] = {
      [](int c, int r) { return Place{c, r}; },          [](int c, int r) { return Place{15 - c, r}; },
      [](int c, int r) { return Place{15 - c, 7 - r}; }, [](int c, int r) { return Place{c, 7 - r}; },
      [](int c, int r) { return Place{r, c}; },          [](int c, int r) { return Place{15 - r, c}; },
      [](int c, int r) { return Place{15 - r, 7 - c}; }, [](int c, int r) { return Place{r, 7 - c}; },
  };
  for (const bool is_big_endian : {false, true}) {
    for (int orientation = 1; orientation <= 8; ++orientation) {
      CAPTURE(orientation, is_big_endian);
      const bool is_sideways = orientation > 4;
      Bytes file = jpeg_of(is_sideways ? 8 : 16, is_sideways ? 16 : 8, 1, [&](int column, int row, int) {
        const Place place = picture_at[orientation - 1](column, row);
        return upright(place[0], place[1]);
      });
      const Bytes exif = exif_of(orientation, is_big_endian);
      file.insert(file.begin() + 2, exif.begin(), exif.end());
      const Picture picture = raytracer::read_jpeg(file);
      REQUIRE(picture.width == 16);
      REQUIRE(picture.height == 8);
      float worst = 0;
      for (int y = 0; y < 8; ++y) {
        for (int x = 0; x < 16; ++x) {
          worst =
              std::max(worst, std::abs(255 * stored(picture, x, y, 0) - static_cast<float>(upright(x, y))));
        }
      }
      CHECK(worst < 8);
    }
  }
}

TEST_CASE("an orientation that makes no sense is none") {
  const auto size_with = [](const Bytes& exif) {
    Bytes file = jpeg_of(16, 8, 1, [](int, int, int) { return 100; });
    file.insert(file.begin() + 2, exif.begin(), exif.end());
    const Picture picture = raytracer::read_jpeg(file);
    return picture.width;
  };
  CHECK(size_with(exif_of(6, false)) == 8);
  CHECK(size_with(exif_of(0, false)) == 16);
  CHECK(size_with(exif_of(9, true)) == 16);
  const Bytes sound = exif_of(6, false);
  for (std::size_t end = 4; end < sound.size(); ++end) {
    Bytes cut(sound.begin(), sound.begin() + static_cast<std::ptrdiff_t>(end));
    cut[2] = 0;
    cut[3] = static_cast<std::uint8_t>(end - 2);
    const int width = size_with(cut);
    CHECK((width == 16 || width == 8));
  }
  for (std::size_t at = 4; at < sound.size(); ++at) {
    Bytes changed = sound;
    changed[at] = 255;
    const int width = size_with(changed);
    CHECK((width == 16 || width == 8));
  }
}

TEST_CASE("an EXR that was written is read back") {
  const TemporaryFolder folder;
  raytracer::write_file(folder / "a.exr", raytracer::encode_exr(slope(70, 600)));
  const Picture picture = read_picture(folder / "a.exr");
  REQUIRE(picture.width == 70);
  REQUIRE(picture.height == 600);
  REQUIRE(picture.channels == 3);
  CHECK(picture.type == TexelType::kFloat);
  CHECK(picture.curve == PictureCurve::kLinear);
  CHECK(stored(picture, 69, 599, 0) == 69);
  CHECK(stored(picture, 69, 599, 1) == -599);
  CHECK(stored(picture, 3, 256, 1) == -256);
  CHECK(stored(picture, 3, 4, 2) == 1 / 255.0f);
}

TEST_CASE("files are told apart by what is in them, and a name that says otherwise is told") {
  const Bytes png = png_of({}, 3, 3), jpeg = jpeg_of(8, 8, 3, [](int x, int, int) { return x; });
  CHECK(error_of_file("a.png", png) == "no error");
  CHECK(error_of_file("a.PNG", png) == "no error");
  CHECK(error_of_file("without-ending", png) == "no error");
  CHECK(error_of_file("a.data", jpeg) == "no error");
  CHECK(error_of_file("a.png", jpeg) == "it is a JPEG, although its name ends in .png");
  CHECK(error_of_file("a.b.Exr", png) == "it is a PNG, although its name ends in .Exr");
  CHECK(error_of_file("a.png", {}) == "it is empty");
  Bytes text;
  put(text, "camera { at 0 0 0 }");
  CHECK(error_of_file("a.hdr", text) == "it is not a Radiance HDR: it does not begin as one does");
  CHECK(error_of_file("a.txt", text) ==
        "it is not a picture of a known kind; PNG, JPEG, Radiance HDR and EXR can be read");
  Bytes gif;
  put(gif, "GIF89a, and so on");
  CHECK(error_of_file("a.gif", gif) == "it is a GIF; PNG, JPEG, Radiance HDR and EXR can be read");
}

TEST_CASE("what is not there, a folder and a pipe are refused at once") {
  const TemporaryFolder folder;
  const std::string missing = folder / "none.png";
  CHECK(error_of([&] { read_picture(missing); }) == "it can't be read: No such file or directory");
  CHECK(error_of([&] { read_picture(folder.path()); }) == "it can't be read: it is a folder");
  CHECK(error_of([] { read_picture("/dev/zero"); }) == "it can't be read: it is a device or a pipe");
}

TEST_CASE("what little files declare takes no memory") {
  Bytes png = png_of({}, 2, 2);
  const auto declare = [](Bytes file, std::size_t at, std::uint32_t width, std::uint32_t height) {
    png_save_uint_32(file.data() + at, width);
    png_save_uint_32(file.data() + at + 4, height);
    const auto crc = [&] {
      std::uint32_t value = 0xFFFFFFFF;
      for (std::size_t i = 12; i < 29; ++i) {
        value ^= file[i];
        for (int bit = 0; bit < 8; ++bit) value = value >> 1 ^ ((value & 1) != 0 ? 0xEDB88320U : 0);
      }
      return ~value;
    };
    png_save_uint_32(file.data() + 29, crc());
    return file;
  };
  CHECK(error_of([&] { raytracer::read_png(declare(png, 16, 1000000, 1000000)); }) ==
        "it has 1000000 x 1000000 pixels; at most 268 million can be read");
  CHECK(error_of([&] {
          raytracer::read_png(declare(png, 16, 16000, 16000));
        }).starts_with("it says that it has pixels for 732 MiB, which can't be in a file of "));
  CHECK(error_of([] {
          raytracer::read_radiance(radiance_of("-Y 40000 +X 40000", {1, 2, 3, 4}));
        }) == "it has 40000 x 40000 pixels; at most 268 million can be read");
  CHECK(error_of([] { raytracer::read_radiance(radiance_of("-Y 9999999999 +X 4", {})); }) ==
        "the Radiance HDR is broken: the line with its size is not one");
}

namespace {

std::vector<Bytes> good_files() {
  std::vector<Bytes> files = {png_of({}, 9, 7),
                              png_of({PNG_COLOR_TYPE_PALETTE, 4, true, true}, 9, 7),
                              png_of({PNG_COLOR_TYPE_RGB_ALPHA, 16}, 5, 4),
                              jpeg_of(17, 9, 3, [](int x, int y, int) { return 9 * x + y; }),
                              jpeg_of(17, 10, 3, [](int x, int y, int) { return 9 * x + y; }),
                              jpeg_of(9, 9, 4, [](int x, int y, int) { return 9 * x + y; }),
                              raytracer::encode_exr(slope(9, 40))};
  Bytes pixels;
  for (int i = 0; i < 60; ++i) pixels.push_back(static_cast<std::uint8_t>(i));
  files.push_back(radiance_of("-Y 3 +X 5", pixels));
  files.push_back(radiance_of("-Y 1 +X 8", {2, 2, 0, 8, 136, 128, 136, 1, 136, 2, 136, 129}));
  files.push_back(radiance_of("-Y 1 +X 4", {128, 64, 32, 129, 1, 1, 1, 3}));
  return files;
}

/// As read_picture chooses.
Picture read_bytes(const Bytes& bytes) {
  if (bytes[0] == 0x89) return raytracer::read_png(bytes);
  if (bytes[0] == 0xFF) return raytracer::read_jpeg(bytes);
  if (bytes[0] == '#') return raytracer::read_radiance(bytes);
  return raytracer::read_exr(bytes);
}

}  // namespace

TEST_CASE("a file that ends too early is refused, wherever it does") {
  for (const Bytes& file : good_files()) {
    CAPTURE(file.size(), file[0]);
    CHECK(error_of([&] { read_bytes(file); }) == "no error");
    const std::size_t step = file.size() / 300 + 1;
    int accepted = 0;
    for (std::size_t size = 4; size + 2 < file.size(); size += step) {
      const std::string error = error_of(
          [&] { read_bytes(Bytes(file.begin(), file.begin() + static_cast<std::ptrdiff_t>(size))); });
      accepted += error == "no error" ? 1 : 0;
    }
    CHECK(accepted == 0);
  }
}

TEST_CASE("files with bytes changed are a picture or an error") {
  std::uint32_t random = 1;
  const auto next = [&] { return random = random * 1664525 + 1013904223; };
  for (const Bytes& file : good_files()) {
    for (int turn = 0; turn < 100; ++turn) {
      Bytes changed = file;
      for (int i = 0; i < 1 + turn % 4; ++i)
        changed[4 + (next() >> 8) % (changed.size() - 4)] = static_cast<std::uint8_t>(next() >> 16);
      error_of([&] { read_bytes(changed); });
    }
  }
  SUCCEED();
}

TEST_CASE("pictures from elsewhere are read, or refused, as their names say") {
  const std::filesystem::path folder = std::string(TEST_DATA) + "/../../../shared/corpora";
  if (!std::filesystem::exists(folder)) return;
  int good = 0, bad = 0;
  for (const auto* kind : {"png", "jpeg", "hdr", "exr"}) {
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder / kind)) {
      const std::string ending = entry.path().extension().string(), name = entry.path().filename().string();
      if (ending != ".png" && ending != ".jpg" && ending != ".hdr" && ending != ".exr") continue;
      const std::string error = error_of([&] { read_picture(entry.path().string()); });
      const bool is_good = error == "no error";
      (is_good ? good : bad) += 1;
      INFO(entry.path() << ": " << error);
      if (ending == ".png" && name[0] == 'x') CHECK(!is_good);
      const bool is_suite = entry.path().string().find("suite/contrib/pngsuite") != std::string::npos;
      if (is_suite && name[0] != 'x') CHECK(is_good);
    }
  }
  CHECK(good > 500);
  CHECK(bad > 50);
}
