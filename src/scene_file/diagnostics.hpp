// Collects what is to be told about a scene, until it is told.
#pragma once

#include <set>
#include <string>
#include <tuple>
#include <vector>

#include "raytracer/scene_file.hpp"
#include "scene_file/source.hpp"

namespace raytracer::scene_file {

/// A second place that belongs to a message: "first given here".
struct Note {
  Place place;
  std::string message;
};

/// The messages of one load. A place has one error and one warning at most: a slip inside a loop or a
/// definition is one slip, however often it is run through. A scene can hold more mistakes than anybody
/// reads: past kMostErrors, and kMostWarnings, they are only counted.
class Diagnostics {
 public:
  static constexpr std::size_t kMostErrors = 100, kMostWarnings = 100;

  void error(const Place& place, std::string message, std::string suggestion = {},
             const std::vector<Note>& notes = {});
  void warning(const Place& place, std::string message, std::string suggestion = {});
  /// About the scene as a whole.
  void warning(const std::string& file, std::string message, std::string suggestion = {});

  /// While one lives, every error names the place that its text was used from: an include, a use of a
  /// definition.
  class UsedFrom {
   public:
    /// A place without a source is none.
    UsedFrom(Diagnostics& diagnostics, const Place& place) : diagnostics_(diagnostics) {
      diagnostics_.used_from_.push_back(place);
    }
    ~UsedFrom() { diagnostics_.used_from_.pop_back(); }
    UsedFrom(const UsedFrom&) = delete;
    UsedFrom& operator=(const UsedFrom&) = delete;

   private:
    Diagnostics& diagnostics_;
  };

  /// While muted, errors are dropped: what follows from a mistake that has been told is none.
  void mute(bool muted) { muted_ = muted; }

  /// Whether a further error would be told: where not, nobody needs to look for a suggestion.
  bool is_listening() const { return !muted_ && errors_ < kMostErrors; }
  bool has_errors() const { return errors_ > 0; }
  std::size_t error_count() const { return errors_; }
  /// Errors that were dropped because their place had one.
  std::size_t repeated() const { return repeated_; }
  /// The messages from the top of the text to its end, and how many more there were; leaves the collector
  /// empty.
  std::vector<Diagnostic> take();

 private:
  std::vector<Diagnostic> messages_;
  std::size_t errors_ = 0, warnings_ = 0, repeated_ = 0;
  bool muted_ = false;
  std::vector<Place> used_from_;
  using PlaceKey = std::tuple<const Source*, std::uint32_t, std::uint32_t>;
  std::set<PlaceKey> error_places_, warning_places_;
};

}  // namespace raytracer::scene_file
