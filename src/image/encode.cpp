#include "image/encode.hpp"

#include <fmt/format.h>

#include <exception>
#include <new>

#include "raytracer/error.hpp"

namespace raytracer {

std::vector<std::uint8_t> encode_checked(const Image& image,
                                         const std::function<std::vector<std::uint8_t>()>& encode) {
  if (image.width <= 0 || image.height <= 0) {
    throw Error(ErrorKind::kUsage,
                fmt::format("a picture of {}x{} pixels can't be written", image.width, image.height));
  }
  const std::size_t count = image.index(0, image.height);
  if (image.red.size() != count || image.green.size() != count || image.blue.size() != count) {
    throw Error(ErrorKind::kUsage,
                fmt::format("a picture of {}x{} pixels needs {} values of each colour, not {}, {} and {}",
                            image.width, image.height, count, image.red.size(), image.green.size(),
                            image.blue.size()));
  }
  try {
    return encode();
  } catch (const std::bad_alloc&) {
    throw Error(ErrorKind::kFile, fmt::format("there is not enough memory to write a picture of {}x{} pixels",
                                              image.width, image.height));
  }
}

}  // namespace raytracer
