#include "image/apng.hpp"

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "catch.hpp"
#include "image/png_text.hpp"
#include "image/zlib_pieces.hpp"
#include "raytracer/error.hpp"
#include "raytracer/image.hpp"
#include "unit/temporary_folder.hpp"

using raytracer::Apng;
using raytracer::Color3f;
using raytracer::Image;

namespace {

using Bytes = std::vector<std::uint8_t>;

struct Chunk {
  std::string type;
  Bytes content;
};

std::uint32_t number_at(const Bytes& bytes, std::size_t at, int size = 4) {
  std::uint32_t number = 0;
  for (int i = 0; i < size; ++i) number = number << 8U | bytes.at(at + static_cast<std::size_t>(i));
  return number;
}

/// The chunks behind the signature, their checksums checked.
std::vector<Chunk> chunks_of(const Bytes& file) {
  std::vector<Chunk> chunks;
  for (std::size_t at = 8; at < file.size();) {
    const std::size_t size = number_at(file, at);
    REQUIRE(at + 12 + size <= file.size());
    const auto start = file.begin() + static_cast<std::ptrdiff_t>(at);
    const auto length = static_cast<std::ptrdiff_t>(size);
    chunks.push_back({std::string(start + 4, start + 8), Bytes(start + 8, start + 8 + length)});
    CHECK(number_at(file, at + 8 + size) == raytracer::crc32_of(file.data() + at + 4, size + 4));
    at += 12 + size;
  }
  return chunks;
}

std::vector<Chunk> of_type(const std::vector<Chunk>& chunks, const std::string& type) {
  std::vector<Chunk> found;
  for (const Chunk& chunk : chunks) {
    if (chunk.type == type) found.push_back(chunk);
  }
  return found;
}

/// The pixels' zlib stream.
Bytes joined(const std::vector<Chunk>& chunks, std::size_t skipped) {
  Bytes all;
  for (const Chunk& chunk : chunks) {
    all.insert(all.end(), chunk.content.begin() + static_cast<std::ptrdiff_t>(skipped), chunk.content.end());
  }
  return all;
}

Image plain(int width, int height, float value) {
  Image image(width, height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x)
      image.set(x, y, Color3f(value, static_cast<float>(x % 256), static_cast<float>(y % 256)));
  }
  return image;
}

std::pair<std::uint32_t, std::uint32_t> delay(const Chunk& control) {
  return {number_at(control.content, 20, 2), number_at(control.content, 22, 2)};
}

std::pair<std::uint32_t, std::uint32_t> delay_at(double fps) {
  Apng apng(fps);
  apng.add(plain(1, 1, 0));
  return delay(of_type(chunks_of(apng.finish()), "fcTL").at(0));
}

}  // namespace

TEST_CASE("a PNG that moves has its chunks in order, and sequence numbers without a gap") {
  Apng apng(24);
  for (const float value : {10.0f, 20.0f, 30.0f})
    apng.add(plain(300, 200, value));  // several pieces of pixels each
  const std::vector<Chunk> chunks = chunks_of(apng.finish());
  CHECK(chunks.front().type == "IHDR");
  CHECK(chunks.back().type == "IEND");
  std::string order;
  std::uint32_t sequence = 0;
  for (const Chunk& chunk : chunks) {
    if (chunk.type == "fcTL" || chunk.type == "fdAT") CHECK(number_at(chunk.content, 0) == sequence++);
    if (order.empty() || !order.ends_with(chunk.type)) order += ' ' + chunk.type;
  }
  CHECK(order == " IHDR tEXt acTL fcTL IDAT fcTL fdAT fcTL fdAT IEND");
  const Chunk control = of_type(chunks, "acTL").at(0);
  CHECK(number_at(control.content, 0) == 3);
  CHECK(number_at(control.content, 4) == 0);  // for ever
  for (const Chunk& frame : of_type(chunks, "fcTL")) {
    REQUIRE(frame.content.size() == 26);
    CHECK(number_at(frame.content, 4) == 300);
    CHECK(number_at(frame.content, 8) == 200);
    CHECK(number_at(frame.content, 12) == 0);
    CHECK(number_at(frame.content, 16) == 0);
    CHECK(delay(frame) == std::pair{1U, 24U});
    CHECK(number_at(frame.content, 24, 2) == 0);
  }
}

