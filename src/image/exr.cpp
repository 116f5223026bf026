#include "image/encode.hpp"
#include "raytracer/error.hpp"

namespace raytracer {

std::vector<std::uint8_t> encode_exr(const Image&) {
  throw Error(ErrorKind::kFile, "EXR can't be written yet");
}

}  // namespace raytracer
