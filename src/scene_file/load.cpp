// The three stages joined: text, nodes, scene.
#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <utility>

#include "raytracer/error.hpp"
#include "raytracer/scene_file.hpp"
#include "scene_file/builder.hpp"
#include "scene_file/files.hpp"
#include "scene_file/finish.hpp"

namespace raytracer {
namespace {

using scene_file::Builder;
using scene_file::Diagnostics;
using scene_file::Files;

// One scene for all times: built from its description when it is first asked for.
SceneAt scene_once(SceneDescription description) {
  struct Once {
    SceneDescription description;
    std::shared_ptr<const Scene> scene;
  };
  auto once = std::make_shared<Once>();
  once->description = std::move(description);
  return [once](double) {
    if (!once->scene) once->scene = std::make_shared<const Scene>(std::move(once->description));
    return once->scene;
  };
}

LoadedScene load(std::string text, const std::string& name, const std::string& path, const LoadOptions& options) {
  // The folder of a bare file name is the current one.
  const std::string folder = std::filesystem::path(path).parent_path().string();
  Files files(folder.empty() ? "." : folder, options.allowed_folders);
  Diagnostics diagnostics;
  LoadedScene loaded;
  Builder builder(files, diagnostics);
  builder.build(*files.add_main(name, path, std::move(text), diagnostics));
  loaded.files_read = files.read_paths();
  // No warning follows from an error.
  if (!diagnostics.has_errors()) {
    builder.warn_of_unused_materials();
    scene_file::SceneDraft& draft = builder.draft();
    loaded.settings = scene_file::finish(draft, options, name, diagnostics);
    loaded.shapes = draft.scene.shapes.size();
    loaded.scene_at = scene_once(std::move(draft.scene));
  }
  loaded.diagnostics = diagnostics.take();
  return loaded;
}

}  // namespace

LoadedScene load_scene_file(const std::string& path, const LoadOptions& options) {
  const bool is_standard_input = path == "-";
  return load(scene_file::read_text(path), is_standard_input ? "<standard input>" : path,
              is_standard_input ? std::string() : path, options);
}

LoadedScene load_scene_text(std::string text, const std::string& name, const LoadOptions& options) {
  return load(std::move(text), name, {}, options);
}

}  // namespace raytracer
