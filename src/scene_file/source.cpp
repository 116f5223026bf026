#include "scene_file/source.hpp"

#include <algorithm>
#include <utility>

namespace raytracer::scene_file {
namespace {

bool is_continuation_byte(char c) { return (static_cast<unsigned char>(c) & 0xC0U) == 0x80U; }

}  // namespace

Source::Source(std::string name, std::string path, std::string text)
    : name_(std::move(name)), path_(std::move(path)), text_(std::move(text)) {}

LineColumn Source::locate(std::uint32_t offset) const {
  if (line_starts_.empty()) {
    line_starts_.push_back(0);
    for (std::uint32_t i = 0; i < text_.size(); ++i) {
      const bool lone_return = text_[i] == '\r' && (i + 1 == text_.size() || text_[i + 1] != '\n');
      if (text_[i] == '\n' || lone_return) line_starts_.push_back(i + 1);
    }
  }
  const auto next = std::upper_bound(line_starts_.begin(), line_starts_.end(), offset);
  const auto line = static_cast<std::uint32_t>(next - line_starts_.begin());
  std::uint32_t start = *(next - 1);
  constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
  if (start == 0 && text_.starts_with(kByteOrderMark)) {
    start = std::min(offset, static_cast<std::uint32_t>(kByteOrderMark.size()));
  }
  const auto characters = std::count_if(text_.begin() + start, text_.begin() + offset,
                                        [](char c) { return !is_continuation_byte(c); });
  return {line, static_cast<std::uint32_t>(characters) + 1};
}

std::string_view Source::line_at(std::uint32_t offset, std::uint32_t reach) const {
  std::size_t first = offset > reach ? offset - reach : 0;
  std::size_t last = text_.size() - offset > reach ? offset + reach : text_.size();
  while (first > 0 && first < offset && is_continuation_byte(text_[first])) ++first;
  while (last > offset && last < text_.size() && is_continuation_byte(text_[last])) --last;
  const std::string_view text = std::string_view(text_).substr(0, last);
  const std::size_t before = text.substr(first, offset - first).find_last_of("\r\n");
  const std::size_t start = before == std::string_view::npos ? first : first + before + 1;
  const std::size_t end = std::min(text.find_first_of("\r\n", start), text.size());
  std::string_view line = text.substr(start, end - start);
  if (start == 0 && line.starts_with("\xEF\xBB\xBF")) line.remove_prefix(3);
  return line;
}

}  // namespace raytracer::scene_file
