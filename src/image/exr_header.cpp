#include "image/exr_header.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <optional>
#include <string_view>
#include <utility>

#include "core/printable.hpp"
#include "image/picture.hpp"
#include "raytracer/error.hpp"

namespace raytracer {
namespace {

Error broken(const std::string& why) { return {ErrorKind::kScene, "the EXR is broken: " + why}; }

/// Little-endian numbers and words that end in 0, never beyond the end.
class Bytes {
 public:
  explicit Bytes(ByteSpan bytes) : bytes_(bytes) {}

  std::uint8_t byte() { return take(1)[0]; }
  std::int32_t number() {
    const ByteSpan four = take(4);
    std::uint32_t value = 0;
    for (std::size_t i = 4; i-- > 0;) value = value << 8U | four[i];
    return static_cast<std::int32_t>(value);
  }
  std::string word() {
    const auto* begin = bytes_.data() + position_;
    const auto* end = std::find(begin, bytes_.data() + bytes_.size(), std::uint8_t{0});
    if (end == bytes_.data() + bytes_.size() || end - begin > 255) throw broken("its header has no end");
    position_ += static_cast<std::size_t>(end - begin) + 1;
    return {begin, end};
  }
  ByteSpan take(std::size_t count) {
    if (count > bytes_.size() - position_) throw broken("it ends in its header");
    position_ += count;
    return bytes_.subspan(position_ - count, count);
  }
  bool is_at_end() const { return position_ == bytes_.size(); }

 private:
  ByteSpan bytes_;
  std::size_t position_ = 0;
};

/// All that decides how much the library takes.
struct Part {
  std::optional<ExrWindow> data, display;
  std::vector<ExrChannel> channels;
  int compression = 0;
  std::optional<std::pair<std::int32_t, std::int32_t>> tile;
  std::string type;
  std::int32_t chunks = 0;
};

ExrWindow read_window(Bytes value) {
  ExrWindow window;
  for (std::int32_t* corner : {&window.x0, &window.y0, &window.x1, &window.y1}) *corner = value.number();
  return window;
}

std::vector<ExrChannel> read_channels(Bytes value) {
  std::vector<ExrChannel> channels;
  for (std::string name = value.word(); !name.empty(); name = value.word()) {
    ExrChannel channel{std::move(name), value.number()};
    value.take(4);  // what it means for compression
    channel.x_sampling = value.number();
    channel.y_sampling = value.number();
    if (channel.type < 0 || channel.type > 2)
      throw broken(fmt::format("channel {} has no type", printable(channel.name)));
    channels.push_back(std::move(channel));
  }
  return channels;
}

/// False at the end of the part.
bool read_attribute(Bytes& bytes, Part& part) {
  const std::string name = bytes.word();
  if (name.empty()) return false;
  const std::string type = bytes.word();
  const std::int32_t size = bytes.number();
  if (size < 0) throw broken(fmt::format("attribute {} has a negative size", printable(name)));
  const ByteSpan content = bytes.take(static_cast<std::size_t>(size));
  Bytes value(content);
  if (name == "dataWindow") part.data = read_window(value);
  if (name == "displayWindow") part.display = read_window(value);
  if (name == "channels") part.channels = read_channels(value);
  if (name == "compression") part.compression = value.byte();
  if (name == "tiles") {
    const std::int32_t width = value.number();
    part.tile = std::pair(width, value.number());
  }
  if (name == "type") part.type = std::string(content.begin(), content.end());
  if (name == "chunkCount") part.chunks = value.number();
  return true;
}

// By the numbers of the compressions: none, RLE, ZIPS, ZIP, PIZ, PXR24, B44, B44A, DWAA, DWAB.
std::int64_t rows_of_chunk(int compression) {
  constexpr std::array kRows = {1, 1, 1, 16, 32, 16, 32, 32, 32, 256};
  if (compression >= static_cast<int>(kRows.size())) throw broken("its compression is unknown");
  return kRows[static_cast<std::size_t>(compression)];
}

// Every chunk has an entry of 8 bytes in a table; what is not there need not be looked for.
void check_table(const Part& part, std::size_t file_size) {
  const std::int64_t width = part.data->width(), height = part.data->height();
  std::int64_t chunks = 0;
  if (part.tile) {
    const auto [tile_width, tile_height] = *part.tile;
    if (tile_width <= 0 || tile_height <= 0) throw broken("its tiles have no size");
    if (std::int64_t{tile_width} * tile_height > static_cast<std::int64_t>(kLargestTexels) / 4) {
      throw broken(fmt::format("its tiles are {} x {} pixels", tile_width, tile_height));
    }
    chunks = ((width - 1) / tile_width + 1) * ((height - 1) / tile_height + 1);
  } else {
    chunks = (height - 1) / rows_of_chunk(part.compression) + 1;
  }
  chunks = std::max(chunks, std::int64_t{part.chunks});
  if (chunks > static_cast<std::int64_t>(file_size / 8)) {
    throw broken(
        fmt::format("it says that its pixels are in {} pieces, more than fit into the file", chunks));
  }
}

void check_window(const ExrWindow& window, const char* name) {
  constexpr std::int64_t kLongestSide = std::int64_t{1} << 17U;
  // Far corners make the library's sums overflow.
  constexpr std::int32_t kFarthest = 1 << 29;
  const std::int64_t width = window.width(), height = window.height();
  if (width <= 0 || height <= 0) throw broken(fmt::format("its {} has no pixels", name));
  for (const std::int32_t corner : {window.x0, window.y0, window.x1, window.y1}) {
    if (corner < -kFarthest || corner > kFarthest) throw broken(fmt::format("its {} is too far out", name));
  }
  if (width > kLongestSide || height > kLongestSide ||
      width * height > static_cast<std::int64_t>(kLargestTexels)) {
    throw Error(ErrorKind::kScene,
                fmt::format("the EXR's {} is {} x {} pixels; at most {} million can be read", name, width,
                            height, kLargestTexels / 1000000));
  }
}

void check_part(const Part& part, std::size_t file_size) {
  if (!part.data || !part.display) throw broken("it does not say its size");
  if (part.channels.empty()) throw broken("it has no channels");
  if (part.channels.size() > 1024) throw broken("it has more than 1024 channels");
  check_window(*part.data, "data window");
  check_window(*part.display, "display window");
  check_table(part, file_size);
}

}  // namespace

ExrHeader read_exr_header(ByteSpan file) {
  constexpr std::uint32_t kTiled = 0x200, kDeep = 0x800, kMultiPart = 0x1000;
  Bytes bytes(file);
  bytes.take(4);
  const auto version = static_cast<std::uint32_t>(bytes.number());
  if ((version & 0xFFU) != 2) throw broken(fmt::format("its version is {}, not 2", version & 0xFFU));
  std::optional<Part> first;
  const bool is_multi_part = (version & kMultiPart) != 0;
  do {
    Part part;
    bool is_empty = true;
    while (read_attribute(bytes, part)) is_empty = false;
    if (is_empty && first) break;  // the end of a multi-part file's headers
    if ((version & kTiled) == 0 && !part.type.starts_with("tiled")) part.tile.reset();
    check_part(part, file.size());
    if (!first) first = std::move(part);
  } while (is_multi_part);
  return {*first->data, *first->display, std::move(first->channels),
          (version & kDeep) != 0 || first->type.starts_with("deep")};
}

}  // namespace raytracer
