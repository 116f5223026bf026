// What a run took: for the summary on the terminal and for --stats.
#pragma once

#include <chrono>
#include <cstdint>
#include <string>

namespace raytracer::cli {

/// Tells how long ago it was asked last.
class Stopwatch {
 public:
  /// Seconds since the last lap, or since the beginning.
  double lap();

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point last_ = Clock::now();
};

/// Seconds of a run's stages, and counts.
struct RunStatistics {
  double load = 0;    ///< reading and checking the scene
  double build = 0;   ///< shapes and the tree over them
  double render = 0;  ///< tiles alone
  double encode = 0;  ///< the picture's file in memory
  double write = 0;
  std::uint64_t rays = 0, shapes = 0;
  std::uint64_t picture_bytes = 0;       ///< of textures and skies
  std::uint64_t pictures = 0, kept = 0;  ///< made, and of these found from an earlier run
  int width = 0, height = 0;             ///< of the picture rendered last

  double total() const { return load + build + render + encode + write; }
  double million_rays_per_second() const;
};

double peak_memory_in_megabytes();

/// One line for the person at the terminal.
std::string summary(const std::string& path, const RunStatistics& run);

/// One flat JSON object, ending in a line feed.
std::string to_json(const RunStatistics& run);

}  // namespace raytracer::cli
