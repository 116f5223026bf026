// A picture's file in memory, as its readers see it.
#pragma once

#include <cstdint>
#include <span>

namespace raytracer {

using ByteSpan = std::span<const std::uint8_t>;

}  // namespace raytracer
