// The three stages joined: text, nodes, scene.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <optional>
#include <utility>

#include "core/hash.hpp"
#include "raytracer/error.hpp"
#include "raytracer/scene_file.hpp"
#include "scene_file/builder.hpp"
#include "scene_file/files.hpp"
#include "scene_file/finish.hpp"
#include "scene_file/method.hpp"
#include "scene_file/named_files.hpp"
#include "scene_file/settings.hpp"

namespace raytracer {
namespace {

using scene_file::Builder;
using scene_file::Diagnostics;
using scene_file::Files;
using scene_file::Moment;

// The method of an evaluated scene.
Method method_of(const LoadOptions& options, Builder& builder) {
  return options.method.value_or(builder.draft().render.method);
}

// What evaluating a scene once more, for another time, needs.
struct SceneText {
  LoadOptions options;
  std::string name;
  std::unique_ptr<Files> files;
  const scene_file::SyntaxTree* tree = nullptr;
  scene_file::KeptShapes kept;
  double fps = 24;
  Method method = Method::kClassic;  // as the latest evaluation had it
};

// The scene at the times that it is asked for; the first one has been evaluated already.
class ScenesOverTime {
 public:
  ScenesOverTime(std::shared_ptr<SceneText> text, SceneDescription first, bool depends_on_time)
      : text_(std::move(text)), depends_on_time_(depends_on_time) {
    latest_.description = std::move(first);
  }

  std::shared_ptr<const Scene> at(double time) {
    make_latest(time, false);
    if (latest_.description) {
      auto scene = std::make_shared<const Scene>(std::move(*latest_.description));
      latest_.description.reset();
      if (!depends_on_time_) only_scene_ = scene;
      return scene;
    }
    return only_scene_;
  }

  SceneMoment moment(double time) {
    make_latest(time, true);
    SceneMoment moment = *latest_.moment;
    if (moment.settings.shutter > 0) moment.hash = hash_of_slices(time, moment);
    return moment;
  }

  std::string json(double time, const std::string& folder) const {
    Diagnostics diagnostics;
    Builder builder(*text_->files, text_->options.limits, moment_of(time), text_->kept, diagnostics);
    scene_file::SceneRecorder recorder(folder);
    builder.record_into(recorder);
    build(builder, time, diagnostics);  // the same text for any method
    for (const scene_file::CameraDraft& camera : builder.draft().cameras) {
      if (camera.shutter == 0) continue;
      diagnostics.error(camera.place, "with an open shutter a picture shows more than one moment",
                        "shutter 0");
      throw Error(ErrorKind::kScene,
                  fmt::format("the scene can't be written as JSON\n{}", all_messages(diagnostics)));
    }
    return recorder.text();
  }

 private:
  struct Evaluated {
    double time = 0;
    std::optional<SceneDescription> description;  // until a scene is made of it
    std::optional<SceneMoment> moment;            // where it was asked for
  };

  // Evaluates the scene unless the latest evaluation will do.
  void make_latest(double time, bool with_moment) {
    const bool is_same = !depends_on_time_ || time == latest_.time;
    const bool has_scene = latest_.description || only_scene_;
    if (is_same && (with_moment ? latest_.moment.has_value() : has_scene)) return;
    latest_ = {};
    latest_ = evaluate(time, with_moment);
  }

  // A picture with an open shutter shows the moments of all its slices.
  SceneHash hash_of_slices(double time, const SceneMoment& moment) const {
    Hasher all;
    for (const std::uint64_t word : moment.hash) all.add(word);
    for (int i = 0; i < moment.settings.slices(); ++i) {
      const Evaluated slice = evaluate(moment.settings.slice_time(time, i), true);
      for (const std::uint64_t word : slice.moment->hash) all.add(word);
    }
    return all.value();
  }

  Moment moment_of(double time) const {
    return {time, static_cast<int>(std::floor(time * text_->fps + 1e-6)) + 1};
  }

  static std::string all_messages(Diagnostics& diagnostics) {
    std::string all;
    for (const Diagnostic& diagnostic : diagnostics.take()) all += to_text(diagnostic) + '\n';
    return all;
  }

  void build(Builder& builder, double time, Diagnostics& diagnostics) const {
    scene_file::apply_settings(text_->options.settings, *text_->files, builder);
    builder.build(*text_->tree);
    require_no_errors(time, diagnostics);
  }

  static void require_no_errors(double time, Diagnostics& diagnostics) {
    if (!diagnostics.has_errors()) return;
    throw Error(ErrorKind::kScene,
                fmt::format("the scene is wrong at t = {}:\n{}", time, all_messages(diagnostics)));
  }

