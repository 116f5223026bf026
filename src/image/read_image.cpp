#include "image/read_image.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <optional>
#include <string_view>

#include "core/mapped_file.hpp"
#include "image/readers.hpp"
#include "raytracer/error.hpp"

namespace raytracer {
namespace {

/// A kind of picture, by what its files begin with.
struct Kind {
  std::string_view name;   // with its article
  std::string_view begin;  // '.' stands for any byte; empty: nothing tells them
  Picture (*read)(ByteSpan);
  std::array<std::string_view, 4> endings = {};
};

using namespace std::string_view_literals;

constexpr std::array kKinds = {
    Kind{"a PNG", "\x89PNG\r\n\x1a\n"sv, read_png, {".png", ".apng"}},
    Kind{"a JPEG", "\xff\xd8\xff"sv, read_jpeg, {".jpg", ".jpeg", ".jpe", ".jfif"}},
    Kind{"a Radiance HDR", "#?"sv, read_radiance, {".hdr", ".rgbe", ".pic"}},
    Kind{"an EXR", "\x76\x2f\x31\x01"sv, read_exr, {".exr", ".sxr", ".mxr"}},
    Kind{"a GIF", "GIF8"sv, nullptr, {".gif"}},
    Kind{"a BMP", "BM....\0\0"sv, nullptr, {".bmp"}},
    Kind{"a TIFF", "II*\0"sv, nullptr, {".tif", ".tiff"}},
    Kind{"a TIFF", "MM\0*"sv, nullptr, {}},
    Kind{"a WebP", "RIFF....WEBP"sv, nullptr, {".webp"}},
    Kind{"an AVIF or HEIF", "....ftyp"sv, nullptr, {".avif", ".heic"}},
    Kind{"a JPEG 2000", "\0\0\0\x0cjP  "sv, nullptr, {".jp2"}},
    Kind{"a JPEG XL", "\xff\x0a"sv, nullptr, {".jxl"}},
    Kind{"a DDS", "DDS "sv, nullptr, {".dds"}},
    Kind{"a KTX", "\xabKTX "sv, nullptr, {".ktx", ".ktx2"}},
    Kind{"a Photoshop file", "8BPS"sv, nullptr, {".psd"}},
    Kind{"a PFM", "PF\n"sv, nullptr, {".pfm"}},
    Kind{"a PFM", "Pf\n"sv, nullptr, {}},
    Kind{"an SVG", "<svg"sv, nullptr, {".svg"}},
    Kind{"a Targa", ""sv, nullptr, {".tga"}},
};

bool begins_with(ByteSpan file, const Kind& kind) {
  if (kind.begin.empty() || file.size() < kind.begin.size()) return false;
  for (std::size_t i = 0; i < kind.begin.size(); ++i) {
    const char expected = kind.begin[i];
    if (expected != '.' && file[i] != static_cast<std::uint8_t>(expected)) return false;
  }
  return true;
}

bool ends_with(std::string name, const Kind& kind) {
  std::transform(name.begin(), name.end(), name.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return std::any_of(kind.endings.begin(), kind.endings.end(), [&](std::string_view ending) {
    return !ending.empty() && name.size() > ending.size() && name.ends_with(ending);
  });
}

const Kind* kind_of(ByteSpan file) {
  const auto* found =
      std::find_if(kKinds.begin(), kKinds.end(), [&](const Kind& kind) { return begins_with(file, kind); });
  return found == kKinds.end() ? nullptr : found;
}

const Kind* kind_named(const std::string& path) {
  const auto* found =
      std::find_if(kKinds.begin(), kKinds.end(), [&](const Kind& kind) { return ends_with(path, kind); });
  return found == kKinds.end() ? nullptr : found;
}

std::string ending_of(const std::string& path) { return path.substr(path.rfind('.')); }

Error unreadable(ByteSpan file, const Kind* content, const Kind* name) {
  if (file.empty()) return {ErrorKind::kScene, "it is empty"};
  if (content == nullptr && name != nullptr && name->read != nullptr) {
    return {ErrorKind::kScene, fmt::format("it is not {}: it does not begin as one does", name->name)};
  }
  const std::string what = content != nullptr ? fmt::format("it is {}", content->name)
                           : name != nullptr  ? fmt::format("it is called {}", name->name)
                                              : "it is not a picture of a known kind";
  return {ErrorKind::kScene, what + "; PNG, JPEG, Radiance HDR and EXR can be read"};
}

}  // namespace

void check_size(std::int64_t width, std::int64_t height) {
  const auto most = static_cast<std::int64_t>(kLargestTexels);
  if (width <= 0 || height <= 0) {
    throw Error(ErrorKind::kScene, fmt::format("it says that it has {} x {} pixels", width, height));
  }
  if (height > most / width) {
    throw Error(ErrorKind::kScene, fmt::format("it has {} x {} pixels; at most {} million can be read", width,
                                               height, most / 1000000));
  }
}

void check_plausible(std::size_t raw_bytes, std::size_t file_bytes) {
  constexpr std::size_t kBestRatio = 1032, kFree = std::size_t{1} << 24U;
  if (raw_bytes > kFree && raw_bytes / kBestRatio > file_bytes) {
    throw Error(ErrorKind::kScene,
                fmt::format("it says that it has pixels for {} MiB, which can't be in a file of "
                            "{} bytes",
                            raw_bytes >> 20U, file_bytes));
  }
}

Picture read_picture(const std::string& path) {
  const MappedFile mapped(path);
  const ByteSpan file(reinterpret_cast<const std::uint8_t*>(mapped.bytes().data()), mapped.bytes().size());
  const Kind* content = kind_of(file);
  const Kind* name = kind_named(path);
  if (content == nullptr || content->read == nullptr) throw unreadable(file, content, name);
  if (name != nullptr && name->name != content->name) {
    throw Error(ErrorKind::kScene,
                fmt::format("it is {}, although its name ends in {}", content->name, ending_of(path)));
  }
  return content->read(file);
}

}  // namespace raytracer
