// Collects what is to be told about a scene, until it is told.
#pragma once

#include <string>
#include <vector>

#include "raytracer/scene_file.hpp"
#include "scene_file/source.hpp"

namespace raytracer::scene_file {

/// A second place that belongs to a message: "first given here".
struct Note {
  Place place;
  std::string message;
};

/// The messages of one load. A scene can hold more mistakes than anybody reads: past kMostErrors they are only
/// counted.
class Diagnostics {
 public:
  static constexpr std::size_t kMostErrors = 100;

  void error(const Place& place, std::string message, std::string suggestion = {},
             const std::vector<Note>& notes = {});
  void warning(const Place& place, std::string message, std::string suggestion = {});
  /// About the scene as a whole.
  void warning(const std::string& file, std::string message, std::string suggestion = {});

  bool has_errors() const { return errors_ > 0; }
  std::size_t error_count() const { return errors_; }
  /// The messages from the top of the text to its end, and how many more there were; leaves the collector empty.
  std::vector<Diagnostic> take();

 private:
  std::vector<Diagnostic> messages_;
  std::size_t errors_ = 0;
};

}  // namespace raytracer::scene_file
