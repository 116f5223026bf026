// From text to a scene. The language is described in docs/scene-language.md.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "raytracer/render.hpp"

namespace raytracer {

enum class Severity : std::uint8_t { kError, kWarning };

/// One mistake, or one thing worth knowing, and its place. Lines and columns count from 1, columns in characters;
/// line 0 means the scene as a whole.
struct Diagnostic {
  Severity severity = Severity::kError;
  std::string file;
  std::uint32_t line = 0, column = 0;
  std::uint32_t end_line = 0, end_column = 0;  ///< just behind the last character
  std::string message;                         ///< what was found
  std::string suggestion;                      ///< what would be right; may be empty
  std::string source_line;                     ///< the text of `line`
  std::vector<Diagnostic> notes;               ///< other places that belong to it
};

/// The message as a compiler prints it: place, line, underline, suggestion; ends with a line feed.
std::string to_text(const Diagnostic& diagnostic);

/// The same as one JSON object.
std::string to_json(const Diagnostic& diagnostic);

/// What the caller decides over the head of the scene file.
struct LoadOptions {
  std::vector<std::string> allowed_folders;  ///< besides the scene's own
  std::optional<int> width, height;
  std::optional<int> samples;
  std::optional<int> bounces;
  std::string camera;  ///< the name of the camera to use; empty: the first
};

/// A scene file, read and checked.
struct LoadedScene {
  std::vector<Diagnostic> diagnostics;
  std::vector<std::string> files_read;  ///< as canonical paths
  RenderSettings settings;
  SceneAt scene_at;          ///< empty unless ok()
  std::uint64_t shapes = 0;  ///< how many were built

  bool ok() const { return static_cast<bool>(scene_at); }
};

/// Reads the scene in the file `path`. Mistakes in the scene come back as diagnostics; throws Error (kFile) when the
/// file itself can't be read.
LoadedScene load_scene_file(const std::string& path, const LoadOptions& options = {});

/// Reads a scene from memory; `name` stands in its messages, its includes are relative to the current folder.
LoadedScene load_scene_text(std::string text, const std::string& name, const LoadOptions& options = {});

}  // namespace raytracer
