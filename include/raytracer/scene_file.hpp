// From text to a scene. The language is described in docs/scene-language.md.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "raytracer/render.hpp"

namespace raytracer {

enum class Severity : std::uint8_t { kError, kWarning };

/// One mistake, or one thing worth knowing, and its place. Lines and columns count from 1, columns in
/// characters; line 0 means the scene as a whole.
struct Diagnostic {
  Severity severity = Severity::kError;
  std::string file;
  std::uint32_t line = 0, column = 0;
  std::uint32_t end_line = 0, end_column = 0;  ///< just behind the last character
  std::string message;                         ///< what was found
  std::string suggestion;                      ///< what would be right; may be empty
  std::string source_line;          ///< the text of `line`; of a very long one the part around `column`
  std::uint32_t source_column = 1;  ///< where in the line source_line begins
  std::vector<Diagnostic> notes;    ///< other places that belong to it
};

/// The message as a compiler prints it: place, line, underline, suggestion; ends with a line feed.
std::string to_text(const Diagnostic& diagnostic);

/// The same as one JSON object.
std::string to_json(const Diagnostic& diagnostic);

/// How much a scene may ask for. Past a limit it is refused with an error at the place that asked.
struct Limits {
  std::uint64_t include_depth = 32;     ///< files that include each other
  std::uint64_t nesting = 256;          ///< uses of definitions inside each other
  std::uint64_t shapes = 50'000'000;    ///< shapes made, instances counted once
  std::uint64_t steps = 1'000'000'000;  ///< steps of evaluation
};

/// A top-level `let` of the scene that the caller replaces: `--set name=value`.
struct Setting {
  std::string name;
  std::string
      value;  ///< as it would be written: 12, #ff8800, tomato, (1, 2, 3) or 1,2,3, or text for a string
};

/// A top-level `let`, as `raytracer params` lists it.
struct Parameter {
  std::string name;
  std::string value;  ///< as it would be written
};

/// What the caller decides over the head of the scene file.
struct LoadOptions {
  std::vector<std::string> allowed_folders;  ///< besides the scene's own
  std::optional<int> width, height;
  std::optional<int> samples;
  std::optional<int> bounces;
  std::optional<Method> method;
  std::optional<std::uint32_t> seed;
  std::string camera;  ///< the name of the camera to use; empty: the first
  std::vector<Setting> settings;
  Limits limits;
};

/// `animation { duration fps }`
struct Animation {
  double duration = 0;  ///< seconds; 0: the scene is a still
  double fps = 24;

  /// How many frames there are; frame n, from 1, shows the time (n - 1) / fps.
  int frames() const;
};

/// Says all that a picture's pixels follow from: the evaluated scene and how it is rendered. What another
/// version of the library makes of it may differ.
using SceneHash = std::array<std::uint64_t, 2>;

/// What is known of a moment before it is rendered.
struct SceneMoment {
  RenderSettings settings;
  SceneHash hash{};
};

/// A scene file, read and checked.
struct LoadedScene {
  std::vector<Diagnostic> diagnostics;
  std::vector<std::string> files_read;  ///< as canonical paths
  /// What it may read besides at other times, whether it is there or not: every file that its texts name in
  /// quotes, evaluated or not, and those that these name. Empty unless ok().
  std::function<std::vector<std::string>()> files_named;
  RenderSettings settings;  ///< at the time 0
  SceneAt scene_at;  ///< empty unless ok(); throws Error (kScene) where the scene is wrong at that time alone
  /// As scene_at; a scene_at for the same time right afterwards does not evaluate it once more.
  std::function<SceneMoment(double time)> moment_at;
  /// One moment as a scene in JSON, which makes the same picture. Throws Error (kScene) as scene_at does, and
  /// where a camera's shutter stays open for more than a moment. Names of files are relative to `folder`, or
  /// to the scene's own where it is empty.
  std::function<std::string(double time, const std::string& folder)> json_at;
  Animation animation;
  bool depends_on_time = false;
  std::vector<Parameter> parameters;
  std::uint64_t shapes = 0;         ///< how many were built
  std::uint64_t picture_bytes = 0;  ///< the memory that the pictures of textures and skies take

  bool ok() const { return static_cast<bool>(scene_at); }
};

/// Reads the scene in the file `path`. Mistakes in the scene come back as diagnostics; throws Error (kFile)
/// when the file itself can't be read.
LoadedScene load_scene_file(const std::string& path, const LoadOptions& options = {});

/// Reads a scene from memory; `name` stands in its messages, its includes are relative to the current folder.
LoadedScene load_scene_text(std::string text, const std::string& name, const LoadOptions& options = {});

}  // namespace raytracer
