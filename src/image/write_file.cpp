#include "image/write_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <mutex>
#include <system_error>
#include <utility>

#include "image/destination.hpp"
#include "raytracer/error.hpp"
#include "raytracer/image.hpp"

namespace raytracer {
namespace {

[[noreturn]] void fail(const std::string& name, int error) {
  throw Error(ErrorKind::kFile,
              fmt::format("can't write '{}': {}", name, std::generic_category().message(error)));
}

class Descriptor {
 public:
  explicit Descriptor(int number) : number_(number) {}
  ~Descriptor() {
    if (number_ >= 0) close(number_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;

  int get() const { return number_; }
  /// Some file systems tell of a failed write only here.
  int close_and_check() { return close(std::exchange(number_, -1)) == 0 ? 0 : errno; }

 private:
  int number_;
};

// The name, in an open folder, of the file that a signal must not leave behind. Set while unfinished_folder
// >= 0.
char unfinished_name[64];
std::atomic<int> unfinished_folder{-1};
static_assert(std::atomic<int>::is_always_lock_free);  // else a signal handler could not read it

/// A name beside the destination, deleted in the end unless it was moved into place.
class TemporaryName {
 public:
  explicit TemporaryName(int folder) : folder_(folder) {}
  ~TemporaryName() {
    remove_unfinished_file();
    unfinished_folder = -1;
  }
  TemporaryName(const TemporaryName&) = delete;
  TemporaryName& operator=(const TemporaryName&) = delete;

  /// Tries names until `make(name)` doesn't fail for the name being taken. Returns what `make` did last:
  /// below 0 for failure, with errno set.
  template <typename Make>
  int create(const Make& make) {
    constexpr int kAttempts = 1000;
    int result = -1;
    for (int i = 0; i < kAttempts; ++i) {
      *fmt::format_to_n(unfinished_name, sizeof unfinished_name - 1, ".raytracer-{}-{}", getpid(), i).out =
          '\0';
      result = make(unfinished_name);
      if (result >= 0) unfinished_folder = folder_;
      if (result >= 0 || errno != EEXIST) break;
    }
    return result;
  }
  /// 0 or the error's number.
  int move_to(const std::string& name) {
    if (renameat(folder_, unfinished_name, folder_, name.c_str()) != 0) return errno;
    unfinished_folder = -1;
    return 0;
  }

 private:
  int folder_;
};

/// 0 or the error's number.
int write_bytes(int descriptor, const std::vector<std::uint8_t>& bytes) {
  std::size_t done = 0;
  while (done < bytes.size()) {
    const ssize_t count = write(descriptor, bytes.data() + done, bytes.size() - done);
    if (count > 0) {
      done += static_cast<std::size_t>(count);
    } else if (count == 0) {
      return EIO;
    } else if (errno == EAGAIN) {  // a pipe or terminal that another program made non-blocking
      pollfd ready = {descriptor, POLLOUT, 0};
      poll(&ready, 1, -1);
    } else if (errno != EINTR) {
      return errno;
    }
  }
  return 0;
}

/// Gives a new file the owner and the permissions of the one it replaces. 0 or the error's number.
int keep_permissions(int file, const Destination& place) {
  if (place.kind != Destination::Kind::kFile) return 0;
  struct stat status = {};
  fstat(file, &status);
  const bool is_other_owner = status.st_uid != place.owner || status.st_gid != place.group;
  // Only root may give files away; another's new picture is its own. So the result doesn't matter.
  if (is_other_owner) [[maybe_unused]]
    const int result = fchown(file, place.owner, place.group);
  return fchmod(file, place.permissions) == 0 ? 0 : errno;
}

/// Gives the new file its contents and the old one's permissions, on the disk. 0 or the error's number.
int fill(int file, const Destination& place, const std::vector<std::uint8_t>& bytes) {
  if (const int error = keep_permissions(file, place)) return error;
  if (const int error = write_bytes(file, bytes)) return error;
  return fsync(file) == 0 ? 0 : errno;
}

enum class Outcome { kDone, kNotPossibleHere };

constexpr mode_t kNewFile = 0666;  // less the umask

/// Writes a file that has no name, and names it when it is whole: even kill -9 leaves nothing behind.
Outcome write_unnamed(int folder, const Destination& place, const std::vector<std::uint8_t>& bytes,
                      const std::string& asked) {
  Descriptor file(openat(folder, ".", O_TMPFILE | O_WRONLY | O_CLOEXEC, kNewFile));
  if (file.get() < 0) return Outcome::kNotPossibleHere;
  const std::string handle = fmt::format("/proc/self/fd/{}", file.get());
  if (access(handle.c_str(), F_OK) != 0) return Outcome::kNotPossibleHere;
  if (const int error = fill(file.get(), place, bytes)) fail(asked, error);

  const auto link_as = [&](const char* name) {
    return linkat(AT_FDCWD, handle.c_str(), folder, name, AT_SYMLINK_FOLLOW);
  };
  if (link_as(place.name.c_str()) == 0) return Outcome::kDone;
  if (errno != EEXIST) return Outcome::kNotPossibleHere;
  // A link can't replace a file. Only between these two lines does a second name exist.
  TemporaryName name(folder);
  if (name.create(link_as) < 0) fail(asked, errno);
  if (const int error = name.move_to(place.name)) fail(asked, error);
  return Outcome::kDone;
}

/// The same with a hidden name from the start.
void write_named(int folder, const Destination& place, const std::vector<std::uint8_t>& bytes,
                 const std::string& asked) {
  TemporaryName name(folder);
  Descriptor file(name.create([&](const char* candidate) {
    return openat(folder, candidate, O_CREAT | O_EXCL | O_WRONLY | O_CLOEXEC, kNewFile);
  }));
  if (file.get() < 0) fail(asked, errno);
  if (const int error = fill(file.get(), place, bytes)) fail(asked, error);
  if (const int error = file.close_and_check()) fail(asked, error);
  if (const int error = name.move_to(place.name)) fail(asked, error);
}

/// Below 0 with errno set when the folder can't be entered.
int open_folder(const std::string& path) {
  const int readable = open(path.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (readable >= 0 || errno != EACCES) return readable;
  return open(path.c_str(), O_PATH | O_DIRECTORY | O_CLOEXEC);  // enough to write in, not to flush
}

void replace(const Destination& place, const std::vector<std::uint8_t>& bytes, const std::string& asked) {
  static std::mutex one_at_a_time;  // a signal handler knows of one unfinished file
  const std::lock_guard lock(one_at_a_time);
  const Descriptor folder(open_folder(place.folder));
  if (folder.get() < 0) fail(asked, errno);
  if (write_unnamed(folder.get(), place, bytes, asked) == Outcome::kNotPossibleHere) {
    write_named(folder.get(), place, bytes, asked);
  }
  // The picture is in place: a folder that can't be flushed is no reason to complain.
  fsync(folder.get());
}

}  // namespace

void write_all(int descriptor, const std::vector<std::uint8_t>& bytes, const std::string& name) {
  if (const int error = write_bytes(descriptor, bytes)) fail(name, error);
}

void remove_unfinished_file() noexcept {
  const int saved = errno;
  const int folder = unfinished_folder;
  if (folder >= 0) unlinkat(folder, unfinished_name, 0);
  errno = saved;
}

void write_file(const std::string& path, const std::vector<std::uint8_t>& bytes) {
  const Destination place = find_destination(path);
  if (place.kind == Destination::Kind::kDescriptor) return write_all(place.descriptor, bytes, path);
  if (place.kind != Destination::Kind::kDevice) return replace(place, bytes, path);
  Descriptor device(open(place.path.c_str(), O_WRONLY | O_NOCTTY | O_CLOEXEC));
  if (device.get() < 0) fail(path, errno);
  write_all(device.get(), bytes, path);
  if (const int error = device.close_and_check()) fail(path, error);
}

class FileInProgress::Place {
 public:
  explicit Place(const std::string& asked)
      : asked_(asked),
        place_(find_destination(asked)),
        folder_(open_folder(place_.folder)),
        name_(folder_.get()) {
    if (place_.kind != Destination::Kind::kNew && place_.kind != Destination::Kind::kFile) {
      throw Error(ErrorKind::kFile, fmt::format("can't write '{}': it is no regular file", asked));
    }
    if (folder_.get() < 0) fail(asked, errno);
    const Descriptor file(name_.create([&](const char* candidate) {
      return openat(folder_.get(), candidate, O_CREAT | O_EXCL | O_WRONLY | O_CLOEXEC, kNewFile);
    }));
    if (file.get() < 0) fail(asked, errno);
  }
  std::string path() const { return place_.folder + "/" + unfinished_name; }

  void finish() {
    const Descriptor file(openat(folder_.get(), unfinished_name, O_WRONLY | O_CLOEXEC));
    if (file.get() < 0) fail(asked_, errno);
    if (const int error = keep_permissions(file.get(), place_)) fail(asked_, error);
    if (fsync(file.get()) != 0) fail(asked_, errno);
    if (const int error = name_.move_to(place_.name)) fail(asked_, error);
    fsync(folder_.get());
  }

 private:
  std::string asked_;
  Destination place_;
  Descriptor folder_;
  TemporaryName name_;
};

FileInProgress::FileInProgress(const std::string& path) : place_(std::make_unique<Place>(path)) {}
FileInProgress::~FileInProgress() = default;
std::string FileInProgress::path() const { return place_->path(); }
void FileInProgress::finish() { place_->finish(); }

}  // namespace raytracer
