#include "scene_file/files.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <utility>

#include "core/canonical_path.hpp"
#include "core/hash.hpp"
#include "raytracer/error.hpp"
#include "scene_file/json_scene.hpp"
#include "scene_file/parser.hpp"
#include "scene_file/quoted_names.hpp"

namespace raytracer::scene_file {
namespace {

namespace fs = std::filesystem;

// A file that is closed on every way out.
class OpenFile {
 public:
  explicit OpenFile(const std::string& path)
      : descriptor_(path == "-" ? STDIN_FILENO : ::open(path.c_str(), O_RDONLY | O_CLOEXEC)) {}
  ~OpenFile() {
    if (descriptor_ > STDERR_FILENO) ::close(descriptor_);
  }
  OpenFile(const OpenFile&) = delete;
  OpenFile& operator=(const OpenFile&) = delete;
  int descriptor() const { return descriptor_; }

 private:
  int descriptor_;
};

}  // namespace

std::string read_text(const std::string& path) {
  const std::string name = path == "-" ? "standard input" : fmt::format("'{}'", path);
  const auto fail = [&](const std::string& reason) -> Error {
    return {ErrorKind::kFile, fmt::format("can't read {}: {}", name, reason)};
  };
  const OpenFile file(path);
  if (file.descriptor() < 0) throw fail(std::strerror(errno));
  struct stat status {};
  if (::fstat(file.descriptor(), &status) == 0) {
    if (S_ISDIR(status.st_mode)) throw fail("it is a folder");
    if (S_ISREG(status.st_mode) && static_cast<std::uint64_t>(status.st_size) > kLargestText) {
      throw fail("it is larger than 1 GiB");
    }
  }
  std::string text;
  if (S_ISREG(status.st_mode)) text.reserve(static_cast<std::size_t>(status.st_size) + 1);
  std::size_t size = 0;
  while (true) {
    constexpr std::size_t kChunk = std::size_t{1} << 18U;
    text.resize(size + kChunk);
    const ssize_t got = ::read(file.descriptor(), text.data() + size, kChunk);
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) throw fail(std::strerror(errno));
    if (got == 0) break;
    // Text holds no zero bytes; /dev/zero and pictures are found out here, not after a gigabyte.
    if (std::memchr(text.data() + size, 0, static_cast<std::size_t>(got)) != nullptr) {
      throw fail("it is not a text file (it contains zero bytes)");
    }
    size += static_cast<std::size_t>(got);
    if (size > kLargestText) throw fail("it is larger than 1 GiB");
  }
  text.resize(size);
  return text;
}

Files::Files(const std::string& main_folder, const std::vector<std::string>& allowed_folders) {
  allowed_folders_.push_back(canonical_path(main_folder));
  for (const std::string& folder : allowed_folders) allowed_folders_.push_back(canonical_path(folder));
}

bool Files::is_allowed(const std::string& canonical_path) const {
  for (const std::string& folder : allowed_folders_) {
    const fs::path relative = fs::path(canonical_path).lexically_relative(folder);
    if (!relative.empty() && *relative.begin() != "..") return true;
  }
  return false;
}

const SyntaxTree* Files::add(std::string name, std::string path, std::string text, Diagnostics& diagnostics) {
  File file;
  file.source = std::make_unique<Source>(std::move(name), std::move(path), std::move(text));
  const bool json = is_json(file.source->name(), file.source->text());
  file.tree =
      json ? parse_json_scene(*file.source, names_, diagnostics) : parse(*file.source, names_, diagnostics);
  files_.push_back(std::move(file));
  const SyntaxTree* tree = files_.back().tree.get();
  read_pictures_ahead(*tree);
  return tree;
}

// On all threads, where there are several. What is wrong with one is told where the scene asks for it.
void Files::read_pictures_ahead(const SyntaxTree& tree) {
  if (tree.source->path().empty()) return;
  std::vector<std::string> paths;
  Diagnostics unheard;
  for (const std::string& name : quoted_names(tree, names_)) {
    std::string path = find(name, {tree.source, {}}, {}, unheard);
    if (!path.empty()) paths.push_back(std::move(path));
  }
  if (paths.size() > 1) pictures_.prefetch(paths);
}

const SyntaxTree* Files::add_main(std::string name, std::string path, std::string text,
                                  Diagnostics& diagnostics) {
  const std::string key = path.empty() ? std::string() : canonical_path(path);
  const SyntaxTree* tree = add(std::move(name), key, std::move(text), diagnostics);
  if (!key.empty()) by_path_.emplace(key, tree);
  return tree;
}

std::string Files::find(const std::string& file, const Place& from, std::string_view what,
                        Diagnostics& diagnostics) const {
  // A scene may name a file ten thousand times, and the system takes its time over each.
  const std::string key = from.source->path() + '\0' + file;
  if (const auto known = found_.find(key); known != found_.end()) return known->second;
  std::string path = look_for(file, from, what, diagnostics);
  if (!path.empty()) found_.emplace(key, path);
  return path;
}

