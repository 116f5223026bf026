#include "meshes/chunks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cstring>
#include <mutex>
#include <utility>

#include "core/parallel.hpp"
#include "core/printable.hpp"
#include "raytracer/error.hpp"

namespace raytracer::meshes {

void for_each_chunk(std::size_t count, const std::function<void(std::size_t)>& body) {
  std::atomic<std::size_t> first_failed{count};
  std::mutex mutex;
  Failure failure{};
  parallel_for(count, [&](std::size_t i) {
    if (i > first_failed) return;
    try {
      body(i);
    } catch (Failure& found) {
      const std::lock_guard lock(mutex);
      if (i >= first_failed) return;
      first_failed = i;
      failure = std::move(found);
    }
  });
  if (first_failed < count) throw failure;
}

void for_each_span(std::size_t count, std::size_t most,
                   const std::function<void(std::size_t begin, std::size_t end)>& body) {
  for_each_chunk((count + most - 1) / most,
                 [&](std::size_t i) { body(i * most, std::min(count, (i + 1) * most)); });
}

std::vector<std::string_view> cut_at_lines(std::string_view text, std::size_t chunk_bytes,
                                           const std::function<bool(const char* line)>& may_cut) {
  std::vector<std::string_view> chunks;
  constexpr std::size_t kLeast = 16;  // so that may_cut may look at a few characters before the cut
  const char* begin = text.data();
  const char* const end = begin + text.size();
  while (begin != end) {
    const auto left = static_cast<std::size_t>(end - begin);
    const char* cut = begin + std::min(std::max(chunk_bytes, kLeast), left);
    while (cut != end) {
      const void* const line_end = std::memchr(cut, '\n', static_cast<std::size_t>(end - cut));
      cut = line_end == nullptr ? end : static_cast<const char*>(line_end) + 1;
      if (cut != end && may_cut(cut)) break;
    }
    chunks.emplace_back(begin, static_cast<std::size_t>(cut - begin));
    begin = cut;
  }
  return chunks;
}

void with_lines(std::string_view file, const std::function<void()>& read) {
  try {
    read();
  } catch (const Failure& failure) {
    const auto line = std::count(file.data(), failure.at, '\n') + 1;
    throw Error(ErrorKind::kScene, fmt::format("line {}: {}", line, failure.what));
  }
}

void with_bytes(std::string_view file, const std::function<void()>& read) {
  try {
    read();
  } catch (const Failure& failure) {
    throw Error(ErrorKind::kScene, fmt::format("byte {}: {}", failure.at - file.data(), failure.what));
  }
}

std::string in_quotes(std::string_view word) {
  constexpr std::size_t kMost = 40;
  // Cut before it is made printable: what should be one word may be the rest of a large file.
  return fmt::format("'{}'", shortened(printable(word.substr(0, 4 * kMost)), kMost));
}

}  // namespace raytracer::meshes
