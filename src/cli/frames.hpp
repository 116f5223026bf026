// Which frames of an animation, and what their files are called.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace raytracer::cli {

/// Frames first, first + step … up to last.
struct FrameRange {
  std::int64_t first = 1, last = 1, step = 1;
};
using FrameList = std::vector<FrameRange>;

/// Reads all, 3, 1-240, 1-240x2 or several of them with commas between. Throws Error (kUsage).
FrameList parse_frame_list(std::string_view text);

/// Those of the list that are among the scene's frames 1 … count: rising, each once. Throws Error (kUsage)
/// where none is, or too many are.
std::vector<int> frames_of(const FrameList& list, int count);

/// Whether a file's name has the frame's number in it, as a row of '#'. Throws Error (kUsage) where it has
/// two.
bool has_frame_number(const std::string& path);

/// shot.####.png -> shot.0007.png; a number that is too long stays whole.
std::string with_frame_number(const std::string& path, int frame);

}  // namespace raytracer::cli
