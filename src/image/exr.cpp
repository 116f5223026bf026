// Pictures as OpenEXR (https://openexr.com/en/latest/OpenEXRFileLayout.html). The only door to that library.
#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfInputFile.h>
#include <ImfOutputFile.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <new>
#include <stdexcept>
#include <string>
#include <utility>

#include "core/parallel.hpp"
#include "core/printable.hpp"
#include "image/encode.hpp"
#include "image/exr_header.hpp"
#include "image/readers.hpp"
#include "raytracer/error.hpp"

namespace raytracer {
namespace {

/// A file in memory.
class BytesOut : public Imf::OStream {
 public:
  BytesOut() : Imf::OStream("picture") {}

  void write(const char bytes[], int count) override {
    const auto size = static_cast<std::size_t>(count);
    if (bytes_.size() < position_ + size) bytes_.resize(position_ + size);
    std::memcpy(bytes_.data() + position_, bytes, size);
    position_ += size;
  }
  std::uint64_t tellp() override { return position_; }
  void seekp(std::uint64_t position) override { position_ = position; }

  std::vector<std::uint8_t> take() { return std::move(bytes_); }

 private:
  std::vector<std::uint8_t> bytes_;
  std::size_t position_ = 0;
};

constexpr std::array<const char*, 3> kChannels = {"R", "G", "B"};

/// 255 is white in an Image, 1 in the file.
std::array<std::vector<float>, 3> whites_of_one(const Image& image) {
  std::array<std::vector<float>, 3> planes;
  const std::array<const std::vector<float>*, 3> sources = {&image.red, &image.green, &image.blue};
  for (std::size_t c = 0; c < 3; ++c) {
    planes[c].resize(sources[c]->size());
    std::transform(sources[c]->begin(), sources[c]->end(), planes[c].begin(),
                   [](float v) { return v / 255; });
  }
  return planes;
}

// Nothing goes into the header that is not the picture's own: no date, no program, so that the same picture
// is the same file. The primaries are the default ones, which are Rec.709's.
std::vector<std::uint8_t> exr_of(const Image& image) {
  Imf::Header header(image.width, image.height);
  header.compression() = Imf::ZIP_COMPRESSION;
  std::array<std::vector<float>, 3> planes = whites_of_one(image);
  Imf::FrameBuffer pixels;
  for (std::size_t c = 0; c < 3; ++c) {
    header.channels().insert(kChannels[c], Imf::Channel(Imf::FLOAT));
    pixels.insert(kChannels[c],
                  Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(planes[c].data()), sizeof(float),
                             sizeof(float) * static_cast<std::size_t>(image.width)));
  }
  BytesOut out;
  {
    Imf::OutputFile file(out, header);
    file.setFrameBuffer(pixels);
    file.writePixels(image.height);
  }  // the destructor writes the table of offsets
  return out.take();
}

// --- reading ------------------------------------------------------------------------------------------

/// A file that is in memory.
class BytesIn : public Imf::IStream {
 public:
  explicit BytesIn(ByteSpan bytes) : Imf::IStream("picture"), bytes_(bytes) {}

  bool isMemoryMapped() const override { return true; }
  char* readMemoryMapped(int count) override {
    // The library only reads what it is pointed to.
    return const_cast<char*>(reinterpret_cast<const char*>(advance(count)));
  }
  bool read(char out[], int count) override {
    std::memcpy(out, advance(count), static_cast<std::size_t>(count));
    return position_ < bytes_.size();
  }
  std::uint64_t tellg() override { return position_; }
  void seekg(std::uint64_t position) override { position_ = position; }

 private:
  const std::uint8_t* advance(int count) {
    if (count < 0 || position_ > bytes_.size() ||
        static_cast<std::size_t>(count) > bytes_.size() - position_) {
      throw std::runtime_error("it ends too early");
    }
    position_ += static_cast<std::size_t>(count);
    return bytes_.data() + position_ - count;
  }

