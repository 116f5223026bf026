// Reading a file in pieces, several at a time, and telling the first thing in it that is wrong.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace raytracer::meshes {

/// How much of a file one thread reads at a time: enough that handing it out costs nothing, little enough
/// that it stays in a cache.
inline constexpr std::size_t kChunkBytes = std::size_t{1} << 18U;

/// What a reader throws at a place in the file.
struct Failure {
  const char* at;
  std::string what;
};

/// Calls body(0) … body(count - 1) on several threads. If some throw Failure, that of the lowest number is
/// thrown on: which is told does not depend on the threads.
void for_each_chunk(std::size_t count, const std::function<void(std::size_t)>& body);

/// Calls body(begin, end) for consecutive pieces of 0 … count, at most `most` long each, as for_each_chunk.
void for_each_span(std::size_t count, std::size_t most,
                   const std::function<void(std::size_t begin, std::size_t end)>& body);

/// The text in pieces of about `chunk_bytes`, cut where a line begins and may_cut(that place) agrees.
std::vector<std::string_view> cut_at_lines(std::string_view text, std::size_t chunk_bytes,
                                           const std::function<bool(const char* line)>& may_cut);

/// Runs `read`, and makes a Failure an Error (kScene) that names the line of `file`, counted from 1.
void with_lines(std::string_view file, const std::function<void()>& read);
/// The same with the byte, counted from 0.
void with_bytes(std::string_view file, const std::function<void()>& read);

/// What stands in the file, to be told: without control characters, and not too long.
std::string in_quotes(std::string_view word);

}  // namespace raytracer::meshes
