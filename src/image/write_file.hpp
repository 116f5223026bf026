// What the program needs of writing beyond the public write_file.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace raytracer {

/// Writes all the bytes to an open file, pipe or terminal. `name` is what an error calls it.
void write_all(int descriptor, const std::vector<std::uint8_t>& bytes, const std::string& name);

/// A file that another program fills, beside its place until finish(). Deleted unless that is called. No
/// other file may be written meanwhile: a signal handler knows of one.
class FileInProgress {
 public:
  /// `path`: its place in the end. Throws Error (kFile).
  explicit FileInProgress(const std::string& path);
  ~FileInProgress();

  /// Where it is now, empty.
  std::string path() const;
  /// Flushes it to the disk and renames it. Throws Error (kFile).
  void finish();

 private:
  class Place;
  std::unique_ptr<Place> place_;
};

/// Deletes the file that write_file or FileInProgress has begun beside its place, if there is one. For signal
/// handlers that end the program: async-signal-safe, and leaves errno alone.
void remove_unfinished_file() noexcept;

}  // namespace raytracer
