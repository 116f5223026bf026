// Files that no picture may take the place of.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <utility>

#include "raytracer/scene_file.hpp"

namespace raytracer::cli {

class KeptFiles {
 public:
  /// All that the scene reads, now and at other times.
  static KeptFiles of(const LoadedScene& scene);

  /// `what` the file is: "a file that the scene reads".
  void add(const std::string& path, std::string_view what);
  /// What the file is that would be written there, by whatever name or link; empty where it is none of these.
  /// Standard output and devices never are.
  std::string_view find(const std::string& path) const;

 private:
  std::map<std::string, std::string_view> paths_;
  std::map<std::pair<std::uint64_t, std::uint64_t>, std::string_view> inodes_;  // of those that are there
};

/// Everything that can be known to go wrong with a file's place. Throws Error.
void check_output(const std::string& path, const KeptFiles& kept);

}  // namespace raytracer::cli
