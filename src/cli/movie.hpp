// Films: frames go through a pipe to ffmpeg.
#pragma once

#include <sys/types.h>

#include <string>
#include <string_view>
#include <vector>

#include "cli/frame_sink.hpp"
#include "image/write_file.hpp"

namespace raytracer::cli {

struct FilmFormat;

/// Whether the name's ending is a film's.
bool is_film(const std::string& path);

/// Appears whole in the end, or not at all.
class Movie : public FrameSink {
 public:
  /// Throws Error (kFile) where ffmpeg is missing or nothing can be written there.
  Movie(const std::string& path, double fps, RunStatistics& run, Stopwatch& watch);
  ~Movie() override;
  Movie(const Movie&) = delete;
  Movie& operator=(const Movie&) = delete;

  void add(int frame, const std::string& key, const Image& image) override;
  void repeat(int frame) override;
  void finish() override;

 private:
  std::vector<std::string> command_line() const;
  void start();
  [[noreturn]] void fail(int status);
  void close_pipe();
  int wait_for_end();
  std::string last_words() const;

  std::string path_, program_;
  const FilmFormat& format_;
  double fps_;
  RunStatistics& run_;
  Stopwatch& watch_;
  FileInProgress file_;
  int width_ = 0, height_ = 0;       // of the pictures
  std::vector<std::uint8_t> bytes_;  // of the latest one, as ffmpeg gets them
  pid_t process_ = -1;
  int pipe_ = -1;      // its standard input
  int messages_ = -1;  // a file in memory
};

}  // namespace raytracer::cli
