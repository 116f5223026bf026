#include "image/destination.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <filesystem>
#include <system_error>

#include "raytracer/error.hpp"
#include "raytracer/image.hpp"

namespace raytracer {
namespace {

[[noreturn]] void refuse(const std::string& path, const std::string& reason) {
  throw Error(ErrorKind::kFile, fmt::format("can't write '{}': {}", path, reason));
}

[[noreturn]] void refuse(const std::string& path, int error) {
  refuse(path, std::generic_category().message(error));
}

void split(Destination& place) {
  const std::size_t name_start = place.path.rfind('/') + 1;  // 0 without a slash
  const bool is_in_root = name_start == 1;
  place.folder =
      name_start == 0 ? std::string(1, '.') : place.path.substr(0, is_in_root ? 1 : name_start - 1);
  place.name = place.path.substr(name_start);
}

/// The number N of an open file when the place is /proc/self/fd/N, where links lead to no path; else -1.
int descriptor_at(const Destination& place) {
  int number = -1;
  const char* end = place.name.data() + place.name.size();
  if (std::from_chars(place.name.data(), end, number).ptr != end || number < 0) return -1;
  std::error_code error;
  const std::filesystem::path folder = std::filesystem::canonical(place.folder, error);
  return !error && folder == fmt::format("/proc/{}/fd", getpid()) ? number : -1;
}

/// Follows the links at the end of place.path, to where nothing need exist yet; stops at an open file.
void follow_links(Destination& place, const std::string& asked) {
  constexpr int kMostLinks = 40;  // as many as Linux follows
  for (int i = 0; i <= kMostLinks; ++i) {
    split(place);
    place.descriptor = descriptor_at(place);
    if (place.descriptor >= 0) return;
    std::error_code error;
    const std::string target = std::filesystem::read_symlink(place.path, error);
    if (error) return;
    place.path = target[0] == '/' ? target : place.folder + "/" + target;
  }
  refuse(asked, ELOOP);
}

/// `folder` is where `asked` would be written: it must exist, and new files in it be allowed.
void check_folder(const std::string& folder, const std::string& asked) {
  struct stat status = {};
  if (stat(folder.c_str(), &status) != 0) {
    if (errno == ENOENT) {
      throw Error(ErrorKind::kFile, fmt::format("there is no folder '{}' to write '{}' into", folder, asked));
    }
    if (errno != ENOTDIR) refuse(asked, errno);
  }
  if (!S_ISDIR(status.st_mode)) refuse(asked, fmt::format("'{}' is not a folder", folder));
  if (faccessat(AT_FDCWD, folder.c_str(), W_OK | X_OK, AT_EACCESS) != 0) {
    refuse(asked, fmt::format("no new file can be put into '{}': {}", folder,
                              std::generic_category().message(errno)));
  }
}

void check_descriptor(const Destination& place, const std::string& asked) {
  const int flags = fcntl(place.descriptor, F_GETFL);
  if (flags < 0) refuse(asked, errno);
  if ((flags & O_ACCMODE) == O_RDONLY) refuse(asked, "it is open for reading only");
}

}  // namespace

Destination find_destination(const std::string& path) {
  if (path.empty()) throw Error(ErrorKind::kFile, "the file to write has no name");
  if (path.find('\0') != std::string::npos)
    refuse(path.substr(0, path.find('\0')), "its name has a zero byte in it");
  Destination place;
  place.path = path;
  follow_links(place, path);
  if (place.descriptor >= 0) {
    place.kind = Destination::Kind::kDescriptor;
    check_descriptor(place, path);
    return place;
  }
  struct stat status = {};
  const bool exists = stat(place.path.c_str(), &status) == 0;
  if (!exists && errno != ENOENT && errno != ENOTDIR) refuse(path, errno);
  if ((exists && S_ISDIR(status.st_mode)) || place.name.empty()) refuse(path, "that is a folder");
  if (exists && faccessat(AT_FDCWD, place.path.c_str(), W_OK, AT_EACCESS) != 0) refuse(path, errno);
  if (exists && !S_ISREG(status.st_mode)) {
    place.kind = Destination::Kind::kDevice;
    return place;
  }
  check_folder(place.folder, path);
  place.kind = exists ? Destination::Kind::kFile : Destination::Kind::kNew;
  place.permissions = status.st_mode & 07777;
  place.owner = status.st_uid;
  place.group = status.st_gid;
  return place;
}

void check_writable(const std::string& path) { find_destination(path); }

}  // namespace raytracer