std::string Files::look_for(const std::string& file, const Place& from, std::string_view what,
                            Diagnostics& diagnostics) const {
  if (file.empty()) {
    diagnostics.error(from, "the name of a file is empty", fmt::format("it names {}", what));
    return {};
  }
  const fs::path folder = fs::path(from.source->path()).parent_path();
  std::string path = canonical_path((folder / file).string());
  if (path.empty()) {
    diagnostics.error(from, "this can't be the name of a file", "it is too long, or can't be looked up");
    return {};
  }
  if (!is_allowed(path)) {
    diagnostics.error(from, fmt::format("'{}' lies outside of the scene's folder", file),
                      fmt::format("--allow-path {} allows it", fs::path(path).parent_path().string()));
    return {};
  }
  std::error_code status_error;
  const fs::file_status status = fs::status(path, status_error);
  if (!fs::exists(status)) {
    diagnostics.error(from, fmt::format("there is no file '{}'", file), fmt::format("looked for {}", path));
    return {};
  }
  if (!fs::is_regular_file(status)) {
    diagnostics.error(from, fmt::format("'{}' is not {}", file, what),
                      fs::is_directory(status) ? "it is a folder" : "it is a device or a pipe");
    return {};
  }
  return path;
}

void Files::require_allowed(const std::string& path) const {
  const std::string resolved = canonical_path(path);
  if (!resolved.empty() && is_allowed(resolved)) return;
  throw Error(ErrorKind::kScene, fmt::format("'{}' lies outside of the scene's folder", path));
}

std::string Files::path_from(const Source& source, const std::string& file) const {
  std::string path = canonical_path((fs::path(source.path()).parent_path() / file).string());
  return is_allowed(path) ? path : std::string();
}

std::string Files::seen_from(const std::string& folder, const std::string& file, const Source& source) const {
  const fs::path path(file);
  if (path.is_absolute()) return file;
  const std::string own = canonical_path(fs::path(source.path()).parent_path().string());
  const fs::path there =
      folder.empty() ? fs::path(allowed_folders_.front()) : fs::path(canonical_path(folder));
  const fs::path way = fs::path(own).lexically_relative(there);
  return way.empty() || way == "." ? file : (way / path).lexically_normal().string();
}

void Files::note_read(const std::string& path) {
  if (std::ranges::find(other_files_, path) == other_files_.end()) other_files_.push_back(path);
}

const SceneHash& Files::content_hash(const std::string& path) {
  const auto [entry, is_new] = hashes_.try_emplace(path);
  if (!is_new) return entry->second;
  Hasher hasher;
  std::ifstream file(path, std::ios::binary);
  std::string chunk(std::size_t{1} << 20U, '\0');
  while (file.read(chunk.data(), static_cast<std::streamsize>(chunk.size())) || file.gcount() > 0) {
    hasher.add(std::string_view(chunk).substr(0, static_cast<std::size_t>(file.gcount())));
  }
  return entry->second = hasher.value();
}

const SyntaxTree* Files::include(const std::string& file, const Place& from, Diagnostics& diagnostics) {
  const fs::path folder = fs::path(from.source->path()).parent_path();
  const std::string written = (folder / file).string();
  // A file that has been read is there, whatever has become of it since. As it is written first: a loop may
  // ask a million times, and the system takes long to say what a name stands for.
  if (const auto known = by_written_path_.find(written); known != by_written_path_.end())
    return known->second;
  if (const auto known = by_path_.find(canonical_path(written)); known != by_path_.end()) {
    return by_written_path_[written] = known->second;
  }
  const std::string path = find(file, from, "a file to include", diagnostics);
  if (path.empty()) return nullptr;
  const std::string shown = fs::path(from.source->name()).parent_path().empty()
                                ? file
                                : (fs::path(from.source->name()).parent_path() / file).string();
  try {
    const SyntaxTree* tree = add(shown, path, read_text(path), diagnostics);
    by_path_.emplace(path, tree);
    return tree;
  } catch (const Error& error) {
    diagnostics.error(from, error.what());
    return nullptr;
  }
}

const SyntaxTree* Files::tree_of(const Source& source) const {
  for (const File& file : files_) {
    if (file.source.get() == &source) return file.tree.get();
  }
  return nullptr;
}

std::vector<const SyntaxTree*> Files::trees() const {
  std::vector<const SyntaxTree*> trees;
  for (const File& file : files_) trees.push_back(file.tree.get());
  return trees;
}

bool Files::is_mentioned_twice(std::string_view word) const {
  const auto is_word = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
  };
  int count = 0;
  for (const File& file : files_) {
    const std::string_view text = file.source->text();
    for (std::size_t at = text.find(word); at != std::string_view::npos;
         at = text.find(word, at + word.size())) {
      const bool begins = at == 0 || !is_word(text[at - 1]);
      const bool ends = at + word.size() >= text.size() || !is_word(text[at + word.size()]);
      if (begins && ends && ++count > 1) return true;
    }
  }
  return false;
}

std::vector<std::string> Files::read_paths() const {
  std::vector<std::string> paths;
  for (const File& file : files_) {
    if (!file.source->path().empty()) paths.push_back(file.source->path());
  }
  paths.insert(paths.end(), other_files_.begin(), other_files_.end());
  return paths;
}

}  // namespace raytracer::scene_file
