// Where rendered pictures go, one after the other.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "cli/statistics.hpp"
#include "image/apng.hpp"
#include "image/png_text.hpp"
#include "raytracer/image.hpp"

namespace raytracer::cli {

class FrameSink {
 public:
  virtual ~FrameSink() = default;

  /// Whether this frame is there from an earlier run; `key` says what it would show.
  virtual bool has(int /*frame*/, const std::string& /*key*/) const { return false; }
  virtual void add(int frame, const std::string& key, const Image& image) = 0;
  /// Whether pictures are wanted as they were rendered, before they are developed for a display.
  virtual bool wants_light() const { return false; }
  /// A frame like the one that was added last.
  virtual void repeat(int frame) = 0;
  virtual void finish() {}
};

/// A file's format by the ending of its name.
struct PictureFormat {
  std::string_view ending;
  std::vector<std::uint8_t> (*encode)(const std::vector<PngText>& texts, const Image& image);
  bool holds_light;  ///< floats, as they were rendered; else what a display shows
};
/// PNG where the name has no ending. Throws Error (kUsage) for another one.
const PictureFormat& format_of(const std::string& path);
bool is_png(const std::string& path);

/// A file per frame, or a single one; "-" is standard output.
class PictureFiles : public FrameSink {
 public:
  PictureFiles(std::string path, RunStatistics& run, Stopwatch& watch)
      : path_(std::move(path)), run_(run), watch_(watch) {}

  bool has(int frame, const std::string& key) const override;
  /// A key that is not empty is put into the file.
  void add(int frame, const std::string& key, const Image& image) override;
  void repeat(int frame) override;
  bool wants_light() const override;

 private:
  std::string path_;
  RunStatistics& run_;
  Stopwatch& watch_;
  std::vector<std::uint8_t> bytes_;  // of the latest one
};

/// One PNG that moves.
class MovingPng : public FrameSink {
 public:
  MovingPng(std::string path, double fps, RunStatistics& run, Stopwatch& watch)
      : path_(std::move(path)), apng_(fps), run_(run), watch_(watch) {}

  void add(int frame, const std::string& key, const Image& image) override;
  void repeat(int frame) override;
  void finish() override;

 private:
  std::string path_;
  Apng apng_;
  RunStatistics& run_;
  Stopwatch& watch_;
};

}  // namespace raytracer::cli