  ByteSpan bytes_;
  std::size_t position_ = 0;
};

/// The channels that make a picture, in the order of a texel. "" stands for one of zeros.
struct ChosenChannels {
  std::vector<std::string> names;
  bool is_half = true;
};

const ExrChannel* find_channel(const ExrHeader& header, const std::string& name) {
  const auto found = std::find_if(header.channels.begin(), header.channels.end(),
                                  [&](const ExrChannel& channel) { return channel.name == name; });
  return found == header.channels.end() ? nullptr : &*found;
}

/// The layers' names with their dots; the one without a name first.
std::vector<std::string> layers_of(const ExrHeader& header) {
  std::vector<std::string> layers = {""};
  for (const ExrChannel& channel : header.channels) {
    const std::size_t dot = channel.name.rfind('.');
    if (dot == std::string::npos) continue;
    const std::string layer = channel.name.substr(0, dot + 1);
    if (std::find(layers.begin(), layers.end(), layer) == layers.end()) layers.push_back(layer);
  }
  return layers;
}

/// What programs call the colours.
struct ColorNames {
  const char *red, *green, *blue, *alpha;
};
constexpr std::array<ColorNames, 3> kColorNames = {
    {{"R", "G", "B", "A"}, {"r", "g", "b", "a"}, {"red", "green", "blue", "alpha"}}};

/// The colours of a layer; none if it has none.
std::vector<std::string> colors_in(const ExrHeader& header, const std::string& layer) {
  const auto has = [&](const char* name) { return find_channel(header, layer + name) != nullptr; };
  const auto name_of = [&](const char* name) { return has(name) ? layer + name : std::string(); };
  if (has("RY") || has("BY")) {
    throw Error(ErrorKind::kScene,
                "the EXR's colours are luminance and chroma (Y, RY, BY), which can't be read");
  }
  for (const auto& [red, green, blue, alpha] : kColorNames) {
    if (!has(red) && !has(green) && !has(blue)) continue;
    std::vector<std::string> names = {name_of(red), name_of(green), name_of(blue)};
    if (has(alpha)) names.push_back(name_of(alpha));
    return names;
  }
  if (!has("Y")) return {};
  if (has("A")) return {name_of("Y"), name_of("A")};
  return {name_of("Y")};
}

std::string all_names(const ExrHeader& header) {
  std::string names;
  for (std::size_t i = 0; i < header.channels.size() && i < 8; ++i) {
    names += (i == 0 ? "" : ", ") + header.channels[i].name;
  }
  return header.channels.size() > 8 ? names + ", ..." : names;
}

ChosenChannels choose_channels(const ExrHeader& header) {
  ChosenChannels chosen;
  if (header.channels.size() == 1) {  // a grey, a height or a mask, whatever it is called
    chosen.names = {header.channels[0].name};
  } else {
    for (const std::string& layer : layers_of(header)) {
      chosen.names = colors_in(header, layer);
      if (!chosen.names.empty()) break;
    }
  }
  if (chosen.names.empty()) {
    throw Error(ErrorKind::kScene,
                fmt::format("the EXR has no channel R, G, B or Y, but {}", printable(all_names(header))));
  }
  for (const std::string& name : chosen.names) {
    if (name.empty()) continue;
    const ExrChannel* channel = find_channel(header, name);
    chosen.is_half = chosen.is_half && channel->type == Imf::HALF;
    if (channel->x_sampling == 1 && channel->y_sampling == 1) continue;
    throw Error(ErrorKind::kScene,
                fmt::format("the EXR's channel {} has fewer pixels than the picture", printable(name)));
  }
  return chosen;
}

/// Rows first … last of the data window into `pixels`, which begins with row first.
void read_rows(Imf::InputFile& file, const ExrHeader& header, const ChosenChannels& chosen, int first,
               int last, std::uint8_t* pixels) {
  const std::size_t channel_bytes = chosen.is_half ? 2 : 4, step = channel_bytes * chosen.names.size();
  const std::size_t row_bytes = step * static_cast<std::size_t>(header.data.width());
  // The library counts rows and columns from the origin, which may be far from the window.
  const auto origin = reinterpret_cast<std::uintptr_t>(pixels) -
                      static_cast<std::uintptr_t>(std::int64_t{first}) * row_bytes -
                      static_cast<std::uintptr_t>(std::int64_t{header.data.x0}) * step;
  Imf::FrameBuffer buffer;
  for (std::size_t c = 0; c < chosen.names.size(); ++c) {
    if (chosen.names[c].empty()) continue;
    buffer.insert(chosen.names[c],
                  Imf::Slice(chosen.is_half ? Imf::HALF : Imf::FLOAT,
                             reinterpret_cast<char*>(origin + c * channel_bytes), step, row_bytes));
  }
  file.setFrameBuffer(buffer);
  file.readPixels(first, last);
}

// "Cannot read image file "picture". Its table is broken." without what the user knows.
std::string reason_of(const std::exception& problem) {
  const std::string text = problem.what();
  const std::size_t at = text.rfind("\"picture\". ");
  std::string reason = at == std::string::npos ? text : text.substr(at + 11);
  while (reason.ends_with('.') || reason.ends_with('\n')) reason.pop_back();
  return reason;
}

/// The data window's rows first … last, as much of them as the display window shows.
void read_band(ByteSpan bytes, const ExrHeader& header, const ChosenChannels& chosen, int first, int last,
               Picture& picture) {
  BytesIn stream(bytes);
  Imf::InputFile file(stream, 0);
  const std::size_t step = picture.texel_bytes();
  const ExrWindow& from = header.data;
  const ExrWindow& to = header.display;
  if (from.x0 == to.x0 && from.x1 == to.x1 && first >= to.y0 && last <= to.y1) {
    read_rows(file, header, chosen, first, last, picture.row(first - to.y0));
    return;
  }
  const std::size_t row_bytes = step * static_cast<std::size_t>(from.width());
  std::vector<std::uint8_t> band(row_bytes * static_cast<std::size_t>(last - first + 1));
  read_rows(file, header, chosen, first, last, band.data());
  const int x0 = std::max(from.x0, to.x0), x1 = std::min(from.x1, to.x1);
  for (int y = std::max(first, to.y0); y <= std::min(last, to.y1) && x0 <= x1; ++y) {
    std::memcpy(picture.row(y - to.y0) + step * static_cast<std::size_t>(x0 - to.x0),
                band.data() + row_bytes * static_cast<std::size_t>(y - first) +
                    step * static_cast<std::size_t>(x0 - from.x0),
                step * static_cast<std::size_t>(x1 - x0 + 1));
  }
}

// Bands of whole chunks, whatever the compression, each with a reader of its own: so all threads unpack.
void read_bands(ByteSpan bytes, const ExrHeader& header, const ChosenChannels& chosen, Picture& picture) {
  constexpr std::int64_t kBand = 256, kMostBands = 16;
  const std::int64_t height = header.data.height();
  const std::int64_t rows = ((height - 1) / (kBand * kMostBands) + 1) * kBand;
  parallel_for(static_cast<std::size_t>((height - 1) / rows + 1), [&](std::size_t band) {
    const std::int64_t first = static_cast<std::int64_t>(band) * rows;
    read_band(bytes, header, chosen, header.data.y0 + static_cast<int>(first),
              header.data.y0 + static_cast<int>(std::min(first + rows, height) - 1), picture);
  });
}

}  // namespace