  Evaluated evaluate(double time, bool with_moment) const {
    Diagnostics diagnostics;
    Builder builder(*text_->files, text_->options.limits, moment_of(time), text_->kept, diagnostics);
    builder.set_method(text_->method);
    scene_file::SceneHasher hasher;
    if (with_moment) builder.hash_into(hasher);
    build(builder, time, diagnostics);
    const Method method = method_of(text_->options, builder);
    if (method != text_->method) {  // an `if` has chosen another one: the colours mean something else
      text_->method = method;
      text_->kept = {};
      return evaluate(time, with_moment);
    }
    builder.store_shapes();
    Evaluated evaluated;
    evaluated.time = time;
    const RenderSettings settings =
        scene_file::finish(builder.draft(), text_->options, text_->name, depends_on_time_, diagnostics);
    require_no_errors(time, diagnostics);
    if (with_moment) evaluated.moment = {settings, hasher.finish(settings, text_->options.camera)};
    evaluated.description = std::move(builder.draft().scene);
    return evaluated;
  }

  std::shared_ptr<SceneText> text_;
  bool depends_on_time_;
  Evaluated latest_;
  std::shared_ptr<const Scene> only_scene_;  // of a scene that does not depend on time
};

// Evaluates the scene for the time 0. Display colours depend on the method, and where it isn't what the text
// looked like (another file says so, or an `if`), once more.
std::unique_ptr<Builder> build_first(SceneText& scene_text, const Limits& limits, Diagnostics& diagnostics) {
  scene_text.method = scene_text.options.method.value_or(scene_file::method_in(*scene_text.tree));
  for (;;) {
    auto builder =
        std::make_unique<Builder>(*scene_text.files, limits, Moment{}, scene_text.kept, diagnostics);
    builder->set_method(scene_text.method);
    scene_file::apply_settings(scene_text.options.settings, *scene_text.files, *builder);
    builder->build(*scene_text.tree);
    const Method method = method_of(scene_text.options, *builder);
    if (diagnostics.has_errors() || method == scene_text.method) return builder;
    scene_text.method = method;
    scene_text.kept = {};
    diagnostics = Diagnostics();  // the warnings come again
  }
}

LoadedScene load(std::string text, const std::string& name, const std::string& path,
                 const LoadOptions& options) {
  // The folder of a bare file name is the current one.
  const std::string folder = std::filesystem::path(path).parent_path().string();
  const auto scene_text = std::make_shared<SceneText>();
  scene_text->options = options;
  scene_text->name = name;
  scene_text->files = std::make_unique<Files>(folder.empty() ? "." : folder, options.allowed_folders);
  Files& files = *scene_text->files;
  Diagnostics diagnostics;
  LoadedScene loaded;
  scene_text->tree = files.add_main(name, path, std::move(text), diagnostics);
  Limits limits = options.limits;
  // A text that could not be read whole is run for the mistakes in what could; its loops may lack their ends.
  constexpr std::uint64_t kStepsOfBadText = 1'000'000;
  if (diagnostics.has_errors()) limits.steps = std::min(limits.steps, kStepsOfBadText);
  const std::unique_ptr<Builder> built = build_first(*scene_text, limits, diagnostics);
  Builder& builder = *built;
  loaded.files_read = files.read_paths();
  // No warning follows from an error.
  if (!diagnostics.has_errors()) {
    scene_file::check_settings(options.settings, builder);
    builder.warn_of_unused_names(*scene_text->tree);
    builder.store_shapes();
    scene_file::SceneDraft& draft = builder.draft();
    loaded.depends_on_time = builder.evaluator().uses_time();
    loaded.settings = scene_file::finish(draft, options, name, loaded.depends_on_time, diagnostics);
  }
  if (!diagnostics.has_errors()) {
    scene_file::SceneDraft& draft = builder.draft();
    loaded.shapes = builder.shapes_made();
    loaded.picture_bytes = files.pictures().bytes();
    loaded.animation = {draft.duration, draft.fps};
    scene_text->fps = draft.fps;
    for (const Builder::TopLevelLet& let : builder.top_level_lets()) {
      loaded.parameters.push_back({let.name, scene_file::to_source(let.value)});
    }
    const auto scenes =
        std::make_shared<ScenesOverTime>(scene_text, std::move(draft.scene), loaded.depends_on_time);
    loaded.scene_at = [scenes](double time) { return scenes->at(time); };
    loaded.moment_at = [scenes](double time) { return scenes->moment(time); };
    loaded.json_at = [scenes](double time, const std::string& from) { return scenes->json(time, from); };
    loaded.files_named = [scene_text] {
      std::vector<std::string> given;
      for (const Setting& setting : scene_text->options.settings) given.push_back(setting.value);
      return scene_file::files_named(*scene_text->files, given);
    };
  }
  loaded.diagnostics = diagnostics.take();
  return loaded;
}

}  // namespace

int Animation::frames() const {
  // A frame that begins within the duration belongs to it; 1e-9 forgives the rounding of 0.1 * 30.
  return duration > 0 ? std::max(1, static_cast<int>(std::ceil(duration * fps - 1e-9))) : 1;
}

LoadedScene load_scene_file(const std::string& path, const LoadOptions& options) {
  const bool is_standard_input = path == "-";
  return load(scene_file::read_text(path), is_standard_input ? "<standard input>" : path,
              is_standard_input ? std::string() : path, options);
}

LoadedScene load_scene_text(std::string text, const std::string& name, const LoadOptions& options) {
  return load(std::move(text), name, {}, options);
}

}  // namespace raytracer
