#include "raytracer/image.hpp"

#include <fmt/format.h>

#include <exception>

#include "raytracer/error.hpp"

namespace raytracer {

Image::Image(int width_in, int height_in) : width(width_in), height(height_in) {
  if (width < 0 || height < 0) {
    throw Error(ErrorKind::kUsage, fmt::format("a picture can't be {}x{} pixels", width, height));
  }
  const std::size_t count = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  try {
    for (std::vector<float>* channel : {&red, &green, &blue}) channel->resize(count);
  } catch (const std::exception&) {
    throw Error(ErrorKind::kFile,
                fmt::format("there is not enough memory for a picture of {}x{} pixels", width, height));
  }
}

}  // namespace raytracer
