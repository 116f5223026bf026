// What the writers of every format share.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "raytracer/image.hpp"

namespace raytracer {

/// Calls `encode` for an image that has pixels and buffers of the right size; other images, and running out
/// of memory, throw Error.
std::vector<std::uint8_t> encode_checked(const Image& image,
                                         const std::function<std::vector<std::uint8_t>()>& encode);

}  // namespace raytracer
