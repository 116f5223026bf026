// Which files a scene may read, and those it has read.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "scene_file/diagnostics.hpp"
#include "scene_file/source.hpp"
#include "scene_file/syntax.hpp"
#include "textures/picture_cache.hpp"

namespace raytracer::scene_file {

/// The largest scene text that is read.
inline constexpr std::uint64_t kLargestText = std::uint64_t{1} << 30U;

class Files {
 public:
  /// `main_folder`: where the main scene stands; it and what is below may be read, as may `allowed_folders`.
  Files(const std::string& main_folder, const std::vector<std::string>& allowed_folders);

  /// Takes the main scene's text.
  const SyntaxTree* add_main(std::string name, std::string path, std::string text, Diagnostics& diagnostics);

  /// Where a file that a scene at `from` names lies, as a canonical path. Empty where it can't be had, or is
  /// not the scene's to read, which has then been reported at `from`; `what` it is good for is said there ("a
  /// file to include").
  std::string find(const std::string& file, const Place& from, std::string_view what,
                   Diagnostics& diagnostics) const;
  /// Throws Error (kScene) where a file that another file names (a mesh its materials) is not the scene's to
  /// read.
  void require_allowed(const std::string& path) const;
  /// Where a file that a source names would lie, as a canonical path, there or not; empty where it is not the
  /// scene's to read.
  std::string path_from(const Source& source, const std::string& file) const;
  /// The name of a file that a source says, as a text in this folder would say it; empty: as the main scene
  /// would.
  std::string seen_from(const std::string& folder, const std::string& file, const Source& source) const;
  /// A file that is no text of the scene has been read.
  void note_read(const std::string& path);

  /// All pictures of the scene, each read once.
  PictureCache& pictures() { return pictures_; }
  /// A hash of a file's content.
  const SceneHash& content_hash(const std::string& path);

  /// The tree of a file that a scene at `from` names, parsed when first asked for. Null where it can't be
  /// had, which has then been reported at `from`.
  const SyntaxTree* include(const std::string& file, const Place& from, Diagnostics& diagnostics);

  /// The tree of a source of this scene.
  const SyntaxTree* tree_of(const Source& source) const;

  /// Of all sources of this scene.
  std::vector<const SyntaxTree*> trees() const;
  /// Whether the file of this canonical path is one of them.
  bool has_text(const std::string& path) const { return by_path_.contains(path); }

  std::vector<std::string> read_paths() const;
  Names& names() { return names_; }
  /// Whether any text of the scene has the word twice: what a branch not taken uses is not unused.
  bool is_mentioned_twice(std::string_view word) const;

 private:
  struct File {
    std::unique_ptr<Source> source;
    std::unique_ptr<SyntaxTree> tree;
  };

  std::string look_for(const std::string& file, const Place& from, std::string_view what,
                       Diagnostics& diagnostics) const;
  bool is_allowed(const std::string& canonical_path) const;
  void read_pictures_ahead(const SyntaxTree& tree);
  const SyntaxTree* add(std::string name, std::string path, std::string text, Diagnostics& diagnostics);

  std::vector<std::string> allowed_folders_;  ///< canonical; the main scene's first
  std::vector<std::string> other_files_;
  Names names_;
  std::vector<File> files_;
  std::unordered_map<std::string, const SyntaxTree*> by_path_;          ///< canonical
  std::unordered_map<std::string, const SyntaxTree*> by_written_path_;  ///< as folder and name make it
  std::unordered_map<std::string, SceneHash> hashes_;
  mutable std::unordered_map<std::string, std::string> found_;  ///< what find() has told, by text and name
  PictureCache pictures_;
};

/// The content of a file, or of standard input for "-". Throws Error (kFile) with the reason.
std::string read_text(const std::string& path);

}  // namespace raytracer::scene_file
