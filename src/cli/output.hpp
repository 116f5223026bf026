// The program's two voices.
#pragma once

#include <string_view>

namespace raytracer::cli {

/// Streams that were closed become ones that can't be read or written: no file that is opened later takes
/// their place.
void occupy_standard_streams();

/// Writes to standard output, at once. Throws Error (kFile).
void say(std::string_view text);

/// Writes to standard error. Where nobody listens nothing is said, and nothing else changes.
void warn(std::string_view text);

}  // namespace raytracer::cli
