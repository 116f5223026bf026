// Hashes that are the same on every machine and in every version: pictures and files carry them.
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <string_view>
#include <utility>

namespace raytracer {

/// The finaliser of SplitMix64 (Steele, Lea, Flood 2014, "Fast splittable pseudorandom number generators").
constexpr std::uint64_t mix_bits(std::uint64_t x) {
  x += 0x9E3779B97F4A7C15U;
  x = (x ^ (x >> 30U)) * 0xBF58476D1CE4E5B9U;
  x = (x ^ (x >> 27U)) * 0x94D049BB133111EBU;
  return x ^ (x >> 31U);
}

/// 128 bits about a sequence of words: two sequences have the same only by a chance that may be neglected. No
/// defence against anyone who looks for such a pair.
class Hasher {
 public:
  void add(std::uint64_t word) {
    first_ = mix_bits(first_ ^ word);
    second_ = mix_bits(second_ + std::rotl(word, 32));
  }
  void add(double number) { add(std::bit_cast<std::uint64_t>(number)); }
  void add(std::string_view text) {
    add(std::uint64_t{text.size()});
    std::uint64_t word = 0;
    for (std::size_t i = 0; i < text.size(); ++i) {
      word = word << 8U | static_cast<unsigned char>(text[i]);
      if (i % 8 == 7 || i + 1 == text.size()) add(std::exchange(word, 0));
    }
  }
  std::array<std::uint64_t, 2> value() const { return {first_, second_}; }

 private:
  std::uint64_t first_ = 0x6A09E667F3BCC908U, second_ = 0xBB67AE8584CAA73BU;  // any two numbers
};

}  // namespace raytracer
