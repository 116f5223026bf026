#include "image/png_text.hpp"

#include <cstdint>
#include <fstream>

#include "image/zlib_pieces.hpp"

namespace raytracer {
namespace {

constexpr std::string_view kSignature = "\x89PNG\r\n\x1A\n";
constexpr std::string_view kEnd("\0\0\0\0IEND\xAE\x42\x60\x82", 12);
constexpr std::uint32_t kLongestText = 1 << 16;

std::uint32_t number_at(const std::string& bytes, std::size_t at) {
  std::uint32_t number = 0;
  for (std::size_t i = at; i < at + 4; ++i) number = number << 8U | static_cast<unsigned char>(bytes[i]);
  return number;
}

// Reads that many bytes; fewer at the file's end.
std::string take(std::istream& file, std::size_t count) {
  std::string bytes(count, '\0');
  file.read(bytes.data(), static_cast<std::streamsize>(count));
  bytes.resize(static_cast<std::size_t>(file.gcount()));
  return bytes;
}

bool is_whole(std::istream& file) {
  file.seekg(-static_cast<std::streamoff>(kEnd.size()), std::ios::end);
  const bool ends_well = take(file, kEnd.size()) == kEnd;
  file.seekg(0);
  return ends_well && take(file, kSignature.size()) == kSignature;
}

}  // namespace

std::optional<std::string> read_png_text(const std::string& path, std::string_view keyword) {
  std::ifstream file(path, std::ios::binary);
  if (!file || !is_whole(file)) return std::nullopt;
  while (true) {
    const std::string head = take(file, 8);
    if (head.size() < 8) return std::nullopt;
    const std::uint32_t size = number_at(head, 0);
    const std::string type = head.substr(4);
    if (type == "IDAT" || size > kLongestText) return std::nullopt;
    const std::string content = take(file, size), checksum = take(file, 4);
    if (checksum.size() < 4) return std::nullopt;
    const std::string summed = type + content;
    const bool is_sound = crc32_of(reinterpret_cast<const std::uint8_t*>(summed.data()), summed.size()) ==
                          number_at(checksum, 0);
    const std::size_t name_size = content.find('\0');
    if (type == "tEXt" && is_sound && name_size != std::string::npos &&
        content.substr(0, name_size) == keyword) {
      return content.substr(name_size + 1);
    }
  }
}

}  // namespace raytracer
