// Pictures from files. The door to all readers.
#pragma once

#include <string>

#include "image/picture.hpp"

namespace raytracer {

/// Reads a PNG, JPEG, Radiance HDR or EXR, told apart by what is in it. Throws Error (kScene) whose message
/// is a clause about the file without its name ("it is a JPEG, although its name ends in .png"), for the
/// caller to go on with: a file that is missing, not readable, broken, of another kind than its name says, or
/// that declares more than kLargestTexels. Sizes are held against the file's own before memory is taken.
Picture read_picture(const std::string& path);

}  // namespace raytracer
