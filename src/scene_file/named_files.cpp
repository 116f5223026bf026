#include "scene_file/named_files.hpp"

#include <unordered_set>

#include "core/deep_stack.hpp"
#include "meshes/read_mesh.hpp"
#include "raytracer/error.hpp"
#include "scene_file/parser.hpp"
#include "scene_file/quoted_names.hpp"

namespace raytracer::scene_file {
namespace {

class Collector {
 public:
  Collector(Files& files, std::span<const std::string> further) : files_(files), further_(further) {
    for (const std::string& path : files.read_paths()) known_.insert(path);
  }

  void add(const SyntaxTree& tree) {
    const NamesInText names = all_quoted_names(tree, files_.names());
    for (const std::string& name : names.all) add_file(files_.path_from(*tree.source, name));
    for (const std::string& name : further_) add_file(files_.path_from(*tree.source, name));
    for (const std::string& name : names.included) add_text(files_.path_from(*tree.source, name));
  }

  std::vector<std::string> take() { return std::move(found_); }

 private:
  // What has been read has told of all that it names.
  void add_file(const std::string& path) {
    if (path.empty() || !known_.insert(path).second) return;
    found_.push_back(path);
    for (const std::string& other : files_named_by_mesh(path)) {
      if (known_.insert(other).second) found_.push_back(other);
    }
  }

  void add_text(const std::string& path) {
    if (path.empty() || files_.has_text(path) || !texts_.insert(path).second) return;
    try {
      Diagnostics unheard;
      const Source source(path, path, read_text(path));
      add(*parse(source, files_.names(), unheard));
    } catch (const Error&) {  // then nothing can be read from it later either
    }
  }

  Files& files_;
  std::span<const std::string> further_;
  std::unordered_set<std::string> known_, texts_;
  std::vector<std::string> found_;
};

}  // namespace

std::vector<std::string> files_named(Files& files, std::span<const std::string> further) {
  Collector collector(files, further);
  run_on_deep_stack([&] {
    for (const SyntaxTree* tree : files.trees()) collector.add(*tree);
  });
  return collector.take();
}

}  // namespace raytracer::scene_file
