// A picture's file as bytes in memory.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace raytracer {

using ByteSpan = std::span<const std::uint8_t>;

/// The whole regular file. Throws Error (kScene) with a clause that says why not, without its name; a folder,
/// a pipe or a device is refused without waiting for it.
std::vector<std::uint8_t> read_file_bytes(const std::string& path);

}  // namespace raytracer
