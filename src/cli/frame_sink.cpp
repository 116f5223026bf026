#include "cli/frame_sink.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>

#include "cli/frames.hpp"
#include "image/write_file.hpp"
#include "raytracer/error.hpp"

namespace raytracer::cli {
namespace {

constexpr char kKeyword[] = "Scene-Hash";

constexpr PictureFormat kFormats[] = {
    {".png", encode_png_with, false},
    {".pfm", [](const std::vector<PngText>&, const Image& image) { return encode_pfm(image); }, true},
    {".exr", [](const std::vector<PngText>&, const Image& image) { return encode_exr(image); }, true},
};

void write_to(const std::string& path, const std::vector<std::uint8_t>& bytes) {
  if (path == "-") {
    write_all(STDOUT_FILENO, bytes, "standard output");
  } else {
    write_file(path, bytes);
  }
}

}  // namespace

const PictureFormat& format_of(const std::string& path) {
  std::string ending = std::filesystem::path(path).extension().string();
  std::ranges::transform(ending, ending.begin(),
                         [](char c) { return c >= 'A' && c <= 'Z' ? char(c + 32) : c; });
  if (ending.empty()) return kFormats[0];
  std::string known;
  for (const PictureFormat& format : kFormats) {
    if (format.ending == ending) return format;
    const bool is_last = &format == std::end(kFormats) - 1;
    known += fmt::format("{}{}", known.empty() ? "" : is_last ? " and " : ", ", format.ending);
  }
  throw Error(ErrorKind::kUsage,
              fmt::format("'{}': pictures are written as {}, films as .mp4, .webm and .gif", path, known));
}

bool is_png(const std::string& path) { return &format_of(path) == &kFormats[0]; }

bool PictureFiles::wants_light() const { return format_of(path_).holds_light; }

bool PictureFiles::has(int frame, const std::string& key) const {
  return read_png_text(with_frame_number(path_, frame), kKeyword) == key;
}

void PictureFiles::add(int frame, const std::string& key, const Image& image) {
  std::vector<PngText> texts;
  if (!key.empty()) texts.push_back({kKeyword, key});
  bytes_ = format_of(path_).encode(texts, image);
  run_.encode += watch_.lap();
  repeat(frame);
}

void PictureFiles::repeat(int frame) {
  write_to(with_frame_number(path_, frame), bytes_);
  run_.write += watch_.lap();
}

void MovingPng::add(int, const std::string&, const Image& image) {
  apng_.add(image);
  run_.encode += watch_.lap();
}

void MovingPng::repeat(int) { apng_.repeat(); }

void MovingPng::finish() {
  write_to(path_, apng_.finish());
  run_.write += watch_.lap();
}

}  // namespace raytracer::cli
