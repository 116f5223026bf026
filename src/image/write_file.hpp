// What main needs of writing beyond the public write_file.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace raytracer {

/// Writes all the bytes to an open file, pipe or terminal. `name` is what an error calls it.
void write_all(int descriptor, const std::vector<std::uint8_t>& bytes, const std::string& name);

/// Deletes the file that write_file has begun beside its place, if there is one. For signal handlers that end
/// the program: async-signal-safe, and leaves errno alone.
void remove_unfinished_file() noexcept;

}  // namespace raytracer
