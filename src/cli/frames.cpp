#include "cli/frames.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <limits>

#include "raytracer/error.hpp"

namespace raytracer::cli {
namespace {

constexpr std::int64_t kLastFrame = std::numeric_limits<int>::max();
constexpr std::size_t kMostFrames = 10'000'000;  // four days and nights at 24 a second

[[noreturn]] void refuse(std::string_view text) {
  throw Error(ErrorKind::kUsage,
              fmt::format("--frames takes all, 3, 1-240, 1-240x2 or 3,7,10-20, not '{}'", text));
}

// The number that a text begins with, taken off it; a text that begins with none is refused.
std::int64_t take_number(std::string_view& text, std::string_view whole) {
  std::int64_t number = 0;
  const auto [end, status] = std::from_chars(text.data(), text.data() + text.size(), number);
  const bool is_number = !text.empty() && text[0] >= '0' && text[0] <= '9';
  if (!is_number || status == std::errc::invalid_argument) refuse(whole);
  text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  return status == std::errc::result_out_of_range ? kLastFrame : std::min(number, kLastFrame);
}

bool take(std::string_view& text, char c) {
  if (!text.starts_with(c)) return false;
  text.remove_prefix(1);
  return true;
}

FrameRange parse_range(std::string_view text, std::string_view whole) {
  FrameRange range;
  range.first = range.last = take_number(text, whole);
  if (take(text, '-')) {
    range.last = take_number(text, whole);
    if (take(text, 'x')) range.step = take_number(text, whole);
  }
  if (!text.empty()) refuse(whole);
  if (range.step == 0)
    throw Error(ErrorKind::kUsage, fmt::format("--frames {}: a step of 0 never ends", whole));
  if (range.last < range.first) {
    throw Error(ErrorKind::kUsage,
                fmt::format("--frames {}: a range runs upwards, as {}-{}", whole, range.last, range.first));
  }
  return range;
}

// Where in the path the row of '#' begins, and how long it is; length 0 where there is none.
struct NumberPlace {
  std::size_t begin = 0, length = 0;
};
NumberPlace find_number(const std::string& path) {
  const std::size_t name = path.rfind('/') + 1;  // 0 without a slash
  const std::size_t begin = path.find('#', name);
  if (begin == std::string::npos) return {};
  const std::size_t end = std::min(path.find_first_not_of('#', begin), path.size());
  if (path.find('#', end) != std::string::npos) {
    throw Error(ErrorKind::kUsage, fmt::format("'{}': the frame's number can stand in one place only", path));
  }
  return {begin, end - begin};
}

}  // namespace

FrameList parse_frame_list(std::string_view text) {
  if (text == "all") return {{1, kLastFrame, 1}};
  FrameList list;
  for (std::string_view rest = text;;) {
    const std::size_t comma = rest.find(',');
    list.push_back(parse_range(rest.substr(0, comma), text));
    if (comma == std::string_view::npos) return list;
    rest.remove_prefix(comma + 1);
  }
}

std::vector<int> frames_of(const FrameList& list, int count) {
  std::vector<int> frames;
  for (const FrameRange& range : list) {
    const std::int64_t last = std::min<std::int64_t>(range.last, count);
    for (std::int64_t frame = range.first; frame <= last; frame += range.step) {
      if (frame < 1) continue;
      frames.push_back(static_cast<int>(frame));
      if (frames.size() > kMostFrames) {
        throw Error(
            ErrorKind::kUsage,
            fmt::format(
                "the scene has {} frames, and at most {} can be rendered at once: --frames 1-1000 names some",
                count, kMostFrames));
      }
    }
  }
  if (frames.empty()) {
    throw Error(ErrorKind::kUsage, fmt::format("--frames names none of the scene's {} frames", count));
  }
  std::ranges::sort(frames);
  frames.erase(std::unique(frames.begin(), frames.end()), frames.end());
  return frames;
}

bool has_frame_number(const std::string& path) { return find_number(path).length > 0; }

std::string with_frame_number(const std::string& path, int frame) {
  const NumberPlace place = find_number(path);
  if (place.length == 0) return path;
  return path.substr(0, place.begin) + fmt::format("{:0{}}", frame, place.length) +
         path.substr(place.begin + place.length);
}

}  // namespace raytracer::cli
