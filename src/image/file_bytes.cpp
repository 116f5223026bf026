#include "image/file_bytes.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <new>

#include "raytracer/error.hpp"

namespace raytracer {
namespace {

constexpr std::uint64_t kLargestFile = std::uint64_t{4} << 30U;

class OpenFile {
 public:
  // Without waiting, so that a pipe to which nobody writes is found out.
  explicit OpenFile(const std::string& path)
      : descriptor_(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY)) {
    if (descriptor_ < 0) throw problem();
  }
  ~OpenFile() { ::close(descriptor_); }
  OpenFile(const OpenFile&) = delete;
  OpenFile& operator=(const OpenFile&) = delete;

  /// Of a file that can be read from its beginning to its end.
  std::size_t size() const {
    struct stat status {};
    if (::fstat(descriptor_, &status) != 0) throw problem();
    if (S_ISDIR(status.st_mode)) throw Error(ErrorKind::kScene, "it is a folder");
    if (!S_ISREG(status.st_mode)) throw Error(ErrorKind::kScene, "it is not a regular file");
    const auto size = static_cast<std::uint64_t>(status.st_size);
    if (size > kLargestFile) throw Error(ErrorKind::kScene, "it is larger than 4 GiB");
    return static_cast<std::size_t>(size);
  }

  /// Fewer than `count` at the file's end.
  std::size_t read(std::uint8_t* bytes, std::size_t count) const {
    std::size_t done = 0;
    while (done < count) {
      const ssize_t got = ::read(descriptor_, bytes + done, count - done);
      if (got < 0 && errno == EINTR) continue;
      if (got < 0) throw problem();
      if (got == 0) break;
      done += static_cast<std::size_t>(got);
    }
    return done;
  }

 private:
  static Error problem() { return {ErrorKind::kScene, std::strerror(errno)}; }

  int descriptor_;
};

}  // namespace

std::vector<std::uint8_t> read_file_bytes(const std::string& path) {
  const OpenFile file(path);
  const std::size_t size = file.size();
  try {
    std::vector<std::uint8_t> bytes(size);
    bytes.resize(file.read(bytes.data(), size));
    return bytes;
  } catch (const std::bad_alloc&) {
    throw Error(ErrorKind::kScene, "there is not enough memory to read it");
  }
}

}  // namespace raytracer
