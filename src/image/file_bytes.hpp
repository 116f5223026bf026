// A picture's file as bytes in memory.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>

namespace raytracer {

using ByteSpan = std::span<const std::uint8_t>;

struct FileBytes {
  std::unique_ptr<std::uint8_t[]> data;
  std::size_t size = 0;

  ByteSpan span() const { return {data.get(), size}; }
};

/// The whole regular file. Throws Error (kScene) with a clause that says why not, without its name; a folder,
/// a pipe or a device is refused without waiting for it.
FileBytes read_file_bytes(const std::string& path);

}  // namespace raytracer