std::vector<std::uint8_t> encode_exr(const Image& image) {
  return encode_checked(image, [&] {
    try {
      return exr_of(image);
    } catch (const std::bad_alloc&) {
      throw;
    } catch (const std::exception& problem) {
      throw Error(ErrorKind::kFile, fmt::format("can't make an EXR: {}", problem.what()));
    }
  });
}

Picture read_exr(ByteSpan bytes) {
  const ExrHeader header = read_exr_header(bytes);
  if (header.is_deep) {
    throw Error(ErrorKind::kScene, "the EXR is a deep one, many values a pixel, which can't be read");
  }
  const ChosenChannels chosen = choose_channels(header);
  const auto channels = static_cast<int>(chosen.names.size());
  const auto pixels = static_cast<std::size_t>(header.data.width() * header.data.height());
  check_plausible(pixels * chosen.names.size() * (chosen.is_half ? 2U : 4U), bytes.size());
  Picture picture(static_cast<int>(header.display.width()), static_cast<int>(header.display.height()),
                  channels, chosen.is_half ? TexelType::kHalf : TexelType::kFloat, PictureCurve::kLinear);
  std::memset(picture.data.get(), 0, picture.bytes());  // what the data window leaves out is black
  try {
    read_bands(bytes, header, chosen, picture);
  } catch (const Error&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw Error(ErrorKind::kScene, "there is not enough memory to read it");
  } catch (const std::exception& problem) {
    throw Error(ErrorKind::kScene, fmt::format("the EXR is broken: {}", reason_of(problem)));
  }
  return picture;
}

}  // namespace raytracer