TEST_CASE("its frames hold the same bytes as PNGs of their own") {
  Apng apng(24);
  const Image first = plain(300, 200, 10), second = plain(300, 200, 20);
  apng.add(first);
  apng.add(second);
  const std::vector<Chunk> chunks = chunks_of(apng.finish());
  CHECK(joined(of_type(chunks, "IDAT"), 0) == joined(of_type(chunks_of(encode_png(first)), "IDAT"), 0));
  CHECK(joined(of_type(chunks, "fdAT"), 4) == joined(of_type(chunks_of(encode_png(second)), "IDAT"), 0));
}

TEST_CASE("a frame that is repeated is shown longer") {
  Apng apng(24);
  apng.add(plain(2, 2, 10));
  apng.repeat();
  apng.repeat();
  apng.add(plain(2, 2, 20));
  const std::vector<Chunk> chunks = chunks_of(apng.finish());
  CHECK(number_at(of_type(chunks, "acTL").at(0).content, 0) == 2);
  CHECK(delay(of_type(chunks, "fcTL").at(0)) == std::pair{3U, 24U});
  CHECK(delay(of_type(chunks, "fcTL").at(1)) == std::pair{1U, 24U});
}

TEST_CASE("a frame that is shown longer than a delay can say comes again") {
  Apng apng(0.001);  // 1000 s a frame; a delay holds 65535
  apng.add(plain(2, 2, 10));
  for (int i = 1; i < 100; ++i) apng.repeat();
  std::uint32_t total = 0;
  const std::vector<Chunk> chunks = chunks_of(apng.finish());
  for (const Chunk& control : of_type(chunks, "fcTL")) total += delay(control).first / delay(control).second;
  CHECK(total == 100'000);
  CHECK(of_type(chunks, "fcTL").size() == 2);
  CHECK(number_at(of_type(chunks, "acTL").at(0).content, 0) == 2);
}

TEST_CASE("frames per second as a fraction of 16 bits") {
  CHECK(delay_at(1) == std::pair{1U, 1U});
  CHECK(delay_at(25) == std::pair{1U, 25U});
  CHECK(delay_at(1000) == std::pair{1U, 1000U});
  CHECK(delay_at(0.001) == std::pair{1000U, 1U});
  CHECK(delay_at(12.5) == std::pair{2U, 25U});
  CHECK(delay_at(29.97) == std::pair{100U, 2997U});
  CHECK(delay_at(24000.0 / 1001) == std::pair{1001U, 24000U});
  const auto [numerator, denominator] = delay_at(3.14159265358979);
  CHECK(std::abs(numerator / static_cast<double>(denominator) * 3.14159265358979 - 1) < 1e-6);
}

TEST_CASE("pictures of different sizes make no film") {
  Apng apng(24);
  apng.add(plain(2, 2, 10));
  CHECK_THROWS_AS(apng.add(plain(3, 2, 10)), raytracer::Error);
}

TEST_CASE("a PNG's remarks are read back") {
  const TemporaryFolder folder;
  const std::string path = folder / "a.png";
  const Bytes file = raytracer::encode_png_with({{"Scene-Hash", "abc"}, {"Empty", ""}}, plain(3, 3, 1));
  raytracer::write_file(path, file);
  CHECK(raytracer::read_png_text(path, "Scene-Hash") == "abc");
  CHECK(raytracer::read_png_text(path, "Empty") == "");
  CHECK(raytracer::read_png_text(path, "Software") == "raytracer");
  CHECK_FALSE(raytracer::read_png_text(path, "Scene"));
  CHECK_FALSE(raytracer::read_png_text(folder / "missing.png", "Scene-Hash"));
  CHECK_FALSE(raytracer::read_png_text(folder.path(), "Scene-Hash"));
}

TEST_CASE("a PNG that is damaged says nothing") {
  const TemporaryFolder folder;
  const std::string path = folder / "a.png";
  const Bytes file = raytracer::encode_png_with({{"Scene-Hash", "abc"}}, plain(3, 3, 1));
  for (std::size_t size = 0; size < file.size(); ++size) {
    raytracer::write_file(path, Bytes(file.begin(), file.begin() + static_cast<std::ptrdiff_t>(size)));
    INFO(size);
    CHECK_FALSE(raytracer::read_png_text(path, "Scene-Hash"));
  }
  const std::string text(file.begin(), file.end());
  Bytes other = file;
  other[text.find("abc")] = 'x';
  raytracer::write_file(path, other);
  CHECK_FALSE(raytracer::read_png_text(path, "Scene-Hash"));
}
