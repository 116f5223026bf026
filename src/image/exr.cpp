// Pictures as OpenEXR (https://openexr.com/en/latest/OpenEXRFileLayout.html). The only door to that library.
#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfOutputFile.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <new>
#include <utility>

#include "image/encode.hpp"
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

}  // namespace raytracer
