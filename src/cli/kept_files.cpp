#include "cli/kept_files.hpp"

#include <fmt/format.h>
#include <sys/stat.h>

#include "core/canonical_path.hpp"
#include "image/destination.hpp"
#include "raytracer/error.hpp"

namespace raytracer::cli {
namespace {

// A name that the system can't look up stands for itself.
std::string canonical(const std::string& path) {
  const std::string resolved = canonical_path(path);
  return resolved.empty() ? path : resolved;
}

}  // namespace

KeptFiles KeptFiles::of(const LoadedScene& scene) {
  KeptFiles kept;
  for (const std::string& path : scene.files_read) kept.add(path, "a file that the scene reads");
  for (const std::string& path : scene.files_named()) {
    kept.add(path, "a file that the scene names and may read at another time");
  }
  return kept;
}

void KeptFiles::add(const std::string& path, std::string_view what) {
  if (path == "-") return;
  paths_.emplace(canonical(path), what);
  struct stat status = {};
  if (stat(path.c_str(), &status) == 0) inodes_.emplace(std::pair(status.st_dev, status.st_ino), what);
}

std::string_view KeptFiles::find(const std::string& path) const {
  if (path == "-") return {};
  const Destination place = find_destination(path);
  const bool is_file = place.kind == Destination::Kind::kFile || place.kind == Destination::Kind::kNew;
  if (!is_file) return {};
  if (const auto known = paths_.find(canonical(place.path)); known != paths_.end()) return known->second;
  struct stat status = {};
  if (stat(place.path.c_str(), &status) != 0) return {};
  const auto known = inodes_.find(std::pair(status.st_dev, status.st_ino));
  return known == inodes_.end() ? std::string_view() : known->second;
}

void check_output(const std::string& path, const KeptFiles& kept) {
  const std::string_view what = kept.find(path);
  if (what.empty()) return;
  throw Error(ErrorKind::kFile, fmt::format("'{}' is {}: it is not overwritten", path, what));
}

}  // namespace raytracer::cli
