#include "core/mapped_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

#include "raytracer/error.hpp"

namespace raytracer {
namespace {

Error failure(const std::string& reason) {
  return {ErrorKind::kScene, fmt::format("it can't be read: {}", reason)};
}

std::string last_reason() { return std::generic_category().message(errno); }

class Descriptor {
 public:
  // Without O_NONBLOCK the opening of a pipe would wait for somebody who writes into it.
  explicit Descriptor(const std::string& path)
      : number_(open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK)) {
    if (number_ < 0) throw failure(last_reason());
  }
  ~Descriptor() { close(number_); }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  int get() const { return number_; }

 private:
  int number_;
};

}  // namespace

MappedFile::MappedFile(const std::string& path) {
  const Descriptor file(path);
  struct stat status {};
  if (fstat(file.get(), &status) != 0) throw failure(last_reason());
  if (S_ISDIR(status.st_mode)) throw failure("it is a folder");
  if (!S_ISREG(status.st_mode)) throw failure("it is a device or a pipe");
  size_ = static_cast<std::size_t>(status.st_size);
  if (size_ == 0) return;  // nothing can't be mapped
  void* const data = mmap(nullptr, size_, PROT_READ, MAP_PRIVATE, file.get(), 0);
  if (data == MAP_FAILED) throw failure(last_reason());
  data_ = data;
  madvise(data_, size_, MADV_WILLNEED);  // only a hint: whether it is taken does not matter
}

MappedFile::~MappedFile() {
  if (data_ != nullptr) munmap(data_, size_);
}

}  // namespace raytracer
