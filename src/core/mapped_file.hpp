// A whole file as bytes in memory, without reading or copying it.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace raytracer {

/// The bytes of a file, there as long as this object is. Another program that shortens the file meanwhile
/// ends this one, as with every mapped file.
class MappedFile {
 public:
  /// Throws Error (kScene) with the reason, which does not repeat the path, where the file can't be read.
  /// Folders, devices and pipes can't.
  explicit MappedFile(const std::string& path);
  ~MappedFile();
  MappedFile(const MappedFile&) = delete;
  MappedFile& operator=(const MappedFile&) = delete;

  std::string_view bytes() const { return {static_cast<const char*>(data_), size_}; }

 private:
  void* data_ = nullptr;
  std::size_t size_ = 0;
};

}  // namespace raytracer
