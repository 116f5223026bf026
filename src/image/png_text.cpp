#include "image/png_text.hpp"

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <utility>

#include "image/zlib_pieces.hpp"

namespace raytracer {
namespace {

constexpr std::string_view kSignature = "\x89PNG\r\n\x1A\n";
constexpr std::string_view kEnd("\0\0\0\0IEND\xAE\x42\x60\x82", 12);

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

// The content of the next chunk, whose checksum is right; nothing where there is none.
std::optional<std::string> take_chunk(std::istream& file, std::uintmax_t most, std::string& type) {
  const std::string head = take(file, 8);
  if (head.size() < 8 || number_at(head, 0) > most) return std::nullopt;
  type = head.substr(4);
  std::string content = take(file, number_at(head, 0));
  const std::string checksum = take(file, 4), summed = type + content;
  const bool is_sound = checksum.size() == 4 && crc32_of(reinterpret_cast<const std::uint8_t*>(summed.data()),
                                                         summed.size()) == number_at(checksum, 0);
  return is_sound ? std::optional(std::move(content)) : std::nullopt;
}

}  // namespace

std::optional<std::string> read_png_text(const std::string& path, std::string_view keyword) {
  std::ifstream file(path, std::ios::binary);
  if (!file || !is_whole(file)) return std::nullopt;
  std::error_code unknown;
  const std::uintmax_t most = std::filesystem::file_size(path, unknown);  // that a chunk can hold
  std::optional<std::string> text;
  bool has_pixels = false;
  for (std::string type; type != "IEND";) {
    const std::optional<std::string> content = take_chunk(file, unknown ? 0 : most, type);
    if (!content) return std::nullopt;
    has_pixels = has_pixels || type == "IDAT";
    const std::size_t name_size = content->find('\0');
    const bool is_it = type == "tEXt" && !has_pixels && name_size != std::string::npos &&
                       content->substr(0, name_size) == keyword;
    if (is_it && !text) text = content->substr(name_size + 1);
  }
  return text;
}

}  // namespace raytracer
