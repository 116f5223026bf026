// One name for each file, however it is written.
#pragma once

#include <filesystem>
#include <string>

namespace raytracer {

/// Absolute and without links as far as it exists; empty where the system can't say (a name too long).
inline std::string canonical_path(const std::string& path) {
  namespace fs = std::filesystem;
  std::error_code error;
  const fs::path absolute = fs::absolute(path.empty() ? "." : path, error);
  if (error) return {};
  const fs::path resolved = fs::weakly_canonical(absolute, error);
  return error ? std::string() : resolved.string();
}

}  // namespace raytracer
