// What of a scene is rendered, and where it goes.
#pragma once

#include <string>
#include <vector>

#include "cli/frame_sink.hpp"
#include "cli/kept_files.hpp"
#include "cli/options.hpp"

namespace raytracer::cli {

/// One picture to make.
struct Shot {
  double time = 0;  ///< seconds
  int frame = 0;    ///< 0 where it is a still
};

/// Where pictures go, as the command line has it.
struct Target {
  std::string path;          ///< "-" is standard output
  bool is_film = false;      ///< ffmpeg makes it
  bool is_numbered = false;  ///< the frame's number is in the name
  bool wants_frames = false;
};

/// Throws Error (kUsage) for whatever is wrong with it whatever the scene may be.
Target target_of(const Options& options);

/// At least one, in the order in which they are made. Throws Error (kUsage) where the scene doesn't have
/// them, or the target can't hold them.
std::vector<Shot> shots_of(const Target& target, const Options& options, const LoadedScene& scene);

/// Everything that can be known to go wrong with the places of the pictures. Throws Error.
void check_target(const Target& target, const std::vector<Shot>& shots, const KeptFiles& kept);
/// Likewise of --stats, which would be the last to write.
void check_statistics(const std::string& path, const Target& target, const std::vector<Shot>& shots,
                      KeptFiles kept);

/// Opens the target for so many pictures. Throws Error.
std::unique_ptr<FrameSink> open_target(const Target& target, std::size_t shots, double fps,
                                       RunStatistics& run, Stopwatch& watch);

}  // namespace raytracer::cli
